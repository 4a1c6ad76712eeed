// SPDX-License-Identifier: Apache-2.0
// Member functions of rig.hpp for timeline, skipped ticks, faults of inputs, wiring, and samples in the
// middle of a period.
#pragma once
#include "sixstep/rig/rig.hpp"

namespace sixstep::rig {

template <class Real, class Firmware, class Plant>
bool Rig<Real, Firmware, Plant>::do_timeline() {
  if (next_action_ >= timeline_.size() || now_ < timeline_[next_action_].at) return false;
  do_action(timeline_[next_action_++]);
  return true;
}

/// Actions that only the plant of the general kernel can execute.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::act_on_general(const Action& action) {
  if constexpr (requires { plant_.fail_switch(0, false, false); }) {
    if (action.kind == ActionKind::wire_break) return plant_.break_wire(static_cast<int>(action.value));
    if (action.kind == ActionKind::shaft_speed) return plant_.set_speed(action.value, action.waveform.rate);
    const int which = static_cast<int>(action.value) - 1;
    plant_.fail_switch(which / 2, which % 2 == 0, action.kind == ActionKind::switch_short);
  }
}

template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::do_action(const Action& action) {
  switch (action.kind) {
    case ActionKind::load_torque:
      if constexpr (requires { plant_.set_load(0.0, 0.0); })
        return plant_.set_load(action.value, action.waveform.rate);
      else
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
    case ActionKind::switch_open:
    case ActionKind::switch_short:
    case ActionKind::shaft_speed:
      return act_on_general(action);
    case ActionKind::wire_phases:
    case ActionKind::wire_probes:
    case ActionKind::invert_lines:
      return rewire(action);
    case ActionKind::current_offset:
    case ActionKind::current_gain:
      return drift(action);
    case ActionKind::hall_glitch:
      return glitch(action);
    case ActionKind::encoder_misses:
    case ActionKind::track_sticks:
    case ActionKind::track_whole:
    case ActionKind::winding_breaks:
    case ActionKind::encoder_line_sticks:
    case ActionKind::encoder_line_whole:
    case ActionKind::false_index:
    case ActionKind::excitation:
      return fail_shaft_sensor(action);
    case ActionKind::divider_breaks:
      return break_divider(static_cast<std::size_t>(action.value));
    case ActionKind::setpoint:
      break;
  }
  setpoint_ = action.value;
  moving_ = action.waveform.moves();
  waveform_ = next_action_ - 1;
  if constexpr (!keeps_time)
    // mutant: !board_.delayed => true
    if (firmware_.follows_setpoint_at_once() && !board_.delayed) control_step(false);
}

/// First tick at or after the next setpoint or retune action of the timeline; never() if none is left.
template <class Real, class Firmware, class Plant>
sim::Instant Rig<Real, Firmware, Plant>::told_next() const {
  const std::int64_t period = board_.modulator.period_ticks;
  for (std::size_t n = next_action_; n < timeline_.size(); ++n)
    if (timeline_[n].kind == ActionKind::setpoint || timeline_[n].kind == ActionKind::retune)
      // mutant: timeline_[n].at.ticks + period - 1 => timeline_[n].at.ticks + period
      return {(timeline_[n].at.ticks + period - 1) / period * period, 0.0};
  return sim::Instant::never();
}

/// Skips ticks that have no effect: in open loop with a steady bridge, these are the ticks until the next
/// setpoint or retune action.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::skip_idle_ticks() {
  if constexpr (requires { plant_.warms(); })
    if (plant_.warms()) return;
  // mutant: moving_ => false
  if (!firmware_.open_loop() || moving_ || board_.delayed || board_.commutate_at_sample ||
      !modulator_.steady())
    return;
  if (const sim::Instant told = told_next(); told > now_) next_tick_ = told;
}

/// Replaces the future part of the timeline. If the new timeline has a further setpoint or retune action,
/// ticks that were skipped are due again.
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
  if constexpr (!keeps_time)
    if (const sim::Instant told = told_next(); told < next_tick_) next_tick_ = told;
  moved_ = true;
}

/// Sets the setpoint to its waveform's value at this tick.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::follow_waveform() {
  // mutant: waveform_ => 0
  const Action& from = timeline_[waveform_];
  setpoint_ = from.waveform.after(from.value, sim::seconds_between(from.at, now_));
}

template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::sector_edge() {
  count(EventKind::sector_edge);
  if (probes_.mounted()) return;  // the edges of mounted probes are events of other guards
  const std::uint8_t stuck = stuck_high_ | stuck_low_;
  // The pins have no edge if the line that differs between the present and the previous sector is stuck.
  const int s = plant_.sector(), behind = (s + (plant_.state().w < Real(0) ? 1 : 5)) % 6;
  if ((wires_.at_pins(probes_.code(s)) ^ wires_.at_pins(probes_.code(behind))) & stuck) return;
  hall_edge();
}

/// Instant of the next sample: the next tick, or the middle of the period that begins with the next tick.
template <class Real, class Firmware, class Plant>
sim::Instant Rig<Real, Firmware, Plant>::next_sample() const {
  sim::Instant sample = next_tick_;
  if (board_.sampled_in_middle && !half_) sample.ticks += board_.modulator.period_ticks / 2;
  return sample;
}

