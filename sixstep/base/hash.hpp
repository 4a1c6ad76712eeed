// SPDX-License-Identifier: Apache-2.0
// Numbers into 64 bits that tell whether any of them differs.
#pragma once
#include <bit>
#include <cstdint>

namespace sixstep::base {

/// 64-bit words into one: xor, multiply by an odd constant, swap the halves. Each step is a bijection of what
/// was there before, and the swap carries the high bits (sign, exponent) down, where a product alone would
/// leave them. Like FNV-1a, but by words: a segment costs nine products instead of seventy. No cryptography.
class Hash {
 public:
  constexpr void word(std::uint64_t bits) { value_ = std::rotl((value_ ^ bits) * 0x9e3779b97f4a7c15u, 32); }
  /// The bits as they are, so -0 and 0 differ; a NaN is a NaN, whatever sign and payload a platform gives it.
  constexpr void number(double x) {
    word(x == x ? std::bit_cast<std::uint64_t>(x) : std::uint64_t{0x7ff8000000000000u});
  }
  constexpr std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace sixstep::base
