// SPDX-License-Identifier: Apache-2.0
// The output registers of the example firmware are interpreted according to the manuals of the chips. They
// are equal to the gates of the command.
#include <gtest/gtest.h>

#include "faces/firmware/example/avr/bridge.hpp"
#include "faces/firmware/example/cortex_m/bridge.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

/// Every possible command of a bridge: off, and all pairs with each kind of chopping and either switch.
std::vector<BridgeCommand<float>> commands() {
  std::vector<BridgeCommand<float>> all(1);
  for (const Leg source : {Leg::a, Leg::b, Leg::c})
    for (const Leg sink : {Leg::a, Leg::b, Leg::c})
      for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary})
        for (const ChoppedSwitch chopped : {ChoppedSwitch::upper, ChoppedSwitch::lower})
          all.push_back({.enabled = true,
                         .pair = {source, sink},
                         .duty = 0.5f,
                         .chopping = chopping,
                         .chopped = chopped});
  return all;
}

/// The gates according to RM0316 (output control bits of complementary channels, MOE = OSSR = 1), from CCxE,
/// CCxNE and the reference OCxREF. PWM mode 1 (110) sets OCxREF in the on-time, PWM mode 2 (111) outside the
/// on-time. Mode 101 forces OCxREF high, mode 100 low. Dead time is not included. Without an enable bit the
/// output floats, which is never allowed for a gate.
unsigned gates_of(const firmware::GateOutputs& out, bool on_time) {
  unsigned gates = 0;
  for (unsigned n = 0; n < 3; ++n) {
    const std::uint32_t mode = (n == 0 ? out.CCMR1 >> 4 : n == 1 ? out.CCMR1 >> 12 : out.CCMR2 >> 4) & 7;
    const bool upper = out.CCER >> (4 * n) & 1, lower = out.CCER >> (4 * n + 2) & 1;
    const bool reference = mode == 5 || (mode == 6 && on_time) || (mode == 7 && !on_time);
    EXPECT_GE(mode, 4u);
    EXPECT_TRUE(upper || lower) << "a leg is let go";
    if (upper && reference) gates |= 1u << (2 * n);
    if (lower && (upper ? !reference : reference)) gates |= 2u << (2 * n);
  }
  return gates;
}

TEST(CortexM, TheTimersOutputsAreTheGates) {
  for (const BridgeCommand<float>& c : commands()) {
    const firmware::GateOutputs out = firmware::registers(firmware::outputs(c));
    for (const bool on_time : {true, false}) EXPECT_EQ(gates_of(out, on_time), gates(c, on_time));
  }
}

/// Each change between two commands is tested. If a leg changes from one switch to the other without the
/// timer's dead time, this leg is off in between, and no other leg is. In between, no leg conducts through a
/// switch that neither command uses. tests/target/transitions.py checks the executed image, clock by clock.
TEST(CortexM, ALegThatChangesSidesIsOffOnTheWay) {
  using firmware::BridgeOutputs;
  const auto can = [](const BridgeOutputs& o, bool pulse) { return gates_of(firmware::registers(o), pulse); };
  const auto ever = [&](const BridgeOutputs& o) { return can(o, true) | can(o, false); };
  int pauses = 0;
  for (const BridgeCommand<float>& from : commands())
    for (const BridgeCommand<float>& to : commands()) {
      const BridgeOutputs before = firmware::outputs(from), behind = firmware::outputs(to),
                          way = firmware::between(before, behind);
      for (unsigned n = 0; n < 3; ++n) {
        const auto of_leg = [n](unsigned gates) { return gates >> (2 * n) & 3; };
        const unsigned first = of_leg(ever(before)), last = of_leg(ever(behind)), on_way = of_leg(ever(way));
        const bool timed = before.leg[n].enables() == 5 && behind.leg[n].enables() == 5;
        const bool changes = !(before.leg[n] == behind.leg[n]) && !timed &&
                             ((first & 1 && last & 2) || (first & 2 && last & 1));
        EXPECT_EQ(on_way, changes ? 0u : last);
        pauses += changes;
      }
      EXPECT_EQ(ever(firmware::legs_off(before)), 0u);
      EXPECT_EQ(firmware::between(way, behind), behind) << "two events do";
    }
  EXPECT_GT(pauses, 500);
}

/// Counts of the dead time by RM0316, 20.4.18, DTG: the upper bits select the step.
std::uint32_t counts_of(std::uint32_t dtg) {
  if (dtg < 0x80) return dtg;
  if (dtg < 0xC0) return 2 * (64 + (dtg & 0x3f));
  return dtg < 0xE0 ? 8 * (32 + (dtg & 0x1f)) : 16 * (32 + (dtg & 0x1f));
}

TEST(CortexM, ADeadTimeIsNeverShorterAndAtMostAStepLonger) {
  for (std::uint32_t counts = 0; counts <= 1008; ++counts) {
    const std::uint32_t dtg = firmware::dead_time_bits(counts);
    ASSERT_LT(dtg, 256u);
    EXPECT_GE(counts_of(dtg), counts);
    EXPECT_LT(counts_of(dtg), counts + (counts < 128    ? 1
                                        : counts <= 254 ? 2
                                        : counts <= 504 ? 8
                                                        : 16))
        << counts;
  }
}

/// ATmega2560 data sheet, 17.11.1 and 13.2.1: with COM1x1, a pin carries the timer's pulse if its bit of DDRB
/// makes the pin an output. Otherwise the pin floats, and an external resistor pulls it down.
unsigned gates_of(const firmware::Pins& pins, bool on_time) {
  unsigned gates = 0;
  EXPECT_EQ(pins.DDRB & 0x1f, 0);
  for (unsigned n = 0; n < 3; ++n) {
    if (on_time && (pins.DDRB >> (5 + n) & 1)) gates |= 1u << (2 * n);
    if (pins.PORTA >> n & 1) gates |= 2u << (2 * n);
  }
  return gates;
}

/// tests/target/avr_gates.py checks the executed image for the sequence and the pauses between two settings.
TEST(Avr, ThePinsAreTheGates) {
  for (const BridgeCommand<float>& c : commands()) {
    // At compile time, the example refuses all other drives.
    if (c.chopping != Chopping::soft || c.chopped != ChoppedSwitch::upper) continue;
    for (const bool on_time : {true, false})
      EXPECT_EQ(gates_of(firmware::pins(c), on_time), gates(c, on_time));
  }
}

TEST(Avr, NeverBothGatesOfALeg) {
  for (const BridgeCommand<float>& c : commands())
    for (const bool on_time : {true, false}) {
      const unsigned g = gates_of(firmware::pins(c), on_time);
      EXPECT_EQ(g & g >> 1 & 0b010101u, 0u);
    }
}

}  // namespace SIXSTEP_TEST_FILE
