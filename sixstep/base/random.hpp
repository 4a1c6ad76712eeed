// SPDX-License-Identifier: Apache-2.0
// Random numbers without a state. Each number is a function of its seed, stream and counter. A run therefore
// draws the same values regardless of earlier draws, of the number of threads and of the platform.
//
// Generator: Philox4x32-10 (J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, "Parallel random numbers: as
// easy as 1, 2, 3", SC11, 2011). Ten rounds pass all of TestU01's BigCrush; the authors' test vectors are in
// tests/base/random_test.cpp.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>

#include "sixstep/base/elementary.hpp"

namespace sixstep::base {

using PhiloxBlock = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;

/// The bijection of 128-bit blocks that a key selects.
constexpr PhiloxBlock philox(PhiloxBlock x, PhiloxKey key) {
  constexpr std::uint64_t multiplier_0 = 0xd2511f53u, multiplier_1 = 0xcd9e8d57u;
  constexpr std::uint32_t golden_ratio = 0x9e3779b9u, root_3_less_1 = 0xbb67ae85u;  // steps of the key
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = multiplier_0 * x[0], b = multiplier_1 * x[2];
    x = {static_cast<std::uint32_t>(b >> 32) ^ x[1] ^ key[0], static_cast<std::uint32_t>(b),
         static_cast<std::uint32_t>(a >> 32) ^ x[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key = {key[0] + golden_ratio, key[1] + root_3_less_1};
  }
  return x;
}

/// Address of a random number. The numbers at two addresses that differ in any of the three members are
/// independent.
struct RandomPlace {
  std::uint64_t seed = 0;
  std::uint64_t stream = 0;   ///< identifies the quantity: each quantity has its own stream
  std::uint64_t counter = 0;  ///< index of the draw within the stream
};

/// The 128 random bits at an address, as two words.
constexpr std::array<std::uint64_t, 2> random_bits(const RandomPlace& at) {
  const auto low = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
  const auto high = [](std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32); };
  const PhiloxBlock out = philox({low(at.counter), high(at.counter), low(at.stream), high(at.stream)},
                                 {low(at.seed), high(at.seed)});
  return {std::uint64_t{out[1]} << 32 | out[0], std::uint64_t{out[3]} << 32 | out[2]};
}

/// The middle of one of 2^52 equal parts of (0, 1). The result is exact, never 0 or 1, and equally often
/// above and below 1/2.
constexpr double open_unit(std::uint64_t bits) { return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52; }

/// A number uniformly distributed in (0, 1).
constexpr double uniform(const RandomPlace& at) { return open_unit(random_bits(at)[0]); }

/// A normally distributed number of mean 0 and standard deviation 1 (Box and Muller, 1958). Its magnitude is
/// at most sqrt(2 ln 2^53) = 8.57.
inline double normal(const RandomPlace& at) {
  constexpr double two_pi = 6.283185307179586;
  const std::array<std::uint64_t, 2> bits = random_bits(at);
  return std::sqrt(-2.0 * log(open_unit(bits[0]))) * cos(two_pi * open_unit(bits[1]));
}

}  // namespace sixstep::base
