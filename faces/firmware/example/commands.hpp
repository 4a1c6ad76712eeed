// SPDX-License-Identifier: Apache-2.0
// What a person types on a terminal: r runs, s stops, c clears faults, a whole number and Enter is the setpoint in the mode's unit.
#pragma once
#include <cstdint>

namespace firmware {

struct Command {
  enum class Kind : std::uint8_t { none, run, stop, clear, setpoint } kind = Kind::none;
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
      *this = {};
      negative_ = true;
      return {};
    }
    const Command found = at_end_of_number(c);
    *this = {};
    return found;
  }

 private:
  static constexpr std::int32_t most = 1'000'000;

  constexpr Command at_end_of_number(char c) const {
    using Kind = Command::Kind;
    if (c == '\r' || c == '\n')
      return digits_ ? Command{Kind::setpoint, negative_ ? -number_ : number_} : Command{};
    return {c == 'r' ? Kind::run : c == 's' ? Kind::stop : c == 'c' ? Kind::clear : Kind::none, 0};
  }

  std::int32_t number_ = 0;
  bool digits_ = false, negative_ = false;
};

}  // namespace firmware
