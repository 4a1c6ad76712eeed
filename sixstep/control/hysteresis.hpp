// SPDX-License-Identifier: Apache-2.0
// Two-level current control: on below |i_ref| - h, off above |i_ref| + h, kept between, starts on (model.md
// 4).
#pragma once

#include "sixstep/control/bridge_command.hpp"

namespace sixstep::control {

/// Where the comparators sit: on the board (an event, no sampling) or here, once per control tick.
template <class Scalar>
struct HysteresisConfig {
  Scalar band_A{};             ///< h, half the width of the band
  Watch watch = Watch::motor;  ///< what the board's comparators look at; Watch::none: sampled here, on i_m
  bool operator==(const HysteresisConfig&) const = default;
};

template <class Scalar>
struct HysteresisState {
  bool on = true;
};

/// The sampled form; `current` and `reference` are taken in the direction of the reference, so both are
/// positive.
template <class Scalar>
constexpr bool hysteresis_step(const HysteresisConfig<Scalar>& config, HysteresisState<Scalar>& state,
                               Scalar current, Scalar reference) {
  if (current > reference + config.band_A) state.on = false;
  if (current < reference - config.band_A) state.on = true;
  return state.on;
}

}  // namespace sixstep::control
