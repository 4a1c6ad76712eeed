// SPDX-License-Identifier: Apache-2.0
// Handles the board's reasons to keep the gates off, in addition to the drive's faults: the comparator, the
// sensors, the clock, a converter that stopped, and a reason kept over a reset. The drive does not restart by
// itself: it waits for a typed c, and then for r.
#pragma once
#include "faces/firmware/example/cortex_m/bridge_timer.hpp"
#include "faces/firmware/example/cortex_m/kept.hpp"
#include "faces/firmware/example/cortex_m/set_up.hpp"

namespace firmware {

volatile Reason board_fault = Reason::none;
volatile bool needs_reset = false;  // true: there are no more control ticks
std::uint32_t counts_a_us = clock_Hz / 1'000'000;
volatile std::uint32_t last_tick = 0;  // count of TIM2 at the last control tick
std::uint8_t strange_sums = 0;

/// A bit in addition to the bits of Fault. It stops the drive, and the log's column `faults` contains it.
constexpr std::uint16_t fault_board = 1u << 15;

inline void trip(Reason why) {
  gates_off();
  if (board_fault == Reason::none) board_fault = why;
}

/// Disables the gates in hardware until the chip is reset.
inline void stand_until_reset(Reason why) {
  forbid_gates();
  stop_control_interrupts();
  if (!needs_reset) board_fault = why;
  needs_reset = true;
}

/// Whether the sum of the currents is impossible. Currents into a star point sum to zero, so the sum of the
/// three readings is the sum of their offsets. If the two sums differ by more than 4 times the tolerance of
/// one offset, a reading is wrong.
inline bool sum_is_strange(const ProtectedState<Scalar>& state, const BoardInput& in) {
  std::int32_t eighths = 0;
  for (int n = 0; n < 3; ++n) {
    const std::int32_t offset = state.current_adc[n].offset_eighths;
    eighths += 8 * in.current_counts[n] - (offset < 0 ? 8 * config.current_adc[n].offset_counts : offset);
  }
  constexpr std::int32_t most = 4 * 8 * config.current_adc[0].offset_tolerance;
  return eighths > most || eighths < -most;
}

/// Called before the tick. Reports a fault only after three wrong sums in a row, because a single wrong sum
/// may be a disturbance.
inline void watch_sensors(const ProtectedState<Scalar>& state, const BoardInput& in) {
  strange_sums = !sum_is_strange(state, in)
                     ? std::uint8_t{0}
                     : static_cast<std::uint8_t>(strange_sums < 3 ? strange_sums + 1 : 3);
  if (strange_sums == 3) trip(Reason::current_sensor);
}

/// The reason why the drive is stopped. It is never `none`, so that the line "# fault" is printed during the
/// whole stop.
constexpr Reason reason_of(std::uint16_t faults) {
  return faults & fault_hall            ? Reason::hall
         : faults & fault_calibration   ? Reason::calibration
         : faults & fault_over_current  ? Reason::over_current
         : faults & fault_over_voltage  ? Reason::over_voltage
         : faults & fault_under_voltage ? Reason::under_voltage
         : faults & fault_over_speed    ? Reason::over_speed
         : faults & fault_stall         ? Reason::stall
         : faults & fault_align         ? Reason::align
                                        : Reason::board;
}

/// Checks that conversions end. After a millisecond without a conversion (or four periods, if longer),
/// nothing monitors the current, and the drive stops.
inline void watch_converter(bool listening) {
  constexpr std::uint32_t longest = clock_Hz / 1000 > 4 * pwm_counts ? clock_Hz / 1000 : 4 * pwm_counts;
  // The check is made twice: a tick between the two reads of late() looks like a missing tick.
  const auto late = [] {
    const std::uint32_t seen = last_tick;
    return tim2().CNT - seen > longest;
  };
  if (listening && !needs_reset && late() && late()) stand_until_reset(Reason::converter);
}

/// Called after a typed c: clears faults whose cause has ended. The caller has disabled interrupts, because
/// the interrupt at the period's end also writes DIER.
inline void clear_board_fault() {
  kept_reason.forget();
  if (needs_reset) {
    aircr() = bit::SYSRESETREQ;
    for (;;) asm volatile("");
  }
  strange_sums = 0;
  board_fault = Reason::none;
  tim1().SR = ~bit::BIF;
  tim1().DIER = tim1().DIER | bit::BIE;
  let_gates_work();
  if (needs_reset) forbid_gates();  // the clock may have stopped in the meantime
}

}  // namespace firmware

/// Interrupt of the break input, or of a lockup of the core. MOE is already cleared. The flag is set again
/// while the level persists.
extern "C" void TIM1_BRK_IRQHandler() {
  using namespace firmware;
  tim1().DIER = tim1().DIER & ~bit::BIE;
  trip(Reason::comparator);
}

/// Interrupt after the external clock stopped. The chip then runs on its own 8 MHz, and TIM1's break has
/// turned the gates off. The function keeps the baud rate of the serial line.
extern "C" void NMI_Handler() {
  using namespace firmware;
  rcc().CIR = rcc().CIR | bit::CSSC;
  stand_until_reset(Reason::clock);
  kept_reason.keep(Reason::clock);
  fall_back_to_own_clock();
  counts_a_us = own_clock_Hz / 1'000'000;
  set_up_serial_line(own_clock_Hz);
}
