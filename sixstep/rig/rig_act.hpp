// SPDX-License-Identifier: Apache-2.0
// Member functions of rig.hpp that execute the actions at one instant, in the order of model.md 4b.
#pragma once
#include "sixstep/rig/rig.hpp"

namespace sixstep::rig {

/// Executes all actions that are due now, in this order: delayed Hall edge, action of the timeline, control
/// tick, stop of a chip, timed commutation, PWM edge, comparator. The gates are set after the last action, so
/// that no leg depends on the order of actions at one instant.
template <class Real, class Firmware, class Plant>
bool Rig<Real, Firmware, Plant>::act() {
  ticked_ = false;
  // mutant: now_ < due_ && !moved_ && !watching() => now_ < due_ && !watching()
  if (now_ < due_ && !moved_ && !watching()) return true;
  return act_on_due();
}

template <class Real, class Firmware, class Plant>
bool Rig<Real, Firmware, Plant>::act_on_due() {
  if (moved_) due_ = next_due();
  moved_ = false;
  do {
    while (fault_ == Fault::none && !(now_ < due_)) {
      // mutant: !do_timeline() && !do_tick() => !do_tick() && !do_timeline()
      if (!show_probes() && !do_timeline() && !do_tick() && !do_chip() && !do_commutation() &&
          modulator_.act(now_))
        count(EventKind::pwm_edge);
      due_ = next_due();
    }
  } while (fault_ == Fault::none && compared());
  if (fault_ == Fault::none && !plant_.set_gates(wires_.at_phases(modulator_.gates())))
    fault_ = Fault::shoot_through;
  return fault_ == Fault::none;
}

template <class Real, class Firmware, class Plant>
bool Rig<Real, Firmware, Plant>::do_tick() {
  if constexpr (keeps_time) {
    return false;
  } else {
    if (now_ < next_tick_) return false;
    if (board_.sampled_in_middle) return do_half_tick();
    next_tick_.ticks += board_.modulator.period_ticks;
    warm_up();
    control_step(true);
    skip_idle_ticks();
    count(EventKind::tick);
    return ticked_ = true;
  }
}

template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::control_step(bool starts_period) {
  if (moving_) follow_waveform();
  const plant::State<Real>& state = wires_.at_legs(plant_.state());
  const plant::Legs& legs = wires_.at_legs(plant_.mode().legs);
  SampleInstant<Real> instant{state,
                              legs,
                              plant_.constants().pole_pairs,
                              now_,
                              static_cast<std::uint64_t>(event_count(EventKind::tick)),
                              chip_pins(),
                              reversed_};
  if constexpr (six_step) instant.duty = modulator_.command().duty;
  if constexpr (has_front_end) {
    if (front_end_.follows()) instant.seen = &front_end_.reading();
    if (board_.sensors.low_side.shunts != 0) {
      instant.shunts = board_.sensors.low_side.shunts;
      instant.low_side = low_side_sample(board_.sensors.low_side, modulator_.command());
    }
  }
  if constexpr (looks_at_terminals)
    if (sees_terminals()) show_terminals();
  const auto& answer = firmware_.tick(instant, setpoint_);
  if (answer.fault && ends_run(firmware_)) fault_ = fault_of(firmware_.diagnosis());
  if (!answer.enabled) let_go();
  BoardAnswer command = widened(answer, board_.bases);
  bool reversed = false;
  if constexpr (six_step) reversed = firmware_.reversed();
  if (board_.delayed) {
    std::swap(command, pending_);
    // mutant: std::swap(reversed, pending_reversed_); => nothing
    std::swap(reversed, pending_reversed_);
    // As at a compare match, the pair changes in the command that takes effect now too. The next sample must
    // show the driven pair that the firmware expects.
    if constexpr (has_commutation_clock)
      if (firmware_.moved_on())
        command.pair = firmware_.reversed() == reversed ? answer.pair : control::swapped(answer.pair);
  }
  if (board_.sampled_in_middle) {
    loaded_ = command;
    loaded_reversed_ = reversed;
    return;
  }
  reversed_ = reversed;
  if constexpr (six_step)
    if (!starts_period) return modulator_.rearm(now_, command);
  modulator_.start_period(now_, command);
}

template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::apply(int id) {
  using namespace plant;
  if constexpr (has_crossings)
    if (id >= crossing) return pass_crossing(id - crossing);
  if constexpr (can_be_askew)
    if (id >= probe_ahead)
      return pass_probe_edge(id == probe_ahead ? plant::ProbeEdge::ahead : plant::ProbeEdge::behind);
  if (id >= guard::first_free) {
    count(EventKind::comparator);
    moved_ = true;
    if constexpr (six_step) trip(id - guard::first_free);
    return;
  }
  if (id < guard::standstill) count(EventKind::diode_off);
  if (id == guard::standstill) count(EventKind::standstill);
  if (id == guard::breakaway_forward || id == guard::breakaway_backward) count(EventKind::breakaway);
  if (!plant_.apply(id)) {
    if constexpr (requires { plant_.beyond_model(); })
      if (plant_.beyond_model()) {
        fault_ = Fault::beyond_model;
        moved_ = true;
      }
    return;
  }
  sector_edge();
  moved_ = true;
}

}  // namespace sixstep::rig
