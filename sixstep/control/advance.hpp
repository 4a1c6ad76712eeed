// SPDX-License-Identifier: Apache-2.0
// Commutates ahead of the Hall edge: the pair changes once the interpolated angle is within the advance angle
// of the next edge. This compensates the lag L/R of the current and, at speed, the lag of filters.
//
//   advance = fixed + per_speed |w|, at most limit;    switch early where fraction >= 1 - advance
//
// advance and fraction are in sectors (1 = 60 electrical degrees), measured in the direction of rotation. w
// is the mechanical speed.
#pragma once
#include <cstdint>

#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: the drive commutates at the edge. With a limit of 1/2 or less, the drive commutates at most 30
/// electrical degrees before the edge.
template <class Scalar>
struct AdvanceConfig {
  Scalar fixed{};            ///< sectors
  Gain<Scalar> per_speed{};  ///< sectors per rad/s, mechanical
  Scalar limit{};            ///< sectors, below 1
  bool operator==(const AdvanceConfig&) const = default;
};

template <class Scalar>
constexpr Scalar advance_angle(const AdvanceConfig<Scalar>& config, Scalar speed_rad_s) {
  const Scalar wanted =
      config.fixed + ScalarTraits<Scalar>::product(magnitude(speed_rad_s), config.per_speed);
  return between(wanted, Scalar{}, config.limit);
}

/// The sector whose pair the drive selects. `direction`: -1, 0 or 1. `fraction`: distance since the last edge
/// in `direction`, in sectors.
template <class Scalar>
constexpr std::uint8_t advanced_sector(const AdvanceConfig<Scalar>& config, std::uint8_t sector,
                                       std::int8_t direction, Scalar fraction, Scalar speed_rad_s) {
  if (sector > 5 || direction == 0) return sector;
  const Scalar advance = advance_angle(config, speed_rad_s);
  if (!(advance > Scalar{}) || fraction < one<Scalar> - advance) return sector;
  return static_cast<std::uint8_t>((sector + (direction > 0 ? 1 : 5)) % 6);
}

}  // namespace sixstep::control
