// SPDX-License-Identifier: Apache-2.0
// A common view of the modulators for figures and recorders. The six-step modulator has a pair, a sign and
// comparators; the three-leg modulator has none of them; a chip with its own firmware sets the gates itself.
#pragma once
#include <algorithm>

#include "sixstep/rig/gate_modulator.hpp"
#include "sixstep/rig/six_step_modulator.hpp"
#include "sixstep/rig/three_leg_modulator.hpp"

namespace sixstep::study {

/// Points to the modulator that the rig has; the other two pointers are null.
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
  /// Number of switches that are chopped at the same time; turn_ons() counts all of them.
  int chopped() const { return legs ? 3 : 1; }
  /// True if the bus voltage is applied between two legs: the source's switch is commanded on, or the three
  /// legs' commands differ.
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

/// The largest difference between the duties of two legs; for a driven pair this would be the pair's duty.
inline double duty_between(const control::LegCommands<double>& c) {
  if (!c.enabled) return 0.0;
  const auto [least, most] = std::minmax({c.leg[0].duty, c.leg[1].duty, c.leg[2].duty});
  return most - least;
}

}  // namespace sixstep::study
