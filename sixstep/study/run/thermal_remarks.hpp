// SPDX-License-Identifier: Apache-2.0
// Finds losses that the winding does not withstand within the run, or not for ever if they go on.
#pragma once
#include <string>

#include "sixstep/design/sheet/thermal_ranges.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/winding_watch.hpp"

namespace sixstep::study {

/// ": ... withstands this current for 12.8 s from 25 degC, and by the worse ends of the thermal ranges for 6.82 s".
std::string withstood(const design::WithstandTimes& times, double start_degC);

/// A winding that passes its limit within a run without temperatures, by the sheet's thermal model along the run's
/// copper loss. Empty if it stays below.
std::string on_cold_winding(const Scenario& scenario, const WindingWatch& watch);

/// The copper loss that a drive keeps up at the run's end, the winding's temperature in the run, and the time at which
/// it reaches its limit if this current goes on. Empty if the winding withstands the loss, if it ends with a run-up, and
/// without both thermal values and a nominal current.
std::string on_kept_current(const Scenario& scenario, const WindingWatch& watch, const Compiled& compiled);

}  // namespace sixstep::study
