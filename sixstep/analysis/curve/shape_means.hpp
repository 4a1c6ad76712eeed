// SPDX-License-Identifier: Apache-2.0
// Computes the torque of a slowly turning rotor from the current of a held rotor. The means over the angle
// use the driven pair's shape g = f_p - f_n, with the back-EMF shapes f_p, f_n of its positive and negative
// phase.
#pragma once
#include "sixstep/analysis/curve/operating_point.hpp"
#include "sixstep/analysis/curve/sums_recorder.hpp"
#include "sixstep/plant/back_emf.hpp"

namespace sixstep::analysis {

/// K_e (f_p - f_n) over a sector, N m/A: its mean, the mean of its square, and its extremes.
struct ShapeMeans {
  double mean = 0.0, square = 0.0, low = 0.0, high = 0.0;
};
ShapeMeans shape_means(const plant::Machine& machine);

/// Sets torque and ripple over all instants and angles: at standstill T = K_e g(theta) i_m(t) with
/// independent theta and t.
void spread_over_angles(const design::MotorModel& motor, const Sums& sums, OperatingPoint& p);

/// The torque of the same current with a held rotor; its ripple is computed at the angle of least torque.
LockedRotor locked_rotor(const design::MotorModel& motor, const Sums& sums);

}  // namespace sixstep::analysis
