// SPDX-License-Identifier: Apache-2.0
// Steps the duty at a commutation. While the leaving phase's current decays through its diode, the duty that
// keeps the staying phase's current constant differs from the duty before and after. E is the back-EMF of a
// phase on its flat top, R and L are the values of a phase, I is the current, U the bus voltage and d the
// duty. The leaving terminal is at the far rail. From the star's three equations (model.md 1) the staying
// phase's current I changes by
//
//   L dI/dt = ((2 d - 1) U - 4 E - 3 R I)/3     if the staying phase's switch is chopped
//   L dI/dt = (d U - 4 E - 3 R I)/3             if the entering phase's switch is chopped
//
// The current is constant at
//
//   d = 1/2 + (4 E + 3 R I)/(2 U)   and   d = (4 E + 3 R I)/U
//
// Without a leaving current, I is constant at d = (2 E + 2 R I)/U. If 4 E + 3 R I is above U, I falls at
// every duty, and d is 1 (Carlson, Lajoie-Mazenc and Fagundes, Analysis of torque ripple due to phase
// commutation in brushless DC machines, IEEE Trans. Ind. Appl. 28, 1992). If legs may overlap, the leaving
// phase's switch is then also chopped, with the duty
//
//   x = (4 E + 3 R I)/U - 1
//
// The leaving terminal is then at x U on average instead of at the rail. In the formulas above, (d + x) U
// then replaces d U.
//
// Meanwhile the leaving current i falls by (2 E + R I + R i)/L per second. On average (i = I/2) it falls by
// u/L, with u = 2 E + 3 R I/2, half of the voltage that keeps I constant. With overlapping legs i falls by (U
// - u)/L. A step is too late if, at the instant when the command acts, i is less than its fall in half a
// period. In a braking motor the back-EMF maintains the leaving current, and no step is needed.
//
// The leaving phase's flat top ends at the edge, or later by the fraction g of a flank. At the fraction f of
// the flank the leaving phase's back-EMF is E (1 - 2 f). In the formulas, 4 E then becomes 4 E - 2 E f, and 2
// E in u becomes 2 E - E f.
//
// The edge lies within a control period, and the staying current falls until the command acts. A step without
// a correction would keep the current at this lower value. The deviation from the reference therefore adds
// voltage: 3/2 V for each volt that the pair's current loop would add. The factor is 3/2 because L di/dt is a
// third of the voltage during a commutation, and half of it otherwise.
#pragma once
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: the duty steps to 0 or 1/2 at every commutation in which a current flows.
template <class Scalar>
struct CommutationStepConfig {
  Gain<Scalar> K_t_V_s{};           ///< V of the back-EMF 2 E per mechanical rad/s
  Gain<Scalar> V_per_A{};           ///< 3 R/2: half of 3 R, because u is half of the voltage
  Gain<Scalar> A_per_V{};           ///< T/L (1/2 + periods until a command acts)
  Scalar overlap_bus_V{};           ///< U, V, if legs may overlap; else 0
  Gain<Scalar> missing_V_per_A{};   ///< added to u: 3/4 of the proportional gain of the pair's loop
  Gain<Scalar> flanks_per_rad_s{};  ///< fraction of the flank that passes in a period, per mechanical rad/s
  Gain<Scalar> ahead_per_rad_s{};   ///< fraction of the flank that passes until a command acts, per
                                    ///< mechanical rad/s
  Scalar flat_flanks{};             ///< g: flat part beyond the edge, in flanks
  bool operator==(const CommutationStepConfig&) const = default;
};

template <class Scalar>
struct CommutationStepState {
  StayingPhase staying{};
  bool hands_over = false;
  bool drives = false;  ///< true: the rotor turned in the command's direction at the last tick
  Scalar driven_A{};    ///< the staying phase's current at the last tick, positive in the command's direction
  Scalar volts{};       ///< u at the last tick, V
  Scalar flank{};       ///< f; below 0 before the flank begins
  Scalar least_A{};     ///< least leaving current for a step; below this value a step is too late
  Scalar part{};        ///< (4 E + 3 R I)/(2 U): 0 to 1/2, or 0 to 1 if legs may overlap
};

/// u = 2 E - E f + 3 R I/2 in the command's direction, V: half of the voltage that keeps the staying current
/// constant. `flank` is f, 0 to 1.
template <class Scalar>
constexpr Scalar holding_voltage(const CommutationStepConfig<Scalar>& config, Scalar driven_rad_s,
                                 Scalar driven_A, Scalar flank = {}) {
  using T = ScalarTraits<Scalar>;
  const Scalar two_E = T::product(driven_rad_s, config.K_t_V_s);
  return two_E - T::half_difference(two_E * flank, Scalar{}) + T::product(driven_A, config.V_per_A);
}

