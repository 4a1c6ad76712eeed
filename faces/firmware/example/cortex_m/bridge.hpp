// SPDX-License-Identifier: Apache-2.0
// A bridge command as TIM1's output modes. With both outputs of a channel enabled the timer itself makes the
// lower gate the upper one's complement and puts the dead time between (RM0316, output control bits of
// complementary channels).
#pragma once
#include "faces/firmware/example/cortex_m/registers.hpp"
#include "sixstep/control/gates.hpp"

namespace firmware {

struct GateOutputs {
  std::uint32_t CCMR1, CCMR2, CCER;
};

/// OCxM, and CCxE as bit 0, CCxNE as bit 2.
struct LegOutput {
  std::uint32_t mode, enables;
};

constexpr LegOutput leg_output(sixstep::control::Leg leg, unsigned on, unsigned off) {
  const unsigned upper = sixstep::control::upper_gate(leg), lower = sixstep::control::lower_gate(leg);
  if (on & off & upper) return {bit::force_high, 1};
  if (on & upper) return {bit::pwm_1, off & lower ? 5u : 1u};
  if (on & off & lower) return {bit::force_low, 5};
  if (on & lower && off & upper)
    return {bit::pwm_2, 5};                // the upper gate's on-time is the rest of the period
  if (on & lower) return {bit::pwm_1, 4};  // the lower gate alone follows the on-time
  return {bit::force_low, 0};
}

template <class Scalar>
constexpr GateOutputs outputs(const sixstep::control::BridgeCommand<Scalar>& command) {
  using sixstep::control::Leg;
  const unsigned on = gates(command, true), off = gates(command, false);
  const LegOutput a = leg_output(Leg::a, on, off), b = leg_output(Leg::b, on, off),
                  c = leg_output(Leg::c, on, off);
  return {(a.mode << 4 | bit::preload) | (b.mode << 4 | bit::preload) << 8, c.mode << 4 | bit::preload,
          a.enables | b.enables << 4 | c.enables << 8};
}

/// DTG of a dead time in counts, never shorter (20.4.18): steps of 1, 2, 8 and 16 counts.
constexpr std::uint32_t dead_time_bits(std::uint32_t counts) {
  const auto steps = [counts](std::uint32_t of, std::uint32_t from) { return (counts + of - 1) / of - from; };
  if (counts < 128) return counts;
  if (counts <= 254) return 0x80 | steps(2, 64);
  if (counts <= 504) return 0xC0 | steps(8, 32);
  return 0xE0 | steps(16, 32);
}

}  // namespace firmware
