// SPDX-License-Identifier: Apache-2.0
// Models timer 1 of an ATmega2560 in its phase correct modes up to ICR1 (8 and 10), according to data sheet
// 2549 (17). In all other modes it does not count, and its outputs are off. next() is the next cycle with an
// event; no call is necessary before this cycle.
//
// The phase is counted in ticks from the tick that leaves BOTTOM. TOV1 is set at this tick, and a match takes
// effect at the tick that leaves the matching count (figures 17-12 and 17-13). So the on-time is centred on
// phase 0, and the counter value is one tick ahead of the phase.
#pragma once
#include <algorithm>
#include <cstdint>

#include "faces/firmware/example/avr/addresses.hpp"

namespace board {

constexpr std::uint64_t never = ~std::uint64_t{0};

class Timer1 {
 public:
  static constexpr int channels = 3;

  std::uint64_t next() const { return next_; }

  enum class Event { match, top, bottom };

  /// Executes the event at next(): TOP sets ICF1, because both modes count up to ICR1; BOTTOM sets TOV1.
  Event pass() {
    if (next_phase_ == period()) {
      base_ += period() * prescaler_;
      next_phase_ = 0;
    }
    passed_ = next_phase_;
    if (passed_ == (mode() == 10 ? top_ : 0))
      for (Channel& c : channel_) c.compare = c.buffer;
    for (Channel& c : channel_) match(c);
    find_next();
    return passed_ == 0 ? Event::bottom : passed_ == top_ ? Event::top : Event::match;
  }

  /// Whether the timer drives the pin; else the port drives it.
  bool connected(int channel) const { return (com(channel) & 2) != 0; }
  bool level(int channel) const {
    return has_outputs() && channel_[channel].latch != ((com(channel) & 1) != 0);
  }

  void write(atmega2560::Address to, std::uint8_t value, std::uint64_t now) {
    using namespace atmega2560;
    const Count at = count(now);
    if (to == TCCR1A) {
      tccr_a_ = value;
    } else if (to == TCCR1B) {
      tccr_b_ = value;
    } else if ((to & 1) != 0) {  // a high byte waits until its low byte is written
      temp_ = value;
      return;
    } else {
      const auto word = static_cast<std::uint16_t>(temp_ << 8 | value);
      if (to == TCNT1L) return place({word, at.up}, now);
      if (to != ICR1L) return write_compare(channel_[(to - OCR1AL) / 2], word);
      icr_ = word;
    }
    if (counts() != counted_ || icr_ != top_ || prescaler_of(tccr_b_) != prescaler_) place(at, now);
  }

  std::uint8_t read(atmega2560::Address from, std::uint64_t now) {
    using namespace atmega2560;
    if (from == TCCR1A) return tccr_a_;
    if (from == TCCR1B) return tccr_b_;
    if (from >= OCR1AL && from <= OCR1CH) {
      const std::uint16_t word = channel_[(from - OCR1AL) / 2].buffer;
      return static_cast<std::uint8_t>((from & 1) != 0 ? word >> 8 : word);
    }
    if ((from & 1) != 0) return temp_;
    const std::uint16_t word = from == ICR1L ? icr_ : static_cast<std::uint16_t>(count(now).value);
    temp_ = static_cast<std::uint8_t>(word >> 8);
    return static_cast<std::uint8_t>(word);
  }

 private:
  struct Channel {
    std::uint16_t buffer = 0, compare = 0;
    bool latch = false;  ///< true: OC1x is high before inversion
    int com_shift = 0;
  };
  struct Count {
    std::int64_t value = 0;
    bool up = true;
  };

  int mode() const { return (tccr_b_ >> 1 & 12) | (tccr_a_ & 3); }
  bool has_outputs() const { return mode() == 8 || mode() == 10; }
  bool counts() const { return has_outputs() && prescaler_of(tccr_b_) > 0 && icr_ >= 3; }
  int com(int channel) const { return tccr_a_ >> channel_[channel].com_shift & 3; }
  std::int64_t period() const { return 2 * top_; }

  static std::int64_t prescaler_of(std::uint8_t tccr_b) {
    constexpr int divided[8] = {0, 1, 8, 64, 256, 1024, 0, 0};
    return divided[tccr_b & 7];
  }

  void write_compare(Channel& c, std::uint16_t word) {
    c.buffer = word;
    if (!has_outputs()) c.compare = word;
  }

  /// Handles a match. The latch of a disconnected output does not change (17.8.1). At TOP, the latch is set
  /// to the level that a match while counting up gives, even without a match (16.7.4), so that a pulse is
  /// symmetric about BOTTOM.
  void match(Channel& c) const {
    if ((tccr_a_ >> c.com_shift & 2) == 0) return;
    const std::int64_t compare = c.compare;
    if (passed_ == top_)
      c.latch = compare >= top_;
    else if (compare >= top_ || passed_ == period() - compare)
      c.latch = true;
    else if (passed_ == compare)
      c.latch = false;
  }

  Count count(std::uint64_t now) const {
    if (!counted_) return still_;
    const std::int64_t ticks = (static_cast<std::int64_t>(now) - base_ + prescaler_) / prescaler_ % period();
    return {ticks <= top_ ? ticks : period() - ticks, ticks < top_};
  }

  /// Continues from a count with the present registers. The prescaler is not reset: its edges are multiples
  /// of the prescaler's factor since the chip's reset.
  void place(Count from, std::uint64_t now) {
    counted_ = counts();
    top_ = icr_;
    prescaler_ = prescaler_of(tccr_b_);
    still_ = from;
    next_ = never;
    if (!counted_) return;
    const std::int64_t value = std::min(from.value, top_);
    const auto edge = static_cast<std::int64_t>(now) / prescaler_ * prescaler_;
    passed_ = (from.up ? value : period() - value) - 1;
    base_ = edge - passed_ * prescaler_;
    find_next();
  }

  void find_next() {
    std::int64_t phase = passed_ < 0 ? 0 : passed_ < top_ ? top_ : period();
    const auto may_be = [&](std::int64_t p) {
      if (p > passed_) phase = std::min(phase, p);
    };
    for (const Channel& c : channel_) {
      if (c.compare == 0 || c.compare >= top_) continue;
      may_be(c.compare);
      may_be(period() - c.compare);
    }
    next_phase_ = phase;
    next_ = static_cast<std::uint64_t>(base_ + phase * prescaler_);
  }

  std::uint8_t tccr_a_ = 0, tccr_b_ = 0, temp_ = 0;
  std::uint16_t icr_ = 0;
  Channel channel_[channels] = {{.com_shift = 6}, {.com_shift = 4}, {.com_shift = 2}};
  bool counted_ =
      false;  ///< true: the timer counts; place() computes this and the following members from the registers
  std::int64_t top_ = 0, prescaler_ = 0;
  std::int64_t base_ = 0;                     ///< cycle of phase 0
  std::int64_t passed_ = 0, next_phase_ = 0;  ///< in ticks
  std::uint64_t next_ = never;
  Count still_;
};

}  // namespace board
