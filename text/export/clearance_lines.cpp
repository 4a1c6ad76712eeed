// SPDX-License-Identifier: Apache-2.0
#include "text/export/clearance_lines.hpp"

#include <fmt/format.h>

#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/thermal.hpp"
#include "sixstep/study/check/pace.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"
#include "text/escape/escape.hpp"
#include "text/results/shaft_sensor_words.hpp"
#include "text/results/source_words.hpp"

namespace text {
namespace {

std::string line(std::string_view text) { return fmt::format("// {}\n", comment_text(text)); }

std::string entry(std::string_view label, std::string_view text) {
  return fmt::format("//   {:<10}{}\n", label, comment_text(text));
}

std::string verdict(const study::Verdict& v) {
  const std::string unit = v.unit.empty() ? "" : " " + v.unit;
  std::string required;
  if (v.min && v.max)
    required = fmt::format("{:.6g} .. {:.6g}{}", *v.min, *v.max, unit);
  else if (v.min || v.max)
    required = fmt::format("{} {:.6g}{}", v.min ? ">=" : "<=", v.min ? *v.min : *v.max, unit);
  return fmt::format("{}: {} required, {:.6g}{} measured", v.figure, required, v.measured, unit);
}

/// Text about one sensor error or one property of the load, such as "; offset 0.1 A". Empty if the value is
/// 0.
std::string flaw(std::string_view name, double x, std::string_view unit) {
  return x != 0 ? fmt::format("; {} {:.6g}{}{}", name, x, unit.empty() ? "" : " ", unit) : "";
}

std::string plain(double x, std::string_view unit) { return fmt::format("{:.6g} {}", x, unit); }

std::string supply(const study::Supply& s) {
  std::string text = source_words(s, plain);
  text += s.capacitance_F > 0
              ? fmt::format(" behind {:.6g} ohm, {:.6g} F at the bridge", s.resistance_ohm, s.capacitance_F)
              : ", stiff";
  text += s.sinks ? ", takes current back" : ", takes no current back";
  text += flaw("up to", s.sink_limit_A, "A") + flaw("inductance", s.inductance_H, "H") +
          flaw("capacitor's resistance", s.capacitor_resistance_ohm, "ohm");
  if (s.brake_resistance_ohm > 0)
    text += fmt::format("; brake resistor {:.6g} ohm from {:.6g} V until {:.6g} V", s.brake_resistance_ohm,
                        s.brake_on_V, s.brake_off_V);
  return text;
}

std::string bridge(const study::Scenario& s) {
  const std::string drop = s.bridge.device == study::Device::igbt
                               ? fmt::format("IGBTs of {:.6g} V and", s.bridge.saturation_V)
                               : "switches of";
  return fmt::format("{} {:.6g} ohm, diodes of {:.6g} V and {:.6g} ohm, dead time {:.6g} s", drop,
                     s.bridge.on_resistance_ohm, s.bridge.diode_drop_V, s.bridge.diode_resistance_ohm,
                     study::dead_time_in_counts_s(s.bridge.dead_time_s, s.pwm));
}

std::string timing(const study::Pwm& p) {
  std::string text = p.sample == study::SampleAt::middle ? "sampled in the middle of a period"
                                                         : "sampled at a period's start";
  text += p.delay_periods > 0 ? ", answered one period later" : "";
  if (p.delay_periods == 0)
    text += p.sample == study::SampleAt::middle ? ", answered at the next start" : ", answered at once";
  text += p.timer_Hz > 0 ? fmt::format("; PWM edges rounded to counts of a {:.6g} Hz timer", p.timer_Hz)
                         : "; PWM edges not rounded to timer counts";
  return text +
         (p.minimum_pulse_s > 0 ? fmt::format("; no pulse or gap below {:.6g} s", p.minimum_pulse_s) : "");
}

std::string currents(const study::Sensors& s) {
  if (s.currents == sixstep::rig::CurrentMeasurement::ideal) return "as they are";
  return fmt::format("{}, {} bits over +-{:.6g} A",
                     sixstep::base::word(study::current_sensing_choices, s.currents), s.adc_bits,
                     s.current_range_A.value_or(0.0)) +
         flaw("offset", s.current_offset_A, "A") + flaw("gain error", s.current_gain_error, "") +
         flaw("noise", s.current_noise_A, "A rms") +
         flaw("bandwidth", s.current_bandwidth_Hz.value_or(0.0), "Hz") +
         flaw("delay", s.current_delay_s, "s");
}

std::string bus(const study::Sensors& s) {
  if (s.bus == study::BusSensing::ideal) return "as it is";
  return fmt::format("{} bits over {:.6g} V", s.adc_bits, s.bus_range_V.value_or(0.0)) +
         flaw("offset", s.bus_offset_V, "V") + flaw("gain error", s.bus_gain_error, "") +
         flaw("noise", s.bus_noise_V, "V rms") + flaw("bandwidth", s.bus_bandwidth_Hz.value_or(0.0), "Hz");
}

std::string rotor(const study::Sensors& s) {
  using study::RotorSensing;
  if (s.rotor == RotorSensing::ideal) return "as it is";
  if (s.rotor != RotorSensing::hall) return shaft_sensor_words(s, SensorWordsOf::header, plain);
  const std::string over = s.speed_edges > 0
                               ? fmt::format("speed over {} edges", s.speed_edges)
                               : "speed over six edges if the loop tolerates their delay, else over one edge";
  const bool in_place = s.hall_offset_deg == 0 && s.hall_edges_deg.empty() && s.hall_hysteresis_deg == 0 &&
                        s.hall_delay_s == 0 && s.hall_glitches_Hz == 0;
  const bool runs_on = s.hall_angle != sixstep::rig::HallAngleFrom::sectors;
  return fmt::format(
      "Hall probes {} degrees apart, edges {}, captured at {:.6g} Hz, {}{}",
      sixstep::base::word(study::hall_spacing_choices, s.hall_spacing),
      in_place
          ? "exactly at the sector edges (real probes are not; sheet_tolerances of a plan moves each edge by up to 3 deg)"
          : "displaced as [sensors] states",
      s.capture_Hz, over, runs_on ? ", angle interpolated between edges" : "");
}

/// The wiring in words: phases at legs a b c, probes at pins H1 H2 H3.
std::string wires(const study::Scenario& s) {
  std::string text = fmt::format("phases {} at legs a b c, Hall lines {} at H1 H2 H3",
                                 sixstep::base::word(study::phase_order_choices, s.bridge.phases),
                                 sixstep::base::word(study::hall_order_choices, s.sensors.hall_lines));
  return text + (s.sensors.hall_inverted != study::HallLines::none ? ", some of them inverted" : "");
}

std::string load(const study::Load& l) {
  if (l.locked) return "rotor held";
  std::string text = fmt::format("{:.6g} N m, {:.6g} kg m2 beside the rotor's", l.torque_Nm, l.inertia_kg_m2);
  if (l.gear != 1) text += fmt::format("; behind a gear of {:.6g}", l.gear);
  if (l.gear_efficiency < 1) text += fmt::format(" with an efficiency of {:.6g}", l.gear_efficiency);
  if (!l.at_speeds_Nm.empty()) text += fmt::format("; torque over speed in {} points", l.at_speeds_Nm.size());
  if (!l.dynamometer_rad_s.empty()) text += "; turned by a dynamometer";
  text += flaw("elastic shaft", l.stiffness_Nm_rad, "N m/rad") +
          flaw("fan", study::square_law(l).Nm_s2, "N m s2") + flaw("weight", l.gravity_Nm, "N m");
  return text + flaw("friction", l.coulomb_Nm, "N m") + flaw("viscous friction", l.viscous_Nm_s, "N m s") +
         (l.times_s.empty() ? "" : "; steps of torque");
}

std::string heat(const study::Heat& h) {
  if (!h.motor)
    return fmt::format("winding and magnets constant at {:.6g} degC", sixstep::design::sheet_degC);
  return fmt::format("winding from {:.6g} degC, housing from {:.6g} degC, air of {:.6g} degC",
                     h.winding_degC.value_or(h.ambient_degC), h.housing_degC.value_or(h.ambient_degC),
                     h.ambient_degC);
}

/// The assumptions of the run. The run proves nothing for a board that differs from these assumptions.
std::string assumptions(const ClearanceText& t) {
  const study::Scenario& s = t.scenario;
  std::string text = "// Assumptions of that run:\n";
  text += entry("supply", supply(s.supply)) + entry("bridge", bridge(s)) + entry("timing", timing(s.pwm));
  text += entry("currents", currents(s.sensors)) + entry("bus", bus(s.sensors)) +
          entry("rotor", rotor(s.sensors)) + entry("wires", wires(s)) + entry("load", load(s.load)) +
          entry("heat", heat(s.heat));
  if (t.other_scale)
    text += entry(
        "scale", "the run used the scenario's full scales; the larger range below was proved, not simulated");
  return text;
}

}  // namespace

std::string clearance_lines(const ClearanceText& t) {
  if (!t.clearance) return line("NOT CLEARED FOR A BRIDGE: no run has checked these constants.");
  const study::Clearance& c = *t.clearance;
  std::string text;
  if (!c.clear()) {
    text += "// NOT CLEARED FOR A BRIDGE. The header was written anyway, for this reason:\n";
    text += fmt::format("//   {}\n// This reason overrides these findings:\n", comment_text(t.despite));
    for (const base::Problems* problems : {&c.unmeasured, &c.unheld})
      for (const base::Problem& p : *problems) text += fmt::format("//   {}\n", comment_text(to_string(p)));
  }
  text += line(fmt::format("{} {:.6g} s simulated in {}, digest {}",
                           c.clear() ? "Cleared by its run:" : "Its run:", c.outcome.simulated_s,
                           sixstep::base::word(study::arithmetic_choices, t.scenario.control.arithmetic),
                           sixstep::base::written_hex(c.outcome.digest)));
  for (const study::Verdict& v : c.outcome.verdicts)
    if (v.ok) text += fmt::format("//   {}\n", comment_text(verdict(v)));
  if (!c.outcome.remarks.empty()) text += line("Warnings of that run:");
  for (const std::string& remark : c.outcome.remarks) text += fmt::format("//   {}\n", comment_text(remark));
  for (const std::string& note : c.notes) text += line("Note: " + note);
  return text + assumptions(t);
}

}  // namespace text
