// SPDX-License-Identifier: Apache-2.0
// Counts the cycles of one interrupt, from its request to the instruction after its return.
#pragma once
#include <algorithm>
#include <cstdint>

#include "faces/loop/avr/timer1.hpp"
#include "sixstep/rig/chip_port.hpp"

namespace board {

class Stopwatch {
 public:
  explicit Stopwatch(std::uint32_t bin_cycles) { times_.bin_cycles = bin_cycles; }

  const sixstep::rig::InterruptTimes& times() const { return times_; }

  void asked(std::uint64_t at) { asked_ = at; }
  /// Called when the interrupt is entered. A later request belongs to the next interrupt.
  void entered() {
    served_ = asked_;
    asked_ = never;
  }
  void left(std::uint64_t at) {
    if (served_ != never) add(static_cast<std::uint32_t>(at - served_));
    served_ = never;
  }

 private:
  void add(std::uint32_t cycles) {
    times_.least = times_.count == 0 ? cycles : std::min(times_.least, cycles);
    times_.most = std::max(times_.most, cycles);
    ++times_.count;
    times_.sum += cycles;
    constexpr std::uint32_t last = sixstep::rig::InterruptTimes::bins - 1;
    ++times_.bin[std::min(cycles / times_.bin_cycles, last)];
  }

  sixstep::rig::InterruptTimes times_;
  std::uint64_t asked_ = never, served_ = never;
};

}  // namespace board
