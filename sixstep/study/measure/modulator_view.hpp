// SPDX-License-Identifier: Apache-2.0
// The modulator as figures and recorders see it, whichever it is: six-step's, which has a pair, a sign and comparators, that of
// three legs, which has none of them, or the gates that a chip sets itself.
#pragma once
#include <algorithm>

#include "sixstep/rig/gate_modulator.hpp"
#include "sixstep/rig/six_step_modulator.hpp"
#include "sixstep/rig/three_leg_modulator.hpp"

namespace sixstep::study {

/// One of the three.
struct ModulatorView {
  const rig::SixStepModulator* pair = nullptr;
  const rig::ThreeLegModulator* legs = nullptr;
  const rig::GateModulator* pins = nullptr;

  explicit ModulatorView(const rig::SixStepModulator& of) : pair(&of) {}
  explicit ModulatorView(const rig::ThreeLegModulator& of) : legs(&of) {}
  explicit ModulatorView(const rig::GateModulator& of) : pins(&of) {}

  bool enabled() const {
    return pair ? pair->command().enabled : legs ? legs->command().enabled : pins->enabled();
  }
  std::int64_t turn_ons() const {
    return pair ? pair->turn_ons() : legs ? legs->turn_ons() : pins->turn_ons();
  }
  /// Switches that are chopped side by side: turn_ons are of all of them.
  int chopped() const { return legs ? 3 : 1; }
  /// The bus stands between two legs: the source's switch is told to be on, or three legs are not told the same.
  bool drives() const {
    if (pair) return pair->source_on();
    if (pins) return pins->drives();
    const plant::Gates gates = legs->gates();
    return gates.high.any() && gates.low.any();
  }
  rig::ArmedComparator comparator(int which) const {
    return pair ? pair->comparator(which) : rig::ArmedComparator{};
  }
};

/// The largest difference of two legs' duties in effect: of a pair it would be the pair's own.
inline double duty_between(const control::LegCommands<double>& c) {
  if (!c.enabled) return 0.0;
  const auto [least, most] = std::minmax({c.leg[0].duty, c.leg[1].duty, c.leg[2].duty});
  return most - least;
}

}  // namespace sixstep::study
