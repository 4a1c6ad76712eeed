// SPDX-License-Identifier: Apache-2.0
// Computes the voltage of the phase whose leg floats, for observers:
//
//   w = u_f - (u_a + u_b + u_c)/3 = R i_f + L di_f/dt + g,   g = e_f - (e_a + e_b + e_c)/3        (1) of model.md
//
// u_f is the voltage of the floating leg, u_s and u_k are the voltages of the driven legs. w does not need
// the star point: the switches determine the sum of the driven legs' voltages, and the terminal shows the
// floating leg's voltage.
//
//   no current    3 w = 2 u_f - u_s - u_k of the sample, which is 3 g, in the pulse and in the freewheel
//   a current     a diode clamps the leg to a rail for the whole period:
//                 3 w = 2 u_f - d U (soft, complementary) or 2 u_f - U (hard)
//
// d is the duty, U the bus. The second line is used while the motor is driven and the old current decays. The
// leg is then at the lower rail if the back-EMF falls, at the upper rail if the back-EMF rises. In two cases
// the leg is at the opposite rail:
// - the motor is braked,
// - in soft chopping at a small duty a current flows during the off-time and ends in the next pulse.
// The mean voltage is then unknown, and the period is skipped.
//
// The back-EMF of the driven legs is not used. At small currents the diodes of these legs stop conducting
// within the period, and the legs' voltage is not duty times bus voltage. The voltage drops of the devices
// count as part of R.
//
// While the old current decays, L di/dt is several times the back-EMF of a slow rotor. An error of 30 % in L
// results in a wrong sign of the estimate. A pair that was exchanged against its current has the same effect.
// By default these periods are skipped, and the estimate of the previous sector is kept. Set
// through_freewheel only with a measured inductance.
#pragma once
#include <cstdint>

#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/sensorless/zero_crossing.hpp"

namespace sixstep::control {

/// Default: the voltage is 0.
template <class Scalar>
struct FloatingVoltageConfig {
  Gain<Scalar> third_per_count{};  ///< V/3 per count of the converter; in fixed point: raw units
  std::uint16_t rail_counts = 0;   ///< a terminal within this distance from a rail counts as clamped by a
                                   ///< diode or a switch
  bool through_freewheel = false;  ///< true: also uses periods at the rail, if L and each phase's current are
                                   ///< measured
  bool operator==(const FloatingVoltageConfig&) const = default;
};

template <class Scalar>
struct FloatingVoltage {
  Scalar w_V{};
  bool held = false;   ///< true: the old current clamps the terminal to a rail
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
