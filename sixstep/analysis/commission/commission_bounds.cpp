// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sixstep/analysis/commission/commission_study.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::analysis {
namespace {

/// Bound in standard deviations: a normally distributed value exceeds it once in 370.
constexpr double deviations = 3.0;
constexpr double per_rad = 180 / base::pi;

/// Errors that the converters' noise causes: in the difference of the two levels' means (counts), and in the
/// area of the steps between the levels (ticks).
struct OfNoise {
  double level_counts, area_ticks;

  OfNoise(const CommissionBench& b, const control::LevelStepsConfig& steps, double apart) {
    const double noise = deviations * b.noise_A / b.board.A_per_count, n = steps.ticks, pairs = steps.pairs;
    // The current along a vector, (2 i_a - i_b - i_c)/3, has sqrt(2/3) of a sample's noise. A level's mean is
    // over a quarter of its ticks, and the difference of two means has the noise of both.
    const double along = noise * std::sqrt(2.0 / 3.0);
    level_counts = along * std::sqrt(2.0 / (n / 4 * pairs));
    // The area contains the tails with weight three and the rest with weight one (level_steps.hpp). With N
    // ticks in all tails, its variance equals the variance of 24 N samples. The result is divided by the
    // number of steps, which is twice `pairs`.
    area_ticks = along * std::sqrt(6.0 * n * pairs) / (2 * pairs * apart);
  }
};

/// Angle between rotor and field that cogging and a back-EMF without sine shape cause. At rest, a trapezoid
/// causes 1.12 degrees. During the turn the trapezoid's angle is a ripple at up to a third of the rotor's
/// resonance frequency; the resonance amplifies it by up to 1/(1 - 1/9) (commission_bench.cpp), and friction
/// changes this factor by at most a twentieth.
double of_motor_deg(const CommissionBench& b) {
  constexpr double trapezoid_deg = 1.12 / (1 - 1.0 / 9) * 1.05;
  const double torque = 1.5 * b.compiled.motor.machine.pole_pairs * b.truth.flux_linkage_Vs * b.wish.test_A;
  const double aside = std::min(b.truth.cogging_Nm / torque, 1.0);
  return (b.truth.sine ? 0.0 : trapezoid_deg) + base::atan2(aside, std::sqrt(1 - aside * aside)) * per_rad;
}

/// Angle error by dead time and diodes. The signs of their voltage are the signs of the currents; the angle
/// of this voltage differs from the vector's angle by up to 30 degrees.
double of_drop_deg(const control::CommissioningState& found) {
  const double lost = std::fabs(static_cast<double>(found.winding.lost)), applied = found.magnet.applied;
  return applied > lost ? base::atan2(0.5 * lost, applied - lost) * per_rad : 0.0;
}

/// Error by unknown signs, as a fraction of the back-EMF. The voltage of dead time and diodes has the
/// currents' signs. If |current| is smaller than its ripple and noise, its sign is unknown, and `lost` is
/// wrong in this part of a turn.
double of_signs(const CommissionBench& b, const control::CommissioningState& found,
                const control::Commissioned<double>& si) {
  const double lost = std::fabs(static_cast<double>(found.winding.lost)), emf = found.magnet.emf,
               applied = found.magnet.applied;
  const double V = applied / 256.0 * b.board.V_per_count;
  const double turning_A = std::max(applied - lost - emf, 0.0) / applied * V / si.R_ohm;
  const double ripple_A = V * b.board.period_s / (4 * si.L_H);
  const double unknown_A = ripple_A + deviations * b.noise_A + 0.5 * b.board.A_per_count;
  const double part = unknown_A < turning_A ? 2 / base::pi * unknown_A / turning_A : 2 / base::pi;
  return lost / emf * part;
}

}  // namespace

CommissionBounds bounds_of(const CommissionBench& b, const control::CommissioningState& found) {
  const control::CommissioningConfig config = control::commissioning_config(b.board, b.wish);
  CommissionBounds out;
  // Angle of one count of the capture timer, in both directions and at both ends. Without a measured winding,
  // the bounds other than edge_deg are 0.
  const double count_deg = 360.0 * b.wish.slow_turns_s / b.board.timer_Hz;
  out.edge_deg = 6 * count_deg + of_drop_deg(found) + of_motor_deg(b);
  if (!found.winding.usable) return out;
  const double apart = (found.winding.higher - found.winding.lower) / 24.0;
  const double bus = 0.5 * b.board.V_per_count / b.voltage_V;
  const OfNoise noise(b, config.steps, apart);
  out.R_part = (4.0 / 3.0 + noise.level_counts) / apart + bus;
  // The ripple within a period changes the measured step by at most the fraction (T/tau)^2/4; T: period, tau:
  // L/R.
  const double ticks = found.winding.tau / 65536.0;
  out.L_part = out.R_part + base::log(2 * apart) / apart + 1 / (4 * ticks * ticks) + noise.area_ticks / ticks;
  if (found.magnet.emf <= 0 || found.magnet.flux <= 0) return out;
  // psi = |v - R i - j w L i|/w; psi: flux linkage, v: voltage, i: current, w: electrical speed. With the
  // back-EMF e, an error of R is weighted by R i/e, at most v/e, and an error of L by L i/psi.
  const auto si = control::commissioned<double>(control::commissioning_scale<double>(b.board), found);
  const double i_A = found.v * b.voltage_V / control::whole_bus / si.R_ohm;
  out.flux_part = static_cast<double>(found.magnet.applied) / found.magnet.emf * (out.R_part + bus) +
                  si.L_H * i_A / si.flux_linkage_Vs * out.L_part + of_signs(b, found, si) +
                  b.truth.beyond_L_H * i_A / si.flux_linkage_Vs;
  return out;
}

}  // namespace sixstep::analysis
