// SPDX-License-Identifier: Apache-2.0
#include "text/export/clearance_lines.hpp"

#include <fmt/format.h>

#include "sixstep/base/written.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"
#include "text/escape/escape.hpp"

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

/// "; offset 0.1 A": what is not there is not told.
std::string flaw(std::string_view name, double x, std::string_view unit) {
  return x != 0 ? fmt::format("; {} {:.6g}{}{}", name, x, unit.empty() ? "" : " ", unit) : "";
}

std::string source(const study::Supply& s) {
  std::string text = fmt::format("{:.6g} V", s.voltage_V);
  text += s.capacitance_F > 0
              ? fmt::format(" behind {:.6g} ohm, {:.6g} F at the bridge", s.resistance_ohm, s.capacitance_F)
              : ", stiff";
  return text + (s.sinks ? ", takes current back" : ", takes no current back");
}

std::string bridge(const study::Scenario& s) {
  return fmt::format("switches of {:.6g} ohm, diodes of {:.6g} V and {:.6g} ohm, dead time {:.6g} s",
                     s.bridge.on_resistance_ohm, s.bridge.diode_drop_V, s.bridge.diode_resistance_ohm,
                     s.bridge.dead_time_s);
}

std::string timing(const study::Pwm& p) {
  std::string text = p.sample == study::SampleAt::middle ? "sampled in the middle of a period"
                                                         : "sampled at a period's start";
  text += p.delay_periods > 0 ? ", answered one period later" : "";
  if (p.delay_periods == 0)
    text += p.sample == study::SampleAt::middle ? ", answered at the next one's start" : ", answered at once";
  text += p.timer_Hz > 0 ? fmt::format("; edges on counts of {:.6g} Hz", p.timer_Hz)
                         : "; edges on no counter's steps";
  return text +
         (p.minimum_pulse_s > 0 ? fmt::format("; no pulse or gap below {:.6g} s", p.minimum_pulse_s) : "");
}

std::string currents(const study::Sensors& s) {
  if (s.currents == sixstep::rig::CurrentMeasurement::ideal) return "as they are";
  return fmt::format("{}, {} bits over +-{:.6g} A",
                     sixstep::base::word(study::current_sensing_choices, s.currents), s.adc_bits,
                     s.current_range_A.value_or(0.0)) +
         flaw("offset", s.current_offset_A, "A") + flaw("gain error", s.current_gain_error, "") +
         flaw("noise", s.current_noise_A, "A rms");
}

std::string bus(const study::Sensors& s) {
  if (s.bus == study::BusSensing::ideal) return "as it is";
  return fmt::format("{} bits over {:.6g} V", s.adc_bits, s.bus_range_V.value_or(0.0)) +
         flaw("offset", s.bus_offset_V, "V") + flaw("gain error", s.bus_gain_error, "") +
         flaw("noise", s.bus_noise_V, "V rms");
}

std::string rotor(const study::Sensors& s) {
  if (s.rotor == study::RotorSensing::ideal) return "as it is";
  const std::string over = s.speed_edges > 0
                               ? fmt::format("speed over {} edges", s.speed_edges)
                               : "speed over six edges where the loop stands their delay, else one";
  return fmt::format("Hall edges exactly at the sectors' ends, captured at {:.6g} Hz, {}", s.capture_Hz,
                     over);
}

std::string load(const study::Load& l) {
  if (l.locked) return "rotor held";
  std::string text = fmt::format("{:.6g} N m, {:.6g} kg m2 beside the rotor's", l.torque_Nm, l.inertia_kg_m2);
  return text + flaw("friction", l.coulomb_Nm, "N m") + flaw("viscous friction", l.viscous_Nm_s, "N m s") +
         (l.times_s.empty() ? "" : "; steps of torque");
}

/// What a board may have otherwise: then this run says nothing of it.
std::string assumptions(const ClearanceText& t) {
  const study::Scenario& s = t.scenario;
  std::string text = "// That run took for granted:\n";
  text += entry("supply", source(s.supply)) + entry("bridge", bridge(s)) + entry("timing", timing(s.pwm));
  text += entry("currents", currents(s.sensors)) + entry("bus", bus(s.sensors)) +
          entry("rotor", rotor(s.sensors)) + entry("load", load(s.load));
  if (t.other_scale) text += entry("scale", "the scenario's own; that of --range below was proved, not run");
  return text;
}

}  // namespace

std::string clearance_lines(const ClearanceText& t) {
  if (!t.clearance) return line("NOT CLEARED FOR A BRIDGE: no run stands behind these constants.");
  const study::Clearance& c = *t.clearance;
  std::string text;
  if (!c.clear()) {
    text += "// NOT CLEARED FOR A BRIDGE. Written all the same, for this reason:\n";
    text += fmt::format("//   {}\n// What was overridden:\n", comment_text(t.despite));
    for (const base::Problems* problems : {&c.unmeasured, &c.unheld})
      for (const base::Problem& p : *problems) text += fmt::format("//   {}\n", comment_text(to_string(p)));
  }
  text += line(fmt::format("{} {:.6g} s simulated in {}, digest {}",
                           c.clear() ? "Cleared by its run:" : "Its run:", c.outcome.simulated_s,
                           sixstep::base::word(study::arithmetic_choices, t.scenario.control.arithmetic),
                           sixstep::base::written_hex(c.outcome.digest)));
  for (const study::Verdict& v : c.outcome.verdicts)
    if (v.ok) text += fmt::format("//   {}\n", comment_text(verdict(v)));
  return text + assumptions(t);
}

}  // namespace text
