// SPDX-License-Identifier: Apache-2.0
// Finds faults of a drive before its export that no [[require]] covers: currents and bus voltages beyond the
// converters' ranges, a bus that braking has raised, a stop that ends in a fault.
#pragma once
#include <optional>

#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

struct SeenPeaks {
  double phase_A = 0.0;        ///< largest magnitude of a phase current
  double bus_V = 0.0;          ///< highest voltage of the bus
  std::optional<Trip> trip{};  ///< the fault at which a product drive turned its bridge off
};

/// The scenario with the measures that take_peaks() reads, behind its own [[compare]] entries.
Scenario watching_peaks(const Scenario& scenario);
/// Removes these measures from the outcome, which is then that of `scenario` itself, and returns their
/// values.
SeenPeaks take_peaks(const Scenario& scenario, Outcome& outcome);

/// Refuses a current above the converter's range, because such a current is neither measured nor limited.
void look_at_current_range(const Scenario& scenario, const SeenPeaks& peaks, base::Problems& out);
/// Refuses a bus above its converter's range if the drive reads it, and a bus that braking, or a load after a
/// trip, raises without a bound.
void look_at_bus(const Scenario& scenario, const SeenPeaks& peaks, bool is_read, const Listeners& listeners,
                 base::Problems& out);
/// A product drive that brakes when its run request ends does so at its first test. Therefore it is stopped
/// here at its highest setpoint, unless the scenario has a stop of its own.
void look_at_stop(const Scenario& scenario, const design::MotorModel& motor, const Listeners& listeners,
                  base::Problems& out);

}  // namespace sixstep::study
