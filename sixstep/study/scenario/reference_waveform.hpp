// SPDX-License-Identifier: Apache-2.0
// The reference over a whole run in closed form: intervals that are constant or move, [[at]] events included.
#pragma once
#include <optional>
#include <vector>

#include "sixstep/rig/timeline.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// An interval from at_s to the beginning of the next interval.
struct Stretch {
  double at_s = 0.0;
  double value = 0.0;  ///< value at at_s
  rig::Waveform waveform{};

  double at(double t_s) const { return waveform.after(value, t_s - at_s); }
};

/// The intervals in time order, the first at 0. Requires that check_references() found nothing.
std::vector<Stretch> reference_waveform(const Scenario& scenario);

/// The reference's constant values over time: {instant, value}, the first at 0. A moving interval counts with
/// the value at its end, so that the constant value after it is no step.
struct Level {
  double at_s = 0.0;
  double value = 0.0;
};
std::vector<Level> reference_levels(const Scenario& scenario);

/// The largest magnitude of the reference during the run; for a sine an upper bound.
double largest_reference(const Scenario& scenario);

/// True if the reference moves anywhere in [from_s, to_s).
bool reference_moves(const Scenario& scenario, double from_s, double to_s);

/// Time in s after which the reference would stay constant if the run continued. It may lie after the run's
/// end. It is 0 if the reference never moves; steps and square waves do not count as movement. Empty if the
/// reference never rests: a sine, or a movement longer than any run.
std::optional<double> reference_rests_from_s(const Scenario& scenario);

}  // namespace sixstep::study
