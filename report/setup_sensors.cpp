// SPDX-License-Identifier: Apache-2.0
// Describes a board's sensors.
#include <fmt/format.h>

#include "report/figures.hpp"
#include "report/setup_words.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"
#include "text/results/shaft_sensor_words.hpp"

namespace report {

using namespace sixstep;

namespace {

std::string shaft_sensor(const study::Sensors& s) {
  std::string words = text::shaft_sensor_words(s, text::SensorWordsOf::page, given);
  if (words.empty()) return words;
  return "; " + words + (s.shaft == study::SensorShaft::motor ? "" : ", on the load's shaft");
}

/// The dividers and comparators at the terminals.
std::string terminals(const study::Sensors& s) {
  std::string text;
  if (!s.terminal_gain_error.empty())
    text += fmt::format("; relative gain errors of the dividers a, b, c {:.4g}",
                        fmt::join(s.terminal_gain_error, ", "));
  const study::Comparators& c = s.comparators;
  if (c == study::Comparators{}) return text;
  text += fmt::format("; comparators against {}, filtered at {}",
                      c.against == rig::CrossingReference::half_bus ? "half the bus" : "the virtual star",
                      given(c.bandwidth_Hz.value_or(0.0), "Hz"));
  if (!c.offset_V.empty()) text += fmt::format(", offsets {:.4g} V", fmt::join(c.offset_V, ", "));
  if (c.hysteresis_V > 0.0) text += ", hysteresis " + given(c.hysteresis_V, "V");
  return text;
}

/// The deviations of the Hall probes from their sectors.
std::string probes(const study::Sensors& s) {
  std::string text;
  if (s.hall_spacing != sixstep::control::HallArrangement::degrees_120) text += "; Hall probes 60° apart";
  if (s.hall_offset_deg != 0) text += "; Hall edges late by " + given(s.hall_offset_deg, "deg");
  if (!s.hall_edges_deg.empty()) text += "; each additionally by " + listed(s.hall_edges_deg, "deg");
  if (s.hall_hysteresis_deg > 0) text += "; Hall hysteresis " + given(s.hall_hysteresis_deg, "deg");
  if (s.hall_delay_s > 0) text += "; Hall lines late by " + given(s.hall_delay_s, "s");
  if (s.hall_glitches_Hz > 0)
    text += fmt::format("; {} glitches of {} each second", s.hall_glitches_Hz, given(s.hall_glitch_s, "s"));
  return text;
}

}  // namespace

std::string sensors(const study::Sensors& s) {
  using sixstep::rig::CurrentMeasurement;
  std::string text = s.currents == CurrentMeasurement::ideal    ? "ideal currents"
                     : s.currents == CurrentMeasurement::phases ? "phase currents"
                     : s.currents == CurrentMeasurement::dc_link
                         ? "one shunt in the DC link"
                         : fmt::format("low-side shunts {}", base::word(study::shunt_choices, s.shunts));
  if (s.currents != CurrentMeasurement::ideal)
    text += fmt::format(" through {} bits over ±{}", s.adc_bits, given(s.current_range_A.value_or(0.0), "A"));
  if (s.currents == CurrentMeasurement::dc_link || s.currents == CurrentMeasurement::low_side)
    text += ", settled after " + given(s.shunt_settle_s, "s");
  if (s.currents != CurrentMeasurement::ideal && s.current_noise_A > 0.0)
    text += ", noise " + given(s.current_noise_A, "A");
  if (s.currents != CurrentMeasurement::ideal && s.current_bandwidth_Hz)
    text += ", amplifiers of " + given(*s.current_bandwidth_Hz, "Hz");
  if (s.currents != CurrentMeasurement::ideal && s.current_delay_s > 0.0)
    text += ", late by " + given(s.current_delay_s, "s");
  if (s.bus == study::BusSensing::adc)
    text +=
        fmt::format("; bus through {} bits up to {}", s.adc_bits, given(s.bus_range_V.value_or(0.0), "V"));
  if (s.bus_bandwidth_Hz) text += "; dividers filtered at " + given(*s.bus_bandwidth_Hz, "Hz");
  text += terminals(s);
  if (s.rotor == study::RotorSensing::hall)
    text += fmt::format("; speed: Hall edges timed at {}, {}", given(s.capture_Hz, "Hz"),
                        s.speed_edges == 0   ? "mean of six sectors, at low speed one sector"
                        : s.speed_edges == 1 ? "one sector"
                                             : fmt::format("mean of {} sectors", s.speed_edges));
  if (s.rotor == study::RotorSensing::hall && s.hall_angle != rig::HallAngleFrom::sectors)
    text += fmt::format(", {}", base::word(study::hall_angle_choices, s.hall_angle));
  if (s.hall_lines != rig::WireOrder::abc)
    text += fmt::format("; probes {} at H1, H2, H3", base::word(study::hall_order_choices, s.hall_lines));
  if (s.hall_inverted != study::HallLines::none)
    text +=
        fmt::format("; inverted Hall lines: {}", base::word(study::hall_inverted_choices, s.hall_inverted));
  text += shaft_sensor(s) + probes(s);
  if (s.hall_break.at_s)
    text += fmt::format("; line H{} reads {} from {} on", s.hall_break.line,
                        base::word(study::level_choices, s.hall_break.level), given(*s.hall_break.at_s, "s"));
  return text;
}

bool all_ideal(const study::Sensors& s) {
  return s.currents == sixstep::rig::CurrentMeasurement::ideal && s.bus == study::BusSensing::ideal &&
         s.rotor == study::RotorSensing::ideal && !s.bus_bandwidth_Hz && !s.hall_break.at_s &&
         terminals(s).empty() && s.hall_lines == rig::WireOrder::abc &&
         s.hall_inverted == study::HallLines::none && probes(s).empty();
}

}  // namespace report
