// SPDX-License-Identifier: Apache-2.0
// Finds the rotor's true angle: compares the voltages that it induces with the path from the Hall lines.
//
// The vector of the three voltages turns with the rotor, as long as the speed is high, and its phase is the
// electrical angle (notation.md): e_a = lambda w cos(theta - 60 degrees) and its harmonics, w < 0 where the rotor
// turns backwards.
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

/// Orders of the vector's harmonics: no multiples of 3, turning forward (+) or backward (-).
inline constexpr std::array<int, 5> vector_orders = {1, -5, 7, -11, 13};

/// The vector over the path: sum over orders h of K_h w exp(j h theta), and an offset. K_1 is the flux linkage of
/// a phase, its phase -60 degrees where theta is the electrical angle.
struct VoltageModel {
  std::array<double, vector_orders.size()> re_Vs{}, im_Vs{};
  double offset_alpha_V = 0.0, offset_beta_V = 0.0;
  double variance_V2 = 0.0;         ///< variance of each component, white
  double flux_half_width_Vs = 0.0;  ///< 95 % half width of |K_1|, from the differences of half turns
  double residual_V2 = 0.0;         ///< sum of squares over both components
  double still_V2 = 0.0;            ///< the same for an offset alone
  std::size_t rows = 0;
  double memory_rows = 1.0;  ///< rows with as much information as one independent row
};

/// Empty where the rotor hardly moves while voltages are recorded.
std::optional<VoltageModel> fit_voltages(const std::vector<VoltageVector>& vectors, const MotionPath& path);

/// Turns the model so that the fundamental's angle is that of notation.md. Returns the path's error in
/// degrees.
double turned_into_place(VoltageModel& model);

/// The voltages' phase as sightings, one for every few degrees of the path.
std::vector<Sighting> voltage_sightings(const std::vector<VoltageVector>& vectors, const VoltageModel& model,
                                        const MotionPath& path);

}  // namespace sixstep::analysis
