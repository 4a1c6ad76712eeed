// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "report/figures.hpp"
#include "report/setup_words.hpp"
#include "sixstep/study/scenario/at_description.hpp"

namespace report {

using namespace sixstep;

namespace {

/// The controller settings that an event changes, each in one or two words.
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

/// Events in wires, amplifiers and dividers: wires change, amplifiers drift, dividers break.
template <class Add>
void add_wires(const study::At& at, const Add& add) {
  const study::AtSensors& s = at.sensors;
  if (at.bridge.phases != study::AtOrder::same)
    add(fmt::format("phases {} at legs a, b, c",
                    base::word(study::at_phase_order_choices, at.bridge.phases)));
  if (s.hall_lines != study::AtOrder::same)
    add(fmt::format("probes {} at H1, H2, H3", base::word(study::at_hall_order_choices, s.hall_lines)));
  if (s.hall_inverted != study::AtHallLines::same)
    add(fmt::format("inverted Hall lines: {}", base::word(study::at_hall_inverted_choices, s.hall_inverted)));
  if (s.current_offset_A) add("current offset " + given(*s.current_offset_A, "A"));
  if (s.current_gain_error) add(fmt::format("current gain error {}", *s.current_gain_error));
  if (s.broken_divider != study::Wire::none)
    add(fmt::format("divider of terminal {} breaks", base::word(study::divider_choices, s.broken_divider)));
}

/// The text "line H1 reads high", or a text that the line follows its probe again.
std::string hall_line(const study::AtHallBreak& at) {
  if (at.level == study::PinLevel::probe) return fmt::format("line H{} follows its probe again", at.line);
  return fmt::format("line H{} reads {}", at.line, base::word(study::pin_level_choices, at.level));
}

/// Encoders and resolvers that fail or recover.
template <class Add>
void add_shaft_faults(const study::AtSensors& s, const Add& add) {
  const auto shows = [](study::EncoderLevel level) {
    return level == study::EncoderLevel::whole
               ? std::string("is intact again")
               : fmt::format("reads {}", base::word(study::encoder_level_choices, level));
  };
  if (s.missed_edges) add(fmt::format("{} edges missed", *s.missed_edges));
  if (s.bad_track) add(fmt::format("track {} {}", s.bad_track->track, shows(s.bad_track->level)));
  if (s.encoder_line)
    add(fmt::format("encoder's line {} {}", base::word(study::encoder_line_choices, s.encoder_line->line),
                    shows(s.encoder_line->level)));
  if (s.false_index.value_or(false)) add("a disturbance on line Z that counts as the index");
  if (s.broken_winding == study::Winding::whole) add("resolver's windings intact again");
  if (s.broken_winding == study::Winding::cosine || s.broken_winding == study::Winding::sine)
    add(fmt::format("resolver's {} winding breaks", base::word(study::winding_choices, s.broken_winding)));
  if (s.excitation) add(fmt::format("resolver's excitation {} of the full excitation", *s.excitation));
}

}  // namespace

std::string events(const std::vector<study::At>& events, bool linear) {
  std::string text;
  for (const study::At& at : events) {
    std::string what;
    const auto add = [&what](const std::string& words) { what += (what.empty() ? "" : ", ") + words; };
    if (at.supply.voltage_V) add("supply " + given(*at.supply.voltage_V, "V"));
    if (at.supply.sinks) add(*at.supply.sinks ? "supply takes current back" : "supply takes no current back");
    if (at.load.torque_Nm) add("load " + given(*at.load.torque_Nm, linear ? "N" : "Nm"));
    if (at.load.locked) add(*at.load.locked ? "rotor clamped" : "rotor let go");
    if (at.sensors.hall_break) add(hall_line(*at.sensors.hall_break));
    add_wires(at, add);
    add_shaft_faults(at.sensors, add);
    if (at.motor.broken_wire != study::Wire::none)
      add(fmt::format("wire {} breaks", base::word(study::wire_choices, at.motor.broken_wire)));
    const auto fails = [&](study::Switch which, const char* how) {
      if (which != study::Switch::none)
        add(fmt::format("{} {}", base::word(study::switch_choices, which), how));
    };
    fails(at.bridge.open_switch, "no longer follows its gate signal");
    fails(at.bridge.shorted_switch, "is shorted");
    if (at.bridge.dead_time_s) add("dead time " + given(*at.bridge.dead_time_s, "s"));
    if (const std::string words = tuned(at); !words.empty()) add(words);
    if (at.request == study::DriveRequest::on) add("asked to run");
    if (at.request == study::DriveRequest::off) add("run command removed");
    if (at.request == study::DriveRequest::clear) add("fault cleared");
    if (!what.empty()) text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", given(at.time_s, "s"), what);
  }
  return text;
}

}  // namespace report
