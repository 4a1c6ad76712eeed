// SPDX-License-Identifier: Apache-2.0
// Reads commands typed on a terminal: r runs, s stops, c clears faults, and a number with Enter sets the
// setpoint in the mode's unit. An interrupt writes characters into a ring buffer, and the main loop reads
// them.
//
// After a lost or invalid character, everything except s is ignored up to the next Enter. For example, "70"
// is never read as 7 or 0.
#pragma once
#include <cstdint>

#include "faces/firmware/example/log.hpp"

namespace firmware {

struct Command {
  /// `spoiled` is returned at an invalid character, `dropped` at the Enter that ends the line.
  enum class Kind : std::uint8_t { none, run, stop, clear, setpoint, spoiled, dropped } kind = Kind::none;
  std::int32_t thousandths = 0;
};

class Commands {
 public:
  /// Reads the next character, and returns a command if it is complete.
  constexpr Command take(char c) {
    using Kind = Command::Kind;
    if (c == 's') {  // s is accepted at any place in a line
      if (begun_) spoiled_ = true;
      return {Kind::stop, 0};
    }
    if (c == '\r' || c == '\n') {
      const Command found = at_end_of_line();
      *this = {};
      return found;
    }
    if (spoiled_) return {};
    if (!begun_ && (c == 'r' || c == 'c')) return {c == 'r' ? Kind::run : Kind::clear, 0};
    if (!begun_ && c == ' ') return {};
    spoiled_ = !continues_number(c);
    begun_ = true;
    return {spoiled_ ? Kind::spoiled : Kind::none, 0};
  }
  /// Reports that a character before the next one was lost.
  constexpr void lost() { spoiled_ = true; }

 private:
  static constexpr std::int32_t most = 200'000;  // a number below this bound can be extended by one digit,
                                                 // and its thousandths still fit into 31 bits
  static constexpr std::uint8_t no_point = 0xFF;

  /// Whether a character continues a number such as -12.345: an optional sign, at most one point, and up to
  /// three digits after the point.
  constexpr bool continues_number(char c) {
    if (c == '-') {
      negative_ = true;
      return !begun_;
    }
    if (c == '.') {
      const bool first = decimals_ == no_point;
      decimals_ = 0;
      return first;
    }
    if (c < '0' || c > '9') return false;
    digits_ = true;
    if (decimals_ != no_point) {
      constexpr std::int32_t weights[] = {100, 10, 1};
      if (decimals_ == 3) return false;
      thousandths_ += weights[decimals_++] * (c - '0');
    } else if (whole_ < most) {
      whole_ = 10 * whole_ + (c - '0');
    }
    return true;
  }

  constexpr Command at_end_of_line() const {
    using Kind = Command::Kind;
    if (spoiled_ || (begun_ && !digits_)) return {Kind::dropped, 0};
    const std::int32_t value = 1000 * whole_ + thousandths_;
    return digits_ ? Command{Kind::setpoint, negative_ ? -value : value} : Command{};
  }

  std::int32_t whole_ = 0, thousandths_ = 0;
  std::uint8_t decimals_ = no_point;
  bool begun_ = false, digits_ = false, negative_ = false, spoiled_ = false;
};

/// Passes characters from an interrupt, which writes, to the main loop, which reads. Only the interrupt
/// writes end_, and only the main loop writes begin_.
template <std::uint8_t size>
class Ring {
  static_assert((size & (size - 1)) == 0, "its indices wrap");

 public:
  enum class Kind : std::uint8_t { none, character, gap };
  struct Item {
    Kind kind = Kind::none;
    char character = 0;
  };

  /// Called in the interrupt: stores a character. If the buffer is full, the character is lost.
  void put(char c) {
    const auto begin = begin_, end = end_;
    if (static_cast<std::uint8_t>(end - begin) >= size) return lose();
    characters_[end % size] = c;
    losses_before_[end % size] = losses_;
    barrier();
    end_ = static_cast<std::uint8_t>(end + 1);
  }
  /// Called in the interrupt: reports that a character after the last stored one was lost.
  void lose() { losses_ = static_cast<std::uint8_t>(losses_ + 1); }

  /// Called in the main loop: returns `gap` where characters were lost, else the next character.
  Item take() {
    const auto begin = begin_;
    std::uint8_t losses = losses_;  // read before end_, so that a character received before a loss is
                                    // returned first
    const bool empty = begin == end_;
    barrier();
    if (!empty) losses = losses_before_[begin % size];
    if (losses != told_) {
      told_ = losses;
      return {Kind::gap, 0};
    }
    if (empty) return {};
    const char c = characters_[begin % size];
    barrier();
    begin_ = static_cast<std::uint8_t>(begin + 1);
    return {Kind::character, c};
  }

 private:
  char characters_[size] = {};
  std::uint8_t losses_before_[size] = {};
  volatile std::uint8_t losses_ = 0;  // written by the interrupt
  std::uint8_t told_ = 0;             // written by the main loop
  volatile std::uint8_t begin_ = 0, end_ = 0;
};

/// Prints the setpoint that is in effect from now on: "# setpoint 70 rad/s", or 70.500.
template <class Put>
constexpr void put_setpoint(Put put, std::int32_t thousandths, const char* unit) {
  const std::int32_t whole = thousandths / 1000;
  put_text(put, "# setpoint ");
  if (1000 * whole == thousandths)
    put_number(put, whole);
  else
    put_number(put, thousandths, 3);
  put(' ');
  put_text(put, unit);
  put('\n');
}

}  // namespace firmware
