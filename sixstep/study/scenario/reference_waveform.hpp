// SPDX-License-Identifier: Apache-2.0
// The reference over a whole run in closed form: intervals that are constant or move, [[at]] events included.
#pragma once
#include <optional>
#include <vector>

#include "sixstep/rig/timeline.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// An interval from at_s to the begin of the next one.
struct Stretch {
  double at_s = 0.0;
  double value = 0.0;  ///< at at_s
  rig::Waveform waveform{};

  double at(double t_s) const { return waveform.after(value, t_s - at_s); }
};

/// Rising in time, the first at 0. Requires that check_references() found nothing.
std::vector<Stretch> reference_waveform(const Scenario& scenario);

/// The reference's constant values over time: {instant, value}, the first at 0. A moving interval has its end's
/// value, because the value after it is no step.
struct Level {
  double at_s = 0.0;
  double value = 0.0;
};
std::vector<Level> reference_levels(const Scenario& scenario);

/// The largest magnitude of the reference during the run; for a sine an upper bound.
double largest_reference(const Scenario& scenario);

/// Whether the reference moves anywhere in [from_s, to_s).
bool reference_moves(const Scenario& scenario, double from_s, double to_s);

/// Time in s after which the reference would not move any more if the run continued. It may lie after the
/// run's end. 0 if it never moves. Steps and square waves are no movement. Empty: a sine, or a movement
/// longer than any run.
std::optional<double> reference_rests_from_s(const Scenario& scenario);

}  // namespace sixstep::study
