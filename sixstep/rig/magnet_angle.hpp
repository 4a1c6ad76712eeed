// SPDX-License-Identifier: Apache-2.0
// True direction of the magnet relative to phase a's axis: theta_d = theta_e - 150 electrical degrees
// (control/frames.hpp).
#pragma once
#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/control/frames.hpp"
#include "sixstep/control/sensing/binary_angle.hpp"
#include "sixstep/plant/state.hpp"

namespace sixstep::rig {

inline constexpr double magnet_behind_rad = 5 * base::pi / 6;

/// Direction of the magnet, electrical rad, within one turn.
template <class Real>
double magnet_rad(const plant::State<Real>& s) {
  return plant::sector_in_turn(s.sector) * base::sector_rad + static_cast<double>(s.x) - magnet_behind_rad;
}

inline control::BinaryAngle binary_angle(double rad) { return control::binary_degrees(rad * 180 / base::pi); }

template <class Scalar>
control::Direction<Scalar> direction_at(double rad) {
  const base::SinCos at = base::sin_cos(rad);
  return {static_cast<Scalar>(at.cos), static_cast<Scalar>(at.sin)};
}

}  // namespace sixstep::rig
