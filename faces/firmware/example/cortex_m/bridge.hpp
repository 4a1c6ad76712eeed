// SPDX-License-Identifier: Apache-2.0
// Converts a bridge command to TIM1's output modes, one per leg, and decides which mode may follow which.
//
// States of the two outputs of a channel with MOE = OSSR = 1 (RM0316, table of the output control bits of
// complementary channels, and "dead-time insertion is enabled by setting both CCxE and CCxNE"):
//
//   CCxE CCxNE   upper OCx             lower OCxN
//    0     0     off (Hi-Z)            off (Hi-Z)
//    1     0     OCxREF                driven low            no dead time
//    0     1     driven low            OCxREF                no dead time
//    1     1     OCxREF                not OCxREF            dead time at each edge of OCxREF
//
// A leg with only one switch in use needs one enable bit, and the timer then inserts no dead time. Therefore
// a leg that changes from one switch to the other is off for the dead time. The change takes two commutation
// events (COM), at least the dead time apart. At the first event, this leg turns off, and all other legs get
// their new outputs. At the second event, this leg gets its new outputs. A leg with both enable bits before
// and after the change needs only one event, because the timer inserts the dead time.
//
// In the state off, the outputs are driven: only CCxE or only CCxNE is set, with OCxREF forced low. A leg
// turns off by its mode. Its enable bits change while OCxREF is low, so their order within one event has no
// effect.
//
// bridge_timer.hpp decides when the events occur.
#pragma once
#include "faces/firmware/example/cortex_m/registers.hpp"
#include "sixstep/control/gates.hpp"

namespace firmware {

/// Output of a leg in one byte, which interrupts compare quickly: OCxM, CCxE as bit 0, CCxNE as bit 2, and
/// the switches that the output may turn on.
class LegOutput {
 public:
  static constexpr unsigned upper_alone = 1, lower_alone = 4, both = 5;
  constexpr LegOutput() : LegOutput(bit::force_low, upper_alone) {}
  constexpr LegOutput(unsigned mode, unsigned enables)
      : bits_(static_cast<std::uint8_t>(mode | enables << 3 | switches_of(mode, enables) << 6)) {}
  constexpr std::uint32_t mode() const { return bits_ & 7u; }
  constexpr std::uint32_t enables() const { return bits_ >> 3 & 7u; }
  /// Switches that are on at any time of a period: bit 0 is the upper switch, bit 1 the lower one.
  constexpr unsigned switches() const { return bits_ >> 6; }
  constexpr bool operator==(const LegOutput&) const = default;

 private:
  static constexpr unsigned switches_of(unsigned mode, unsigned enables) {
    if (mode == bit::force_low) return enables == both ? 2 : 0;
    return (enables & 1u) | (enables & 4u) >> 1;
  }
  std::uint8_t bits_;
};

/// Output of a leg from its two gates during the on-time and during the rest of the period; bit 0 is the
/// upper gate, bit 1 the lower one.
constexpr LegOutput leg_output(unsigned on, unsigned off) {
  constexpr unsigned upper = 1, lower = 2;
  if (on & off & upper) return {bit::force_high, LegOutput::upper_alone};
  if (on & upper) return {bit::pwm_1, off & lower ? LegOutput::both : LegOutput::upper_alone};
  if (on & off & lower) return {bit::force_low, LegOutput::both};
  if (on & lower && off & upper)
    return {bit::pwm_2, LegOutput::both};  // the upper gate is on in the rest of the period
  if (on & lower) return {bit::pwm_1, LegOutput::lower_alone};  // only the lower gate follows the on-time
  return {};
}

/// The output with both switches off that may follow the output `from`.
constexpr LegOutput leg_off(LegOutput from) {
  const bool lower = from.enables() == LegOutput::lower_alone;
  return {bit::force_low, lower ? LegOutput::lower_alone : LegOutput::upper_alone};
}

/// Whether a leg must be off between two outputs: the leg changes from one switch to the other, and for one
/// of the outputs the timer inserts no dead time.
constexpr bool needs_pause(LegOutput from, LegOutput to) {
  const unsigned before = from.switches(), behind = to.switches();
  if (((before >> 1 & behind) | (behind >> 1 & before)) == 0 || from == to) return false;
  return from.enables() != LegOutput::both || to.enables() != LegOutput::both;
}

/// Outputs of legs a, b, c.
struct BridgeOutputs {
  LegOutput leg[3];
  constexpr bool operator==(const BridgeOutputs& other) const {
    return leg[0] == other.leg[0] && leg[1] == other.leg[1] && leg[2] == other.leg[2];
  }
};

template <class Scalar>
constexpr BridgeOutputs outputs(const sixstep::control::BridgeCommand<Scalar>& command) {
  const unsigned on = gates(command, true), off = gates(command, false);
  return {
      {leg_output(on & 3, off & 3), leg_output(on >> 2 & 3, off >> 2 & 3), leg_output(on >> 4, off >> 4)}};
}

/// The outputs between the two commutation events: off for each leg that must pause.
constexpr BridgeOutputs between(const BridgeOutputs& from, const BridgeOutputs& to) {
  BridgeOutputs way = to;
  for (int n = 0; n < 3; ++n)
    if (needs_pause(from.leg[n], to.leg[n])) way.leg[n] = leg_off(from.leg[n]);
  return way;
}

/// The outputs with all legs off.
constexpr BridgeOutputs legs_off(const BridgeOutputs& from) {
  return {{leg_off(from.leg[0]), leg_off(from.leg[1]), leg_off(from.leg[2])}};
}

/// Whether `to` may turn on a switch that `from` keeps off.
constexpr bool turns_on(const BridgeOutputs& from, const BridgeOutputs& to) {
  unsigned more = 0;
  for (int n = 0; n < 3; ++n) more |= to.leg[n].switches() & ~from.leg[n].switches();
  return more != 0;
}

/// Values of the output registers. CCMR2 also contains the mode of the fourth channel. The reference of the
/// fourth channel rises at its compare value and starts the converter.
struct GateOutputs {
  std::uint32_t CCMR1, CCMR2, CCER;
};

constexpr GateOutputs registers(const BridgeOutputs& o) {
  const auto mode = [&o](int n) { return o.leg[n].mode() << 4 | bit::preload; };
  return {mode(0) | mode(1) << 8, mode(2) | (bit::pwm_2 << 4 | bit::preload) << 8,
          o.leg[0].enables() | o.leg[1].enables() << 4 | o.leg[2].enables() << 8};
}

/// The bits DTG for a dead time in counts, rounded up (20.4.18). The step is 1, 2, 8 or 16 counts, depending
/// on the dead time.
constexpr std::uint32_t dead_time_bits(std::uint32_t counts) {
  const auto steps = [counts](std::uint32_t of, std::uint32_t from) { return (counts + of - 1) / of - from; };
  if (counts < 128) return counts;
  if (counts <= 254) return 0x80 | steps(2, 64);
  if (counts <= 504) return 0xC0 | steps(8, 32);
  return 0xE0 | steps(16, 32);
}

}  // namespace firmware
