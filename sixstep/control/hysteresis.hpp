// SPDX-License-Identifier: Apache-2.0
// Controls the current between two levels: on below |i_ref| - h, off above |i_ref| + h, unchanged between;
// starts on (model.md 4).
#pragma once

#include "sixstep/control/bridge_command.hpp"

namespace sixstep::control {

/// The comparators are on the board (events, no sampling), or hysteresis_step() replaces them once per control
/// tick.
template <class Scalar>
struct HysteresisConfig {
  Scalar band_A{};             ///< h, half the width of the band
  Watch watch = Watch::motor;  ///< current that the board's comparators use; Watch::none: i_m, sampled here
  bool operator==(const HysteresisConfig&) const = default;
};

template <class Scalar>
struct HysteresisState {
  bool on = true;
};

/// The sampled form. `current` and `reference` are counted positive in the direction of the reference.
template <class Scalar>
constexpr bool hysteresis_step(const HysteresisConfig<Scalar>& config, HysteresisState<Scalar>& state,
                               Scalar current, Scalar reference) {
  if (current > reference + config.band_A) state.on = false;
  if (current < reference - config.band_A) state.on = true;
  return state.on;
}

}  // namespace sixstep::control
