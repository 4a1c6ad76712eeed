// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/curve/shape_means.hpp"

#include "sixstep/series/quadrature.hpp"

namespace sixstep::analysis {
namespace {

/// Sector 0 drives a against b (model.md 3). A trapezoid's g is linear on each piece; the values at the ends
/// of a piece therefore determine its means.
ShapeMeans trapezoid(double flat_deg) {
  const plant::EmfSector<double> sector = plant::trapezoid_table<double>(flat_deg)[0];
  ShapeMeans out{.low = 2.0, .high = 0.0};
  for (int n = 0; n < sector.count; ++n) {
    const plant::EmfPiece<double>& piece = sector.piece[static_cast<std::size_t>(n)];
    const auto g = [&](double x) {
      return piece.alpha[0] - piece.alpha[1] + (piece.beta[0] - piece.beta[1]) * x;
    };
    const double a = g(piece.from), b = g(piece.to), share = (piece.to - piece.from) / base::sector_rad;
    out.mean += share * (a + b) / 2;
    out.square += share * (a * a + a * b + b * b) / 3;
    out.low = std::min({out.low, a, b});
    out.high = std::max({out.high, a, b});
  }
  return out;
}

/// g = sqrt(3) cos(x - 30 deg), x in 0..60 deg: mean 3 sqrt(3)/pi, mean square (3/2)(1 + sin(60 deg) 3/pi).
ShapeMeans sine() {
  const double root3 = std::sqrt(3.0);
  return {3 * root3 / base::pi, 1.5 * (1 + 1.5 * root3 / base::pi), 1.5, root3};
}

}  // namespace

ShapeMeans shape_means(const plant::Machine& m) {
  ShapeMeans s = m.back_emf == plant::BackEmf::sine ? sine() : trapezoid(m.flat_deg);
  const double K = m.K_e_V_s;
  return {K * s.mean, K * K * s.square, K * s.low, K * s.high};
}

void spread_over_angles(const design::MotorModel& motor, const Sums& sums, OperatingPoint& p) {
  const ShapeMeans g = shape_means(motor.machine);
  const double T = sums.seconds, i = sums.motor / T;
  p.torque_Nm = g.mean * i;
  p.ripple_rms_Nm = std::sqrt(std::max(0.0, g.square * sums.motor_square / T - p.torque_Nm * p.torque_Nm));
  const double highest = sums.motor_high > 0 ? g.high * sums.motor_high : g.low * sums.motor_high;
  const double lowest = sums.motor_low > 0 ? g.low * sums.motor_low : g.high * sums.motor_low;
  p.ripple_Nm = highest - lowest;
}

LockedRotor locked_rotor(const design::MotorModel& motor, const Sums& sums) {
  const ShapeMeans g = shape_means(motor.machine);
  const double T = sums.seconds, i = sums.motor / T;
  return {.phase_rms_A = std::sqrt(sums.copper / T / (2 * motor.machine.R_ohm)),
          .least_torque_Nm = g.low * i,
          .greatest_torque_Nm = g.high * i,
          .ripple_Nm = g.low * (sums.motor_high - sums.motor_low)};
}

}  // namespace sixstep::analysis
