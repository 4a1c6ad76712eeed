// SPDX-License-Identifier: Apache-2.0
// Writes a configuration as C++ assignments, one per line, each with its number in SI on the same line. A
// member with its default value (0, off) is omitted; an enumeration is always written.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "sixstep/base/describe.hpp"
#include "sixstep/control/fixed.hpp"
#include "sixstep/design/fields/estimator_fields.hpp"
#include "sixstep/design/fields/observer_fields.hpp"
#include "sixstep/design/fields/sensorless_fields.hpp"
#include "sixstep/design/scaling/scaling.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace text {

/// A number in the form 0x1.2p+2, which is the same in every locale and for every compiler.
inline std::string hex_float(double x) {
  char digits[40];
  const auto end = std::to_chars(digits, digits + sizeof digits, std::fabs(x), std::chars_format::hex);
  return (std::signbit(x) ? "-0x" : "0x") + std::string(digits, end.ptr);
}

/// In floating point, gains, divisors and sums are plain numbers. Therefore this overload also writes them.
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

/// Literal of a member that is a whole number in every arithmetic.
template <class Whole>
std::string whole(Whole x) {
  return std::to_string(x);
}
inline std::string whole(bool on) { return on ? "true" : "false"; }
inline std::string whole(sixstep::control::FixedGain<std::int32_t> g) {
  return fmt::format("FixedGain<std::int32_t>::from_raw({}, {})", g.mantissa, int{g.right});
}

/// The C++ names of an enumeration in control/ and its values.
template <class Enum>
struct EnumText;
template <>
struct EnumText<sixstep::control::Mode> {
  static constexpr const char* type = "Mode";
  static constexpr auto& words = sixstep::study::mode_choices;
};
template <>
struct EnumText<sixstep::control::Chopping> {
  static constexpr const char* type = "Chopping";
  static constexpr auto& words = sixstep::study::chopping_choices;
};
template <>
struct EnumText<sixstep::control::CurrentControl> {
  using enum sixstep::control::CurrentControl;
  static constexpr const char* type = "CurrentControl";
  static constexpr sixstep::base::Choice<sixstep::control::CurrentControl> words[] = {
      {"pi", pi, ""}, {"hysteresis", hysteresis, ""}};
};
template <>
struct EnumText<sixstep::control::SpeedControl> {
  using enum sixstep::control::SpeedControl;
  static constexpr const char* type = "SpeedControl";
  static constexpr sixstep::base::Choice<sixstep::control::SpeedControl> words[] = {{"cascade", cascade, ""},
                                                                                    {"duty", duty, ""}};
};
template <>
struct EnumText<sixstep::control::SpeedLaw> {
  using enum sixstep::control::SpeedLaw;
  static constexpr const char* type = "SpeedLaw";
  static constexpr sixstep::base::Choice<sixstep::control::SpeedLaw> words[] = {
      {"pi", pi, ""}, {"positional", positional, ""}, {"observed", observed, ""}, {"sliding", sliding, ""}};
};
template <>
struct EnumText<sixstep::control::PwmPattern> {
  static constexpr const char* type = "PwmPattern";
  static constexpr auto& words = sixstep::study::pattern_choices;
};
template <>
struct EnumText<sixstep::control::Watch> {
  using enum sixstep::control::Watch;
  static constexpr const char* type = "Watch";
  static constexpr sixstep::base::Choice<sixstep::control::Watch> words[] = {
      {"none", none, ""}, {"motor", motor, ""}, {"phase", phase, ""}};
};
template <>
struct EnumText<sixstep::control::CurrentSensing> {
  using enum sixstep::control::CurrentSensing;
  static constexpr const char* type = "CurrentSensing";
  static constexpr sixstep::base::Choice<sixstep::control::CurrentSensing> words[] = {
      {"phases", phases, ""}, {"one_shunt", one_shunt, ""}};
};
template <>
struct EnumText<sixstep::control::HallArrangement> {
  using enum sixstep::control::HallArrangement;
  static constexpr const char* type = "HallArrangement";
  static constexpr sixstep::base::Choice<sixstep::control::HallArrangement> words[] = {
      {"degrees_120", degrees_120, ""}, {"degrees_60", degrees_60, ""}};
};

