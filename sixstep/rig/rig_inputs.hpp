// SPDX-License-Identifier: Apache-2.0
// The rig's inputs: the Hall lines and the sample in the middle of a period. Part of rig.hpp.
#pragma once
#include "sixstep/rig/rig.hpp"

namespace sixstep::rig {

template <class Real, class Firmware>
void Rig<Real, Firmware>::sector_edge() {
  count(Happening::sector_edge);
  const std::uint8_t stuck = stuck_high_ | stuck_low_;
  // The one line that changes between this sector and its neighbour behind is stuck: no edge on the pins.
  const int s = plant_.sector(), behind = (s + (plant_.state().w < Real(0) ? 1 : 5)) % 6;
  if ((plant::hall_code(s) ^ plant::hall_code(behind)) & stuck) return;
  hall_edge();
}

/// A line breaks: where it stood the other way, that is an edge on the pins.
template <class Real, class Firmware>
void Rig<Real, Firmware>::stick_hall(double line) {
  const std::uint8_t before = pins(), bit = static_cast<std::uint8_t>(8 >> static_cast<int>(std::fabs(line)));
  (line > 0 ? stuck_high_ : stuck_low_) |= bit;
  if (pins() != before) hall_edge();
}

/// Sampled in the middle of a period: the answer waits in the timer's buffer for the next start.
template <class Real, class Firmware>
bool Rig<Real, Firmware>::do_half_tick() {
  const std::int64_t period = board_.modulator.period_ticks, first = period / 2;
  half_ = !half_;
  next_tick_.ticks += half_ ? first : period - first;
  if (half_) {
    reversed_ = loaded_reversed_;
    modulator_.start_period(now_, loaded_);
    return true;
  }
  control_step(true);
  count(Happening::tick);
  return ticked_ = true;
}

}  // namespace sixstep::rig
