// SPDX-License-Identifier: Apache-2.0
// What one phase's back-EMF of peak 1 looks like between terminals, as a mean and as a fundamental: the
// numbers that turn a printed constant of any convention into K_e.
#pragma once
#include <span>

#include "sixstep/design/sheet/sheet.hpp"

namespace sixstep::design {

/// Sheets speak of sine machines when they say "peak", "rms" or "flux linkage". Of a trapezoid the same
/// measurement gives other factors; these are of the shape at hand.
struct ShapeFactors {
  double sector_mean =
      0.0;  ///< of f_p - f_n over a sector: K_t/K_e; 2 for 120 degrees flat, 1.65399 for a sine
  double line_peak = 0.0;   ///< largest f_a - f_b; 2, sqrt 3
  double line_rms = 0.0;    ///< of f_a - f_b; 1.49071, 1.22474
  double phase_rms = 0.0;   ///< 0.88192, 0.70711
  double phase_peak = 0.0;  ///< largest |f_a|; 1 unless a table or harmonics say otherwise
  double fundamental =
      0.0;  ///< amplitude of the first harmonic, what a field-oriented drive sees; 1.21585, 1
};

/// Of a trapezoid or a sine. flat_deg in (0, 180); a sine has no flat top and does not look at it.
ShapeFactors shape_factors(BackEmfShape shape, double flat_deg);

/// Of a sine with odd harmonics beside it: orders and sizes alike in number, sizes as parts of the sine's.
ShapeFactors harmonic_factors(std::span<const double> orders, std::span<const double> sizes);

/// Of a table (model.md 7), by the integrals of its straight lines, exact: angles in degrees as sheet_description.hpp has
/// them, a value for each, two points at least. sector_mean is the mean over all six sectors, each with its pair; no symmetry
/// is asked for. Factors are of the values as they stand.
ShapeFactors table_factors(std::span<const double> angle_deg, std::span<const double> values);

/// Torque per ampere rms of a sine in each phase, in line with the EMF: (3/2) sqrt 2 of the fundamental.
inline double torque_per_rms_A(double K_e_V_s, const ShapeFactors& f) {
  return 1.5 * 1.4142135623730951 * K_e_V_s * f.fundamental;
}

}  // namespace sixstep::design
