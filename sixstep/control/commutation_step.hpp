// SPDX-License-Identifier: Apache-2.0
// Duty step at commutation: while the leaving phase's current dies away through its diode, the staying phase is held at its
// current by another duty than the pair's. With E the back-EMF of a phase on its flat top, R and L of a phase, I the current
// and U the bus, the star's three equations (model.md 1) with the leaving terminal at the far rail give the staying phase
//
//   L dI/dt = ((2 d - 1) U - 4 E - 3 R I)/3     where its own switch is chopped
//   L dI/dt = (d U - 4 E - 3 R I)/3             where the entering phase's is
//
// so that it rests at
//
//   d = 1/2 + (4 E + 3 R I)/(2 U)   and   d = (4 E + 3 R I)/U
//
// where the pair alone takes d = (2 E + 2 R I)/U. Above 4 E + 3 R I = U no duty holds it (Carlson, Lajoie-Mazenc and Fagundes,
// Analysis of torque ripple due to phase commutation in brushless DC machines, IEEE Trans. Ind. Appl. 28, 1992): d = 1, and
// where legs may overlap the leaving phase's own switch is chopped on at
//
//   x = (4 E + 3 R I)/U - 1
//
// for with its terminal at x U in place of the rail (d + x) U takes the place of d U above.
//
// While it is held, the leaving current i falls by (2 E + R I + R i)/L, on the mean of both by u/L, u = 2 E + 3 R I/2 being half of
// what the held current takes; where legs overlap by (U - u)/L. An answer that finds less than half a period's fall left when it
// acts comes too late. In a motor that is braked the back-EMF drives the leaving current on, and there is nothing to fill.
//
// The leaving phase's flat top ends at the edge, or a flank's part g later, and its back-EMF falls to E (1 - 2 f) at the part f of
// the flank, to -E at its end: 4 E becomes 4 E - 2 E f, and u with it.
//
// The edge comes within a period, and what the staying phase loses until the answer acts it would be held at. So what is missing of
// the reference is added by a gain: 3/2 volts for each that the pair's loop would ask for, for L di/dt is a third of them here and
// a half there.
#pragma once
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// The default steps at every commutation that has a current, to a duty of 0 or 1/2.
template <class Scalar>
struct CommutationStepConfig {
  Gain<Scalar> K_t_V_s{};           ///< 2 E per mechanical rad/s
  Gain<Scalar> V_per_A{};           ///< 3 R/2
  Gain<Scalar> A_per_V{};           ///< T/L times half a period and those that an answer waits
  Scalar overlap_bus_V{};           ///< U where legs may overlap, else 0
  Gain<Scalar> missing_V_per_A{};   ///< of u: 3/4 of the proportional gain of the pair's loop
  Gain<Scalar> flanks_per_rad_s{};  ///< what turning passes of the flank in a period, per mechanical rad/s
  Gain<Scalar> ahead_per_rad_s{};   ///< and in those that an answer waits
  Scalar flat_flanks{};             ///< g
  bool operator==(const CommutationStepConfig&) const = default;
};

template <class Scalar>
struct CommutationStepState {
  StayingPhase staying{};
  bool hands_over = false;
  bool drives = false;  ///< turned by the command at the last tick
  Scalar driven_A{};    ///< the staying phase's current in the command's direction, of the last tick
  Scalar volts{};       ///< u of the last tick
  Scalar flank{};       ///< f since the edge, below 0 before the flank begins
  Scalar least_A{};     ///< what is left of a smaller current when an answer acts is not worth a step
  Scalar part{};        ///< (4 E + 3 R I)/(2 U), 0 to 1/2, to 1 where legs may overlap
};

/// 2 E + 3 R I/2 in the command's direction, V: half of what a held current takes. `flank`: f, 0 to 1.
template <class Scalar>
constexpr Scalar holding_voltage(const CommutationStepConfig<Scalar>& config, Scalar driven_rad_s,
                                 Scalar driven_A, Scalar flank = {}) {
  using T = ScalarTraits<Scalar>;
  const Scalar two_E = T::product(driven_rad_s, config.K_t_V_s);
  return two_E - T::half_difference(two_E * flank, Scalar{}) + T::product(driven_A, config.V_per_A);
}

/// The pair's sector has changed: whether there is a current that takes its time to leave.
template <class Scalar>
constexpr void enter_sector(const CommutationStepConfig<Scalar>& config, CommutationStepState<Scalar>& state,
                            std::uint8_t sector) {
  if (state.staying.sector == sector) return;
  const bool first = state.staying.sector == no_sector;
  staying_leg(state.staying, sector);
  state.hands_over = !first && state.drives && state.least_A < state.driven_A;
  state.flank = -config.flat_flanks;
}

/// Once per tick: sees what is left of the leaving current, and the voltage that holds the staying one.
/// `reversed`: the sign of the last command.
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
  // What comes next, where nothing hands over, is an edge.
  const Scalar u = holding_voltage(config, driven_rad_s, state.driven_A,
                                   state.hands_over ? between(flank, Scalar{}, one<Scalar>) : Scalar{});
  const Scalar headroom = config.overlap_bus_V - u;
  const bool overlaps = Scalar{} < config.overlap_bus_V && headroom < u;
  state.volts = u;
  state.least_A = T::product(overlaps ? headroom : u, config.A_per_V);
  const Scalar left = magnitude(phase_current(measured, free_leg(positive_pair(sector))));
  state.hands_over = state.hands_over && state.drives && state.least_A < left;
}

/// u for what the reference is short of, or above. `driven_reference_A`: in the command's direction.
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

/// What a held current's part may be raised to. Beyond 1/2 the leaving phase is fed by it: it shall lose its current at two thirds of
/// the rate at least, L di/dt = u - U where the other is held, and 4/3 of what u is raised by more.
template <class Scalar>
constexpr Scalar greatest_part(Scalar holding) {
  using T = ScalarTraits<Scalar>;
  const Scalar half = half_of_one<Scalar>();
  const Scalar most = holding + T::half_difference(T::half_difference(one<Scalar>, holding), Scalar{});
  return most < half ? half : most;
}

/// Of the command's pair, chopped at the switch that it says.
template <class Scalar>
constexpr Scalar holding_duty(const CommutationStepState<Scalar>& state, Pair pair, ChoppedSwitch chopped) {
  const Scalar half = half_of_one<Scalar>();
  if (half < state.part) return one<Scalar>;
  const bool staying_chops = (state.staying.leg == pair.source) == (chopped == ChoppedSwitch::upper);
  return staying_chops ? half + state.part : state.part + state.part;
}

/// Of the leg in no pair: where the staying one is the sink, current left the source, and it is the upper switch.
template <class Scalar>
constexpr Scalar holding_overlap(const CommutationStepState<Scalar>& state, Pair pair) {
  const Scalar beyond = state.part - half_of_one<Scalar>();
  if (!(Scalar{} < beyond)) return Scalar{};
  return state.staying.leg == pair.sink ? beyond + beyond : -beyond - beyond;
}

}  // namespace sixstep::control
