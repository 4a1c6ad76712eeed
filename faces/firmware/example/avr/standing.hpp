// SPDX-License-Identifier: Apache-2.0
// What the drive is about, and why it stands. It begins to drive by itself at one place alone: with its offsets measured and the
// potentiometer at its middle. A reason to stand is kept over resets.
#pragma once
#include "faces/firmware/example/avr/gates.hpp"
#include "faces/firmware/example/fault_reason.hpp"

namespace firmware {

enum class Phase : std::uint8_t {
  calibrates,  ///< the bridge is off, no current flows: what do the transducers read?
  waits,       ///< until the potentiometer is at its middle
  drives,
  stands  ///< for a reason, until the supply goes or the reset pin is pulled
};

// By an interrupt amid the control interrupt, too.
inline volatile Phase phase = Phase::calibrates;
inline volatile Reason reason = Reason::none;

}  // namespace firmware

/// Where avr-libc's start code clears nothing. As a section of clang's it would be in the image, with zeros.
asm(".pushsection .noinit,\"aw\",@nobits\n"
    ".global kept_reason\n"
    "kept_reason: .skip 6\n"
    ".popsection");
extern "C" firmware::KeptReason kept_reason;
static_assert(sizeof(firmware::KeptReason) == 6);

namespace firmware {

/// The first reason stays. The control tick stops with interrupts on: one that came amid this would let the pair out again.
inline void stop(Reason why) {
  const std::uint8_t interrupts = byte(atmega2560::SREG);
  asm volatile("cli" ::: "memory");
  turn_off();
  if (phase != Phase::stands) {
    byte(atmega2560::TIMSK0) = 0;
    byte(atmega2560::TIMSK1) = 0;
    phase = Phase::stands;
    reason = why;
    kept_reason.keep(why);
  }
  asm volatile("" ::: "memory");
  byte(atmega2560::SREG) = interrupts;
}

/// By what MCUSR said and what was kept. Nobody asks for a reset that no bit tells of: a boot loader has hidden the watchdog's, or the
/// program ran into its own beginning.
inline Reason reason_after_reset(std::uint8_t cause) {
  const bool ran_before = kept_reason.key == KeptReason::right_key;
  if ((cause & atmega2560::WDRF) == 0 && (cause != 0 || !ran_before)) return Reason::none;
  const Reason before = kept_reason.kept();
  return before != Reason::none ? before : Reason::watchdog;
}

}  // namespace firmware
