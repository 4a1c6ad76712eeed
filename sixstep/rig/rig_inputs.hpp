// SPDX-License-Identifier: Apache-2.0
// The rig's inputs: what the controller is given at a sample and at a Hall edge. Part of rig.hpp.
#pragma once
#include "sixstep/rig/rig.hpp"

namespace sixstep::rig {

template <class Real, class Scalar>
control::Measurement<Scalar> Rig<Real, Scalar>::measure() {
  const plant::State<Real>& s = plant_.state();
  const Real sector_deg = static_cast<Real>(s.sector) * 60 + s.x * Real(180) / Real(base::pi);
  const Units& u = board_.units;
  control::Measurement<Scalar> m{
      .i_a_A = from_si<Scalar>(s.i[0], u.current_A),
      .i_b_A = from_si<Scalar>(s.i[1], u.current_A),
      .i_c_A = from_si<Scalar>(s.i[2], u.current_A),
      .speed_rad_s = from_si<Scalar>(s.w, u.speed_rad_s),
      .position_deg = from_si<Scalar>(sector_deg / plant_.constants().pole_pairs, u.position_deg),
      .bus_V = from_si<Scalar>(s.bus, u.voltage_V),
      .hall = pins()};
  if (!sensors_.on()) return m;
  Sample sample{.bus_V = static_cast<double>(s.bus),
                .at = now_,
                .number = static_cast<std::uint64_t>(happened(Happening::tick)),
                .duty = modulator_.command().duty,
                .reversed = reversed_};
  for (std::size_t k = 0; k < 3; ++k) {
    sample.i_A[k] = static_cast<double>(s.i[k]);
    if (plant::is_high(plant_.mode().legs[k])) sample.dc_link_A += sample.i_A[k];
  }
  sensors_.sense(m, sample);
  return m;
}

template <class Real, class Scalar>
void Rig<Real, Scalar>::sector_edge() {
  count(Happening::sector_edge);
  const std::uint8_t stuck = stuck_high_ | stuck_low_;
  // The one line that changes between this sector and its neighbour behind is stuck: no edge on the pins.
  const int s = plant_.sector(), behind = (s + (plant_.state().w < Real(0) ? 1 : 5)) % 6;
  if ((plant::hall_code(s) ^ plant::hall_code(behind)) & stuck) return;
  hall_edge();
}

/// A line breaks: where it stood the other way, that is an edge on the pins.
template <class Real, class Scalar>
void Rig<Real, Scalar>::stick_hall(double line) {
  const std::uint8_t before = pins(), bit = static_cast<std::uint8_t>(8 >> static_cast<int>(std::fabs(line)));
  (line > 0 ? stuck_high_ : stuck_low_) |= bit;
  if (pins() != before) hall_edge();
}

/// Sampled in the middle of a period: the answer waits in the timer's buffer for the next start.
template <class Real, class Scalar>
bool Rig<Real, Scalar>::do_half_tick() {
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
