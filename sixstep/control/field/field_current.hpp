// SPDX-License-Identifier: Apache-2.0
// The current loops along the magnet and across it, and what the two axes do to each other (model.md 11):
//
//   v_d = R i_d + L_d di_d/dt - w_e L_q i_q              e_d = -w p L_q i_q
//   v_q = R i_q + L_q di_q/dt + w_e (L_d i_d + psi)      e_q =  w (p L_d i_d + p psi)
//
// Each axis has a PI (pi.hpp). Decoupled, e is added to what it asks for, so that it sees a winding of R and L at
// every speed (Vas, Sensorless Vector and Direct Torque Control, 2.1). The voltage that there is:
//
//   axes     each within its PI's own limit
//   circle   |v| <= U_s/sqrt 3, the largest vector that three legs make in every direction; d comes first, since it holds
//            the field down where the bus is short, and q has the rest, sqrt(U_s^2/3 - v_d^2)
//
// Whichever it is, the PI keeps what is left of its output after the limit, e taken off: it cannot wind up against a bound
// that moves with the speed and with the other axis.
#pragma once
#include "sixstep/control/frames.hpp"
#include "sixstep/control/pi.hpp"
#include "sixstep/control/root.hpp"

namespace sixstep::control {

enum class VoltageLimit : std::uint8_t { axes, circle };

/// Defaults give no voltage.
template <class Scalar>
struct FieldCurrentConfig {
  PiConfig<Scalar> d{}, q{};  ///< A -> V of a phase; their limits count for VoltageLimit::axes
  VoltageLimit limit = VoltageLimit::circle;
  bool decouples = false;
  Gain<Scalar> d_V_s_A{};     ///< p L_d: V per A and mechanical rad/s
  Gain<Scalar> q_V_s_A{};     ///< p L_q
  Gain<Scalar> magnet_V_s{};  ///< p psi: V per mechanical rad/s, the back-EMF's fundamental
  bool operator==(const FieldCurrentConfig&) const = default;
};

template <class Scalar>
struct FieldCurrentState {
  PiState<Scalar> d{}, q{};
  Dq<Scalar> voltage{};  ///< the last answer
};

/// e: what turning does to the axes, at what is measured.
template <class Scalar>
constexpr Dq<Scalar> turning_voltage(const FieldCurrentConfig<Scalar>& config, const Dq<Scalar>& current,
                                     Scalar speed_rad_s) {
  using T = ScalarTraits<Scalar>;
  return {-T::product(speed_rad_s * current.q, config.q_V_s_A),
          T::product(speed_rad_s * current.d, config.d_V_s_A) + T::product(speed_rad_s, config.magnet_V_s)};
}

/// The same beside a magnet that makes `magnet_V`, whatever its shape.
template <class Scalar>
constexpr Dq<Scalar> turning_voltage(const FieldCurrentConfig<Scalar>& config, const Dq<Scalar>& current,
                                     Scalar speed_rad_s, const Dq<Scalar>& magnet_V) {
  using T = ScalarTraits<Scalar>;
  return {magnet_V.d - T::product(speed_rad_s * current.q, config.q_V_s_A),
          magnet_V.q + T::product(speed_rad_s * current.d, config.d_V_s_A)};
}

/// U_s/sqrt 3.
template <class Scalar>
constexpr Scalar voltage_circle(Scalar bus_V) {
  constexpr auto one_by_root3 = static_cast<Gain<Scalar>>(0.5773502691896258);
  return bus_V > Scalar{} ? ScalarTraits<Scalar>::product(bus_V, one_by_root3) : Scalar{};
}

namespace detail {

/// PI and e together within +-most; at an end it is that end itself.
template <class Scalar>
constexpr Scalar axis_voltage(const PiConfig<Scalar>& config, PiState<Scalar>& state, Scalar error, Scalar e,
                              Scalar most) {
  const Scalar low = -most - e, high = most - e;
  const Scalar u = pi_step(config, state, error, low, high);
  return u == high ? most : u == low ? -most : u + e;
}

}  // namespace detail

/// One control tick beside an e that is known: the phase voltages to apply, in the frame of the rotor.
template <class Scalar>
constexpr const Dq<Scalar>& field_current_beside(const FieldCurrentConfig<Scalar>& config,
                                                 FieldCurrentState<Scalar>& state,
                                                 const Dq<Scalar>& reference, const Dq<Scalar>& measured,
                                                 const Dq<Scalar>& e, Scalar bus_V) {
  const bool circle = config.limit == VoltageLimit::circle;
  const Scalar most = circle ? voltage_circle(bus_V) : Scalar{};
  state.voltage.d =
      detail::axis_voltage(config.d, state.d, reference.d - measured.d, e.d, circle ? most : config.d.limit);
  state.voltage.q = detail::axis_voltage(config.q, state.q, reference.q - measured.q, e.q,
                                         circle ? circle_rest(most, state.voltage.d) : config.q.limit);
  return state.voltage;
}

/// The same beside what turning does to the axes, where it decouples them.
template <class Scalar>
constexpr const Dq<Scalar>& field_current_step(const FieldCurrentConfig<Scalar>& config,
                                               FieldCurrentState<Scalar>& state, const Dq<Scalar>& reference,
                                               const Dq<Scalar>& measured, Scalar speed_rad_s, Scalar bus_V) {
  const Dq<Scalar> e = config.decouples ? turning_voltage(config, measured, speed_rad_s) : Dq<Scalar>{};
  return field_current_beside(config, state, reference, measured, e, bus_V);
}

}  // namespace sixstep::control
