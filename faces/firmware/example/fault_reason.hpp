// SPDX-License-Identifier: Apache-2.0
// Names the reasons why a board's drive is stopped, for the line "# fault: over-current". The line is printed
// when the fault happens, and then about once a second. The reason is stored in memory that the start-up does
// not clear, so that a reset by the watchdog does not hide it.
#pragma once
#include <cstdint>

#include "faces/firmware/example/log.hpp"

namespace firmware {

enum class Reason : std::uint8_t {
  none,
  hall,            ///< a Hall code that no rotor angle gives, or a jump over a sector
  calibration,     ///< the offset of a current transducer is out of its tolerance
  over_current,    ///< a sampled current exceeds its bound
  current_sensor,  ///< a reading at the converter's full scale, or three currents whose sum is not zero
  setpoint_wire,   ///< the potentiometer reads beyond its ends
  comparator,      ///< the power stage's comparator at the timer's break input
  clock,           ///< the external clock did not start, or stopped
  converter,       ///< no conversion ends any more
  watchdog,        ///< the main loop or the control interrupt hung
  over_voltage,
  under_voltage,
  over_speed,
  stall,
  align,
  board,   ///< the board stopped the drive for a reason that has ended
  program  ///< an unexpected interrupt, or a fault of the core
};

constexpr const char* word(Reason reason) {
  switch (reason) {
    case Reason::none:
      return "none";
    case Reason::hall:
      return "hall";
    case Reason::calibration:
      return "calibration";
    case Reason::over_current:
      return "over-current";
    case Reason::current_sensor:
      return "current-sensor";
    case Reason::setpoint_wire:
      return "setpoint-wire";
    case Reason::comparator:
      return "comparator";
    case Reason::clock:
      return "clock";
    case Reason::converter:
      return "converter";
    case Reason::watchdog:
      return "watchdog";
    case Reason::over_voltage:
      return "over-voltage";
    case Reason::under_voltage:
      return "under-voltage";
    case Reason::over_speed:
      return "over-speed";
    case Reason::stall:
      return "stall";
    case Reason::align:
      return "align";
    case Reason::board:
      return "board";
    case Reason::program:
      return "program";
  }
  return "unknown";
}

template <class Put>
constexpr void put_fault(Put put, Reason reason) {
  put_text(put, "# fault: ");
  put_text(put, word(reason));
  put('\n');
}

/// A stored reason, in a section that the start-up does not clear. After power-up its content is random; it
/// is valid only with the right key.
struct KeptReason {
  static constexpr std::uint32_t right_key = 0x5157E9A3;
  volatile std::uint32_t key;
  volatile Reason reason;
  volatile std::uint8_t check;  ///< inverted bits of the reason

  void keep(Reason why) {
    key = 0;  // a reset during the writing then leaves no valid key
    reason = why;
    check = static_cast<std::uint8_t>(~static_cast<unsigned>(why));
    key = right_key;
  }
  void forget() { key = 0; }
  Reason kept() const {
    const Reason why = reason;
    const bool whole = key == right_key && check == static_cast<std::uint8_t>(~static_cast<unsigned>(why));
    return whole ? why : Reason::none;
  }
};

}  // namespace firmware