template <>
struct EnumText<sixstep::control::NeutralSeen> {
  using enum sixstep::control::NeutralSeen;
  static constexpr const char* type = "NeutralSeen";
  static constexpr sixstep::base::Choice<sixstep::control::NeutralSeen> words[] = {
      {"on_time", on_time, ""}, {"freewheel", freewheel, ""}};
};
template <>
struct EnumText<sixstep::control::RotorSource> {
  using enum sixstep::control::RotorSource;
  static constexpr const char* type = "RotorSource";
  static constexpr sixstep::base::Choice<sixstep::control::RotorSource> words[] = {
      {"hall", hall, ""}, {"back_emf", back_emf, ""}};
};
template <>
struct EnumText<sixstep::control::Follow> {
  using enum sixstep::control::Follow;
  static constexpr const char* type = "Follow";
  static constexpr sixstep::base::Choice<sixstep::control::Follow> words[] = {
      {"crossings", crossings, ""},
      {"luenberger", luenberger, ""},
      {"sliding_mode", sliding_mode, ""},
      {"flux", flux, ""},
      {"comparators", comparators, ""}};
};

template <>
struct EnumText<sixstep::control::VoltageLimit> {
  using enum sixstep::control::VoltageLimit;
  static constexpr const char* type = "VoltageLimit";
  static constexpr sixstep::base::Choice<sixstep::control::VoltageLimit> words[] = {{"axes", axes, ""},
                                                                                    {"circle", circle, ""}};
};

/// Visits the fields of a configuration (design/fields) twice in parallel: as designed in SI, and as kept in
/// the target's arithmetic.
template <class Scalar>
class ConfigText {
 public:
  using Field = sixstep::design::Field;
  using Base = sixstep::design::Base;

  /// In floating point all bases are 1.
  ConfigText(sixstep::control::Mode mode, const sixstep::design::Bases& bases,
             std::vector<std::string_view> unused = {})
      : mode_(mode), b_(bases), unused_(std::move(unused)) {}
  const std::string& text() const { return text_; }

  /// Fields of a loop that does not run are visited too, because floating point keeps their values.
  static constexpr bool when_run(bool) { return true; }
  static constexpr bool when_on(bool on) { return on; }

  template <class Designed, class Kept, class... Told>
  void part(const char* name, const Designed& designed, const Kept& kept, const Told&... told) {
    const std::string outer = within_;
    within_ += name;
    within_ += '.';
    sixstep::design::fields(*this, designed, kept, told...);
    within_ = outer;
  }
  void flag(const Field& f, bool, bool on) {
    if (on) line(f, "true", "");
  }
  template <class Enum>
  void choice(const Field& f, Enum, Enum kept, Enum otherwise) {
    if (!f.always && kept == otherwise) return;
    using Text = EnumText<Enum>;
    std::string word(sixstep::base::word(Text::words, kept));
    std::replace(word.begin(), word.end(), '-', '_');
    line(f, fmt::format("{}::{}", Text::type, word), "");
  }
  template <class Whole>
  void count(const Field& f, Whole, Whole kept, Whole otherwise) {
    if (kept != otherwise) line(f, whole(kept), f.about);
  }
  void signal(const Field& f, double designed, Scalar kept, Base base) {
    if (f.always || literal(kept) != literal(Scalar{}))
      number(f, literal(kept), designed, static_cast<double>(kept) * value(base), unit(f, base));
  }
  void threshold(const Field& f, double designed, Scalar kept, Base base) { signal(f, designed, kept, base); }
  void gain(const Field& f, double designed, sixstep::control::Gain<Scalar> kept,
            sixstep::design::Ratio ratio) {
    gain_of(f, designed, kept, value(ratio.out) / value(ratio.in));
  }
  void raw_gain(const Field& f, double designed, sixstep::control::Gain<Scalar> kept, Base base) {
    gain_of(f, designed, kept, value(base) * digit());
  }
  /// Writes a gain whose input is counted in the last bit of the format.
  void gain_of_raw(const Field& f, double designed, sixstep::control::Gain<Scalar> kept, Base base) {
    gain_of(f, designed, kept, 1.0 / (value(base) * digit()));
  }
  void divisor(const Field& f, double designed, sixstep::control::Divisor<Scalar> kept, Base base) {
    if (!(kept > sixstep::control::Divisor<Scalar>{})) return;
    double held = designed;
    if constexpr (fixed) held = value(base) / static_cast<double>(kept.reciprocal);
    number(f, literal(kept), designed, held, f.unit);
  }
  void sum(const Field& f, double designed, sixstep::control::Accumulator<Scalar> kept, Base base) {
    if (literal(kept) == literal(sixstep::control::Accumulator<Scalar>{})) return;
    double held = designed;
    if constexpr (fixed)
      held = std::ldexp(static_cast<double>(kept.raw), -Scalar::fraction_bits - decltype(kept)::guard_bits) *
             value(base);
    number(f, literal(kept), designed, held, unit(f, base));
  }
  void ticks(const Field& f, double designed, sixstep::control::TickRatio<Scalar> kept, Base base) {
    double held = designed;
    if constexpr (fixed) held = static_cast<double>(kept.raw) * digit() * value(base);
    number(f, literal(kept), designed, held, f.unit);
  }

