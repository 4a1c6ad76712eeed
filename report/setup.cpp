// SPDX-License-Identifier: Apache-2.0
// Describes in sentences the parts of a drive and its surroundings.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <type_traits>

#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/parameters.hpp"
#include "report/setup_words.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/field_description.hpp"
#include "sixstep/study/scenario/in_arithmetic.hpp"
#include "sixstep/study/scenario/sensorless_description.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"
#include "text/scenario/motion_words.hpp"

namespace report {

using namespace sixstep;

std::string listed(const std::vector<double>& values, const char* unit) {
  std::string text;
  for (std::size_t n = 0; n < values.size() && n < 8; ++n)
    text += (n ? ", " : "steps ") + given(values[n], unit);
  return values.size() > 8 ? text + fmt::format(" … ({} in all)", values.size()) : text;
}

namespace {

/// The chopping in words: "soft chopping", and the chopped switch if it is not always the upper switch.
std::string chopping_words(const study::Pwm& p) {
  std::string words = std::string(sixstep::base::word(study::chopping_choices, p.chopping)) + " chopping";
  if (p.pattern != sixstep::control::PwmPattern::upper)
    words += ", pattern " + std::string(sixstep::base::word(study::pattern_choices, p.pattern));
  return words;
}

std::string pwm(const study::Scenario& scenario) {
  const study::Pwm& p = scenario.pwm;
  const study::FirmwareKind drive = scenario.control.drive;
  const std::string answers = drive == study::FirmwareKind::field ? "three legs, each complementary"
                              : study::answers_legs(scenario.control.own)
                                  ? "three legs, as the controller commands"
                              : drive == study::FirmwareKind::own ? "chopping as the controller commands"
                                                                  : "";
  return fmt::format("{} ({}), {}-aligned, {}", given(p.period_s, "s"), computed(1.0 / p.period_s, "Hz"),
                     p.alignment == study::Alignment::edge ? "edge" : "centre",
                     !answers.empty() ? answers : chopping_words(p));
}

bool chooses_legs(const study::Control& c) {
  return c.drive == study::FirmwareKind::field && c.field.law == study::FieldLaw::finite_set;
}

/// The switching rule that replaces a PWM. Empty if the drive has a PWM in any mode of the run.
std::string switching(const study::Scenario& s) {
  if (s.control.mode < control::Mode::current || study::comes_into(s, control::Mode::duty)) return "";
  const std::string tick = given(s.pwm.period_s, "s") + " (" + computed(1.0 / s.pwm.period_s, "Hz") + ")";
  if (chooses_legs(s.control)) return "one state of the three legs for each control period of " + tick;
  if (s.control.current.type != study::CurrentLoopType::hysteresis) return "";
  return (s.control.current.comparator == study::Comparator::event
              ? "comparators switch when the current leaves the band, no PWM; control tick of "
              : "each control tick compares the current with the band, no PWM; control tick of ") +
         tick + ", " + chopping_words(s.pwm);
}

std::string current_loop_words(const study::CurrentLoop& c) {
  if (c.type == study::CurrentLoopType::hysteresis)
    return fmt::format("current hysteresis ±{}, {} comparator", given(c.band_A, "A"),
                       c.comparator == study::Comparator::event ? "event" : "sampled");
  const bool staying = c.feedback == study::CurrentFeedback::staying_phase;
  return std::string(c.type == study::CurrentLoopType::pi ? "current PI" : "deadbeat current") +
         (staying ? " on the staying phase" : "") +
         std::array{"", ", duty step at commutation",
                    ", overlapping at commutation"}[static_cast<std::size_t>(c.commutation)];
}

/// The speed loop and its output.
std::string speed_loop_words(const study::Control& c) {
  static constexpr const char* laws[] = {"speed PI", "speed by state feedback",
                                         "speed by disturbance rejection", "speed by sliding mode"};
  const std::string law = laws[static_cast<int>(c.speed.law)];
  return law + " → " +
         (c.speed.output == study::SpeedOutput::duty ? "duty"
          : chooses_legs(c)                          ? "current by a finite set of states"
                                                     : current_loop_words(c.current));
}

/// The arithmetic in words: ", fixed point Q1.14" with the digits before and after the point.
std::string arithmetic(study::Arithmetic a) {
  return study::in_arithmetic(a, []<class Scalar>() -> std::string {
    if constexpr (std::is_floating_point_v<Scalar>) {
      return fmt::format(", {}-bit float", 8 * sizeof(Scalar));
    } else {
      constexpr int whole = static_cast<int>(8 * sizeof(Scalar)) - 1 - Scalar::fraction_bits;
      return fmt::format(", fixed point Q{}{}", whole > 0 ? fmt::format("{}.", whole) : "",
                         Scalar::fraction_bits);
    }
  });
}

/// A user's controller: its name, the controlled quantity, and the numbers that are not presets.
std::string own_controller(const study::Scenario& s) {
  const study::Own& own = s.control.own;
  std::string text = fmt::format("{} ({}), {}", own.loaded ? own.loaded->name : "own", own.controller,
                                 base::word(study::mode_choices, s.control.mode));
  for (const study::OwnNumber& number : own.number)
    text += fmt::format(", {} = {}", number.name, given(number.value, ""));
  return text;
}

/// The quantities that the library's loops control.
std::string control(const study::Scenario& s) {
  std::string text;
  switch (s.control.mode) {
    case control::Mode::off:
      return "off";
    case control::Mode::duty:
      text = "duty";
      break;
    case control::Mode::current:
      text = chooses_legs(s.control) ? "current by a finite set of states"
                                     : current_loop_words(s.control.current);
      break;
    case control::Mode::speed:
      text = speed_loop_words(s.control);
      break;
    case control::Mode::position:
      text = "position P → " + speed_loop_words(s.control);
      break;
  }
  if (s.control.drive == study::FirmwareKind::own) text = own_controller(s);
  text += arithmetic(s.control.arithmetic);
  if (s.pwm.delay_periods > 0) text += fmt::format(", acts {} period(s) later", s.pwm.delay_periods);
  return text;
}

std::string protection(const study::Protection& p) {
  std::string text = fmt::format(
      "trips above {}, above {} and below {}, above {}", given(p.over_current_A.value_or(0.0), "A"),
      given(p.over_voltage_V.value_or(0.0), "V"), given(p.under_voltage_V.value_or(0.0), "V"),
      given(p.over_speed_rad_s.value_or(0.0), "rad/s"));
  if (p.stall_s && p.stall_current_A)
    text +=
        fmt::format(", after {} of stall above {}", given(*p.stall_s, "s"), given(*p.stall_current_A, "A"));
  if (p.align.current_A) text += ", aligned by " + given(*p.align.current_A, "A");
  if (p.off_at_s) text += ", request to run removed at " + given(*p.off_at_s, "s");
  return text;
}

std::string sensorless(const study::Sensorless& x) {
  std::string text = fmt::format(
      "starts against up to {} of the nominal torque with {} times the nominal current; commutated by the back-EMF from {} of the no-load speed on, by {}",
      computed(100 * x.greatest_load, "%"), x.overload, computed(100 * x.lowest_part, "%"),
      std::ranges::find(study::follow_choices, x.follows, &base::Choice<control::Follow>::value)->meaning);
  if (x.commutates == study::Commutates::hall) text += ", commutated by its Hall probes while they work";
  if (x.advance_deg > 0) text += ", commutated " + given(x.advance_deg, "deg") + " ahead";
  if (x.starts_by == study::StartsBy::pulses)
    text += "; pulses find the angle of a rotor at rest; if they cannot, the rotor is aligned";
  if (!x.catches_spin) text += "; a start does not detect a rotor that already turns";
  return text;
}

std::string finite_set(const study::Field& x) {
  std::string text =
      "currents along and across the magnet are controlled by the leg state whose predicted current is nearest";
  if (x.switching_weight_A > 0)
    text += "; each switching leg counts as a current error of " + given(x.switching_weight_A, "A");
  if (x.peak_A) text += "; at most " + given(*x.peak_A, "A");
  if (!x.delay_compensation) text += "; the command's delay is not compensated";
  if (x.harmonic_current) text += "; the current follows the shape of the back-EMF";
  return text;
}

std::string field(const study::Field& x) {
  if (x.law == study::FieldLaw::finite_set) return finite_set(x);
  std::string text = "currents are controlled along and across the magnet";
  if (x.bandwidth_Hz) text += " to " + given(*x.bandwidth_Hz, "Hz");
  text += x.decoupling ? ", decoupled" : ", not decoupled";
  text += x.voltage_limit == control::VoltageLimit::circle ? "; voltages within the circle"
                                                           : "; each axis within half the bus";
  if (x.weakening_A) text += "; field weakening up to " + given(*x.weakening_A, "A");
  if (x.angle != study::FieldAngle::sensors)
    text += fmt::format("; the magnet's angle by {}", base::word(study::field_angle_choices, x.angle));
  if (x.advance_periods)
    text += fmt::format("; the commanded voltage is rotated ahead by {} periods", *x.advance_periods);
  if (x.harmonic_current) text += "; the current follows the shape of the back-EMF";
  return text;
}

std::string move(const study::Reference& r, const char* unit) {
  const std::string way =
      fmt::format("{}to {}", r.start ? "from " + given(*r.start, unit) + " " : "", given(r.end, unit));
  const std::string rate = fmt::format("{}/s", unit);
  if (r.shape == study::Shape::trapezoid)
    return fmt::format("trapezoid {}, at most {}, {}", way, given(r.slope.value_or(0.0), rate),
                       given(r.acceleration.value_or(0.0), rate + "2"));
  return r.end_s ? fmt::format("ramp {} until {}", way, given(*r.end_s, "s"))
                 : fmt::format("ramp {} at {}", way, given(r.slope.value_or(0.0), rate));
}

std::string reference(const study::Reference& r, const char* unit) {
  switch (r.shape) {
    case study::Shape::constant:
      return given(r.value, unit);
    case study::Shape::square:
      return fmt::format("square, {} and {} at {}", given(r.high, unit), given(r.low, unit),
                         given(1.0 / r.period_s, "Hz"));
    case study::Shape::ramp:
    case study::Shape::trapezoid:
      return move(r, unit);
    case study::Shape::sine:
      return fmt::format("sine, {} ± {} at {}", given(r.offset, unit), given(r.amplitude, unit),
                         given(r.frequency_Hz, "Hz"));
    case study::Shape::csv:
      return fmt::format("{} rows of {}", r.values.size(), r.file.empty() ? "the scenario" : r.file);
    case study::Shape::steps:
      break;
  }
  return listed(r.values, unit);
}

std::string reference(const study::Scenario& s) {
  static constexpr const char *units[] = {"", "", "A", "rad/s", "deg"},
                              *moving[] = {"", "", "A", "m/s", "mm"};
  const bool linear = s.sheet.kind == sixstep::design::MotorKind::linear;
  const auto unit = [linear](control::Mode mode) {
    return (linear ? moving : units)[static_cast<int>(mode)];
  };
  std::string text = reference(s.reference, unit(s.control.mode));
  const std::vector<control::Mode> modes = study::modes_from(s);
  for (std::size_t n = 0; n < s.at.size(); ++n)
    if (s.at[n].reference)
      text += fmt::format("; from {} on {}", given(s.at[n].time_s, "s"),
                          reference(*s.at[n].reference, unit(modes[n])));
  return text;
}

/// The set-up in sentences, one for each part of the drive.
std::string sentences(const study::Scenario& scenario) {
  study::Scenario s = scenario;
  text::in_units_of_its_motor(s);
  std::string html;
  const auto add = [&](const char* name, const std::string& text) {
    html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, escaped(text));
  };
  const bool at_edge = s.pwm.commutation == study::CommutationAt::hall_edge;
  add("Supply", supply(s.supply));
  add("Bridge", bridge(s.bridge));
  const std::string no_pwm = switching(s);
  add(no_pwm.empty() ? "PWM" : "Switching", no_pwm.empty() ? pwm(s) : no_pwm);
  add("Control", control(s));
  if (!all_ideal(s.sensors)) add("Sensors", sensors(s.sensors));
  if (s.control.drive == study::FirmwareKind::product) add("Product drive", protection(s.protection));
  if (s.control.drive == study::FirmwareKind::sensorless)
    add("Sensorless drive", sensorless(s.control.sensorless));
  if (s.control.drive == study::FirmwareKind::field) add("Field-oriented drive", field(s.control.field));
  if (s.control.mode != control::Mode::off) add("Reference", reference(s));
  if (s.control.drive != study::FirmwareKind::field)
    add("Commutation", s.control.drive == study::FirmwareKind::sensorless
                           ? "at the zero crossings that the drive finds, or at its estimated angle"
                       : at_edge ? "at the Hall edge"
                                 : "at the next sample");
  const bool linear = s.sheet.kind == sixstep::design::MotorKind::linear;
  add(linear ? "Slide" : "Shaft", shaft(s.load, linear));
  if (const std::string text = heat(s.heat); !text.empty()) add("Heat", text);
  if (const std::string text = events(s.at, linear); !text.empty()) add("During the run", text);
  return html;
}

}  // namespace

std::string setup_section(const study::Scenario& scenario) {
  std::string rest;
  for (const auto& [key, value] : other_keys(scenario, sentences))
    rest += fmt::format("{}{}", rest.empty() ? "" : "<br>", escaped(fmt::format("{} = {}", key, value)));
  return sentences(scenario) + (rest.empty() ? "" : "<div><dt>Other keys</dt><dd>" + rest + "</dd></div>\n");
}

}  // namespace report
