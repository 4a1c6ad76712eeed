// SPDX-License-Identifier: Apache-2.0
// Decides when TIM1's legs change, as in a simulation in which an answer takes effect a period later
// (control/bridge_command.hpp, the rig's act()):
//
//   control tick      Duty and pair take effect together at the next period. The duty waits in the preloaded
//                     compare registers. If a leg's output changes too, the interrupt of the fourth compare
//                     unit, shortly before the period's end, waits for the update and causes the commutation
//                     event there. A leg that changes from one switch to the other is off from that event on;
//                     its new switch turns on after the dead time. A late answer waits for the end of the
//                     next
//                     period and is counted as missed.
//   Hall interrupt The pair changes at once, in the present and in the waiting command. The pulse continues
//                     in the incoming leg. The duty does not change.
//   off, and a fault  The gates turn off at once.
//
// The manual does not define when the reference of a leg follows PWM after a forced level: at once, or at the
// next match of its compare unit. So the pulse of a leg that starts at a Hall edge may begin within the
// present period or with the next one. In neither case are both switches on.
//
// Two commutation events that change one leg are at least the dead time apart: each event that turns a switch
// on waits for it. Interrupts are off while outputs change, so that the interrupt at the period's end never
// finds a half-made change.
#pragma once
#include "faces/firmware/example/cortex_m/board.hpp"
#include "faces/firmware/example/cortex_m/bridge.hpp"

namespace firmware {

class InterruptsOff {
 public:
  InterruptsOff() {
    asm volatile("mrs %0, primask" : "=r"(were_off_));
    asm volatile("cpsid i" ::: "memory");
  }
  ~InterruptsOff() { asm volatile("msr primask, %0" ::"r"(were_off_) : "memory"); }
  InterruptsOff(const InterruptsOff&) = delete;
  InterruptsOff& operator=(const InterruptsOff&) = delete;