 private:
  static constexpr bool fixed = !std::is_floating_point_v<Scalar>;

  /// The value of the last bit of a fixed-point format. Gains of counts have their output in this unit
  /// (adc.hpp, hall_speed.hpp).
  static double digit() {
    if constexpr (fixed)
      return static_cast<double>(Scalar::from_raw(1));
    else
      return 1.0;
  }
  double value(Base base) const { return sixstep::design::value_of(base, mode_, b_); }
  std::string_view unit(const Field& f, Base base) const {
    return base == Base::setpoint ? sixstep::study::reference_unit(mode_) : f.unit;
  }
  void gain_of(const Field& f, double designed, sixstep::control::Gain<Scalar> kept, double per_unit) {
    if (literal(kept) != literal(sixstep::control::Gain<Scalar>{}))
      number(f, literal(kept), designed, static_cast<double>(kept) * per_unit, f.unit);
  }
  void line(const Field& f, const std::string& value, std::string comment) {
    const std::string path = within_ + f.name, code = fmt::format("  c.{} = {};", path, value);
    if (std::any_of(unused_.begin(), unused_.end(),
                    [&path](std::string_view part) { return path.starts_with(part); }))
      comment += (comment.empty() ? "" : "; ") + std::string("not used by this drive");
    text_ += comment.empty() ? code + "\n" : fmt::format("{:<72}  // {}\n", code, comment);
  }
  /// `held` is the value that the format represents, in SI. The comment states `held` if it differs from the
  /// designed value in six digits.
  void number(const Field& f, const std::string& value, double designed, double held, std::string_view unit) {
    std::string comment = fmt::format("{:.9g}", designed);
    if (!unit.empty()) comment += fmt::format(" {}", unit);
    if (fixed && fmt::format("{:.6g}", held) != fmt::format("{:.6g}", designed))
      comment += fmt::format(", held as {:.6g}", held);
    if (*f.about != '\0') comment += fmt::format(": {}", f.about);
    line(f, value, comment);
  }

  sixstep::control::Mode mode_;
  sixstep::design::Bases b_;
  std::vector<std::string_view> unused_;  ///< beginnings of the paths of fields that the drive does not use
  std::string text_, within_;
};

/// Fields that the drive never reads. Floating point keeps their values.
inline std::vector<std::string_view> unused_fields(const sixstep::control::DriveConfig<double>& d) {
  std::vector<std::string_view> out;
  if (!sixstep::design::runs_current(d)) return out;
  const bool hysteresis = d.current_control == sixstep::control::CurrentControl::hysteresis;
  out.push_back(hysteresis ? "current." : "hysteresis.");
  return out;
}
inline std::vector<std::string_view> unused_fields(const sixstep::control::ProtectedConfig<double>& p) {
  std::vector<std::string_view> out;
  if (p.sensing != sixstep::control::CurrentSensing::one_shunt) out.push_back("shunt.");
  return out;
}
template <class Config>
std::vector<std::string_view> unused_fields(const Config&) {
  return {};
}

/// The assignments of a sensorless drive, without the assignments of its loops.
template <class Scalar>
std::string sensorless_lines(sixstep::control::Mode mode,
                             const sixstep::control::PulsedDriveConfig<double>& designed,
                             const sixstep::control::PulsedDriveConfig<Scalar>& kept,
                             const sixstep::design::Bases& bases) {
  ConfigText<Scalar> text(mode, bases);
  text.part("drive", designed.drive, kept.drive);
  text.part("drive.observer", designed.drive.observer, kept.drive.observer);
  text.part("pulses", designed.pulses, kept.pulses);
  return text.text();
}

/// Writes the drive or the product around it: `designed` in SI, `kept` in the target's arithmetic.
template <class Scalar, class Designed, class Kept>
std::string config_lines(sixstep::control::Mode mode, const Designed& designed, const Kept& kept,
                         const sixstep::design::Bases& bases) {
  ConfigText<Scalar> text(mode, bases, unused_fields(designed));
  sixstep::design::fields(text, designed, kept);
  return text.text();
}

}  // namespace text
