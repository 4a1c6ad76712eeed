// SPDX-License-Identifier: Apache-2.0
// Commands for tests of a modulator, and its gates as text.
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "sixstep/rig/modulator.hpp"

namespace sixstep::testing {

using control::Chopping;
using control::Leg;
using control::Pair;
using control::Watch;
using rig::BoardCommand;
using rig::ModulatorConfig;
using rig::SixStepModulator;
using rig::ThreeLegModulator;
using sim::Instant;

inline constexpr std::int64_t period = 30'000'000;

inline BoardCommand command(double duty, Chopping chopping = Chopping::soft, Pair pair = {Leg::a, Leg::b}) {
  return {.enabled = true, .pair = pair, .duty = duty, .chopping = chopping};
}
inline Instant at(std::int64_t ticks, double offset = 0.0) { return {ticks, offset}; }

/// Returns the gates that are on, such as "a+b-".
template <class Modulator>
std::string on(const Modulator& m) {
  std::string text;
  for (int k = 0; k < 3; ++k) {
    const char leg = static_cast<char>('a' + k);
    if (m.gates().high[k]) text += std::string(1, leg) + "+";
    if (m.gates().low[k]) text += std::string(1, leg) + "-";
  }
  return text;
}

/// Executes the next edge and returns its instant.
template <class Modulator>
Instant do_next(Modulator& m) {
  const Instant edge = m.next_edge();
  EXPECT_TRUE(m.act(edge));
  return edge;
}

inline BoardCommand compared(Watch watch, Chopping chopping, double ref, Pair pair = {Leg::a, Leg::b}) {
  BoardCommand c = command(0.0, chopping, pair);
  c.watch = watch;
  c.on_below_A = ref - 0.25;
  c.off_above_A = ref + 0.25;
  return c;
}

}  // namespace sixstep::testing
