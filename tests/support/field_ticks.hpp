// SPDX-License-Identifier: Apache-2.0
// Records values of a field-oriented drive at each tick, in the kernel that the scenario requires.
#pragma once
#include <gtest/gtest.h>

#include <vector>

#include "sixstep/sim/run.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/compile/compile.hpp"

namespace sixstep::testing {

namespace detail {

template <class Look, class Tick>
struct TickWatch {
  Look& look;
  std::vector<Tick>& ticks;
  template <class Rig>
  void segment(const Rig& rig, double) {
    if (rig.ticked()) ticks.push_back(look(rig));
  }
  template <class Rig>
  bool done(const Rig&) {
    return false;
  }
};

}  // namespace detail

/// Calls look(rig) at each tick. Returns the results in the order of the ticks.
template <class Scalar = double, class Look>
auto field_ticks(const study::Scenario& s, Look look) {
  using Firmware = rig::FieldDrive<Scalar>;
  using Tick = decltype(look(std::declval<const rig::Rig<double, Firmware>&>()));
  std::vector<Tick> ticks;
  const base::Problems problems = check(s);
  EXPECT_TRUE(problems.empty()) << to_string(problems[0]);
  const auto compiled = compile(s);
  EXPECT_TRUE(compiled) << to_string(compiled.problems()[0]);
  if (!problems.empty() || !compiled) return ticks;
  const auto chip = study::chip_of<Firmware>(s, *compiled);
  const auto run = [&](auto rig) {
    detail::TickWatch<Look, Tick> watch{look, ticks};
    EXPECT_EQ(sim::run(rig, compiled->end, watch).stop, sim::Stop::end);
  };
  if (compiled->general)
    run(study::general_rig_of<Firmware>(*compiled, *chip, compiled->timeline));
  else
    run(study::rig_of<Firmware>(*compiled, *chip, compiled->timeline));
  return ticks;
}

}  // namespace sixstep::testing
