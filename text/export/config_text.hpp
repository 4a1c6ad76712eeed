// SPDX-License-Identifier: Apache-2.0
// A configuration as C++ assignments, one a line, each with its number in SI beside it. What still has its
// default (nothing, off) is left out; enumerations always stand.
#pragma once
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>

#include "sixstep/base/describe.hpp"
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/pi.hpp"
#include "sixstep/design/scaling/scaling.hpp"

namespace text {

/// 0x1.2p+2, the same in every locale and for every compiler.
inline std::string hex_float(double x) {
  char digits[40];
  const auto end = std::to_chars(digits, digits + sizeof digits, std::fabs(x), std::chars_format::hex);
  return (std::signbit(x) ? "-0x" : "0x") + std::string(digits, end.ptr);
}

/// Gains, divisors and sums of floating point are plain numbers: one overload for all of them.
inline std::string literal(double x) { return hex_float(x); }
inline std::string literal(float x) { return hex_float(static_cast<double>(x)) + "f"; }
template <class Storage, int FractionBits>
std::string literal(sixstep::control::Fixed<Storage, FractionBits> x) {
  return fmt::format("Scalar::from_raw({})", x.raw);
}
template <class Storage>
std::string literal(sixstep::control::FixedGain<Storage> g) {
  return fmt::format("Gain<Scalar>::from_raw({}, {})", g.mantissa, int{g.right});
}
template <class Storage>
std::string literal(sixstep::control::FixedDivisor<Storage> d) {
  return fmt::format("Divisor<Scalar>::from_reciprocal({})", literal(d.reciprocal));
}
template <class Format>
std::string literal(sixstep::control::FixedTickRatio<Format> r) {
  return fmt::format("TickRatio<Scalar>::from_raw({})", r.raw);
}
template <class Format>
std::string literal(sixstep::control::FixedSum<Format> s) {
  return fmt::format("Accumulator<Scalar>::from_raw({})", s.raw);
}

template <class Scalar>
class ConfigText {
 public:
  static constexpr bool fixed = !std::is_floating_point_v<Scalar>;

  /// Floating point has the bases 1.
  explicit ConfigText(const sixstep::design::Bases& bases) : b_(bases) {}
  const sixstep::design::Bases& bases() const { return b_; }
  const std::string& text() const { return text_; }

  void line(std::string_view member, const std::string& value, const std::string& comment) {
    const std::string code = fmt::format("  c.{} = {};", member, value);
    text_ += comment.empty() ? code + "\n" : fmt::format("{:<72}  // {}\n", code, comment);
  }
  /// `held`: what the format makes of it, in SI; told where it differs in six digits.
  void number(std::string_view member, const std::string& value, double designed, double held,
              std::string_view unit, std::string_view why) {
    std::string comment = fmt::format("{:.9g}", designed);
    if (!unit.empty()) comment += fmt::format(" {}", unit);
    if (fixed && fmt::format("{:.6g}", held) != fmt::format("{:.6g}", designed))
      comment += fmt::format(", held as {:.6g}", held);
    if (!why.empty()) comment += fmt::format(": {}", why);
    line(member, value, comment);
  }
  void signal(std::string_view member, Scalar kept, double designed, double base, std::string_view unit,
              std::string_view why = "") {
    if (literal(kept) != literal(Scalar{}))
      number(member, literal(kept), designed, static_cast<double>(kept) * base, unit, why);
  }
  /// `per_unit`: the base of its output over that of its input.
  void gain(std::string_view member, sixstep::control::Gain<Scalar> kept, double designed, double per_unit,
            std::string_view unit, std::string_view why = "") {
    if (literal(kept) != literal(sixstep::control::Gain<Scalar>{}))
      number(member, literal(kept), designed, static_cast<double>(kept) * per_unit, unit, why);
  }
  template <class Enum, class Choices>
  void choice(std::string_view member, std::string_view type, Enum value, const Choices& choices) {
    line(member, fmt::format("{}::{}", type, sixstep::base::word(choices, value)), "");
  }
  void flag(std::string_view member, bool on) {
    if (on) line(member, "true", "");
  }

  void pi(const std::string& member, const sixstep::control::PiConfig<double>& designed,
          const sixstep::control::PiConfig<Scalar>& kept, double in, double out, const std::string& per,
          std::string_view unit) {
    gain(member + ".d1", kept.d1, designed.d1, out / in, per);
    if constexpr (fixed)
      gain(member + ".K_i", kept.K_i, designed.d1 + designed.d0, out / in, per, "d1 + d0, per sample");
    else
      gain(member + ".d0", kept.d0, designed.d0, out / in, per);
    signal(member + ".limit", kept.limit, designed.limit, out, unit);
  }
  /// A count, left out where it is the default's.
  void count(std::string_view member, std::uint64_t kept, std::uint64_t otherwise,
             std::string_view what = "") {
    if (kept != otherwise) line(member, std::to_string(kept), std::string(what));
  }

 private:
  sixstep::design::Bases b_;
  std::string text_;
};

}  // namespace text
