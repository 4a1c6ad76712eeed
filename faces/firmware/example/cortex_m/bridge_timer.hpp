// SPDX-License-Identifier: Apache-2.0
// Decides when TIM1's legs change, as in a simulation that answers a period later (control/bridge_command.hpp,
// the rig's act()):
//
//   control tick      duty and pair take effect together at the next period. The duty waits in the preloaded compare registers. If a
//                     leg's output changes too, the interrupt of the fourth compare unit, shortly before the period's end, waits for the
//                     update and gives the commutation event there. A leg that changes sides is off from that event on, and has its new
//                     switch after the dead time.
//                     A later answer waits as a whole for the next period's end, and is counted as missed.
//   Hall interrupt    the pair changes at once, in the present and in the waiting command; the pulse continues in the incoming leg.
//                     The duty stays.
//   off, and a fault  at once
//
// The manual does not define when the reference of a leg follows PWM after a forced level: at once, or at the
// next match of its compare unit. So the pulse of a leg that starts at a Hall edge may begin with the next
// period instead of within this one. In neither case are both switches on.
//
// Two commutation events that change one leg are never closer than the dead time: each event that turns a
// switch on waits for it first. Interrupts are off while outputs change, so that the interrupt at the
// period's end finds them complete.
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

/// A command, and whether it is for the negative direction. A Hall edge changes the pairs of the two
/// directions differently.
struct Commanded {
  BridgeCommand<Scalar> bridge;
  bool reversed;
};

Commanded in_effect, waiting;  // commands for this period and for the next one
BridgeOutputs legs;            // after the last commutation event
std::uint32_t changed_at = 0;  // count of TIM2 at that event
bool charging = false;         // while short pulses of all lower gates charge the bootstrap capacitors, no
                               // command is on

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

/// A change of the legs, by one event, or by two if a leg pauses between them.
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

Change coming;            // change at the period's end,
bool change_due = false;  // if this is true

inline void compare_next(std::uint32_t counts) {
  for (int n = 0; n < 3; ++n) tim1().CCR[n] = counts;
}

/// Enables the interrupt at the period's end. If its flag is set, it was set in this period, because each
/// control tick clears it first.
inline void arm_period_end(bool on) { tim1().DIER = (tim1().DIER & bit::BIE) | (on ? bit::CC4IE : 0); }

/// Whether two enabled commands have the same gates at any duty.
inline bool same_gates(const BridgeCommand<Scalar>& a, const BridgeCommand<Scalar>& b) {
  return a.enabled && b.enabled && a.pair == b.pair && a.chopping == b.chopping && a.chopped == b.chopped;
}

/// Prepares the change at the period's end, from the present state of the legs. If it is unknown what the
/// legs did before, a switch that turns on waits for the dead time, as in a simulation.
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

/// The interrupt of the fourth compare unit. It waits for the update, which follows after some counts, and
/// makes the period's change there. The commutation event must be at the update or some counts before it, in
/// the off-time of the old pulse. If it were later, the old pair would have a pulse of some counts.
[[gnu::noinline]] void at_period_end() {
  const InterruptsOff hold;
  // Nothing to do: the interrupt was revoked after the core had accepted it, or a late control tick has
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

/// Whether the period's end that an answer is for has passed, or is so near that its duty and its pair might
/// not take effect together. Both then wait for the next end. If a change is still waiting for the end that
/// has passed, it is made first.
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

/// Executes the Hall interrupt's answer; its pair has the sign of the last control tick.
[[gnu::noinline]] void at_once(const BridgeCommand<Scalar>& command, bool reversed) {
  if (!command.enabled) {
    if (!charging) gates_off();
    return;
  }
  const InterruptsOff hold;
  if (!waiting.bridge.enabled) return;  // the drive was turned off since that tick
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
