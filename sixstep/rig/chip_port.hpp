// SPDX-License-Identifier: Apache-2.0
// What goes between the plant and a chip that runs a firmware of its own, register by register, with all its interrupts: the plant lets
// it run for so many of its cycles with so much at its pins; the chip stops where its gates move, where its converter samples, or where
// they end. Plain structs, for both sides of a pipe on one machine. What carries them stands outside the library (faces/loop/).
#pragma once
#include <cstdint>

#include "sixstep/rig/lockstep_core.hpp"

namespace sixstep::rig {

constexpr int chip_inputs = 8;  ///< of the converter

/// Run on. Pins change at the cycle that was reached last; counts are read where the last answer was a sample.
struct ChipRun {
  std::uint64_t until = 0;              ///< cycle since the reset
  std::uint16_t counts[chip_inputs]{};  ///< at the converter's inputs, by its channels
  std::uint32_t hall_pins = 0;          ///< H1 H2 H3 as bits 2, 1, 0
  std::uint32_t asks_for_times = 0;     ///< runs nothing: a ChipTimes is the answer
};

enum class ChipEvent : std::uint32_t {
  ran,     ///< up to `until`
  gates,   ///< they moved
  sample,  ///< the converter holds an input: the next ChipRun says what stood there
  ended    ///< it ran into an instruction that there is not, or stopped for good
};

struct ChipAnswer {
  std::uint64_t cycle = 0;  ///< at which it happened, never above `until`
  ChipEvent event = ChipEvent::ran;
  std::uint32_t gates =
      0;  ///< now: bits 0..5 upper a, lower a, upper b, lower b, upper c, lower c (control/gates.hpp)
  std::uint32_t channel = 0;  ///< sampled; 4 to 6: a current of 0 to 2 that is no control sample
  std::uint32_t unused = 0;
};

/// Cycles that one interrupt took, from what asked for it to the instruction behind its return.
struct InterruptTimes {
  static constexpr int bins = 64;
  std::uint64_t count = 0, sum = 0;
  std::uint32_t least = 0, most = 0;
  std::uint32_t bin_cycles = 0;  ///< width of each bin, from 0 on; the last one holds all above
  std::uint32_t bin[bins]{};
  std::uint32_t unused = 0;
};

struct ChipTimes {
  InterruptTimes control, hall;
  std::uint64_t periods = 0;  ///< of the PWM timer, since it runs
  std::uint64_t conversions =
      0;  ///< that the timer started: fewer than periods where the control interrupt overran
};

/// Whoever carries a ChipRun to a chip and its answer back; none: `run` is null.
struct ChipPort {
  void* chip = nullptr;
  CoreTrouble (*run)(void* chip, const ChipRun& run, ChipAnswer& answer) = nullptr;
  std::uint32_t clock_Hz = 0;  ///< of its cycles

  explicit operator bool() const { return run != nullptr; }
};

/// What a chip says first.
struct ChipGreeting {
  std::uint32_t word = 0x73697863;  ///< "sixc"
  std::uint32_t run_bytes = sizeof(ChipRun), answer_bytes = sizeof(ChipAnswer),
                times_bytes = sizeof(ChipTimes);
  std::uint32_t clock_Hz = 0, unused = 0;
};

}  // namespace sixstep::rig
