// SPDX-License-Identifier: Apache-2.0
// Models the timing of an ATmega2560's converter according to data sheet 2549 (26): when a conversion's
// channel is latched, when its input is sampled, and when the conversion is done. chip.hpp models the
// converter's registers and its interrupt.
#pragma once
#include <cstdint>

#include "faces/loop/avr/timer1.hpp"

namespace board {

class Converter {
 public:
  enum class Event { starts, holds, done };

  bool busy() const { return next_ != never; }
  std::uint64_t next() const { return next_; }

  /// Sets ADEN and the bits of the prescaler. The prescaler counts from the instant at which the converter is
  /// switched on.
  void set(bool on, unsigned adps, std::uint64_t now) {
    clocks_ = 1u << (adps == 0 ? 1 : adps);
    if (on && !on_) {
      reset_at_ = now;
      first_ = true;
    }
    on_ = on;
    if (!on) next_ = never;
  }

  /// Starts a conversion by ADSC, at the next edge of the converter's clock.
  void start(std::uint64_t now) {
    if (!on_ || busy()) return;
    begin(reset_at_ + ((now - reset_at_) / clocks_ + 1) * clocks_);
  }

  /// Starts a conversion at the trigger's edge, which resets the prescaler. The input is sampled two
  /// converter clocks later. Returns false if the trigger is lost.
  bool trigger(std::uint64_t now) {
    if (!on_ || busy()) return false;
    reset_at_ = now;
    begin(now + clocks_ / 2);
    return true;
  }

  Event pass() {
    const Event now = event_;
    event_ = now == Event::starts ? Event::holds : Event::done;
    next_ = now == Event::starts ? hold_at_ : now == Event::holds ? done_at_ : never;
    return now;
  }

 private:
  /// Times from table 26-1. The first conversion also initialises the analogue circuit.
  void begin(std::uint64_t at) {
    hold_at_ = at + (first_ ? 27 : 3) * clocks_ / 2;
    done_at_ = at + (first_ ? 25 : 13) * clocks_;
    first_ = false;
    event_ = Event::starts;
    next_ = at;
  }

  bool on_ = false, first_ = false;
  std::uint64_t clocks_ = 2, reset_at_ = 0;
  Event event_ = Event::starts;
  std::uint64_t next_ = never, hold_at_ = 0, done_at_ = 0;
};

}  // namespace board
