// SPDX-License-Identifier: Apache-2.0
// Controls the currents along the magnet (d) and across it (q). The rotor's rotation couples the two axes
// (model.md 11):
//
//   v_d = R i_d + L_d di_d/dt - w_e L_q i_q              e_d = -w p L_q i_q
//   v_q = R i_q + L_q di_q/dt + w_e (L_d i_d + psi)      e_q =  w (p L_d i_d + p psi)
//
// v, i: phase voltage and current, e: coupling voltage, w: mechanical speed, w_e = p w, psi: the magnet's
// flux linkage. Each axis has a PI (pi.hpp). With decoupling, e is added to the PI's output. The PI then
// controls a winding of R and L at every speed (Vas, Sensorless Vector and Direct Torque Control, 2.1). The
// voltage has one of two limits:
//
//   axes     the limit of each axis is `limit` of the axis's PI
//   circle   |v| <= U_s/sqrt 3, the longest vector that three legs produce in every direction at the bus
//            voltage U_s. v_d has priority, because i_d weakens the field when the bus voltage is too low.
//            v_q is limited to sqrt(U_s^2/3 - v_d^2).
//
// In both cases the PI's state is its output after the limit, minus e. The state therefore cannot wind up,
// although the bound changes with the speed and with the voltage of the second axis.
//
// If the rotation needs more than 0.9 of the available voltage, v_q would be too small if v_d had priority.
// The magnet would then drive a current that needs even more v_d, up to a current of twice psi/L_d. In this
// case v moves back to the circle, along the line to the voltage that a constant current at the reference
// needs. The integrals do not change. A drive without decoupling then decouples only the deviation from the
// reference (reachable_current.hpp).
#pragma once
#include "sixstep/control/frames.hpp"
#include "sixstep/control/pi.hpp"
#include "sixstep/control/root.hpp"

