// SPDX-License-Identifier: Apache-2.0
// The scenario's circumstances in words: what stands around the motor.
#include <fmt/format.h>

#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/parameters.hpp"
#include "sixstep/study/scenario/at_description.hpp"
#include "sixstep/study/scenario/changes.hpp"

namespace report {
namespace {

using namespace sixstep;

std::string supply(const study::Supply& s) {
  const std::string volts = given(s.voltage_V, "V");
  if (s.capacitance_F == 0.0) return volts + ", stiff";
  return fmt::format("{} behind {} on {}{}", volts, given(s.resistance_ohm, "ohm"),
                     given(s.capacitance_F, "F"), s.sinks ? "" : ", takes no current back");
}

std::string bridge(const study::Bridge& b) {
  const bool ideal = b.on_resistance_ohm == 0.0 && b.diode_drop_V == 0.0 && b.diode_resistance_ohm == 0.0;
  std::string text = ideal ? "ideal switches and diodes"
                           : fmt::format("switches {}, diodes {} + {}", given(b.on_resistance_ohm, "ohm"),
                                         given(b.diode_drop_V, "V"), given(b.diode_resistance_ohm, "ohm"));
  if (b.dead_time_s > 0.0) text += ", dead time " + given(b.dead_time_s, "s");
  return text;
}

std::string pwm(const study::Pwm& p) {
  static constexpr const char* choppings[] = {"soft", "hard", "complementary"};
  return fmt::format(
      "{} ({}), {}-aligned, {} chopping", given(p.period_s, "s"), computed(1.0 / p.period_s, "Hz"),
      p.alignment == study::Alignment::edge ? "edge" : "centre", choppings[static_cast<int>(p.chopping)]);
}

std::string current_loop(const study::CurrentLoop& c) {
  if (c.type == study::CurrentLoopType::pi) return "current PI";
  return fmt::format("current hysteresis ±{}, {} comparator", given(c.band_A, "A"),
                     c.comparator == study::Comparator::event ? "event" : "sampled");
}

const char* arithmetic(study::Arithmetic a) {
  using study::Arithmetic;
  switch (a) {
    case Arithmetic::float64:
      return ", 64-bit float";
    case Arithmetic::float32:
      return ", 32-bit float";
    case Arithmetic::q15:
      return ", fixed point Q15";
    case Arithmetic::q14:
      return ", fixed point Q1.14";
    case Arithmetic::q31:
      return ", fixed point Q31";
    case Arithmetic::q30:
      return ", fixed point Q1.30";
  }
  return "";
}

std::string control(const study::Scenario& s) {
  std::string text;
  switch (s.control.mode) {
    case control::Mode::off:
      return "off";
    case control::Mode::duty:
      text = "duty";
      break;
    case control::Mode::current:
      text = current_loop(s.control.current);
      break;
    case control::Mode::speed:
      text = "speed PI → " + current_loop(s.control.current);
      break;
    case control::Mode::position:
      text = "position P → speed PI → " + current_loop(s.control.current);
      break;
  }
  text += arithmetic(s.control.arithmetic);
  if (s.pwm.delay_periods > 0) text += fmt::format(", acts {} period(s) later", s.pwm.delay_periods);
  return text;
}

std::string sensors(const study::Sensors& s) {
  using sixstep::rig::CurrentMeasurement;
  std::string text = s.currents == CurrentMeasurement::ideal    ? "ideal currents"
                     : s.currents == CurrentMeasurement::phases ? "phase currents"
                                                                : "one shunt in the DC link";
  if (s.currents != CurrentMeasurement::ideal)
    text += fmt::format(" through {} bits over ±{}", s.adc_bits, given(s.current_range_A.value_or(0.0), "A"));
  if (s.currents != CurrentMeasurement::ideal && s.current_noise_A > 0.0)
    text += ", noise " + given(s.current_noise_A, "A");
  if (s.bus == study::BusSensing::adc)
    text +=
        fmt::format("; bus through {} bits up to {}", s.adc_bits, given(s.bus_range_V.value_or(0.0), "V"));
  if (s.rotor == study::RotorSensing::hall)
    text += fmt::format("; speed from Hall edges against {}, over {}", given(s.capture_Hz, "Hz"),
                        s.speed_edges == 0   ? "six sectors, at low speed one"
                        : s.speed_edges == 1 ? "one sector"
                                             : fmt::format("{} sectors", s.speed_edges));
  if (s.hall_break.at_s)
    text += fmt::format("; line H{} breaks at {}", s.hall_break.line, given(*s.hall_break.at_s, "s"));
  return text;
}

bool all_ideal(const study::Sensors& s) {
  return s.currents == sixstep::rig::CurrentMeasurement::ideal && s.bus == study::BusSensing::ideal &&
         s.rotor == study::RotorSensing::ideal && !s.hall_break.at_s;
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
  if (p.off_at_s) text += ", let go at " + given(*p.off_at_s, "s");
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

std::string listed(const std::vector<double>& values, const char* unit) {
  std::string text;
  for (std::size_t n = 0; n < values.size() && n < 8; ++n)
    text += (n ? ", " : "steps ") + given(values[n], unit);
  return values.size() > 8 ? text + fmt::format(" … ({} in all)", values.size()) : text;
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
  static constexpr const char* units[] = {"", "", "A", "rad/s", "deg"};
  const auto unit = [](control::Mode mode) { return units[static_cast<int>(mode)]; };
  std::string text = reference(s.reference, unit(s.control.mode));
  const std::vector<control::Mode> modes = study::modes_from(s);
  for (std::size_t n = 0; n < s.at.size(); ++n)
    if (s.at[n].reference)
      text += fmt::format("; from {} on {}", given(s.at[n].time_s, "s"),
                          reference(*s.at[n].reference, unit(modes[n])));
  return text;
}

/// What of the controller an event changes, in a word or two each.
std::string tuned(const study::At& at) {
  std::string text;
  const auto add = [&text](bool changed, const std::string& words) {
    if (changed) text += (text.empty() ? "" : ", ") + words;
  };
  const study::AtControl& c = at.control;
  add(c.mode != study::AtMode::same, fmt::format("mode {}", base::word(study::at_mode_choices, c.mode)));
  add(!(c.current == study::AtCurrentLoop{}), "current controller");
  add(!(c.speed == study::AtSpeedLoop{}), "speed controller");
  add(!(c.position == study::AtPositionLoop{}), "position controller");
  add(!(c.limits == study::AtLimits{}), "limits");
  add(c.slew.has_value(), "slew");
  add(at.pwm.chopping != study::AtChopping::same,
      fmt::format("{} chopping", base::word(study::at_chopping_choices, at.pwm.chopping)));
  return text;
}

std::string events(const std::vector<study::At>& events) {
  std::string text;
  for (const study::At& at : events) {
    std::string what;
    const auto add = [&what](const std::string& words) { what += (what.empty() ? "" : ", ") + words; };
    if (at.supply.voltage_V) add("supply " + given(*at.supply.voltage_V, "V"));
    if (at.supply.sinks) add(*at.supply.sinks ? "supply takes current back" : "supply takes none back");
    if (at.load.torque_Nm) add("load " + given(*at.load.torque_Nm, "Nm"));
    if (at.load.locked) add(*at.load.locked ? "rotor clamped" : "rotor let go");
    if (at.sensors.hall_break) add(fmt::format("line H{} breaks", at.sensors.hall_break->line));
    if (at.bridge.dead_time_s) add("dead time " + given(*at.bridge.dead_time_s, "s"));
    if (const std::string words = tuned(at); !words.empty()) add(words);
    if (at.request == study::DriveRequest::on) add("asked to run");
    if (at.request == study::DriveRequest::off) add("let go");
    if (at.request == study::DriveRequest::clear) add("fault cleared");
    if (!what.empty()) text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", given(at.time_s, "s"), what);
  }
  return text;
}

std::string shaft(const study::Load& load) {
  if (load.locked) return "locked";
  std::string text = "free";
  if (load.torque_Nm != 0.0) text += ", load " + given(load.torque_Nm, "Nm");
  if (!load.torques_Nm.empty()) text += fmt::format(", {} load steps", load.torques_Nm.size());
  if (load.inertia_kg_m2 != 0.0) text += ", load inertia " + given(load.inertia_kg_m2, "kg m2");
  return text;
}

}  // namespace

std::string setup_section(const study::Scenario& s) {
  std::string html;
  const auto add = [&](const char* name, const std::string& text) {
    html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, escaped(text));
  };
  const bool at_edge = s.pwm.commutation == study::CommutationAt::hall_edge;
  add("Supply", supply(s.supply));
  add("Bridge", bridge(s.bridge));
  add("PWM", pwm(s.pwm));
  add("Control", control(s));
  if (!all_ideal(s.sensors)) add("Sensors", sensors(s.sensors));
  if (s.control.drive == study::FirmwareKind::product) add("Product drive", protection(s.protection));
  if (s.control.mode != control::Mode::off) add("Reference", reference(s));
  add("Commutation", at_edge ? "at the Hall edge" : "at the next sample");
  add("Shaft", shaft(s.load));
  if (const std::string text = events(s.at); !text.empty()) add("During the run", text);
  return html;
}

}  // namespace report
