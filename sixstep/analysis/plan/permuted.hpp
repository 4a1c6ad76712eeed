// SPDX-License-Identifier: Apache-2.0
// Permutes numbers without a table: the new position of a number is computed from this number only.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

#include "sixstep/base/random.hpp"

namespace sixstep::analysis {

/// Position of `n` in the permutation of 0 .. count - 1 that seed and stream select: a Feistel network of six
/// rounds over the least even number of bits for `count`, repeated until the result is below count (Luby and
/// Rackoff 1988; Black and Rogaway 2002, "cycle walking").
constexpr std::uint64_t permuted(std::uint64_t n, std::uint64_t count, std::uint64_t seed,
                                 std::uint64_t stream) {
  const auto half = static_cast<unsigned>(std::bit_width(count - 1) + 1) / 2;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  do {
    std::uint64_t left = n >> half, right = n & mask;
    for (std::uint64_t round = 0; round < 6; ++round) {
      const std::uint64_t mixed = base::random_bits({seed, stream, right << 8 | round})[1] & mask;
      const std::uint64_t next = left ^ mixed;
      left = right;
      right = next;
    }
    n = left << half | right;
  } while (n >= count);
  return n;
}

}  // namespace sixstep::analysis
