// SPDX-License-Identifier: Apache-2.0
// Controls the current between two levels. The switch turns on below |i_ref| - h and off above |i_ref| + h,
// with the reference i_ref and half the band h. Between the levels it does not change. It is initially on
// (model.md 4).
#pragma once

#include "sixstep/control/bridge_command.hpp"

namespace sixstep::control {

/// Two kinds: with `watch` set, the board's comparators switch without sampling. With Watch::none,
/// hysteresis_step() compares once per control tick.
template <class Scalar>
struct HysteresisConfig {
  Scalar band_A{};             ///< h, half the width of the band
  Watch watch = Watch::motor;  ///< current that the board's comparators use; Watch::none: hysteresis_step()
                               ///< uses the sampled i_m
  bool operator==(const HysteresisConfig&) const = default;
};

template <class Scalar>
struct HysteresisState {
  bool on = true;
};

/// One control tick with a sampled current. `current` and `reference`, A, are positive in the direction of
/// the reference. Returns true if the switch is on.
template <class Scalar>
constexpr bool hysteresis_step(const HysteresisConfig<Scalar>& config, HysteresisState<Scalar>& state,
                               Scalar current, Scalar reference) {
  if (current > reference + config.band_A) state.on = false;
  if (current < reference - config.band_A) state.on = true;
  return state.on;
}

}  // namespace sixstep::control
