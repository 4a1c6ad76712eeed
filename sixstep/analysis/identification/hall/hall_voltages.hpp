// SPDX-License-Identifier: Apache-2.0
// Finds the rotor's true angle: compares the induced voltages with the path from the Hall lines.
//
// The vector of the three voltages turns with the rotor. Its length is proportional to the speed w, and its
// phase is the electrical angle theta (notation.md): e_a = lambda w cos(theta - 60 degrees) and its
// harmonics, with the flux linkage lambda and w < 0 if the rotor turns backwards.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "sixstep/analysis/identification/hall/hall_log.hpp"
#include "sixstep/analysis/identification/hall/hall_motion.hpp"
#include "sixstep/base/result.hpp"

namespace sixstep::analysis {

struct VoltageVector {
  double t_s = 0.0, alpha_V = 0.0, beta_V = 0.0;
};
std::vector<VoltageVector> vectors_of(const HallLog& log);

/// Orders of the vector's harmonics: no multiples of 3. The vector of a positive order turns forward, the
/// vector of a negative order backward.
inline constexpr std::array<int, 5> vector_orders = {1, -5, 7, -11, 13};

/// The vector over the path: sum over orders h of K_h w exp(j h theta), and an offset. |K_1| is the flux
/// linkage of a phase. The phase of K_1 is -60 degrees if theta is the electrical angle.
struct VoltageModel {
  std::array<double, vector_orders.size()> re_Vs{}, im_Vs{};
  double offset_alpha_V = 0.0, offset_beta_V = 0.0;
  double variance_V2 = 0.0;         ///< variance of each component's white noise
  double flux_half_width_Vs = 0.0;  ///< 95 % half width of |K_1|, from the differences of half turns
  double residual_V2 = 0.0;         ///< sum of squares over both components
  double still_V2 = 0.0;            ///< residual_V2 of a model with an offset only, as with a rotor at rest
  std::size_t rows = 0;
  double memory_rows = 1.0;  ///< number of rows with as much information as one independent row
};

/// Fits the model. Empty if the rotor hardly moves while voltages are recorded.
std::optional<VoltageModel> fit_voltages(const std::vector<VoltageVector>& vectors, const MotionPath& path);

/// Rotates the model so that the fundamental has the angle of notation.md. Returns the error of the path's
/// angle, in degrees.
double turned_into_place(VoltageModel& model);

/// The voltages' phase as sightings, one for every few degrees of the path.
std::vector<Sighting> voltage_sightings(const std::vector<VoltageVector>& vectors, const VoltageModel& model,
                                        const MotionPath& path);

}  // namespace sixstep::analysis
