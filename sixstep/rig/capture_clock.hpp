// SPDX-License-Identifier: Apache-2.0
// The free-running counter that captures Hall edges: counts(t) = floor(t f) for time t and frequency f,
// computed in integers. In floating point, t f can be just below a count that is exactly reached; at 48 MHz
// this error affects a twelfth of the counts.
#pragma once
#include <cmath>
#include <cstdint>

#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

class CaptureClock {
 public:
  /// `Hz`: 1 Hz to 1 GHz, not necessarily an integer. The loop finds f = numerator/2^n, which is exact for
  /// any double.
  explicit CaptureClock(double Hz) {
    while (Hz != std::floor(Hz)) {
      Hz *= 2;
      per_count_ *= 2;
    }
    numerator_ = static_cast<std::uint64_t>(Hz);
  }

  /// Count at an instant. The product ticks x numerator has at most 63 + 53 bits and fits in 128 bits.
  std::uint32_t counts(const sim::Instant& t) const {
    const Wide passed = static_cast<Wide>(t.ticks) * numerator_;
    const Wide whole = passed / per_count_, missing = per_count_ - passed % per_count_;
    // mutant: t.offset * static_cast<double>(numerator_) >= static_cast<double>(missing) => false
    const bool one_more = t.offset * static_cast<double>(numerator_) >= static_cast<double>(missing);
    return static_cast<std::uint32_t>(whole) + std::uint32_t{one_more};
  }

 private:
  __extension__ typedef unsigned __int128 Wide;  // g++ and clang have this type on every host

  std::uint64_t numerator_ = 0;
  Wide per_count_ = static_cast<Wide>(sim::ticks_per_second);  ///< ticks x numerator per count
};

}  // namespace sixstep::rig
