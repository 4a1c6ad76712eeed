// SPDX-License-Identifier: Apache-2.0
// What a person types on a terminal: r runs, s stops, c clears faults, a whole number and Enter is the setpoint in the mode's unit.
// Characters come in an interrupt into a ring, from which the main loop takes them. Where one was lost, the number that it belonged to
// is not obeyed: "70" is never taken for 7, nor "7" and "30" for 730.
#pragma once
#include <cstdint>

#include "faces/firmware/example/log.hpp"

namespace firmware {

struct Command {
  enum class Kind : std::uint8_t { none, run, stop, clear, setpoint, dropped } kind = Kind::none;
  std::int32_t number = 0;
};

class Commands {
 public:
  /// One character more.
  constexpr Command take(char c) {
    if (c >= '0' && c <= '9') {
      if (number_ < most) number_ = 10 * number_ + (c - '0');
      digits_ = true;
      return {};
    }
    if (c == '-') {
      const bool spoiled = spoiled_;
      *this = {};
      negative_ = true;
      spoiled_ = spoiled;
      return {};
    }
    const Command found = at_end_of_number(c);
    *this = {};
    return found;
  }
  /// A character before the next one did not arrive: no number counts up to the next Enter. r, s and c stand alone, and do.
  constexpr void lost() { spoiled_ = true; }

 private:
  static constexpr std::int32_t most = 1'000'000;

  constexpr Command at_end_of_number(char c) const {
    using Kind = Command::Kind;
    if (c == '\r' || c == '\n') {
      if (spoiled_) return {Kind::dropped, 0};
      return digits_ ? Command{Kind::setpoint, negative_ ? -number_ : number_} : Command{};
    }
    return {c == 'r' ? Kind::run : c == 's' ? Kind::stop : c == 'c' ? Kind::clear : Kind::none, 0};
  }

  std::int32_t number_ = 0;
  bool digits_ = false, negative_ = false, spoiled_ = false;
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
    gaps_[end % size] = lost_;
    lost_ = false;
    barrier();
    end_ = static_cast<std::uint8_t>(end + 1);
  }
  /// In the interrupt: a character was lost behind the last one. It is told with the next that arrives.
  void lose() { lost_ = true; }

  /// In the main loop: first that something is missing before a character, then the character.
  Item take() {
    const auto begin = begin_;
    if (begin == end_) return {};
    barrier();
    if (gaps_[begin % size]) {
      gaps_[begin % size] = false;
      return {Kind::gap, 0};
    }
    const char c = characters_[begin % size];
    barrier();
    begin_ = static_cast<std::uint8_t>(begin + 1);
    return {Kind::character, c};
  }

 private:
  char characters_[size] = {};
  bool gaps_[size] = {};
  bool lost_ = false;  // the interrupt's
  volatile std::uint8_t begin_ = 0, end_ = 0;
};

/// "# setpoint 70 rad/s": what is obeyed from now on.
template <class Put>
constexpr void put_setpoint(Put put, std::int32_t value, unsigned decimals, const char* unit) {
  put_text(put, "# setpoint ");
  put_number(put, value, decimals);
  put(' ');
  put_text(put, unit);
  put('\n');
}

}  // namespace firmware
