// SPDX-License-Identifier: Apache-2.0
// What voltage the phase has whose leg floats, for observers:
//
//   w = u_f - (u_a + u_b + u_c)/3 = R i_f + L di_f/dt + g,   g = e_f - (e_a + e_b + e_c)/3        (1) of model.md
//
// the star point drops out. The sum of the driven legs is told by the switches, the floating leg's own by its terminal:
//
//   no current    3 w = 2 u_f - u_s - u_k of the sample, which is 3 g: the same in the pulse and in the freewheel
//   a current     its diode holds it at a rail through the period: 3 w = 2 u_f - d U (soft, complementary), - U (hard)
//
// The latter where the drive motors and the old current runs out: the lower rail where the back-EMF falls, the upper one
// where it rises. The other rail has the sign of the back-EMF: a drive that brakes, or soft chopping at a small duty, whose
// freewheel drives a current that the next pulse ends somewhere; what the mean was is not known, and nothing is lost by
// waiting.
//
// The driven legs' own back-EMF is left alone: at small currents their diodes stop conducting within the period, and duty
// times bus is not what they had. Devices' drops count as R.
//
// While the old current runs out L di/dt is several times a slow rotor's back-EMF: L wrong by 30 % makes the estimate's sign a
// wrong one, and so does a pair that was swapped against its current. By default these periods are not looked at, the estimate
// of the sector before stands; through_freewheel is for an inductance that was measured.
#pragma once
#include <cstdint>

#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/sensorless/zero_crossing.hpp"

namespace sixstep::control {

/// The default sees no voltage.
template <class Scalar>
struct FloatingVoltageConfig {
  Gain<Scalar> third_per_count{};  ///< V/3 per count of the converter; fixed: raw units
  std::uint16_t rail_counts = 0;   ///< a terminal so near to a rail hangs on a diode or a switch
  bool through_freewheel = false;  ///< a period at the rail tells, too: L and each phase's current are known
  bool operator==(const FloatingVoltageConfig&) const = default;
};

template <class Scalar>
struct FloatingVoltage {
  Scalar w_V{};
  bool held = false;   ///< by the old current
  bool known = false;  ///< w is the phase's voltage
};

/// At one sample, in a sector where the back-EMF `falls` or rises; `command`: in effect at it.
template <class Scalar>
constexpr FloatingVoltage<Scalar> floating_voltage(const FloatingVoltageConfig<Scalar>& config,
                                                   const TerminalSample& s, std::uint8_t leg, bool falls,
                                                   const BridgeCommand<Scalar>& command, Scalar bus_V) {
  using T = ScalarTraits<Scalar>;
  const std::int32_t u = s.u[leg], bus = s.bus, rail = config.rail_counts;
  const bool low = u <= rail, high = u + rail >= bus;
  if (!command.enabled || (!low && !high))
    return {T::counts(above_neutral(s, leg), config.third_per_count), false, true};
  if (low != falls) return {};
  constexpr auto third = static_cast<Gain<Scalar>>(1.0 / 3.0);
  const Scalar driven = command.chopping == Chopping::hard ? bus_V : command.duty * bus_V;
  return {T::counts(u + u, config.third_per_count) - T::product(driven, third), true, true};
}

}  // namespace sixstep::control
