// SPDX-License-Identifier: Apache-2.0
// Combines numbers into 64 bits that differ if any number differs (collisions are improbable).
#pragma once
#include <bit>
#include <cstdint>

namespace sixstep::base {

/// Combines 64-bit words into one: xor, multiplication by an odd constant, exchange of the halves. Each step
/// is a bijection of the state before. The exchange moves the high bits (sign, exponent) to the low half,
/// where the next product mixes them. The algorithm is like FNV-1a but processes words: a segment costs nine
/// products instead of seventy. It is not cryptographic.
class Hash {
 public:
  constexpr void word(std::uint64_t bits) { value_ = std::rotl((value_ ^ bits) * 0x9e3779b97f4a7c15u, 32); }
  /// Adds the bits of x unchanged: -0 and 0 differ. All NaNs are treated alike, because a NaN's sign and
  /// payload depend on the platform.
  constexpr void number(double x) {
    word(x == x ? std::bit_cast<std::uint64_t>(x) : std::uint64_t{0x7ff8000000000000u});
  }
  constexpr std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace sixstep::base
