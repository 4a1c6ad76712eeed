// SPDX-License-Identifier: Apache-2.0
// Random numbers for tests of decoders. A failed test prints the seed with which it can be repeated.
#pragma once
#include <cstdint>

#include "sixstep/base/random.hpp"

namespace sixstep::control {

struct Drawn {
  std::uint64_t seed = 0;
  std::uint64_t counter = 0;

  double unit() { return base::uniform({seed, 0, counter++}); }
  double normal() { return base::normal({seed, 0, counter++}); }
  std::uint32_t word() { return static_cast<std::uint32_t>(base::random_bits({seed, 0, counter++})[0]); }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(unit() * n); }
};

/// Degrees of a signed binary angle.
inline double degrees_of(std::int32_t angle) { return angle * (360.0 / 4294967296.0); }

/// An angle in turns, converted to a wrapped and rounded binary angle.
inline std::uint32_t of_turns(double turns) {
  const double whole = turns * 4294967296.0;
  return static_cast<std::uint32_t>(
      static_cast<std::uint64_t>(static_cast<std::int64_t>(whole < 0 ? whole - 0.5 : whole + 0.5)));
}

}  // namespace sixstep::control
