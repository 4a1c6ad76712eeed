// SPDX-License-Identifier: Apache-2.0
// Stores the phase of the drive and the reason for its stop. Only one place in the program starts the drive:
// after the offsets are measured and the potentiometer is in its middle. The reason is preserved over resets.
#pragma once
#include "faces/firmware/example/avr/gates.hpp"
#include "faces/firmware/example/fault_reason.hpp"

namespace firmware {

enum class Phase : std::uint8_t {
  calibrates,  ///< the bridge is off and no current flows, while the transducers' offsets are measured
  waits,       ///< waits until the potentiometer is at its middle
  drives,
  stands  ///< stopped by a fault, until a power-up or a reset by the reset pin
};

// Volatile, because interrupts within the control interrupt also write these variables.
inline volatile Phase phase = Phase::calibrates;
inline volatile Reason reason = Reason::none;

}  // namespace firmware

/// The reason is in .noinit, which avr-libc's start code does not clear. It is declared in assembly, because
/// clang would put such a section into the image as zeros.
asm(".pushsection .noinit,\"aw\",@nobits\n"
    ".global kept_reason\n"
    "kept_reason: .skip 6\n"
    ".popsection");
extern "C" firmware::KeptReason kept_reason;
static_assert(sizeof(firmware::KeptReason) == 6);

namespace firmware {

/// Stops the drive and keeps the first reason. The control tick calls this function with interrupts enabled.
/// An interrupt within the function could enable the pair again, so the function disables interrupts.
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

/// Determines the reason from MCUSR and the kept reason. A reset without any bit in MCUSR was not requested.
/// Either a boot loader has cleared the watchdog's bit, or the program jumped to its own beginning.
inline Reason reason_after_reset(std::uint8_t cause) {
  const bool ran_before = kept_reason.key == KeptReason::right_key;
  if ((cause & atmega2560::WDRF) == 0 && (cause != 0 || !ran_before)) return Reason::none;
  const Reason before = kept_reason.kept();
  return before != Reason::none ? before : Reason::watchdog;
}

}  // namespace firmware
