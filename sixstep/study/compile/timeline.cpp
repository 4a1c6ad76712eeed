// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/compile/timeline.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/random.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"
#include "sixstep/study/scenario/supply_voltages.hpp"

namespace sixstep::study {

namespace {

using rig::ActionKind;

/// The number of the stuck line or track, positive if the level is high and negative if it is low.
double stuck_line(int line, bool high) { return high ? line : -1.0 * line; }

/// The value of a word in the enumeration without `same`. In the enumeration with `same` each value is one
/// higher.
template <class Word>
constexpr double behind_same(Word word) {
  return static_cast<double>(static_cast<int>(word) - 1);
}
static_assert(behind_same(AtOrder::bac) == static_cast<int>(rig::WireOrder::bac));
static_assert(behind_same(AtHallLines::line_1) == static_cast<int>(HallLines::line_1) &&
              behind_same(AtHallLines::lines_12) == static_cast<int>(HallLines::lines_12) &&
              behind_same(AtHallLines::all) == static_cast<int>(HallLines::all));

/// Adds the faults of an encoder or a resolver.
template <class Add>
void add_shaft_faults(const AtSensors& at, const Add& add) {
  const auto stick = [&](ActionKind sticks, ActionKind whole, int line, EncoderLevel level) {
    if (level == EncoderLevel::whole)
      add(whole, line);
    else
      add(sticks, stuck_line(line, level == EncoderLevel::high));
  };
  if (at.missed_edges) add(ActionKind::encoder_misses, *at.missed_edges);
  if (const auto& bad = at.bad_track)
    stick(ActionKind::track_sticks, ActionKind::track_whole, bad->track, bad->level);
  if (const auto& stuck = at.encoder_line)
    stick(ActionKind::encoder_line_sticks, ActionKind::encoder_line_whole, static_cast<int>(stuck->line),
          stuck->level);
  if (at.false_index.value_or(false)) add(ActionKind::false_index, 1.0);
  if (at.broken_winding != Winding::none)
    add(ActionKind::winding_breaks,
        at.broken_winding == Winding::whole ? 0.0 : static_cast<double>(at.broken_winding));
  if (at.excitation) add(ActionKind::excitation, *at.excitation);
}

void add_event(const At& at, rig::Timeline& timeline) {
  const auto add = [&](ActionKind kind, double value) {
    timeline.push_back({sim::to_instant(at.time_s), kind, value});
  };
  if (at.supply.voltage_V) add(ActionKind::source_voltage, *at.supply.voltage_V);
  if (at.supply.sinks) add(ActionKind::source_sinks, *at.supply.sinks ? 1.0 : 0.0);
  if (at.load.torque_Nm) add(ActionKind::load_torque, *at.load.torque_Nm);
  if (at.load.locked) add(ActionKind::shaft_locked, *at.load.locked ? 1.0 : 0.0);
  if (const auto& broken = at.sensors.hall_break) {
    if (broken->level == PinLevel::probe)
      add(ActionKind::hall_whole, broken->line);
    else
      add(ActionKind::hall_stuck, stuck_line(broken->line, broken->level == PinLevel::high));
  }
  if (at.bridge.phases != AtOrder::same) add(ActionKind::wire_phases, behind_same(at.bridge.phases));
  if (at.sensors.hall_lines != AtOrder::same)
    add(ActionKind::wire_probes, behind_same(at.sensors.hall_lines));
  if (at.sensors.hall_inverted != AtHallLines::same)
    add(ActionKind::invert_lines, behind_same(at.sensors.hall_inverted));
  if (at.sensors.current_offset_A) add(ActionKind::current_offset, *at.sensors.current_offset_A);
  if (at.sensors.current_gain_error) add(ActionKind::current_gain, *at.sensors.current_gain_error);
  add_shaft_faults(at.sensors, add);
  if (at.sensors.broken_divider != Wire::none)
    add(ActionKind::divider_breaks, static_cast<double>(at.sensors.broken_divider) - 1.0);
  if (at.bridge.dead_time_s)
    add(ActionKind::dead_time, static_cast<double>(sim::to_instant(*at.bridge.dead_time_s).ticks));
  if (at.bridge.open_switch != Switch::none)
    add(ActionKind::switch_open, static_cast<double>(at.bridge.open_switch));
  if (at.bridge.shorted_switch != Switch::none)
    add(ActionKind::switch_short, static_cast<double>(at.bridge.shorted_switch));
  if (at.motor.broken_wire != Wire::none)
    add(ActionKind::wire_break, static_cast<double>(at.motor.broken_wire) - 1.0);
  if (at.request == DriveRequest::on) add(ActionKind::run_request, 1.0);
  if (at.request == DriveRequest::off) add(ActionKind::run_request, 0.0);
  if (at.request == DriveRequest::clear) add(ActionKind::clear_request, 1.0);
}

/// Adds each event's configuration at the first control sample at or after the event, before the setpoint of
/// the same instant.
void add_tunings(const Scenario& s, rig::Timeline& timeline) {
  double number = 0.0;
  for (const At* at : in_order(s))
    if (retunes(*at))
      timeline.push_back(
          {{sample_from_ticks(s.pwm, sim::to_instant(at->time_s).ticks), 0.0}, ActionKind::retune, number++});
}

/// Adds each point of a table at its time; with `lines` the value moves linearly to the next point.
void add_table(ActionKind kind, const std::vector<double>& times_s, const std::vector<double>& values,
               Between between, rig::Timeline& timeline) {
  for (std::size_t n = 0; n < times_s.size(); ++n) {
    rig::Action action{sim::to_instant(times_s[n]), kind, values[n]};
    if (between == Between::lines && n + 1 < times_s.size())
      action.waveform.rate = (values[n + 1] - values[n]) / (times_s[n + 1] - times_s[n]);
    timeline.push_back(action);
  }
}

/// Adds single missed edges of an encoder as a Poisson process.
void add_missed_edges(const Scenario& s, rig::Timeline& timeline) {
  if (s.sensors.rotor != RotorSensing::encoder || !(s.sensors.encoder.missed_Hz > 0)) return;
  const auto seed = static_cast<std::uint64_t>(s.sensors.seed);
  constexpr std::uint64_t gaps = std::uint64_t{0x612} << 32;
  double at_s = 0.0;
  for (std::uint64_t n = 0;; ++n) {
    at_s -= base::log(base::uniform({seed, gaps, n})) / s.sensors.encoder.missed_Hz;
    if (!(at_s < s.duration_s)) return;
    timeline.push_back({sim::to_instant(at_s), ActionKind::encoder_misses, 1.0});
  }
}

/// Adds glitches as a Poisson process: the times between glitches and the lines are drawn at random.
void add_glitches(const Scenario& s, rig::Timeline& timeline) {
  if (!(s.sensors.hall_glitches_Hz > 0)) return;
  const auto seed = static_cast<std::uint64_t>(s.sensors.seed);
  constexpr std::uint64_t gaps = std::uint64_t{0x611} << 32, lines = gaps + 1;
  double at_s = 0.0;
  for (std::uint64_t n = 0;; ++n) {
    at_s -= base::log(base::uniform({seed, gaps, n})) / s.sensors.hall_glitches_Hz;
    if (!(at_s < s.duration_s)) return;
    const double line = 1.0 + std::floor(3.0 * base::uniform({seed, lines, n}));
    timeline.push_back({sim::to_instant(at_s), ActionKind::hall_glitch, line});
    timeline.push_back({sim::to_instant(at_s + s.sensors.hall_glitch_s), ActionKind::hall_glitch, line});
  }
}

}  // namespace

rig::Timeline timeline_of(const Scenario& s) {
  rig::Timeline timeline;
  add_tunings(s, timeline);
  for (const Stretch& stretch : reference_waveform(s))
    timeline.push_back(
        {sim::to_instant(stretch.at_s), ActionKind::setpoint, stretch.value, stretch.waveform});
  timeline.push_back({sim::Instant{}, ActionKind::load_torque, s.load.torque_Nm});
  add_table(ActionKind::load_torque, s.load.times_s, s.load.torques_Nm, s.load.between, timeline);
  add_table(ActionKind::shaft_speed, s.load.dynamometer_times_s, s.load.dynamometer_rad_s, Between::lines,
            timeline);
  if (s.control.drive == FirmwareKind::product)
    timeline.push_back({sim::Instant{}, ActionKind::run_request, 1.0});
  if (const auto& off_at_s = s.protection.off_at_s)
    timeline.push_back({sim::to_instant(*off_at_s), ActionKind::run_request, 0.0});
  if (const HallBreak& broken = s.sensors.hall_break; broken.at_s)
    timeline.push_back({sim::to_instant(*broken.at_s), ActionKind::hall_stuck,
                        stuck_line(broken.line, broken.level == Level01::high)});
  for (const At& at : s.at) add_event(at, timeline);
  add_glitches(s, timeline);
  add_missed_edges(s, timeline);
  std::stable_sort(timeline.begin(), timeline.end(),
                   [](const rig::Action& a, const rig::Action& b) { return a.at < b.at; });
  return timeline;
}

bool breaks_a_hall_line(const Scenario& s) {
  return s.sensors.hall_break.at_s.has_value() || std::any_of(s.at.begin(), s.at.end(), [](const At& at) {
           return at.sensors.hall_break.has_value();
         });
}

bool breaks_wire_or_switch(const Scenario& s) {
  return std::any_of(s.at.begin(), s.at.end(), [](const At& at) {
    return at.motor.broken_wire != Wire::none || at.bridge.open_switch != Switch::none ||
           at.bridge.shorted_switch != Switch::none;
  });
}

bool crosses_wires(const Scenario& s) {
  const auto crossed = [](rig::WireOrder order) { return order != rig::WireOrder::abc; };
  return crossed(s.bridge.phases) || crossed(s.sensors.hall_lines) || crossed(s.believed.hall_lines) ||
         inverts_a_hall_line(s) || std::any_of(s.at.begin(), s.at.end(), [](const At& at) {
           return at.bridge.phases != AtOrder::same || at.sensors.hall_lines != AtOrder::same;
         });
}

bool inverts_a_hall_line(const Scenario& s) {
  return s.sensors.hall_inverted != HallLines::none ||
         std::any_of(s.at.begin(), s.at.end(),
                     [](const At& at) { return at.sensors.hall_inverted != AtHallLines::same; });
}

bool displaces_probes(const Scenario& s) {
  const Sensors& x = s.sensors;
  return x.hall_spacing != control::HallArrangement::degrees_120 || x.hall_offset_deg != 0 ||
         !x.hall_edges_deg.empty() || x.hall_hysteresis_deg > 0 || x.hall_delay_s > 0 ||
         x.hall_glitches_Hz > 0;
}

double highest_supply_V(const Scenario& s) {
  double highest = std::max(s.supply.voltage_V, highest_open_V(s.supply));
  for (const At& at : s.at) highest = std::max(highest, at.supply.voltage_V.value_or(0.0));
  return highest;
}

}  // namespace sixstep::study
