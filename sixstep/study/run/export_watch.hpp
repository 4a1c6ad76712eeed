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

/// The scenario with the measures that take_peaks() reads, appended to its [[compare]] entries.
Scenario watching_peaks(const Scenario& scenario);
/// Removes the measures of watching_peaks() from the outcome and returns their values. The outcome is then
/// the outcome of a run of `scenario`.
SeenPeaks take_peaks(const Scenario& scenario, Outcome& outcome);

/// Refuses a current above the converter's range, because such a current is neither measured nor limited.
void look_at_current_range(const Scenario& scenario, const SeenPeaks& peaks, base::Problems& out);
/// Refuses two kinds of bus voltage: above the converter's range, if the drive reads it (is_read); and raised
/// without a bound, by braking or by a load after a trip.
void look_at_bus(const Scenario& scenario, const SeenPeaks& peaks, bool is_read, const Listeners& listeners,
                 base::Problems& out);
/// Refuses a stop that ends in a fault. A product drive that brakes when its run request ends does so in the
/// first test on a bench. Therefore a second run stops it at its highest setpoint, unless the scenario
/// contains a stop.
void look_at_stop(const Scenario& scenario, const design::MotorModel& motor, const Listeners& listeners,
                  base::Problems& out);

}  // namespace sixstep::study