 private:
  std::uint32_t were_off_;
};

/// A command with its direction. A Hall edge changes the pair in a way that depends on the direction.
struct Commanded {
  BridgeCommand<Scalar> bridge;
  bool reversed;
};

Commanded in_effect, waiting;  // commands for this period and for the next one
BridgeOutputs legs;            // state after the last commutation event
std::uint32_t changed_at = 0;  // count of TIM2 at that event
bool charging = false;         // true: no command is on, and short pulses of all lower gates charge the
                               // bootstrap capacitors

constexpr std::uint32_t compare_of(Scalar duty) {
  const auto counts = static_cast<std::uint32_t>(duty * static_cast<float>(pwm_counts));
  return counts > most_on_counts ? most_on_counts : counts;
}

inline void preload(const GateOutputs& out) {
  tim1().CCMR1 = out.CCMR1;
  tim1().CCMR2 = out.CCMR2;
  tim1().CCER = out.CCER;
}

/// Causes the commutation event, at which all channels load their preloaded values.
inline void commutation_event() {
  tim1().EGR = bit::COMG;
  changed_at = tim2().CNT;
}

inline void wait_for_dead_time() {
  while (tim2().CNT - changed_at < dead_counts) continue;
}

/// A change of the legs by one commutation event, or by two if a leg pauses between them.
struct Change {
  BridgeOutputs to;
  bool waits_before, pauses;
  GateOutputs first, second;
};

inline Change change(const BridgeOutputs& way, const BridgeOutputs& to) {
  const GateOutputs second = registers(to);
  const bool pauses = !(way == to);
  return {to, turns_on(legs, way), pauses, pauses ? registers(way) : second, second};
}
inline Change change(const BridgeOutputs& to) { return change(between(legs, to), to); }

/// Executes a change whose first event is due and whose values are preloaded.
inline void make(const Change& change) {
  commutation_event();
  if (change.pauses) {
    preload(change.second);
    wait_for_dead_time();
    commutation_event();
  }
  legs = change.to;
}

/// Changes the outputs now. The caller has disabled interrupts.
inline void change_at_once(const BridgeOutputs& to) {
  if (to == legs) return;
  const Change now = change(to);
  preload(now.first);
  if (now.waits_before) wait_for_dead_time();
  make(now);
}

Change coming;            // change at the period's end
bool change_due = false;  // whether `coming` must be made

inline void compare_next(std::uint32_t counts) {
  for (int n = 0; n < 3; ++n) tim1().CCR[n] = counts;
}

/// Enables the interrupt at the period's end. Each control tick clears the interrupt's flag first, so a set
/// flag was set in this period.
inline void arm_period_end(bool on) { tim1().DIER = (tim1().DIER & bit::BIE) | (on ? bit::CC4IE : 0); }

/// Whether two enabled commands have the same gates at any duty.
inline bool same_gates(const BridgeCommand<Scalar>& a, const BridgeCommand<Scalar>& b) {
  return a.enabled && b.enabled && a.pair == b.pair && a.chopping == b.chopping && a.chopped == b.chopped;
}

/// Prepares the change at the period's end, from the present state of the legs. If the previous state of the
/// legs is unknown, a switch turns on only after the dead time, as in a simulation.
inline void prepare_period_end() {
  change_due = false;
  if (same_gates(waiting.bridge, in_effect.bridge))
    return arm_period_end(in_effect.reversed != waiting.reversed);
  constexpr LegOutput pulse{bit::pwm_1, LegOutput::lower_alone};
  const BridgeOutputs to = waiting.bridge.enabled ? outputs(waiting.bridge)
                           : charging             ? BridgeOutputs{{pulse, pulse, pulse}}
                                                  : legs_off(legs);
  const bool wakes = waiting.bridge.enabled && !in_effect.bridge.enabled;
  change_due = !(to == legs);
  if (change_due) coming = wakes ? change(legs_off(legs), to) : change(to);
  arm_period_end(change_due || in_effect.bridge.enabled != waiting.bridge.enabled);
}

/// Turns all six gates off now and in the waiting command.
[[gnu::noinline]] void gates_off() {
  const InterruptsOff hold;
  in_effect.bridge.enabled = waiting.bridge.enabled = charging = change_due = false;
  change_at_once(legs_off(legs));
  arm_period_end(false);
}

/// The interrupt of the fourth compare unit. Waits for the update, which follows after some counts, and
/// changes the outputs there. The commutation event must be at the update or some counts before it, in the
/// off-time of the old pulse. After the update, the old pair would have a pulse of some counts.
[[gnu::noinline]] void at_period_end() {
  const InterruptsOff hold;
  // Nothing to do: the interrupt was disabled after the core had accepted it, or a late control tick has
  // already made the change.
  if ((tim1().DIER & bit::CC4IE) == 0 || (tim1().SR & bit::CC4IF) == 0) return;
  if (change_due) {
    preload(coming.first);
    if (coming.waits_before) wait_for_dead_time();
    for (std::uint32_t count = tim1().CNT; count >= sample_count && count < event_count; count = tim1().CNT)
      continue;
    make(coming);
    change_due = false;  // the change must be made only once
  }
  in_effect = waiting;
  arm_period_end(false);
}

/// Whether the answer is too late for its period's end: this end has passed, or is so near that duty and pair
/// might not take effect together. Duty and pair then wait for the next end. If a change still waits for the
/// passed end, the function makes it first.
inline bool period_is_over() {
  if ((tim1().SR & bit::CC4IF) == 0) return false;  // each control tick clears the flag when it begins
  at_period_end();
  while (tim1().CNT >= sample_count) continue;
  tim1().SR = ~bit::CC4IF;
  return true;
}

/// Prepares the control tick's answer. `charges`: the drive is about to start, and pulses of the lower gates
/// charge the bootstrap capacitors. Returns false if the answer was late and takes effect a period later.
[[gnu::noinline]] bool at_next_period(const BridgeCommand<Scalar>& command, bool reversed, bool charges) {
  if (!command.enabled && (!charges || in_effect.bridge.enabled)) {
    gates_off();
    return true;
  }
  const InterruptsOff hold;
  const bool in_time = !period_is_over();
  charging = !command.enabled;
  waiting = {command, reversed};
  compare_next(charging ? charge_counts : compare_of(command.duty));
  prepare_period_end();
  return in_time;
}

/// Executes the Hall interrupt's answer. The sign of the pair is the sign of the last control tick.
[[gnu::noinline]] void at_once(const BridgeCommand<Scalar>& command, bool reversed) {
  if (!command.enabled) {
    if (!charging) gates_off();
    return;
  }
  const InterruptsOff hold;
  if (!waiting.bridge.enabled) return;  // the drive was turned off after the last control tick
  waiting = {command, reversed};
  compare_next(compare_of(command.duty));
  if (in_effect.bridge.enabled) {
    const bool same = in_effect.reversed == reversed;
    in_effect.bridge.pair = same ? command.pair : swapped(command.pair);
    if (same) in_effect.bridge.chopped = command.chopped;
    change_at_once(outputs(in_effect.bridge));
  }
  prepare_period_end();
}

}  // namespace firmware
