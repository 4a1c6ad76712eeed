// SPDX-License-Identifier: Apache-2.0
// The reference over a whole run, in closed form: stretches that stand or move, [[at]] events included.
#pragma once
#include <optional>
#include <vector>

#include "sixstep/rig/timeline.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// From at_s on, until the next stretch begins.
struct Stretch {
  double at_s = 0.0;
  double value = 0.0;  ///< at at_s
  rig::Waveform waveform{};

  double at(double t_s) const { return waveform.after(value, t_s - at_s); }
};

/// Rising in time, the first at 0. Assumes that check_reference() found nothing.
std::vector<Stretch> reference_waveform(const Scenario& scenario);

/// The reference's values over time: {instant, value}, first at 0. A stretch that moves counts as its end's
/// value, for what comes after it is no step.
struct Level {
  double at_s = 0.0;
  double value = 0.0;
};
std::vector<Level> reference_levels(const Scenario& scenario);

/// The largest magnitude of the reference during the run; of a sine a bound.
double largest_reference(const Scenario& scenario);

/// Whether the reference moves anywhere in [from_s, to_s).
bool reference_moves(const Scenario& scenario, double from_s, double to_s);

/// The instant in s from which on the reference would not move any more if the run went on, behind its end too; 0 where it never
/// moves. Steps and square waves are no movement. Empty: a sine, or a way longer than any run.
std::optional<double> reference_rests_from_s(const Scenario& scenario);

}  // namespace sixstep::study
