// SPDX-License-Identifier: Apache-2.0
// Converts a board's constants from SI units to signals at compile time: x becomes x/base, rounded once. A
// base is the SI value of a signal's 1.0, in A, V, rad/s or degrees; in floating point every base is 1.
// design/scaling/product_scaling.hpp computes the same quotients. A converter or threshold written in
// firmware therefore has the bits for which the scaling is proved. (On the AVR, where double has 32 bits, the
// last of 16 bits may differ. An exported drive has no such difference, because it consists of integers.)
//
// All functions are consteval, so that a chip never divides by a base. A value outside of the format's range
// does not compile ("does_not_fit").
#pragma once
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/hall_speed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

namespace detail {

void does_not_fit();  // not constexpr and never defined: a call is a compile error

template <class Scalar>
struct FormatEnds {  // range of floating point, which no number in SI units exceeds
  static constexpr double digit = 1.0;
  static constexpr bool holds(double) { return true; }
  static constexpr bool holds_gain(double) { return true; }
  static constexpr bool holds_ticks(double) { return true; }
};

template <class Storage, int FractionBits>
struct FormatEnds<Fixed<Storage, FractionBits>> {
  using Scalar = Fixed<Storage, FractionBits>;
  static constexpr double digit = static_cast<double>(Scalar::from_raw(1));
  /// True if x is within the format. The number one digit above the largest is accepted: 1.0 in Q15 and Q31.
  static constexpr bool holds(double x) {
    return x <= static_cast<double>(Scalar::max()) + digit && x >= static_cast<double>(Scalar::min());
  }
  static constexpr bool holds_gain(double x) {
    constexpr double most = static_cast<double>(greatest<Storage>);
    return x <= most && x >= -most;
  }
  static constexpr bool holds_ticks(double x) {
    return x / digit <= static_cast<double>(greatest<typename Scalar::WideInt>);
  }
};

}  // namespace detail

template <class Scalar>
struct Units {
  double current_A = 1.0;
  double voltage_V = 1.0;
  double speed_rad_s = 1.0;
  double position_deg = 1.0;

  consteval Scalar amperes(double x) const { return signal(x / current_A); }
  consteval Scalar volts(double x) const { return signal(x / voltage_V); }
  consteval Scalar rad_per_s(double x) const { return signal(x / speed_rad_s); }
  consteval Scalar degrees(double x) const { return signal(x / position_deg); }
  /// A number without a unit, such as a duty, a fraction or a number of sectors: its base is 1 in every
  /// format.
  consteval Scalar plain(double x) const { return signal(x); }

  /// AdcConfig::per_eighth of a converter with x A per count. volts_per_count(): of a converter with x V per
  /// count.
  consteval Gain<Scalar> amperes_per_count(double x) const { return per_eighth(x, current_A); }
  consteval Gain<Scalar> volts_per_count(double x) const { return per_eighth(x, voltage_V); }

  /// Configuration of the speed from Hall edges, timed by a free-running timer (hall_speed.hpp). `edges`:
  /// 1..6; 6 edges are one electrical turn.
  consteval HallSpeedConfig<Scalar> hall_speed(int pole_pairs, double timer_Hz, std::uint32_t timeout_ticks,
                                               std::uint8_t edges) const {
    constexpr double pi = 3.14159265358979323846;
    const double ticks = pi / 3 / pole_pairs * timer_Hz / speed_rad_s;
    if (!detail::FormatEnds<Scalar>::holds_ticks(ticks * edges)) detail::does_not_fit();
    return {TickRatio<Scalar>(ticks), timeout_ticks, edges};
  }

  /// Configuration of the position from Hall edges: 60/p mechanical degrees each.
  consteval HallPositionConfig<Scalar> hall_position(int pole_pairs) const {
    const double sector = 60.0 / pole_pairs / position_deg;
    return {gain(sector / detail::FormatEnds<Scalar>::digit), gain(sector)};
  }

 private:
  static consteval Scalar signal(double x) {
    if (!detail::FormatEnds<Scalar>::holds(x)) detail::does_not_fit();
    return static_cast<Scalar>(x);
  }
  static consteval Gain<Scalar> gain(double x) {
    if (!detail::FormatEnds<Scalar>::holds_gain(x)) detail::does_not_fit();
    return static_cast<Gain<Scalar>>(x);
  }
  static consteval Gain<Scalar> per_eighth(double per_count, double base) {
    return gain(per_count / 8 / base / detail::FormatEnds<Scalar>::digit);
  }
};

}  // namespace sixstep::control