/// Enters the sector of the new pair, and decides whether the leaving current is large enough for a step.
template <class Scalar>
constexpr void enter_sector(const CommutationStepConfig<Scalar>& config, CommutationStepState<Scalar>& state,
                            std::uint8_t sector) {
  if (state.staying.sector == sector) return;
  const bool first = state.staying.sector == no_sector;
  staying_leg(state.staying, sector);
  state.hands_over = !first && state.drives && state.least_A < state.driven_A;
  state.flank = -config.flat_flanks;
}

/// Call it once per tick. It compares the leaving current with state.least_A, and computes the voltage that
/// keeps the staying current constant. `reversed`: sign of the last command.
template <class Scalar>
constexpr void watch_leaving(const CommutationStepConfig<Scalar>& config, CommutationStepState<Scalar>& state,
                             const Measurement<Scalar>& measured, std::uint8_t sector, bool reversed) {
  using T = ScalarTraits<Scalar>;
  enter_sector(config, state, sector);
  const Scalar staying = staying_current(state.staying, measured, sector);
  state.driven_A = reversed ? -staying : staying;
  const Scalar driven_rad_s = reversed ? -measured.speed_rad_s : measured.speed_rad_s;
  state.drives = Scalar{} < driven_rad_s;
  state.flank = state.flank + T::product(driven_rad_s, config.flanks_per_rad_s);
  const Scalar flank = state.flank + T::product(driven_rad_s, config.ahead_per_rad_s);
  // If no commutation is in progress, the next commutation begins at an edge, where f is 0.
  const Scalar u = holding_voltage(config, driven_rad_s, state.driven_A,
                                   state.hands_over ? between(flank, Scalar{}, one<Scalar>) : Scalar{});
  const Scalar headroom = config.overlap_bus_V - u;
  const bool overlaps = Scalar{} < config.overlap_bus_V && headroom < u;
  state.volts = u;
  state.least_A = T::product(overlaps ? headroom : u, config.A_per_V);
  const Scalar left = magnitude(phase_current(measured, free_leg(positive_pair(sector))));
  state.hands_over = state.hands_over && state.drives && state.least_A < left;
}

/// u, corrected by the difference between reference and current. `driven_reference_A` is positive in the
/// command's direction.
template <class Scalar>
constexpr Scalar corrected_voltage(const CommutationStepConfig<Scalar>& config,
                                   const CommutationStepState<Scalar>& state, Scalar driven_reference_A) {
  return state.volts +
         ScalarTraits<Scalar>::product(driven_reference_A - state.driven_A, config.missing_V_per_A);
}

template <class Scalar>
constexpr Scalar half_of_one() {
  return ScalarTraits<Scalar>::half_difference(one<Scalar>, Scalar{});
}

/// Largest value of state.part after a correction. Above 1/2 the duty also feeds the leaving phase. The
/// leaving phase's L di/dt is then u - U while the staying current is constant. Each rise of u raises this
/// value by 4/3 of the rise. With this bound the leaving current still falls at two thirds of its rate.
template <class Scalar>
constexpr Scalar greatest_part(Scalar holding) {
  using T = ScalarTraits<Scalar>;
  const Scalar half = half_of_one<Scalar>();
  const Scalar most = holding + T::half_difference(T::half_difference(one<Scalar>, holding), Scalar{});
  return most < half ? half : most;
}

/// Duty of the command's pair that keeps the staying current constant. `chopped`: the command's chopped
/// switch.
template <class Scalar>
constexpr Scalar holding_duty(const CommutationStepState<Scalar>& state, Pair pair, ChoppedSwitch chopped) {
  const Scalar half = half_of_one<Scalar>();
  if (half < state.part) return one<Scalar>;
  const bool staying_chops = (state.staying.leg == pair.source) == (chopped == ChoppedSwitch::upper);
  return staying_chops ? half + state.part : state.part + state.part;
}

/// Overlap of the leaving leg (BridgeCommand::overlap). If the staying leg is the sink, the leaving leg was
/// the source, and its upper switch is chopped; otherwise its lower switch.
template <class Scalar>
constexpr Scalar holding_overlap(const CommutationStepState<Scalar>& state, Pair pair) {
  const Scalar beyond = state.part - half_of_one<Scalar>();
  if (!(Scalar{} < beyond)) return Scalar{};
  return state.staying.leg == pair.sink ? beyond + beyond : -beyond - beyond;
}

}  // namespace sixstep::control
