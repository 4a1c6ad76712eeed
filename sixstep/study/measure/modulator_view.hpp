// SPDX-License-Identifier: Apache-2.0
// The modulator as figures and recorders see it, whichever it is: six-step's, which has a pair, a sign and comparators, or that of
// three legs, which has none of them.
#pragma once
#include <algorithm>

#include "sixstep/rig/six_step_modulator.hpp"
#include "sixstep/rig/three_leg_modulator.hpp"

namespace sixstep::study {

/// One of the two.
struct ModulatorView {
  const rig::SixStepModulator* pair = nullptr;
  const rig::ThreeLegModulator* legs = nullptr;

  explicit ModulatorView(const rig::SixStepModulator& of) : pair(&of) {}
  explicit ModulatorView(const rig::ThreeLegModulator& of) : legs(&of) {}

  bool enabled() const { return pair ? pair->command().enabled : legs->command().enabled; }
  std::int64_t turn_ons() const { return pair ? pair->turn_ons() : legs->turn_ons(); }
  /// The bus stands between two legs: the source's switch is told to be on, or three legs are not told the same.
  bool drives() const {
    if (pair) return pair->source_on();
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
