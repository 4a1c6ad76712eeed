// SPDX-License-Identifier: Apache-2.0
// Where the rotor really is: the voltages that it induces, held against the way that the Hall lines tell.
//
// The vector of the three voltages turns with the rotor, as long as the speed is high, and its phase is the electrical angle
// (notation.md): e_a = lambda w cos(theta - 60 degrees) and its harmonics, w < 0 where the rotor turns backwards.
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

/// Orders of the vector's harmonics: what is no multiple of 3, turning forward (+) or backward (-).
inline constexpr std::array<int, 5> vector_orders = {1, -5, 7, -11, 13};

/// The vector over the way: sum over orders h of K_h w exp(j h theta), and an offset. K_1 is the flux linkage of a phase, its
/// phase -60 degrees where theta is the electrical angle.
struct VoltageModel {
  std::array<double, vector_orders.size()> re_Vs{}, im_Vs{};
  double offset_alpha_V = 0.0, offset_beta_V = 0.0;
  double variance_V2 = 0.0;         ///< of each component, white
  double flux_half_width_Vs = 0.0;  ///< of |K_1|, 95 %, by how much half turns differ
  double residual_V2 = 0.0;         ///< sum of squares over both components
  double still_V2 = 0.0;            ///< the same with the offset alone
  std::size_t rows = 0;
  double memory_rows = 1.0;  ///< rows that say as much as one independent one
};

/// Nothing where the rotor hardly moves while voltages are recorded.
std::optional<VoltageModel> fit_voltages(const std::vector<VoltageVector>& vectors, const MotionPath& path);

/// The same with the angle of the fundamental as notation.md has it: the path then is off by the degrees that come back.
double turned_into_place(VoltageModel& model);

/// The phase of every few degrees of way as a sighting.
std::vector<Sighting> voltage_sightings(const std::vector<VoltageVector>& vectors, const VoltageModel& model,
                                        const MotionPath& path);

}  // namespace sixstep::analysis
