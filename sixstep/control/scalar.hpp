// SPDX-License-Identifier: Apache-2.0
// Arithmetic that the control blocks require of their number type. The blocks are templates over one Scalar,
// which is the type of signals. Four quantities do not fit into a fixed-point signal and have separate types:
//
//   Gain         output per input; may exceed the range of a signal
//   Divisor      a constant that divides a signal once per tick; a chip multiplies by its reciprocal
//   Accumulator  a sum over many ticks, whose increments may be far below a signal's last bit
//   TickRatio    product of a signal and timer counts, for a division by timer counts
//
// For float and double all these types are the Scalar itself, and every function below returns the same bits
// as the plain expression. fixed.hpp defines types and functions for fixed point.
//
// Compilers: C++20 is required. For the AVR use clang 19 or later. Clang 14 to 16 compile a drive for the AVR
// wrongly, without a warning; 17 and 18 were never tested. avr-gcc 5 and 7, of Debian 12 and the Arduino IDE,
// do not support C++20. SIXSTEP_ANY_COMPILER disables the check. Define it for a compiler that has passed
// `tools/check_target.sh proof` or your own test on the chip.
#pragma once
#if __cplusplus < 201709L && !defined(_MSC_VER)
#error \
    "sixstep/control needs C++20 (-std=c++20), which avr-gcc 5 and 7 (Debian 12, the Arduino IDE) lack; use clang 19 for the AVR"
#endif
#if defined(__AVR__) && defined(__clang__) && __clang_major__ < 19 && !defined(SIXSTEP_ANY_COMPILER)
#error \
    "this clang compiles drives wrongly for the AVR, without a warning; use clang 19 or later, or define SIXSTEP_ANY_COMPILER"
#endif
#include <cstdint>

namespace sixstep::control {

/// Types and functions for floating point; fixed.hpp specialises them for fixed point.
template <class Scalar>
struct ScalarTraits {
  using Gain = Scalar;
  using Divisor = Scalar;
  using Accumulator = Scalar;
  using TickRatio = Scalar;
  using Wide = Scalar;  ///< range for a difference of two signals, and for a signal times a small integer

  static constexpr Scalar half_difference(Scalar a, Scalar b) { return (a - b) * Scalar(0.5); }
  static constexpr Scalar product(Scalar x, Gain gain) { return x * gain; }
  static constexpr Scalar quotient(Scalar x, Divisor divisor) { return x / divisor; }
  static constexpr Accumulator accumulated(Scalar x, Gain gain) { return x * gain; }
  static constexpr Accumulator accumulator(Scalar x) { return x; }
  static constexpr Scalar signal(Accumulator sum) { return sum; }
  static constexpr Accumulator share(Accumulator sum, Gain part) { return sum * part; }
  static constexpr TickRatio times(TickRatio ratio, std::uint8_t n) { return ratio * static_cast<Scalar>(n); }
  static constexpr Scalar per_ticks(TickRatio ratio, std::uint32_t ticks) {
    return ratio / static_cast<Scalar>(ticks);
  }
  /// part/whole, at most 1; 1 for whole = 0.
  static constexpr Scalar fraction(std::uint32_t part, std::uint32_t whole) {
    return part >= whole ? Scalar(1) : static_cast<Scalar>(part) / static_cast<Scalar>(whole);
  }
  static constexpr Scalar counts(std::int32_t n, Gain per_count) {
    return static_cast<Scalar>(n) * per_count;
  }
  static constexpr Wide wide(Scalar x) { return x; }
  static constexpr Scalar narrow(Wide x) { return x; }
};

template <class Scalar>
using Gain = typename ScalarTraits<Scalar>::Gain;
template <class Scalar>
using Divisor = typename ScalarTraits<Scalar>::Divisor;
template <class Scalar>
using Accumulator = typename ScalarTraits<Scalar>::Accumulator;
template <class Scalar>
using TickRatio = typename ScalarTraits<Scalar>::TickRatio;
template <class Scalar>
using Wide = typename ScalarTraits<Scalar>::Wide;

/// The largest duty, fraction or flag: 1, or the largest number below 1 if the format does not contain 1
/// (Q15, Q31).
template <class Scalar>
inline constexpr Scalar one = Scalar(1);

template <class Scalar>
constexpr Scalar clamped(Scalar x, Scalar limit) {
  return x > limit ? limit : x < -limit ? -limit : x;
}

template <class Scalar>
constexpr Scalar between(Scalar x, Scalar low, Scalar high) {
  return x > high ? high : x < low ? low : x;
}

template <class Scalar>
constexpr Scalar magnitude(Scalar x) {
  return x < Scalar{} ? -x : x;
}

}  // namespace sixstep::control
