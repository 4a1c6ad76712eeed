// SPDX-License-Identifier: Apache-2.0
// What a person types on a terminal: r runs, s stops, c clears faults, a number and Enter is the setpoint in the mode's unit. Characters
// come in an interrupt into a ring, from which the main loop takes them. Where one was lost or makes no sense, nothing but s counts up
// to the next Enter: "70" is never taken for 7, "7" and "30" never for 730, nor "1,5" for 5.
#pragma once
#include <cstdint>

#include "faces/firmware/example/log.hpp"

namespace firmware {

struct Command {
  /// `spoiled`: from this character on; `dropped`: at the Enter behind it.
  enum class Kind : std::uint8_t { none, run, stop, clear, setpoint, spoiled, dropped } kind = Kind::none;
  std::int32_t thousandths = 0;
};

class Commands {
 public:
  /// One character more.
  constexpr Command take(char c) {
    using Kind = Command::Kind;
    if (c == 's') {  // whatever it stands amid
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
  /// A character before the next one did not arrive.
  constexpr void lost() { spoiled_ = true; }

 private:
  static constexpr std::int32_t most = 200'000;  // a digit more, and its thousandths fit in 31 bits
  static constexpr std::uint8_t no_point = 0xFF;

  /// -12.345: a sign at its begin, one point, and up to three digits behind it.
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

/// Characters between an interrupt, which writes, and the main loop, which reads: each index is written by one of them alone.
template <std::uint8_t size>
class Ring {
  static_assert((size & (size - 1)) == 0, "its indices wrap");

 public:
  enum class Kind : std::uint8_t { none, character, gap };
  struct Item {
    Kind kind = Kind::none;
    char character = 0;
  };

  /// In the interrupt. A full ring loses this one.
  void put(char c) {
    const auto begin = begin_, end = end_;
    if (static_cast<std::uint8_t>(end - begin) >= size) return lose();
    characters_[end % size] = c;
    losses_before_[end % size] = losses_;
    barrier();
    end_ = static_cast<std::uint8_t>(end + 1);
  }
  /// In the interrupt: a character was lost behind the last one.
  void lose() { losses_ = static_cast<std::uint8_t>(losses_ + 1); }

  /// In the main loop: first that something is missing before a character, or behind the last one, then the character.
  Item take() {
    const auto begin = begin_;
    std::uint8_t losses = losses_;  // read before the end: whatever came before it is then taken first
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
  volatile std::uint8_t losses_ = 0;  // the interrupt's
  std::uint8_t told_ = 0;             // the main loop's
  volatile std::uint8_t begin_ = 0, end_ = 0;
};

/// "# setpoint 70 rad/s", or 70.500: what is obeyed from now on.
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
