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
  if (on & off & upper) return {force_high, 1};
  if (on & upper) return {pwm_1, off & lower ? 5u : 1u};
  if (on & off & lower) return {force_low, 5};
  if (on & lower && off & upper) return {pwm_2, 5};  // the upper gate's on-time is the rest of the period
  if (on & lower) return {pwm_1, 4};                 // the lower gate alone follows the on-time
  return {force_low, 0};
}

template <class Scalar>
constexpr GateOutputs outputs(const sixstep::control::BridgeCommand<Scalar>& command) {
  using sixstep::control::Leg;
  const unsigned on = gates(command, true), off = gates(command, false);
  const LegOutput a = leg_output(Leg::a, on, off), b = leg_output(Leg::b, on, off),
                  c = leg_output(Leg::c, on, off);
  return {(a.mode << 4 | preload) | (b.mode << 4 | preload) << 8, c.mode << 4 | preload,
          a.enables | b.enables << 4 | c.enables << 8};
}

}  // namespace firmware
