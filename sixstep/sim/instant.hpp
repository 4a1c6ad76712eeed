// SPDX-License-Identifier: Apache-2.0
// Instants without accumulated rounding errors: an integer number of picoseconds (106 days fit into an int64)
// plus an offset within the picosecond. Instants from a file are whole ticks. PWM edges and located events
// have an offset.
#pragma once
#include <cmath>
#include <cstdint>
#include <limits>

namespace sixstep::sim {

inline constexpr double ticks_per_second = 1e12;

struct Instant {
  std::int64_t ticks = 0;
  double offset = 0.0;  ///< fraction of a tick, in [0, 1)

  static constexpr Instant never() { return {std::numeric_limits<std::int64_t>::max(), 0.0}; }

  constexpr bool operator==(const Instant&) const = default;
  friend constexpr bool operator<(const Instant& a, const Instant& b) {
    // Equal ticks are rare. The processor therefore predicts the branch well and seldom reads the offsets.
    // mutant: a.offset < b.offset => a.offset <= b.offset
    return a.ticks != b.ticks ? a.ticks < b.ticks : a.offset < b.offset;
  }
  friend constexpr bool operator>(const Instant& a, const Instant& b) { return b < a; }
  friend constexpr bool operator<=(const Instant& a, const Instant& b) { return !(b < a); }
  friend constexpr bool operator>=(const Instant& a, const Instant& b) { return !(a < b); }

  /// The instant that is later by `count` ticks; `count` need not be an integer.
  Instant plus_ticks(double count) const {
    const double sum = offset + count;
    auto whole = static_cast<std::int64_t>(sum);
    if (static_cast<double>(whole) > sum) --whole;  // the cast rounds towards zero
    Instant later{ticks + whole, sum - static_cast<double>(whole)};
    // mutant: later.offset >= 1.0 => later.offset > 1.0
    if (later.offset >= 1.0) later = {later.ticks + 1, 0.0};  // sum - whole may round up to 1
    return later;
  }
  Instant plus_seconds(double seconds) const { return plus_ticks(seconds * ticks_per_second); }

  double seconds() const { return (static_cast<double>(ticks) + offset) / ticks_per_second; }
};

/// The tick nearest to a time in seconds, for times from files.
inline Instant to_instant(double seconds) {
  // mutant: seconds * ticks_per_second + 0.5 => seconds * ticks_per_second
  return {static_cast<std::int64_t>(std::floor(seconds * ticks_per_second + 0.5)), 0.0};
}

/// Time from one instant to a later instant, s. The error is the rounding of the difference and does not grow
/// with the instants.
inline double seconds_between(const Instant& from, const Instant& to) {
  // mutant: (to.offset - from.offset) => 0.0
  return (static_cast<double>(to.ticks - from.ticks) + (to.offset - from.offset)) / ticks_per_second;
}

}  // namespace sixstep::sim
