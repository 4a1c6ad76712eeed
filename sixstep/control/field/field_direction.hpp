// SPDX-License-Identifier: Apache-2.0
// Where the magnet points when the currents are sampled, and where it will point in the middle of the period that
// the answer fills (model.md 11):
//
//   theta_d = theta_e - 150 degrees,   theta_d' = theta_d + (n + 1/2) T w_e
//
// n periods lie between the sample and the period it is answered in. An answer that is turned into the stator's frame by
// theta_d itself lags by that angle: at (n + 1/2) T w_e = 90 degrees all of v_q would act along d.
#pragma once
#include "sixstep/control/frames.hpp"
#include "sixstep/control/sensing/binary_angle.hpp"
#include "sixstep/control/sensing/sine.hpp"

namespace sixstep::control {

/// As cosine and sine: an ideal sensor tells them, or field_directions() makes them of an angle.
template <class Scalar>
struct FieldDirections {
  Direction<Scalar> sampled{}, answered{};
  BinaryAngle angle = 0;  ///< of `sampled`, for what hangs on the angle itself
};

/// The default does not turn on.
template <class Scalar>
struct FieldAdvanceConfig {
  Gain<Scalar> rad_s{};  ///< (n + 1/2) T p: electrical rad per mechanical rad/s; more than 1 rad is cut off
  bool operator==(const FieldAdvanceConfig&) const = default;
};

/// The magnet's direction; 150 degrees are 5/12 of a turn.
constexpr BinaryAngle magnet_angle(BinaryAngle electrical) { return electrical - 1789569707u; }

/// A magnet that turns on by so much at this speed.
template <class Scalar>
constexpr BinaryAngle turned_on(BinaryAngle magnet, Scalar speed_rad_s, Gain<Scalar> rad_s) {
  const std::int32_t on = angle_of_rad(ScalarTraits<Scalar>::product(speed_rad_s, rad_s));
  return magnet + static_cast<BinaryAngle>(on);
}

/// Of the magnet's own angle.
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
