// SPDX-License-Identifier: Apache-2.0
// Converts the results of commissioning to SI with the data of the board. Computes the configuration of
// commissioning from the same data.
//
//   R = r u/i,   L = R tau T,   psi = f u T/(2 pi)
//
// r, tau, f: the readings `resistance`, `tau` and `flux`. u: V per count, i: A per count, T: control period.
// R is the resistance of a phase and a switch. L is measured along the magnet's axis. psi is the flux linkage
// of the back-EMF's fundamental: the fundamental's peak in a phase divided by the electrical speed. For a
// sinusoidal back-EMF psi is K_e/p, for a trapezoid of 120 degrees 1.2159 K_e/p. K_e is a phase's peak
// back-EMF per mechanical rad/s, p the number of pole pairs.
#pragma once
#include "sixstep/control/commissioning/commissioning.hpp"
#include "sixstep/control/units.hpp"

namespace sixstep::control {

/// SI units per unit of a reading; in fixed point divided by the base and by the format's last digit.
template <class Scalar>
struct CommissioningScale {
  Gain<Scalar> ohm{};        ///< ohm per unit of 2^-20 bus counts per current count
  Gain<Scalar> henry{};      ///< H per unit of 2^-12 bus counts times ticks per current count
  Gain<Scalar> weber{};      ///< V s per unit of 2^-4 bus counts times ticks per turn
  Gain<Scalar> half_turn{};  ///< half a turn in degrees divided by the base of positions
};

template <class Scalar>
struct Commissioned {
  Scalar R_ohm{}, L_H{}, flux_linkage_Vs{};
  Scalar hall_offset_deg{};  ///< mean angle by which the edges are ahead of multiples of 60 degrees,
                             ///< electrical degrees
  Scalar hall_lag_deg{};     ///< mean lag of the edges in each direction, electrical degrees
};

/// Data of the board that commissioning needs.
struct CommissioningBoard {
  double V_per_count = 0.0, A_per_count = 0.0;
  std::uint16_t zero_counts = 2048;
  double period_s = 0.0;  ///< period of the control ticks
  double timer_Hz = 1e6;  ///< clock of the counter that captures Hall edges
  std::uint8_t late_half_ticks = 1;
};

/// Settings of commissioning that depend on motor and bench.
struct CommissioningWish {
  double test_A = 0.0;             ///< current that the motor withstands for several seconds
  double settle_s = 0.2;           ///< time until the rotor rests
  double step_s = 0.02;            ///< duration of a level; choose about ten electrical time constants
  double slow_turns_s = 10.0;      ///< speed of the slow turn, electrical turns per second
  double fastest_turns_s = 500.0;  ///< largest speed, electrical turns per second
  double spin_up_s = 1.0;          ///< time to the largest speed at the first try
  std::uint8_t tries = 4;          ///< number of tries; each new try uses a quarter of the previous
                                   ///< acceleration
};

constexpr CommissioningConfig commissioning_config(const CommissioningBoard& board,
                                                   const CommissioningWish& wish) {
  const auto whole = [](double x) { return static_cast<std::uint32_t>(detail::nearest<std::int64_t>(x)); };
  const auto ticks = [&](double s) { return whole(s / board.period_s); };
  const double turn = 4294967296.0 * board.period_s;
  CommissioningConfig config{};
  config.current.offset_counts = board.zero_counts;
  config.current.offset_tolerance = board.zero_counts / 8;
  config.test_counts = detail::nearest<std::int32_t>(wish.test_A / board.A_per_count);
  config.settle_ticks = ticks(wish.settle_s);
  const std::uint32_t step = ticks(wish.step_s / 4) * 4;
  config.steps.ticks = static_cast<std::uint16_t>(step < 8 ? 8u : step > 65532u ? 65532u : step);
  config.steps.late_half_ticks = board.late_half_ticks;
  config.slow_speed = whole(wish.slow_turns_s * turn);
  const double fastest = wish.fastest_turns_s * turn;  // the next line limits it to a sixteenth of a turn per
                                                       // tick
  config.fastest_speed = static_cast<std::uint32_t>(fastest < 268435456.0 ? fastest : 268435456.0);
  const double spin_up_ticks = wish.spin_up_s / board.period_s;
  config.acceleration =
      static_cast<std::uint32_t>(static_cast<double>(config.fastest_speed) / spin_up_ticks) + 1;
  config.tries = wish.tries;
  config.timer_ticks = whole(board.timer_Hz * board.period_s);
  return config;
}

/// `*_base`: SI value that the controller's number 1.0 represents, for a resistance, an inductance, a flux
/// linkage and a position; 1 in floating point.
template <class Scalar>
constexpr CommissioningScale<Scalar> commissioning_scale(const CommissioningBoard& board,
                                                         double ohm_base = 1.0, double henry_base = 1.0,
                                                         double weber_base = 1.0, double deg_base = 1.0) {
  constexpr double two_pi = 6.28318530717958647692;
  const double digit = detail::FormatEnds<Scalar>::digit;
  const double ohm = board.V_per_count / board.A_per_count;
  return {Gain<Scalar>(ohm / 1048576.0 / ohm_base / digit),
          Gain<Scalar>(ohm * board.period_s / 4096.0 / henry_base / digit),
          Gain<Scalar>(board.V_per_count * board.period_s / 16.0 / two_pi / weber_base / digit),
          Gain<Scalar>(180.0 / deg_base)};
}

/// Inductance in 2^-12 bus counts per current count, times ticks.
constexpr std::int32_t inductance_of(const LevelStepsReading& winding) {
  return detail::held_to_32(
      detail::shifted_down(static_cast<std::int64_t>(winding.resistance) * winding.tau, 24));
}

template <class Scalar>
constexpr Commissioned<Scalar> commissioned(const CommissioningScale<Scalar>& scale,
                                            const CommissioningState& state) {
  using Angle = AngleTraits<Scalar>;
  return {Angle::scaled(state.winding.resistance, scale.ohm),
          Angle::scaled(inductance_of(state.winding), scale.henry),
          Angle::scaled(state.magnet.flux, scale.weber),
          angle_signal<Scalar>(state.probes.offset, scale.half_turn),
          angle_signal<Scalar>(state.probes.lag, scale.half_turn)};
}

}  // namespace sixstep::control