template <class Real, class Firmware, class Plant>
template <class Visit>
void Rig<Real, Firmware, Plant>::probe_guards(Visit&& visit) const {
  probes_.guards(plant_.expansion(), plant_.state().sector,
                 [&](plant::ProbeEdge edge, const series::Coefficients<Real>& g, int degree, Real noise) {
                   visit(edge == plant::ProbeEdge::ahead ? probe_ahead : probe_behind, g, degree, noise);
                 });
}

template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::pass_probe_edge(plant::ProbeEdge which) {
  if constexpr (can_be_askew) {
    const std::uint8_t before = pins();
    probes_.pass(which, now_);
    moved_ = true;
    if (pins() != before) hall_edge();
  }
}

/// Changes the lines by the first Hall edge whose delay has ended. Several edges may be due at one instant.
template <class Real, class Firmware, class Plant>
bool Rig<Real, Firmware, Plant>::show_probes() {
  if constexpr (can_be_askew) {
    const std::uint8_t before = pins();
    if (!probes_.show(now_)) return false;
    if (pins() != before) hall_edge();
    return true;
  }
  return false;
}

/// Begins or ends a glitch on a probe's line. `action.value` is the number of the probe, not of the pin.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::glitch(const Action& action) {
  if constexpr (can_be_askew) {
    const std::uint8_t before = pins();
    probes_.glitch(static_cast<std::uint8_t>(8 >> static_cast<int>(action.value)));
    if (pins() != before) hall_edge();
  }
}

/// Breaks or repairs a line. If the level at its pin changes, the change is a Hall edge.
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

/// Exchanges wires at one instant. Each phase keeps its current, which then flows through another leg. All
/// lines that change are one edge at the pins.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::rewire(const Action& action) {
  if constexpr (std::is_same_v<Wires, Wiring>) {
    const std::uint8_t before = pins();
    const auto chosen = static_cast<std::uint8_t>(action.value);
    if (action.kind == ActionKind::wire_phases) wires_.phases = static_cast<WireOrder>(chosen);
    if (action.kind == ActionKind::wire_probes) wires_.probes = static_cast<WireOrder>(chosen);
    if (action.kind == ActionKind::invert_lines) wires_.inverted = chosen;
    if (pins() != before) hall_edge();
  }
}

/// Changes the amplifiers' errors from now on. For a firmware with ideal measurements, which has no
/// amplifiers, the action has no effect.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::drift(const Action& action) {
  Registers* const registers = registers_of(firmware_);
  if (registers == nullptr) return;
  if (action.kind == ActionKind::current_offset) registers->set_current_offset(action.value);
  if (action.kind == ActionKind::current_gain) registers->set_current_gain_error(action.value);
}

/// Begins or ends a fault of a shaft sensor. Requires a firmware with a shaft sensor.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::fail_shaft_sensor(const Action& action) {
  ShaftPorts* const ports = shaft_ports_of(firmware_);
  if (ports == nullptr) return;
  const int which = static_cast<int>(std::fabs(action.value));
  if (action.kind == ActionKind::encoder_misses) ports->miss(which);
  if (action.kind == ActionKind::track_sticks) ports->stick_track(which - 1, action.value > 0);
  if (action.kind == ActionKind::track_whole) ports->free_track(which - 1);
  if (action.kind == ActionKind::winding_breaks) ports->break_winding(which);
  if (action.kind == ActionKind::encoder_line_sticks) ports->stick_line(which, action.value > 0, now_);
  if (action.kind == ActionKind::encoder_line_whole) ports->free_line(which, now_);
  if (action.kind == ActionKind::false_index) ports->pulse_index();
  if (action.kind == ActionKind::excitation) ports->excite(action.value);
}

/// Breaks the divider of a leg's terminal. Requires a firmware that samples the terminals.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::break_divider(std::size_t leg) {
  if constexpr (requires { firmware_.break_divider(leg); }) {
    firmware_.break_divider(leg);
    if constexpr (has_crossings) {
      const std::uint8_t before = crossings_.lines();
      if (!crossings_.fitted()) return;
      crossings_.break_divider(leg, front_end_.reading());
      if (crossings_.lines() != before) firmware_.captured_crossing(crossings_.lines(), now_);
      moved_ = true;
    }
  }
}

/// Tick of a board that samples in the middle of a period. The command is in the timer's buffer until the
/// next period.
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
  warm_up();
  control_step(true);
  count(EventKind::tick);
  return ticked_ = true;
}

template <class Real, class Firmware, class Plant>
sim::Instant Rig<Real, Firmware, Plant>::next_due() const {
  sim::Instant next = modulator_.next_edge();
  if (next_tick_ < next) next = next_tick_;
  if (next_action_ < timeline_.size() && timeline_[next_action_].at < next) next = timeline_[next_action_].at;
  if constexpr (can_be_askew)
    if (const sim::Instant shown = probes_.next(); shown < next) next = shown;
  if constexpr (has_commutation_clock)
    if (firmware_.next_commutation() < next) next = firmware_.next_commutation();
  if constexpr (keeps_time)
    if (firmware_.next_stop() < next) next = firmware_.next_stop();
  return next;
}

/// Turns the bridge off at once. Also disables the delayed command and the command in the timer's buffer.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::let_go() {
  modulator_.turn_off(now_);
  pending_.enabled = loaded_.enabled = false;
}

}  // namespace sixstep::rig
