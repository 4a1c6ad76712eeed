// SPDX-License-Identifier: Apache-2.0
// The parts of a live rig that take long to compile. Included by the files that are named after a firmware
// only.
#pragma once
#include <utility>

#include "sixstep/study/live/faults.hpp"
#include "sixstep/study/live/live_rig.hpp"

namespace sixstep::study::detail {

template <class Rig>
void count_events(const Rig& rig, Outcome& out) {
  using rig::EventKind;
  constexpr std::pair<EventKind, const char*> names[] = {{EventKind::sector_edge, "sector edges"},
                                                         {EventKind::diode_off, "diode stops"},
                                                         {EventKind::comparator, "comparator switches"},
                                                         {EventKind::standstill, "rotor stops"},
                                                         {EventKind::breakaway, "rotor breaks away"},
                                                         {EventKind::tick, "control ticks"},
                                                         {EventKind::pwm_edge, "PWM edges"}};
  for (const auto& [what, name] : names) out.events.push_back({name, rig.event_count(what)});
  out.events.push_back({"diode starts to conduct", rig.plant().diodes_started()});
}

/// What a run leaves behind that has stopped, or stands where it is now.
template <class Rig>
base::Problems note_end(const Rig& rig, sim::Stop stop, Observers& w, Outcome& out) {
  const double t_s = rig.now().seconds();
  const bool away = has_run_away(rig.plant());
  if (!away && (stop == sim::Stop::unsettled || stop == sim::Stop::no_progress || w.crowded))
    return {{"t = " + std::to_string(t_s) + " s", "",
             stop == sim::Stop::unsettled ? "no consistent conduction mode was found"
                                          : "events repeat without time going on",
             "this is a defect of sixstep: please report it with the scenario file"}};
  if (away)
    out.fault = ran_away(rig.plant().state(), t_s);
  else if (stop == sim::Stop::fault)
    out.fault = stopped_by(rig.fault(), rig.firmware().diagnosis(), t_s);
  else
    note_trip(rig.firmware().diagnosis(), out);
  if constexpr (requires { rig.plant().breaking(); }) note_wires(rig.plant().breaking(), out);
  if constexpr (requires { rig.firmware().latest_edge_s(); })
    out.chip.emplace().latest_edge_s = rig.firmware().latest_edge_s();
  out.turn_ons = rig.modulator().turn_ons();
  out.simulated_s = t_s;
  out.digest = w.digest.after(rig);
  if (w.logic) w.logic->end(rig);
  w.extremes.look(rig);
  count_events(rig, out);
  return {};
}

template <class FirmwareType, class PlantType>
base::Result<LiveRig<FirmwareType, PlantType>> LiveRig<FirmwareType, PlantType>::made(
    const Scenario& scenario, const Compiled& compiled, rig::Timeline timeline) {
  const base::Result<Chip<Firmware>> chip = chip_of<Firmware>(scenario, compiled);
  if (!chip) return chip.problems();
  if constexpr (std::is_same_v<PlantType, plant::general::Plant<double>>)
    return LiveRig{general_rig_of<Firmware>(compiled, *chip, std::move(timeline)), chip->bases};
  else
    return LiveRig{rig_of<Firmware>(compiled, *chip, std::move(timeline)), chip->bases};
}

template <class FirmwareType, class PlantType>
sim::Stop LiveRig<FirmwareType, PlantType>::advance(const sim::Instant& end, Slice& slice) {
  return sim::run(rig, end, slice).stop;
}

template <class FirmwareType, class PlantType>
void LiveRig<FirmwareType, PlantType>::look(Slice& slice) const {
  rig::Rig<double, Firmware, PlantType> twin = rig;
  twin.act();
  if (twin.expand(1e-12) >= 0) slice.take(twin, 0.0, twin.now().seconds());
}

template <class FirmwareType, class PlantType>
base::Problems LiveRig<FirmwareType, PlantType>::take(const Scenario& scenario, const Compiled& compiled,
                                                      rig::Timeline timeline) {
  const base::Result<Chip<Firmware>> chip = chip_of<Firmware>(scenario, compiled);
  if (!chip) return chip.problems();
  rig.replace_future(std::move(timeline), {chip->config, chip->bases.setpoint}, chip->later);
  return {};
}

template <class FirmwareType, class PlantType>
base::Problems LiveRig<FirmwareType, PlantType>::end(sim::Stop stop, Observers& watchers,
                                                     Outcome& out) const {
  return note_end(rig, stop, watchers, out);
}

}  // namespace sixstep::study::detail
