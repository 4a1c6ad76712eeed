// SPDX-License-Identifier: Apache-2.0
// Computes the direction of the magnet at two instants: when the currents are sampled, and in the middle of
// the period in which the output acts (model.md 11):
//
//   theta_d = theta_e - 150 degrees,   theta_d' = theta_d + (n + 1/2) T w_e
//
// n: periods between the sample and the begin of its output, T: control period, w_e: electrical speed. An
// output that is rotated into the stator's frame by theta_d instead of theta_d' lags by (n + 1/2) T w_e. With
// a lag of 90 degrees v_q would act along d only.
#pragma once
#include "sixstep/control/frames.hpp"
#include "sixstep/control/sensing/binary_angle.hpp"
#include "sixstep/control/sensing/sine.hpp"

namespace sixstep::control {

/// Directions as cosine and sine: `sampled` is theta_d, `answered` is theta_d'. An ideal sensor or
/// field_directions() supplies them.
template <class Scalar>
struct FieldDirections {
  Direction<Scalar> sampled{}, answered{};
  BinaryAngle angle = 0;  ///< `sampled` as an angle, for quantities that depend on the angle itself
};

/// Default: no advance.
template <class Scalar>
struct FieldAdvanceConfig {
  Gain<Scalar> rad_s{};  ///< (n + 1/2) T p: electrical rad per mechanical rad/s; clamped to 1 rad
  bool operator==(const FieldAdvanceConfig&) const = default;
};

/// The magnet's angle theta_d from the electrical angle theta_e; 150 degrees are 5/12 of a turn.
constexpr BinaryAngle magnet_angle(BinaryAngle electrical) { return electrical - 1789569707u; }

/// The magnet's angle after a rotation by speed times `rad_s`.
template <class Scalar>
constexpr BinaryAngle turned_on(BinaryAngle magnet, Scalar speed_rad_s, Gain<Scalar> rad_s) {
  const std::int32_t on = angle_of_rad(ScalarTraits<Scalar>::product(speed_rad_s, rad_s));
  return magnet + static_cast<BinaryAngle>(on);
}

/// Directions from the angle theta_d at the sample.
template <class Scalar>
constexpr FieldDirections<Scalar> magnet_directions(const FieldAdvanceConfig<Scalar>& config,
                                                    BinaryAngle sampled, Scalar speed_rad_s) {
  return {direction_of<Scalar>(sampled), direction_of<Scalar>(turned_on(sampled, speed_rad_s, config.rad_s)),
          sampled};
}

template <class Scalar>
constexpr FieldDirections<Scalar> field_directions(const FieldAdvanceConfig<Scalar>& config,
                                                   BinaryAngle electrical, Scalar speed_rad_s) {
  return magnet_directions(config, magnet_angle(electrical), speed_rad_s);
}

}  // namespace sixstep::control
