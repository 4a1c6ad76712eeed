// SPDX-License-Identifier: Apache-2.0
// Collects the proof of a scaling: one line for each value that fits, and one Problem for each that does not.
#pragma once
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "sixstep/base/written.hpp"
#include "sixstep/design/scaling/scaling.hpp"

namespace sixstep::design::detail {

template <class Scalar>
inline constexpr double full_scale = static_cast<double>(Scalar::max());

/// Lines of the proof, and the problems that break it.
template <class Scalar>
struct Proof {
  std::vector<Headroom> rows;
  base::Problems problems;

  void fits(const char* name, double largest, double base) {
    const double end = base * full_scale<Scalar>;
    rows.push_back({name, largest, end});
    // A value of exactly the base fits, even if the format ends one digit below 1 (Q15, Q31).
    if (std::fabs(largest) > end + base * static_cast<double>(Scalar::from_raw(1)))
      problems.push_back({name, base::written(largest), "is above full scale, " + base::written(end),
                          "take a larger base or a format with more bits before the point"});
  }

  /// Converts a threshold. It must be below full scale, because otherwise no signal can pass it. A threshold
  /// of 0 always fits.
  Scalar threshold(const char* name, double value, double base) {
    if (value != 0) fits(name, std::fabs(value) + 2 * base * static_cast<double>(Scalar::from_raw(1)), base);
    return Scalar(value / base);
  }

  control::Gain<Scalar> gain(const char* name, double per_unit) {
    constexpr int bits = control::detail::Widths<typename Scalar::Storage>::bits;
    const double most = static_cast<double>(control::detail::greatest<typename Scalar::Storage>);
    const double least = std::ldexp(1.0, (bits - 2) - control::Gain<Scalar>::most_right);
    if (std::fabs(per_unit) > most)
      problems.push_back({name, base::written(per_unit), "per unit is above " + base::written(most),
                          "take a larger base of its output or a smaller one of its input"});
    else if (per_unit != 0 && std::fabs(per_unit) < least)
      problems.push_back({name, base::written(per_unit), "per unit is below " + base::written(least),
                          "take a smaller base of its output, or 32 bits"});
    return control::Gain<Scalar>(per_unit);
  }

  /// Conditions of a PI: an error of one digit has an effect on its integral, and no increment saturates the
  /// integral.
  void integral(const std::string& name, const control::PiConfig<double>& c, double in, double out,
                double largest_error) {
    const double K_i = c.d1 + c.d0, K_i_pu = K_i * in / out;
    const double vanishes = std::ldexp(1.0, -1 - control::Accumulator<Scalar>::guard_bits);
    if (K_i != 0 && std::fabs(K_i_pu) < vanishes)
      problems.push_back(
          {name + ".K_i", base::written(K_i_pu),
           "per unit leaves an error of one digit unseen: it must reach " + base::written(vanishes),
           "take 32 bits, a longer control period or a smaller base of the output"});
    fits((name + ".limit").c_str(), c.limit, out);
    fits((name + " integral increment").c_str(), std::fabs(K_i) * largest_error, 14 * out);
  }
};

}  // namespace sixstep::design::detail
