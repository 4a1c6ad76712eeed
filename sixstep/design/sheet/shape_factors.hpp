// SPDX-License-Identifier: Apache-2.0
// Factors of a back-EMF's shape, from one phase of peak 1 to line values, means and the fundamental. They
// convert a printed constant of any convention to K_e.
#pragma once
#include <span>

#include "sixstep/design/sheet/sheet.hpp"

namespace sixstep::design {

/// Sheets with "peak", "rms" or "flux linkage" assume a sine machine. For a trapezoid the same measurement
/// has other factors; the members are the factors of the given shape. The comments give two values: for 120
/// degrees flat, and for a sine.
struct ShapeFactors {
  double sector_mean = 0.0;  ///< mean of f_p - f_n over a sector: K_t/K_e; 2, 1.65399
  double line_peak = 0.0;    ///< largest f_a - f_b; 2, sqrt 3
  double line_rms = 0.0;     ///< rms of f_a - f_b; 1.49071, 1.22474
  double phase_rms = 0.0;    ///< rms of f_a; 0.88192, 0.70711
  double phase_peak = 0.0;   ///< largest |f_a|; 1 for trapezoid and sine, another value for harmonics or a
                             ///< table
  double fundamental =
      0.0;  ///< amplitude of the first harmonic, which a field-oriented drive uses; 1.21585, 1
};

/// Factors of a trapezoid or a sine. flat_deg in (0, 180); ignored for a sine.
ShapeFactors shape_factors(BackEmfShape shape, double flat_deg);

/// Factors of a sine with odd harmonics. There is one size for each order, relative to the sine's peak.
ShapeFactors harmonic_factors(std::span<const double> orders, std::span<const double> sizes);

/// Factors of a table (model.md 7), exact by the integrals of its straight lines. Angles are in degrees as in
/// sheet_description.hpp, with one value for each, at least two points. sector_mean is the mean over all six
/// sectors, each with its own pair; no symmetry is required. The values are not normalised.
ShapeFactors table_factors(std::span<const double> angle_deg, std::span<const double> values);

/// Torque per ampere, N m/A, for sine currents of rms 1 A in phase with the back-EMF: (3/2) sqrt 2 K_e times
/// the fundamental.
inline double torque_per_rms_A(double K_e_V_s, const ShapeFactors& f) {
  return 1.5 * 1.4142135623730951 * K_e_V_s * f.fundamental;
}

}  // namespace sixstep::design
