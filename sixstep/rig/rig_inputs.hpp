// SPDX-License-Identifier: Apache-2.0
// The rig's inputs: the scenario's timeline, the Hall lines and the sample in the middle of a period. Part of
// rig.hpp.
#pragma once
#include "sixstep/rig/rig.hpp"

namespace sixstep::rig {

template <class Real, class Firmware, class Plant>
bool Rig<Real, Firmware, Plant>::do_timeline() {
  if (next_action_ >= timeline_.size() || now_ < timeline_[next_action_].at) return false;
  do_action(timeline_[next_action_++]);
  return true;
}

template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::do_action(const Action& action) {
  switch (action.kind) {
    case ActionKind::load_torque:
      return plant_.set_load(action.value);
    case ActionKind::shaft_locked:
      return plant_.set_locked(action.value != 0);
    case ActionKind::source_voltage:
      return plant_.set_source_voltage(action.value);
    case ActionKind::source_sinks:
      return plant_.set_source_sinks(action.value != 0);
    case ActionKind::hall_stuck:
      return set_hall_line(std::fabs(action.value), action.value > 0, !(action.value > 0));
    case ActionKind::hall_whole:
      return set_hall_line(action.value, false, false);
    case ActionKind::run_request:
      return firmware_.request_run(action.value != 0);
    case ActionKind::clear_request:
      return firmware_.request_clear();
    case ActionKind::retune:
      return firmware_.retune(tunings_[static_cast<std::size_t>(action.value)]);
    case ActionKind::dead_time:
      return modulator_.set_dead_time(action.value);
    case ActionKind::wire_break:
      if constexpr (requires { plant_.break_wire(0); }) plant_.break_wire(static_cast<int>(action.value));
      return;
    case ActionKind::setpoint:
      break;
  }
  setpoint_ = action.value;
  moving_ = action.waveform.moves();
  waveform_ = next_action_ - 1;
  // mutant: !board_.delayed => true
  if (firmware_.follows_setpoint_at_once() && !board_.delayed) control_step(false);
}

/// Ticks that were skipped since nothing was to come are due again where something is.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::replace_future(Timeline timeline, const Tuning<Config>& first,
                                                Tunings tunings) {
  timeline_ = std::move(timeline);
  tunings_ = std::move(tunings);
  const Tuning<Config>* in_effect = &first;
  for (std::size_t n = 0; n < next_action_; ++n)
    if (timeline_[n].kind == ActionKind::retune)
      in_effect = &tunings_[static_cast<std::size_t>(timeline_[n].value)];
  firmware_.retune(*in_effect);
  if (const sim::Instant told = told_next(); told < next_tick_) next_tick_ = told;
  moved_ = true;
}

/// Where the setpoint stands at this tick.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::follow_waveform() {
  // mutant: waveform_ => 0
  const Action& from = timeline_[waveform_];
  setpoint_ = from.waveform.after(from.value, sim::seconds_between(from.at, now_));
}

template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::sector_edge() {
  count(EventKind::sector_edge);
  const std::uint8_t stuck = stuck_high_ | stuck_low_;
  // The one line that changes between this sector and its neighbour behind is stuck: no edge on the pins.
  const int s = plant_.sector(), behind = (s + (plant_.state().w < Real(0) ? 1 : 5)) % 6;
  if ((plant::hall_code(s) ^ plant::hall_code(behind)) & stuck) return;
  hall_edge();
}

/// A line breaks or is whole again: where it stood the other way, that is an edge on the pins.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::set_hall_line(double line, bool stuck_high, bool stuck_low) {
  const std::uint8_t before = pins(), bit = static_cast<std::uint8_t>(8 >> static_cast<int>(line));
  const auto set = [bit](std::uint8_t& lines, bool on) {
    lines = static_cast<std::uint8_t>(on ? lines | bit : lines & ~bit);
  };
  set(stuck_high_, stuck_high);
  set(stuck_low_, stuck_low);
  if (pins() != before) hall_edge();
}

/// Sampled in the middle of a period: the answer waits in the timer's buffer for the next start.
template <class Real, class Firmware, class Plant>
bool Rig<Real, Firmware, Plant>::do_half_tick() {
  const std::int64_t period = board_.modulator.period_ticks, first = period / 2;
  half_ = !half_;
  next_tick_.ticks += half_ ? first : period - first;
  if (half_) {
    reversed_ = loaded_reversed_;
    modulator_.start_period(now_, loaded_);
    return true;
  }
  control_step(true);
  count(EventKind::tick);
  return ticked_ = true;
}

}  // namespace sixstep::rig
