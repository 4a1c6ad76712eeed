// SPDX-License-Identifier: Apache-2.0
// Results of fixed-point operations that are checked at compile time. A compiler with 16-bit int can
// therefore check them without a chip. They must have the same bits as on the host, where fixed_test.cpp
// compares them with exact arithmetic.
#pragma once
#include <cstdint>

#include "sixstep/control/fixed.hpp"
#include "sixstep/control/pi.hpp"
#include "sixstep/control/profile.hpp"

namespace sixstep::control::facts {

/// Every operation on a grid of numbers, with all results mixed into 32 bits. The grid includes the ends of
/// the range and both sides of 0.
template <class F>
constexpr std::uint32_t digest() {
  using T = ScalarTraits<F>;
  constexpr int n = 24;
  typename F::Storage grid[n]{};
  for (int k = 0; k < n; ++k) {
    const double share = k < 3 ? k - 1.0 : (k - 13.5) / 10.5;
    grid[k] = detail::nearest<typename F::Storage>(
        share * static_cast<double>(detail::greatest<typename F::Storage>) - (k < 3 ? 0.0 : 1.0));
  }
  std::uint32_t mixed = 2166136261u;
  const auto mix = [&mixed](auto raw) {
    const std::uint64_t bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(raw));
    mixed = static_cast<std::uint32_t>((mixed ^ static_cast<std::uint32_t>(bits ^ (bits >> 32))) * 16777619u);
  };
  const Gain<F> gains[] = {Gain<F>(4.5), Gain<F>(-0.37), Gain<F>(1.3e-4)};
  PiConfig<F> pi{Gain<F>(3.28), Gain<F>(0.32), F::from_raw(grid[20])};
  PiState<F> state{};
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const F x = F::from_raw(grid[a]), y = F::from_raw(grid[b]);
      const F results[] = {x + y,
                           x - y,
                           x * y,
                           x / y,
                           -x,
                           T::half_difference(x, y),
                           T::product(x, gains[b % 3]),
                           T::per_ticks(TickRatio<F>(0.3), static_cast<std::uint32_t>(b) * 9u),
                           T::fraction(static_cast<std::uint32_t>(a) * 0x01234567u, 0x1f000000u),
                           T::counts(b * std::int32_t{1000}, gains[0]),
                           pi_step(pi, state, x)};
      for (const F& z : results) mix(z.raw);
      mix(T::accumulated(static_cast<Wide<F>>(T::wide(x) - T::wide(y)), gains[a % 3]).raw);
    }
  return mixed;
}

static_assert(-Q15::min() == Q15::max() && detail::least<std::int16_t> < 0 &&
              detail::greatest<std::int16_t> == 0x7fff);
static_assert(Q15(0.5).raw == 0x4000 && Q31(0.5).raw == 0x40000000);
static_assert(Q15::min() * Q15::min() == Q15::max() && Q15::min() / Q15(0.5) == Q15::min());
static_assert(digest<Q15>() == 3562686028u);
static_assert(digest<Q31>() == 3071710920u);
static_assert(digest<Fixed<std::int16_t, 12>>() == 3509906223u);
static_assert(digest<Fixed<std::int32_t, 24>>() == 3870995882u);

}  // namespace sixstep::control::facts
