// SPDX-License-Identifier: Apache-2.0
// A drive's configuration as C++ assignments, one a line, each with its number in SI beside it. What still
// has its default (nothing, off) is left out; enumerations always stand.
#pragma once
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>

#include "sixstep/base/written.hpp"
#include "sixstep/control/drive.hpp"
#include "sixstep/design/scaling.hpp"
#include "sixstep/study/choices.hpp"

namespace io {

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
std::string literal(sixstep::control::FixedSum<Format> s) {
  return fmt::format("Accumulator<Scalar>::from_raw({})", s.raw);
}

template <class Scalar>
class ConfigLines {
 public:
  /// `designed` in SI beside `kept` in the target's arithmetic; floating point has the bases 1.
  static std::string of(const sixstep::control::DriveConfig<double>& designed,
                        const sixstep::control::DriveConfig<Scalar>& kept,
                        const sixstep::design::Bases& bases) {
    ConfigLines lines(bases);
    lines.drive(designed, kept);
    if (designed.extras.on) lines.extras(designed.mode, designed.extras, kept.extras);
    return lines.text_;
  }

 private:
  static constexpr bool fixed = !std::is_floating_point_v<Scalar>;
  using Drive = sixstep::control::DriveConfig<Scalar>;
  using SiDrive = sixstep::control::DriveConfig<double>;

  explicit ConfigLines(const sixstep::design::Bases& bases) : b_(bases) {}

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

  void drive(const SiDrive& d, const Drive& k);
  void extras(sixstep::control::Mode mode, const sixstep::control::DriveExtras<double>& d,
              const sixstep::control::DriveExtras<Scalar>& k);
  void limits(const sixstep::control::LimitsConfig<double>& d,
              const sixstep::control::LimitsConfig<Scalar>& k);

  sixstep::design::Bases b_;
  std::string text_;
};

namespace words {
using sixstep::base::Choice;
using namespace sixstep::control;
inline constexpr Choice<CurrentControl> current_control[] = {{"pi", CurrentControl::pi, ""},
                                                             {"hysteresis", CurrentControl::hysteresis, ""}};
inline constexpr Choice<SpeedControl> speed_control[] = {{"cascade", SpeedControl::cascade, ""},
                                                         {"duty", SpeedControl::duty, ""}};
inline constexpr Choice<Watch> watch[] = {
    {"none", Watch::none, ""}, {"motor", Watch::motor, ""}, {"phase", Watch::phase, ""}};
}  // namespace words

template <class Scalar>
void ConfigLines<Scalar>::drive(const SiDrive& d, const Drive& k) {
  choice("mode", "Mode", d.mode, sixstep::study::mode_choices);
  choice("chopping", "Chopping", d.chopping, sixstep::study::chopping_choices);
  choice("current_control", "CurrentControl", d.current_control, words::current_control);
  choice("speed_control", "SpeedControl", d.speed_control, words::speed_control);
  choice("hysteresis.watch", "Watch", k.hysteresis.watch, words::watch);
  pi("current", d.current, k.current, b_.current_A, b_.voltage_V, "V/A", "V");
  signal("hysteresis.band_A", k.hysteresis.band_A, d.hysteresis.band_A, b_.current_A, "A");
  if (k.nominal_bus_V > sixstep::control::Divisor<Scalar>{}) {
    double held = d.nominal_bus_V;
    if constexpr (fixed) held = b_.voltage_V / static_cast<double>(k.nominal_bus_V.reciprocal);
    number("nominal_bus_V", literal(k.nominal_bus_V), d.nominal_bus_V, held, "V", "duty 1");
  }
  pi("speed", d.speed, k.speed, b_.speed_rad_s, 1.0, "per rad/s", "of full torque");
  gain("current_at_full_torque_A", k.current_at_full_torque_A, d.current_at_full_torque_A, b_.current_A, "A",
       "torque limit over K_t");
  signal("current_limit_A", k.current_limit_A, d.current_limit_A, b_.current_A, "A");
  gain("position_gain", k.position_gain, d.position_gain, b_.speed_rad_s / b_.position_deg, "rad/s per deg");
  signal("speed_limit_rad_s", k.speed_limit_rad_s, d.speed_limit_rad_s, b_.speed_rad_s, "rad/s");
}

template <class Scalar>
void ConfigLines<Scalar>::extras(sixstep::control::Mode mode, const sixstep::control::DriveExtras<double>& d,
                                 const sixstep::control::DriveExtras<Scalar>& k) {
  using sixstep::control::Mode;
  const double unit = mode == Mode::current    ? b_.current_A
                      : mode == Mode::speed    ? b_.speed_rad_s
                      : mode == Mode::position ? b_.position_deg
                                               : 1.0;
  flag("extras.on", k.on);
  flag("extras.slews_setpoint", k.slews_setpoint);
  double step = d.slew.step;
  if constexpr (fixed)
    step = std::ldexp(static_cast<double>(k.slew.step.raw),
                      -Scalar::fraction_bits - decltype(k.slew.step)::guard_bits) *
           unit;
  if (literal(k.slew.step) != literal(sixstep::control::Accumulator<Scalar>{}))
    number("extras.slew.step", literal(k.slew.step), d.slew.step, step, sixstep::study::reference_unit(mode),
           "per tick");
  flag("extras.limits_current", k.limits_current);
  if (k.limits_current) limits(d.limits, k.limits);
  gain("extras.torque_fraction_per_A", k.torque_fraction_per_A, d.torque_fraction_per_A, 1 / b_.current_A,
       "per A");
  gain("extras.feed_forward.K_t_V_s", k.feed_forward.K_t_V_s, d.feed_forward.K_t_V_s,
       b_.voltage_V / b_.speed_rad_s, "V per rad/s");
  signal("extras.bus.lowest_bus_V", k.bus.lowest_bus_V, d.bus.lowest_bus_V, b_.voltage_V, "V");
  flag("extras.smooth_chopping", k.smooth_chopping);
  signal("extras.chopping.soft_above_A", k.chopping.soft_above_A, d.chopping.soft_above_A, b_.current_A, "A");
  signal("extras.chopping.complementary_below_A", k.chopping.complementary_below_A,
         d.chopping.complementary_below_A, b_.current_A, "A");
}

template <class Scalar>
void ConfigLines<Scalar>::limits(const sixstep::control::LimitsConfig<double>& d,
                                 const sixstep::control::LimitsConfig<Scalar>& k) {
  signal("extras.limits.current_A", k.current_A, d.current_A, b_.current_A, "A");
  flag("extras.limits.limits_speed", k.limits_speed);
  signal("extras.limits.speed_rad_s", k.speed_rad_s, d.speed_rad_s, b_.speed_rad_s, "rad/s");
  gain("extras.limits.A_per_rad_s", k.A_per_rad_s, d.A_per_rad_s, b_.current_A / b_.speed_rad_s,
       "A per rad/s");
  flag("extras.limits.limits_regeneration", k.limits_regeneration);
  signal("extras.limits.bus_V", k.bus_V, d.bus_V, b_.voltage_V, "V");
  gain("extras.limits.A_per_V", k.A_per_V, d.A_per_V, b_.current_A / b_.voltage_V, "A per V");
}

}  // namespace io
