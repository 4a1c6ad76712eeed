// SPDX-License-Identifier: Apache-2.0
// Messages between the plant and an emulated chip that executes a complete firmware, register by register
// with all interrupts. The plant lets the chip run for a number of cycles with given values at its pins. The
// chip stops at the end of these cycles, when its gates change, or when its converter samples. The messages
// are plain structs that are equal on both sides of a pipe on one machine. faces/loop/ transports them.
#pragma once
#include <cstdint>

#include "sixstep/rig/lockstep_core.hpp"

namespace sixstep::rig {

constexpr int chip_inputs = 8;  ///< channels of the converter

/// Command to continue. The pins change at the cycle of the last answer. The chip reads `counts` if the last
/// answer was a sample.
struct ChipRun {
  std::uint64_t until = 0;              ///< last cycle, counted since the reset
  std::uint16_t counts[chip_inputs]{};  ///< values at the converter's inputs, by channel
  std::uint32_t hall_pins = 0;          ///< H1 H2 H3 as bits 2, 1, 0
  std::uint32_t asks_for_times = 0;     ///< not 0: the chip does not run, and the answer is a ChipTimes
};

enum class ChipEvent : std::uint32_t {
  ran,     ///< ran up to `until`
  gates,   ///< the gates changed
  sample,  ///< the converter samples an input; the next ChipRun contains the counts
  ended    ///< the chip executed an invalid instruction, or stopped permanently
};

struct ChipAnswer {
  std::uint64_t cycle = 0;  ///< cycle of the event, at most `until`
  ChipEvent event = ChipEvent::ran;
  std::uint32_t gates =
      0;  ///< present gates, bits 0..5: upper a, lower a, upper b, lower b, upper c, lower c (control/gates.hpp)
  std::uint32_t channel = 0;  ///< sampled channel; 4 to 6: a current, channel 0 to 2, that is not the control
                              ///< sample
  std::uint32_t unused = 0;
};

/// Duration of one interrupt in cycles, from its request to the instruction after its return.
struct InterruptTimes {
  static constexpr int bins = 64;
  std::uint64_t count = 0, sum = 0;
  std::uint32_t least = 0, most = 0;
  std::uint32_t bin_cycles = 0;  ///< width of each bin; the first bin begins at 0; the last bin also contains
                                 ///< all larger values
  std::uint32_t bin[bins]{};
  std::uint32_t unused = 0;
};

struct ChipTimes {
  InterruptTimes control, hall;
  std::uint64_t periods = 0;  ///< periods of the PWM timer since its start
  std::uint64_t conversions =
      0;  ///< conversions that the timer started; fewer than periods if the control interrupt overran
};

/// Transport that sends a ChipRun to a chip and returns its answer; `run` is null if there is no chip.
struct ChipPort {
  void* chip = nullptr;
  CoreTrouble (*run)(void* chip, const ChipRun& run, ChipAnswer& answer) = nullptr;
  std::uint64_t clock_Hz = 0;  ///< frequency of the chip's cycles
  bool converts = true;        ///< true: the chip's converter must sample once per period, otherwise the chip
                               ///< counts as stalled

  explicit operator bool() const { return run != nullptr; }
};

/// First message of a chip. The plant's side uses it to check that both sides use the same structs.
struct ChipGreeting {
  std::uint32_t word = 0x73697863;  ///< "sixc"
  std::uint32_t run_bytes = sizeof(ChipRun), answer_bytes = sizeof(ChipAnswer),
                times_bytes = sizeof(ChipTimes);
  std::uint32_t clock_Hz = 0, unused = 0;
};

}  // namespace sixstep::rig
