// SPDX-License-Identifier: Apache-2.0
// The digest of a walk: 32 bits that depend on every bit of every output. It is FNV-1a, byte by byte from the
// lowest byte, so the byte order in memory has no effect. All NaNs count as one value, because IEEE 754 does
// not define their sign and digits.
#pragma once
#include <cstdint>

#include "sixstep/control/fixed.hpp"

namespace target {

#ifdef TARGET_SIGHTS
void saw(const char* what, bool it_is);  ///< counts how often an input has the named property
#else
constexpr void saw(const char*, bool) {}
#endif

class Digest {
 public:
  template <class... Values>
  constexpr void operator()(const Values&... values) {
    (take(values), ...);
  }
  constexpr std::uint32_t value() const { return mixed_; }

 private:
  constexpr void byte(std::uint32_t x) { mixed_ = (mixed_ ^ (x & 0xffu)) * std::uint32_t{16777619}; }
  constexpr void take(bool x) { byte(x ? 1 : 0); }
  constexpr void take(std::uint8_t x) { byte(x); }
  constexpr void take(std::int8_t x) { byte(static_cast<std::uint8_t>(x)); }
  constexpr void take(std::uint16_t x) {
    byte(x);
    byte(static_cast<std::uint32_t>(x) >> 8);
  }
  constexpr void take(std::int16_t x) { take(static_cast<std::uint16_t>(x)); }
  constexpr void take(std::uint32_t x) {
    take(static_cast<std::uint16_t>(x));
    take(static_cast<std::uint16_t>(x >> 16));
  }
  constexpr void take(std::int32_t x) { take(static_cast<std::uint32_t>(x)); }
  constexpr void take(std::int64_t x) {
    const std::uint64_t bits = static_cast<std::uint64_t>(x);
    take(static_cast<std::uint32_t>(bits));
    take(static_cast<std::uint32_t>(bits >> 32));
  }
  constexpr void take(float x) {
    take(x == x ? __builtin_bit_cast(std::uint32_t, x) : std::uint32_t{0x7fc00000});
  }
  template <class Storage, int FractionBits>
  constexpr void take(sixstep::control::Fixed<Storage, FractionBits> x) {
    take(x.raw);
  }
  template <class Format>
  constexpr void take(sixstep::control::FixedSum<Format> x) {
    take(x.raw);
  }

  std::uint32_t mixed_ = 2166136261u;
};

}  // namespace target
