// SPDX-License-Identifier: Apache-2.0
// Collects the proof of a scaling: one line for each value that fits, and one Problem for each value that
// does not fit.
#pragma once
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sixstep/base/decimal.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/scaling/scaling.hpp"

namespace sixstep::design::detail {

template <class Scalar>
inline constexpr double full_scale = static_cast<double>(Scalar::max());

/// Four digits for messages. The number is rounded away from zero; at_most() rounds the compared number
/// towards zero.
inline std::string at_least(double x) {
  return base::written(base::shortened(x, 4, x < 0 ? base::Towards::down : base::Towards::up));
}
inline std::string at_most(double x) {
  return base::written(base::shortened(x, 4, x < 0 ? base::Towards::up : base::Towards::down));
}

/// A quantity's base, SI, with its member of Bases.
struct BaseOf {
  std::string_view member;
  double value = 1.0;
};

/// Full scale divided by base: a power of two. The largest number of the format is one digit less.
template <class Scalar>
inline constexpr double scale_per_base =
    std::int64_t{1} << (control::detail::Widths<typename Scalar::Storage>::bits - 1 - Scalar::fraction_bits);

/// Lines of the proof, and the problems that break it.
template <class Scalar>
struct Proof {
  std::vector<Headroom> rows;
  base::Problems problems;

  /// `room`: the number of full scales up to which this quantity may grow.
  void fits(const char* name, double largest, const BaseOf& of, double room = 1.0) {
    const double base = room * of.value, end = base * full_scale<Scalar>;
    rows.push_back({name, largest, end});
    // The two digits above a threshold grow with the base.
    const double needed = std::fabs(largest) * (1 + 4 * static_cast<double>(Scalar::from_raw(1)));
    // A value of exactly the base fits, even if the format ends one digit below 1 (Q15, Q31).
    if (std::fabs(largest) > end + base * static_cast<double>(Scalar::from_raw(1)))
      problems.push_back({name, at_least(largest), "is above full scale, " + at_most(end),
                          of.member.empty()
                              ? "use a format with more bits before the point"
                              : "use a " + full_scale_words(of.member, at_least(needed / room)) +
                                    " or more, or a format with more bits before the point"});
  }

  /// Converts a threshold. It must be below full scale, because otherwise no signal can pass it. A threshold
  /// of 0 always fits.
  Scalar threshold(const char* name, double value, const BaseOf& of) {
    if (value != 0)
      fits(name, std::fabs(value) + 2 * of.value * static_cast<double>(Scalar::from_raw(1)), of);
    return Scalar(value / of.value);
  }

  control::Gain<Scalar> gain(const char* name, double per_unit) {
    constexpr int bits = control::detail::Widths<typename Scalar::Storage>::bits;
    const double most = static_cast<double>(control::detail::greatest<typename Scalar::Storage>);
    const double least = std::ldexp(1.0, (bits - 2) - control::Gain<Scalar>::most_right);
    if (std::fabs(per_unit) > most)
      problems.push_back({name, at_least(per_unit), "per unit is above " + at_most(most),
                          "use a base of its output that is larger by a factor of " +
                              at_least(std::fabs(per_unit) / most) + ", or a smaller base of its input"});
    else if (per_unit != 0 && std::fabs(per_unit) < least)
      problems.push_back({name, at_most(per_unit), "per unit is below " + at_least(least),
                          "use a base of its output that is smaller by a factor of " +
                              at_least(least / std::fabs(per_unit)) + ", or 32 bits"});
    return control::Gain<Scalar>(per_unit);
  }

  /// Conditions of a PI: an error of one digit has an effect on its integral, and no increment saturates the
  /// integral.
  void integral(const std::string& name, const control::PiConfig<double>& c, double in, const BaseOf& out,
                double largest_error) {
    const double K_i = c.d1 + c.d0, K_i_pu = K_i * in / out.value;
    const double vanishes = std::ldexp(1.0, -1 - control::Accumulator<Scalar>::guard_bits);
    if (K_i != 0 && std::fabs(K_i_pu) < vanishes)
      problems.push_back(
          {name + ".K_i", at_most(K_i_pu),
           "per unit is too small: an error of one digit has no effect below " + at_least(vanishes),
           "use 32 bits, a longer control period, or a base of the output that is smaller by a factor of " +
               at_least(vanishes / std::fabs(K_i_pu))});
    fits((name + ".limit").c_str(), c.limit, out);
    fits((name + " integral increment").c_str(), std::fabs(K_i) * largest_error, out, 14.0);
  }
};

}  // namespace sixstep::design::detail
