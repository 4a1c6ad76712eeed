// SPDX-License-Identifier: Apache-2.0
// When TIM1's legs change. As in a simulation that answers a period later (control/bridge_command.hpp, the rig's act()):
//
//   control tick      duty and pair count together from the next period on. The duty waits in the preloaded compare registers; where a
//                     leg's output changes too, the interrupt of the fourth compare unit, shortly before the period's end, waits for the
//                     update and gives the commutation event there. A leg that changes sides is off from that event on, and has its new
//                     switch the dead time later.
//                     An answer that comes too late for that waits for the next end as a whole, and is counted as missed.
//   Hall interrupt    the pair moves at once, in what is in effect and in what waits; the pulse goes on in the leg that takes over. The
//                     duty stays.
//   off, and a fault  at once
//
// The manual leaves open when the reference of a leg that leaves a forced level follows PWM: at once, or at the next match of its compare
// unit. So the pulse of a leg that a Hall edge brings in may begin with the next period instead of amid this one: never both switches
// either way.
//
// No two commutation events that matter to one leg come closer than the dead time: each that turns anything on waits for that
// first. Interrupts are off while outputs change, so that the one at the period's end finds them whole.
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

/// A command, and whether it was made for the negative direction: a Hall edge moves the pair of either kind its own way.
struct Commanded {
  BridgeCommand<Scalar> bridge;
  bool reversed;
};

Commanded in_effect, waiting;  // of this period, and of the next
BridgeOutputs legs;            // as the last commutation event left them
std::uint32_t changed_at = 0;  // TIM2's count at that event
bool charging = false;         // bootstraps, by short pulses of all lower gates while no command is enabled

constexpr std::uint32_t compare_of(Scalar duty) {
  const auto counts = static_cast<std::uint32_t>(duty * static_cast<float>(pwm_counts));
  return counts > most_on_counts ? most_on_counts : counts;
}

inline void preload(const GateOutputs& out) {
  tim1().CCMR1 = out.CCMR1;
  tim1().CCMR2 = out.CCMR2;
  tim1().CCER = out.CCER;
}

/// The commutation event: all channels at once take what is preloaded.
inline void commutation_event() {
  tim1().EGR = bit::COMG;
  changed_at = tim2().CNT;
}

inline void wait_for_dead_time() {
  while (tim2().CNT - changed_at < dead_counts) continue;
}

/// From what the legs do to something else: by one event, or by two where a leg pauses between them.
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

/// Its first event, which is preloaded, is due.
inline void make(const Change& change) {
  commutation_event();
  if (change.pauses) {
    preload(change.second);
    wait_for_dead_time();
    commutation_event();
  }
  legs = change.to;
}

/// Now. Whoever calls has interrupts off.
inline void change_at_once(const BridgeOutputs& to) {
  if (to == legs) return;
  const Change now = change(to);
  preload(now.first);
  if (now.waits_before) wait_for_dead_time();
  make(now);
}

Change coming;            // at the period's end,
bool change_due = false;  // if any is

inline void compare_next(std::uint32_t counts) {
  for (int n = 0; n < 3; ++n) tim1().CCR[n] = counts;
}

/// The interrupt at the period's end. Its flag is that of this period: control ticks clear it as they begin.
inline void arm_period_end(bool on) { tim1().DIER = (tim1().DIER & bit::BIE) | (on ? bit::CC4IE : 0); }

/// Two enabled commands with the same gates, whatever their duty.
inline bool same_gates(const BridgeCommand<Scalar>& a, const BridgeCommand<Scalar>& b) {
  return a.enabled && b.enabled && a.pair == b.pair && a.chopping == b.chopping && a.chopped == b.chopped;
}

/// What the period's end is to bring, from what the legs do now. Where nobody knows what they did before, what turns on waits for the
/// dead time, as in a simulation.
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

/// All six gates off now, and in what waits.
[[gnu::noinline]] void gates_off() {
  const InterruptsOff hold;
  in_effect.bridge.enabled = waiting.bridge.enabled = charging = change_due = false;
  change_at_once(legs_off(legs));
  arm_period_end(false);
}

/// The fourth compare unit's interrupt: waits for the update, some counts away, and makes the period's change there. The event comes
/// with the update or some counts before it, in the gap of the old on-time: behind it, the old pair would have a pulse of some counts.
[[gnu::noinline]] void at_period_end() {
  const InterruptsOff hold;
  // Taken back after the core had seen it, or made by a control tick that came too late.
  if ((tim1().DIER & bit::CC4IE) == 0 || (tim1().SR & bit::CC4IF) == 0) return;
  if (change_due) {
    preload(coming.first);
    if (coming.waits_before) wait_for_dead_time();
    for (std::uint32_t count = tim1().CNT; count >= sample_count && count < event_count; count = tim1().CNT)
      continue;
    make(coming);
    change_due = false;  // made once
  }
  in_effect = waiting;
  arm_period_end(false);
}

/// Whether the period for whose end an answer was meant is over, or so nearly that its duty and its pair might not count together: then
/// both wait for the next end. What waited for that one is made first, where the core has not come to it.
inline bool period_is_over() {
  if ((tim1().SR & bit::CC4IF) == 0) return false;  // control ticks clear it as they begin
  at_period_end();
  while (tim1().CNT >= sample_count) continue;
  tim1().SR = ~bit::CC4IF;
  return true;
}

/// The control tick's answer. `charges`: the drive is about to start, and pulses of the lower gates charge the bootstraps. False: it came
/// too late, and counts a period later.
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

/// The Hall interrupt's answer, whose pair is that of the last tick's sign.
[[gnu::noinline]] void at_once(const BridgeCommand<Scalar>& command, bool reversed) {
  if (!command.enabled) {
    if (!charging) gates_off();
    return;
  }
  const InterruptsOff hold;
  if (!waiting.bridge.enabled) return;  // turned off since that tick
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
