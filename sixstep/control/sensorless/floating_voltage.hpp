// SPDX-License-Identifier: Apache-2.0
// Computes the voltage of the phase whose leg floats, for observers:
//
//   w = u_f - (u_a + u_b + u_c)/3 = R i_f + L di_f/dt + g,   g = e_f - (e_a + e_b + e_c)/3        (1) of model.md
//
// u_f is the voltage of the floating leg, u_s and u_k are the voltages of the driven legs. w does not need
// the star point: the switches determine the sum of the driven legs' voltages, and the terminal shows the
// floating leg's voltage.
//
//   no current    3 w = 2 u_f - u_s - u_k of the sample, which is 3 g: the same in the pulse and in the freewheel
//   a current     a diode holds the leg at a rail for the whole period: 3 w = 2 u_f - d U (soft,
//                 complementary) or 2 u_f - U (hard)
//
// d is the duty, U the bus. The second line is used while the motor is driven and the old current decays: at
// the lower rail if the back-EMF falls, at the upper rail if it rises. The leg is at the other rail, which
// has the sign of the back-EMF, in two cases: the motor is braked, or soft chopping at a small duty drives a
// current in its freewheel that ends during the next pulse. The mean voltage is then unknown; the period is
// skipped without harm.
//
// The back-EMF of the driven legs is not used. At small currents their diodes stop conducting within the
// period, and their voltage is not duty times bus. The voltage drops of the devices count as part of R.
//
// While the old current decays, L di/dt is several times the back-EMF of a slow rotor. An error of 30 % in L
// gives the estimate a wrong sign; so does a pair that was exchanged against its current. By default these
// periods are skipped, and the estimate of the sector before is kept. Set through_freewheel only with a
// measured inductance.
#pragma once
#include <cstdint>

#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/sensorless/zero_crossing.hpp"

namespace sixstep::control {

/// With the default the voltage reads 0.
template <class Scalar>
struct FloatingVoltageConfig {
  Gain<Scalar> third_per_count{};  ///< V/3 per count of the converter; fixed: raw units
  std::uint16_t rail_counts = 0;   ///< a diode or a switch holds a terminal this near to a rail
  bool through_freewheel = false;  ///< true: also uses periods at the rail, because L and each phase's
                                   ///< current are known
  bool operator==(const FloatingVoltageConfig&) const = default;
};

template <class Scalar>
struct FloatingVoltage {
  Scalar w_V{};
  bool held = false;   ///< true: the old current holds the terminal at a rail
  bool known = false;  ///< true: w is the phase's mean voltage
};

/// Evaluates one sample, in a sector in which the back-EMF falls (`falls`) or rises. `command`: the command
/// in effect at the sample.
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
