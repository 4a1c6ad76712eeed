// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/compile/timeline.hpp"

#include <algorithm>

#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"

namespace sixstep::study {

namespace {

using rig::ActionKind;

double hall_line(int line, bool high) { return high ? line : -1.0 * line; }

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
      add(ActionKind::hall_stuck, hall_line(broken->line, broken->level == PinLevel::high));
  }
  if (at.bridge.dead_time_s)
    add(ActionKind::dead_time, static_cast<double>(sim::to_instant(*at.bridge.dead_time_s).ticks));
  if (at.motor.broken_wire != Wire::none)
    add(ActionKind::wire_break, static_cast<double>(at.motor.broken_wire) - 1.0);
  if (at.request == DriveRequest::on) add(ActionKind::run_request, 1.0);
  if (at.request == DriveRequest::off) add(ActionKind::run_request, 0.0);
  if (at.request == DriveRequest::clear) add(ActionKind::clear_request, 1.0);
}

/// On the sample that sees them, before the setpoint of that instant.
void add_tunings(const Scenario& s, rig::Timeline& timeline) {
  double number = 0.0;
  for (const At* at : in_order(s))
    if (retunes(*at))
      timeline.push_back(
          {{sample_from_ticks(s.pwm, sim::to_instant(at->time_s).ticks), 0.0}, ActionKind::retune, number++});
}

}  // namespace

rig::Timeline timeline_of(const Scenario& s) {
  rig::Timeline timeline;
  add_tunings(s, timeline);
  for (const Stretch& stretch : reference_waveform(s))
    timeline.push_back(
        {sim::to_instant(stretch.at_s), ActionKind::setpoint, stretch.value, stretch.waveform});
  timeline.push_back({sim::Instant{}, ActionKind::load_torque, s.load.torque_Nm});
  for (std::size_t n = 0; n < s.load.times_s.size(); ++n)
    timeline.push_back({sim::to_instant(s.load.times_s[n]), ActionKind::load_torque, s.load.torques_Nm[n]});
  if (s.control.drive == FirmwareKind::product)
    timeline.push_back({sim::Instant{}, ActionKind::run_request, 1.0});
  if (const auto& off_at_s = s.protection.off_at_s)
    timeline.push_back({sim::to_instant(*off_at_s), ActionKind::run_request, 0.0});
  if (const HallBreak& broken = s.sensors.hall_break; broken.at_s)
    timeline.push_back({sim::to_instant(*broken.at_s), ActionKind::hall_stuck,
                        hall_line(broken.line, broken.level == Level01::high)});
  for (const At& at : s.at) add_event(at, timeline);
  std::stable_sort(timeline.begin(), timeline.end(),
                   [](const rig::Action& a, const rig::Action& b) { return a.at < b.at; });
  return timeline;
}

bool breaks_a_hall_line(const Scenario& s) {
  return s.sensors.hall_break.at_s.has_value() || std::any_of(s.at.begin(), s.at.end(), [](const At& at) {
           return at.sensors.hall_break.has_value();
         });
}

bool breaks_a_wire(const Scenario& s) {
  return std::any_of(s.at.begin(), s.at.end(),
                     [](const At& at) { return at.motor.broken_wire != Wire::none; });
}

double highest_supply_V(const Scenario& s) {
  double highest = s.supply.voltage_V;
  for (const At& at : s.at) highest = std::max(highest, at.supply.voltage_V.value_or(0.0));
  return highest;
}

}  // namespace sixstep::study
