// SPDX-License-Identifier: Apache-2.0
// The keys of a scenario with a linear motor, each with the rotary motor's key that it replaces
// (base/linear.hpp).
#pragma once
#include "sixstep/base/angle.hpp"
#include "sixstep/base/describe.hpp"

namespace sixstep::study::words {

using base::Spelling;

inline constexpr Spelling force[] = {{.key = "force_N", .unit = "N", .linear = true}};
inline constexpr Spelling forces[] = {{.key = "forces_N", .unit = "N", .linear = true}};
inline constexpr Spelling viscous[] = {{.key = "viscous_N_s_m", .unit = "N s/m", .linear = true}};
inline constexpr Spelling coulomb[] = {{.key = "coulomb_N", .unit = "N", .linear = true}};
inline constexpr Spelling breakaway[] = {{.key = "static_N", .unit = "N", .linear = true}};
inline constexpr Spelling mass[] = {{.key = "mass_kg", .unit = "kg", .linear = true}};
inline constexpr Spelling stiffness[] = {{.key = "stiffness_N_m", .unit = "N/m", .linear = true}};
inline constexpr Spelling damping[] = {{.key = "damping_N_s_m", .unit = "N s/m", .linear = true}};
inline constexpr Spelling at_speeds[] = {{.key = "at_speeds_m_s", .unit = "m/s", .linear = true}};
inline constexpr Spelling at_speeds_forces[] = {{.key = "at_speeds_N", .unit = "N", .linear = true}};
inline constexpr Spelling dynamometer[] = {{.key = "dynamometer_m_s", .unit = "m/s", .linear = true}};
inline constexpr Spelling drag[] = {{.key = "drag_N_s2_m2", .unit = "N s2/m2", .linear = true}};
inline constexpr Spelling speed[] = {{.key = "speed_m_s", .unit = "m/s", .linear = true}};
inline constexpr Spelling acceleration[] = {{.key = "acceleration_m_s2", .unit = "m/s2", .linear = true}};
inline constexpr Spelling jerk[] = {{.key = "jerk_m_s3", .unit = "m/s3", .linear = true}};
inline constexpr Spelling position[] = {{.key = "position_mm", .ten = -3, .unit = "mm", .linear = true}};
inline constexpr Spelling force_limit[] = {{.key = "force_limit_N", .unit = "N", .linear = true}};
inline constexpr Spelling speed_limit[] = {{.key = "speed_limit_m_s", .unit = "m/s", .linear = true}};
inline constexpr Spelling over_speed[] = {{.key = "over_speed_m_s", .unit = "m/s", .linear = true}};
inline constexpr Spelling short_below[] = {{.key = "short_below_m_s", .unit = "m/s", .linear = true}};
inline constexpr Spelling standing[] = {{.key = "standing_m_s", .unit = "m/s", .linear = true}};
/// 1 mm corresponds to 0.18/pi degrees.
inline constexpr Spelling position_gain[] = {
    {.key = "gain_m_s_per_mm", .unit = "m/s/mm", .factor = base::pi / 0.18, .linear = true}};
inline constexpr Spelling full_position[] = {
    {.key = "position_mm", .unit = "mm", .factor = 0.18 / base::pi, .linear = true}};
inline constexpr Spelling speed_limit_gain[] = {{.key = "gain_A_s_per_m", .unit = "A s/m", .linear = true}};

}  // namespace sixstep::study::words
