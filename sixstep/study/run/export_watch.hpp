// SPDX-License-Identifier: Apache-2.0
// What a run shows against a drive that is to be exported although no [[require]] asked for it: currents and a bus beyond what their
// converters read, a bus that braking has raised, a stop that ends in a fault.
#pragma once
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

struct SeenPeaks {
  double phase_A = 0.0;  ///< largest magnitude of a phase current
  double bus_V = 0.0;    ///< highest voltage of the bus
};

/// The scenario with the measures that take_peaks() reads, behind its own [[compare]].
Scenario watching_peaks(const Scenario& scenario);
/// Takes them out again: the outcome is then that of `scenario` itself.
SeenPeaks take_peaks(const Scenario& scenario, Outcome& outcome);

/// A current above the converter's end is neither seen nor limited.
void look_at_current_range(const Scenario& scenario, const SeenPeaks& peaks, base::Problems& out);
/// A bus above its converter's end where the drive reads it, and one that braking raises where nothing bounds it.
void look_at_bus(const Scenario& scenario, const SeenPeaks& peaks, bool is_read, base::Problems& out);
/// A product drive that brakes when it is let go does so on the first bench: here it is run at its highest setpoint, unless the
/// scenario has a stop of its own.
void look_at_stop(const Scenario& scenario, const design::MotorModel& motor, const Listeners& listeners,
                  base::Problems& out);

}  // namespace sixstep::study
