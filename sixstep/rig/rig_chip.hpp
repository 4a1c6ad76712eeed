// SPDX-License-Identifier: Apache-2.0
// Member functions of rig.hpp for an emulated chip (chip_drive.hpp). When the plant reaches the chip's stop,
// the rig applies the chip's actions, and the chip continues.
#pragma once
#include "sixstep/rig/rig.hpp"

namespace sixstep::rig {

template <class Real, class Firmware, class Plant>
bool Rig<Real, Firmware, Plant>::do_chip() {
  if constexpr (keeps_time) {
    if (now_ < firmware_.next_stop()) return false;
    if (firmware_.samples()) {
      if (moving_) follow_waveform();
      const plant::State<Real>& state = wires_.at_legs(plant_.state());
      const plant::Legs& legs = wires_.at_legs(plant_.mode().legs);
      SampleInstant<Real> instant{state,
                                  legs,
                                  plant_.constants().pole_pairs,
                                  now_,
                                  static_cast<std::uint64_t>(event_count(EventKind::tick)),
                                  chip_pins()};
      instant.shunts = board_.sensors.low_side.shunts;
      firmware_.sample(instant, setpoint_);
    }
    if (firmware_.samples_current()) {
      warm_up();
      modulator_.end_period(now_);
      count(EventKind::tick);
      ticked_ = true;
    }
    if (firmware_.gates().bits != gates_of(modulator_.gates())) count(EventKind::pwm_edge);
    modulator_.take(now_, firmware_.gates());
    firmware_.go_on(quiet_s());
    if (firmware_.lost()) fault_ = Fault::core;
    return true;
  }
  return false;
}

/// Time, s, in which the rotor turns by half of the angle to the next edge, at the present speed and twice
/// the present acceleration. Successive stops therefore halve the remaining angle, down to the shortest step.
/// A slow rotor may reverse; then the nearer of the two edges counts.
template <class Real, class Firmware, class Plant>
double Rig<Real, Firmware, Plant>::quiet_s() const {
  constexpr double longest_s = 25e-6;
  const plant::State<Real>& s = plant_.state();
  const auto poles = static_cast<double>(plant_.constants().pole_pairs);
  const auto& y = plant_.expansion();
  const double speed = std::fabs(static_cast<double>(s.w)) * poles;
  const double gains = y.h > 0 ? 2 * std::fabs(static_cast<double>(y.w[1]) / y.h) * poles : 0.0;
  const double behind = static_cast<double>(s.x), ahead = base::sector_rad - behind;
  double way = static_cast<double>(s.w) < 0 ? behind : ahead;
  if (speed <= gains * longest_s) way = std::min(behind, ahead);
  // Solves way/2 = speed t + gains t^2/2 for t.
  return std::min(longest_s, way / (speed + std::sqrt(speed * speed + gains * way) + 1e-9));
}

}  // namespace sixstep::rig
