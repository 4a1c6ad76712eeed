// SPDX-License-Identifier: Apache-2.0
// Prints lines of numbers for a serial line. A board's log is a table that `sixstep run --compare LOG`
// compares with the simulation. The functions use no division and no library: they find digits by
// subtraction, which takes an 8-bit chip a few hundred cycles per number.
#pragma once
#include <cstdint>

namespace firmware {

template <class Word>
constexpr Word tens[10] = {};
template <>
inline constexpr std::uint16_t tens<std::uint16_t>[10] = {0, 0, 0, 0, 0, 10'000, 1'000, 100, 10, 1};
template <>
inline constexpr std::uint32_t tens<std::uint32_t>[10] = {
    1'000'000'000, 100'000'000, 10'000'000, 1'000'000, 100'000, 10'000, 1'000, 100, 10, 1};

/// Prints the digits of `rest` from a decimal place on, with integers of type Word.
template <class Word, class Put>
constexpr void put_digits(Put put, Word rest, unsigned decimals, unsigned first_place) {
  bool begun = false;
  for (unsigned place = first_place; place < 10; ++place) {
    const unsigned behind = 9 - place;  // number of digits that follow
    char digit = '0';
    for (; rest >= tens<Word>[place]; rest = static_cast<Word>(rest - tens<Word>[place])) ++digit;
    begun = begun || digit != '0' || behind <= decimals;
    if (begun) put(digit);
    if (decimals > 0 && behind == decimals) put('.');
  }
}

/// Prints a number with decimals: -123 with three decimals is "-0.123". `put` receives one character at a
/// time.
template <class Put>
constexpr void put_number(Put put, std::int32_t value, unsigned decimals = 0) {
  const std::uint32_t rest =
      value < 0 ? 0u - static_cast<std::uint32_t>(value) : static_cast<std::uint32_t>(value);
  if (value < 0) put('-');
  if (rest < 65536)  // the usual case; 16-bit integers need half the time on an 8-bit chip
    put_digits(put, static_cast<std::uint16_t>(rest), decimals, 5);
  else
    put_digits(put, rest, decimals, 0);
}

template <class Put>
constexpr void put_text(Put put, const char* text) {
  for (; *text != '\0'; ++text) put(*text);
}

/// Time since the clock's start. The printed number of seconds overflows after 68 years.
struct Instant {
  std::uint32_t seconds = 0, microseconds = 0;  ///< microseconds are below a million

  constexpr void pass(std::uint32_t more_microseconds) {
    for (; more_microseconds >= 1'000'000; more_microseconds -= 1'000'000) ++seconds;
    microseconds += more_microseconds;
    if (microseconds < 1'000'000) return;
    microseconds -= 1'000'000;
    ++seconds;
  }
};

/// Prints a time in microseconds, without 64-bit numbers.
template <class Put>
constexpr void put_instant(Put put, const Instant& t) {
  if (t.seconds == 0) return put_number(put, static_cast<std::int32_t>(t.microseconds));
  put_number(put, static_cast<std::int32_t>(t.seconds));
  std::uint32_t rest = t.microseconds;
  for (unsigned place = 4; place < 10; ++place) {
    char digit = '0';
    for (; rest >= tens<std::uint32_t>[place]; rest -= tens<std::uint32_t>[place]) ++digit;
    put(digit);
  }
}

/// Compiler barrier. The compiler moves no read or write of memory over it.
inline void barrier() { asm volatile("" ::: "memory"); }

/// Passes one row at a time from the control interrupt to the main loop. The main loop requests the next row
/// as soon as it has sent one. So the log has as many rows as the line can transmit, each with its instant.
template <class Row>
class LogSlot {
 public:
  /// Called in the interrupt: copies the row if the main loop waits for a row. Returns whether it copied.
  bool take(const Row& row) {
    if (full_) return false;
    row_ = row;
    barrier();
    full_ = true;
    return true;
  }

  /// Called in the main loop: returns the row to send; null if there is none.
  const Row* waiting() const {
    const bool there = full_;
    barrier();
    return there ? &row_ : nullptr;
  }
  /// Called in the main loop after the row was sent.
  void next() {
    barrier();
    full_ = false;
  }

 private:
  Row row_{};
  volatile bool full_ = false;
};

}  // namespace firmware
