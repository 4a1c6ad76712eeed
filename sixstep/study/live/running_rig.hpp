// SPDX-License-Identifier: Apache-2.0
// Implements AnyRun for one kernel with one kind of drive. Only the files rig_* include it: each compiles the
// engine once. Functions that a run calls once are marked cold, and are compiled for size.
#pragma once
#include <utility>

#include "sixstep/study/compile/rig_of.hpp"
#include "sixstep/study/live/any_run.hpp"
#include "sixstep/study/live/faults.hpp"

namespace sixstep::study::detail {

template <class Rig>
[[gnu::cold]] void count_events(const Rig& rig, Outcome& out) {
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

/// Writes the results of a run up to the present instant. The run may have ended at this instant, or may
/// continue.
template <class Rig>
[[gnu::cold, gnu::noinline]] base::Problems note_end(const Rig& rig, sim::Stop stop, Observers& w,
                                                     Outcome& out) {
  const double t_s = rig.now().seconds();
  const bool away = has_run_away(rig.plant());
  const rig::Diagnosis found = rig.firmware().diagnosis();
  if (!away && (stop == sim::Stop::unsettled || stop == sim::Stop::no_progress || w.crowded))
    return {
        {"t = " + std::to_string(t_s) + " s", "",
         stop == sim::Stop::unsettled ? "no consistent conduction mode was found"
                                      : "switching events repeat without end at one instant",
         "this is a defect of sixstep: report this message, with the scenario file, in the issues of the repository"}};
  if (away)
    out.fault = ran_away(rig.plant().state(), t_s);
  else if (stop == sim::Stop::fault)
    out.fault = stopped_by(rig.fault(), found, t_s);
  else
    note_trip(found, out);
  out.shunt_samples = found.shunt_samples;
  out.blind_samples = found.blind_samples;
  if constexpr (requires { rig.plant().breaking(); }) note_wires(rig.plant().breaking(), out);
  if constexpr (requires { rig.firmware().latest_edge_s(); })
    out.chip.emplace().latest_edge_s = rig.firmware().latest_edge_s();
  out.turn_ons = rig.modulator().turn_ons_before(rig.now());
  out.chopped_switches = ModulatorView(rig.modulator()).chopped();
  out.simulated_s = t_s;
  out.digest = w.digest.after(rig);
  if (w.logic) w.logic->end(rig);
  w.look(rig);
  count_events(rig, out);
  return {};
}

template <class Firmware, class PlantType>
class RunningRig final : public AnyRun {
 public:
  /// Creates the chip of a scenario: once at the start, and once in each call of take().
  using MakeChip = base::Result<Chip<Firmware>> (*)(const Scenario&, const Compiled&);

  [[gnu::cold]] static base::Result<std::unique_ptr<AnyRun>> made(MakeChip make_chip,
                                                                  const Scenario& scenario,
                                                                  const Compiled& compiled,
                                                                  rig::Timeline timeline) {
    const base::Result<Chip<Firmware>> chip = make_chip(scenario, compiled);
    if (!chip) return chip.problems();
    return std::unique_ptr<AnyRun>(new RunningRig(make_chip, compiled, *chip, std::move(timeline)));
  }

  std::unique_ptr<AnyRun> clone() const override { return std::unique_ptr<AnyRun>(new RunningRig(*this)); }
  sim::Instant now() const override { return rig_.now(); }
  sim::Instant next_tick() const override { return rig_.next_tick(); }
  sim::Stop advance(const sim::Instant& end, Slice& slice) override {
    return sim::run(rig_, end, slice).stop;
  }
  void look(Slice& slice) const override {
    Rig twin = rig_;
    twin.act();
    if (twin.expand(1e-12) >= 0) slice.take(twin, 0.0, twin.now().seconds());
  }
  [[gnu::cold]] base::Problems take(const Scenario& scenario, const Compiled& compiled,
                                    rig::Timeline timeline) override {
    base::Result<Chip<Firmware>> chip = make_chip_(scenario, compiled);
    if (!chip) return chip.problems();
    rig_.replace_future(std::move(timeline), {chip->config, chip->bases.setpoint}, std::move(chip->later));
    return {};
  }
  base::Problems end(sim::Stop stop, Observers& watchers, Outcome& out) const override {
    return note_end(rig_, stop, watchers, out);
  }
  FullScale full_scale() const override { return full_scale_; }

 private:
  using Rig = rig::Rig<double, Firmware, PlantType>;

  RunningRig(MakeChip make_chip, const Compiled& compiled, const Chip<Firmware>& chip, rig::Timeline timeline)
      : make_chip_(make_chip),
        rig_(built(compiled, chip, std::move(timeline))),
        full_scale_(chip.full_scale) {}
  RunningRig(const RunningRig&) = default;
  static Rig built(const Compiled& compiled, const Chip<Firmware>& chip, rig::Timeline timeline) {
    if constexpr (std::is_same_v<PlantType, plant::general::Plant<double>>)
      return general_rig_of<Firmware>(compiled, chip, std::move(timeline));
    else
      return rig_of<Firmware>(compiled, chip, std::move(timeline));
  }

  MakeChip make_chip_;
  Rig rig_;
  FullScale full_scale_;
};

}  // namespace sixstep::study::detail
