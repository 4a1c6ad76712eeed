// SPDX-License-Identifier: Apache-2.0
// Finds currents that the winding does not withstand permanently, in runs whose own temperatures do not show
// it: a run without temperatures, and a run that ends long before the winding is warm.
#pragma once
#include <string>

#include "sixstep/design/sheet/thermal_ranges.hpp"
#include "sixstep/study/measure/end_watch.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// ": ... withstands this current for 12.8 s from 25 degC, and by the worse ends of the thermal ranges for 6.82 s".
std::string withstood(const design::WithstandTimes& times, double ambient_degC);

/// Applies the run's mean copper loss to the sheet's thermal model, from ambient temperature on. Empty if the
/// winding stays below its limit within the run, and if temperatures are simulated.
std::string on_cold_winding(const Scenario& scenario, const Outcome& outcome);

/// The steady copper loss at the run's end, with the time for which the winding withstands it. Empty if the
/// winding withstands it permanently, and without both thermal values and a nominal current. `winding_degC`:
/// the winding's temperature at the end, which raises the loss in a run with temperatures.
std::string on_kept_current(const Scenario& scenario, const EndWatch& watch, double winding_degC,
                            const design::MotorModel& motor);

}  // namespace sixstep::study