namespace sixstep::control {

enum class VoltageLimit : std::uint8_t { axes, circle };

/// Default: the voltage is 0.
template <class Scalar>
struct FieldCurrentConfig {
  /// They convert the current error in A to a phase voltage in V. Their `limit` applies to VoltageLimit::axes
  /// only.
  PiConfig<Scalar> d{}, q{};
  VoltageLimit limit = VoltageLimit::circle;
  bool decouples = false;
  Gain<Scalar> d_V_s_A{};     ///< p L_d: V per A and mechanical rad/s of the coupling to q
  Gain<Scalar> q_V_s_A{};     ///< p L_q: V per A and mechanical rad/s of the coupling to d
  Gain<Scalar> magnet_V_s{};  ///< p psi: V per mechanical rad/s, the back-EMF's fundamental
  Gain<Scalar> R_ohm{};       ///< resistance of a phase, for the voltage of a constant current
  bool operator==(const FieldCurrentConfig&) const = default;
};

template <class Scalar>
struct FieldCurrentState {
  PiState<Scalar> d{}, q{};
  Dq<Scalar> voltage{};  ///< last output, V of a phase
};

/// e, V: coupling voltage of the rotation at the measured current, for a sinusoidal back-EMF.
template <class Scalar>
constexpr Dq<Scalar> turning_voltage(const FieldCurrentConfig<Scalar>& config, const Dq<Scalar>& current,
                                     Scalar speed_rad_s) {
  using T = ScalarTraits<Scalar>;
  return {-T::product(speed_rad_s * current.q, config.q_V_s_A),
          T::product(speed_rad_s * current.d, config.d_V_s_A) + T::product(speed_rad_s, config.magnet_V_s)};
}

/// e, V, for a magnet of any shape whose back-EMF is `magnet_V`.
template <class Scalar>
constexpr Dq<Scalar> turning_voltage(const FieldCurrentConfig<Scalar>& config, const Dq<Scalar>& current,
                                     Scalar speed_rad_s, const Dq<Scalar>& magnet_V) {
  using T = ScalarTraits<Scalar>;
  return {magnet_V.d - T::product(speed_rad_s * current.q, config.q_V_s_A),
          magnet_V.q + T::product(speed_rad_s * current.d, config.d_V_s_A)};
}

/// Radius of the voltage circle, U_s/sqrt 3, V.
template <class Scalar>
constexpr Scalar voltage_circle(Scalar bus_V) {
  constexpr auto one_by_root3 = static_cast<Gain<Scalar>>(0.5773502691896258);
  return bus_V > Scalar{} ? ScalarTraits<Scalar>::product(bus_V, one_by_root3) : Scalar{};
}

/// Length |v| that is available in every direction, V.
template <class Scalar>
constexpr Scalar voltage_reach(const FieldCurrentConfig<Scalar>& config, Scalar bus_V) {
  return config.limit == VoltageLimit::circle ? voltage_circle(bus_V) : config.q.limit;
}

/// Voltage at which the current `current` is constant, V.
template <class Scalar>
constexpr Dq<Scalar> holding_voltage(const FieldCurrentConfig<Scalar>& config, const Dq<Scalar>& current,
                                     Scalar speed_rad_s) {
  using T = ScalarTraits<Scalar>;
  const Dq<Scalar> e = turning_voltage(config, current, speed_rad_s);
  return {e.d + T::product(current.d, config.R_ohm), e.q + T::product(current.q, config.R_ohm)};
}

namespace detail {

template <class Scalar>
constexpr bool is_within(const Dq<Scalar>& v, Scalar radius) {
  return !(v.d * v.d + v.q * v.q > radius * radius);
}

/// Intersection of the circle with the line from a point inside to a point outside, as a fraction of the
/// line.
template <class Scalar>
constexpr Scalar way_to_rim(const Dq<Scalar>& from, const Dq<Scalar>& to, Scalar radius) {
  const Dq<Scalar> way{to.d - from.d, to.q - from.q};
  const Scalar length = vector_length(way.d, way.q);
  if (!(length > Scalar{})) return Scalar{};
  const Dq<Scalar> along{way.d / length, way.q / length};
  const Scalar past = along.d * from.d + along.q * from.q, beside = along.d * from.q - along.q * from.d;
  const Scalar left = circle_rest(radius, beside) - past;
  return left < length ? (left > Scalar{} ? left / length : Scalar{}) : one<Scalar>;
}

/// True if the reference or the measured current needs more than 0.9 of the voltage. The rest is a reserve
/// for dead time and errors of the model.
template <class Scalar>
constexpr bool is_short(const FieldCurrentConfig<Scalar>& config, const Dq<Scalar>& reference,
                        const Dq<Scalar>& measured, Scalar speed_rad_s, Scalar most) {
  constexpr auto part = static_cast<Gain<Scalar>>(0.9);
  const Scalar radius = ScalarTraits<Scalar>::product(most, part);
  return !is_within(holding_voltage(config, reference, speed_rad_s), radius) ||
         !is_within(holding_voltage(config, measured, speed_rad_s), radius);
}

/// Sum of the PI's output and e, limited to +-most. A limited sum is exactly the limit, without a rounding
/// error.
template <class Scalar>
constexpr Scalar axis_voltage(const PiConfig<Scalar>& config, PiState<Scalar>& state, Scalar error, Scalar e,
                              Scalar most) {
  const Scalar low = -most - e, high = most - e;
  const Scalar u = pi_step(config, state, error, low, high);
  return u == high ? most : u == low ? -most : u + e;
}

/// Coupling voltage of the measured current minus coupling voltage of the reference, V.
template <class Scalar>
constexpr Dq<Scalar> turned_apart(const FieldCurrentConfig<Scalar>& config, const Dq<Scalar>& reference,
                                  const Dq<Scalar>& measured, Scalar speed_rad_s) {
  const Dq<Scalar> is = turning_voltage(config, measured, speed_rad_s),
                   to = turning_voltage(config, reference, speed_rad_s);
  return {is.d - to.d, is.q - to.q};
}

/// Voltage while the bus voltage is too low: the outputs of both loops. If the outputs are outside of the
/// circle, the integrals keep their last state. The output then moves to the circle, along the line to the
/// voltage at which the reference current is constant.
template <class Scalar>
constexpr Dq<Scalar> short_voltage(const FieldCurrentConfig<Scalar>& config, FieldCurrentState<Scalar>& state,
                                   const Dq<Scalar>& reference, const Dq<Scalar>& error, const Dq<Scalar>& e,
                                   Scalar speed_rad_s, Scalar most) {
  const PiState<Scalar> d = state.d, q = state.q;
  const Dq<Scalar> next{axis_voltage(config.d, state.d, error.d, e.d, most),
                        axis_voltage(config.q, state.q, error.q, e.q, most)};
  if (is_within(next, most)) return next;
  state.d = d;
  state.q = q;
  const Dq<Scalar> asked{pi_wait(config.d, state.d, error.d) + e.d,
                         pi_wait(config.q, state.q, error.q) + e.q};
  Dq<Scalar> held = holding_voltage(config, reference, speed_rad_s);
  if (!is_within(held, most)) {
    const Scalar part = way_to_rim(Dq<Scalar>{}, held, most);
    held = {held.d * part, held.q * part};
  }
  const Scalar part = is_within(asked, most) ? one<Scalar> : way_to_rim(held, asked, most);
  return {held.d + (asked.d - held.d) * part, held.q + (asked.q - held.q) * part};
}

}  // namespace detail

/// One control tick with a given coupling voltage e. Returns the phase voltages to apply, V, in the rotor's
/// frame.
template <class Scalar>
constexpr const Dq<Scalar>& field_current_beside(const FieldCurrentConfig<Scalar>& config,
                                                 FieldCurrentState<Scalar>& state,
                                                 const Dq<Scalar>& reference, const Dq<Scalar>& measured,
                                                 const Dq<Scalar>& e, Scalar speed_rad_s, Scalar bus_V) {
  const bool circle = config.limit == VoltageLimit::circle;
  const Scalar most = voltage_reach(config, bus_V);
  const Dq<Scalar> error{reference.d - measured.d, reference.q - measured.q};
  const PiState<Scalar> d = state.d, q = state.q;
  const Scalar most_d = circle ? most : config.d.limit;
  state.voltage.d = detail::axis_voltage(config.d, state.d, error.d, e.d, most_d);
  const Scalar most_q = circle ? circle_rest(most, state.voltage.d) : config.q.limit;
  state.voltage.q = detail::axis_voltage(config.q, state.q, error.q, e.q, most_q);
  const bool reached = magnitude(state.voltage.d) >= most_d || magnitude(state.voltage.q) >= most_q;
  if ((reached || !config.decouples) && detail::is_short(config, reference, measured, speed_rad_s, most)) {
    state.d = d;
    state.q = q;
    const Dq<Scalar> off =
        config.decouples ? e : detail::turned_apart(config, reference, measured, speed_rad_s);
    state.voltage = detail::short_voltage(config, state, reference, error, off, speed_rad_s, most);
  }
  return state.voltage;
}

/// One control tick. If the axes are decoupled, e is the voltage of the rotation, else 0.
template <class Scalar>
constexpr const Dq<Scalar>& field_current_step(const FieldCurrentConfig<Scalar>& config,
                                               FieldCurrentState<Scalar>& state, const Dq<Scalar>& reference,
                                               const Dq<Scalar>& measured, Scalar speed_rad_s, Scalar bus_V) {
  const Dq<Scalar> e = config.decouples ? turning_voltage(config, measured, speed_rad_s) : Dq<Scalar>{};
  return field_current_beside(config, state, reference, measured, e, speed_rad_s, bus_V);
}

}  // namespace sixstep::control
