// SPDX-License-Identifier: Apache-2.0
// From a firmware's type to a run: builds the rig, runs it, reads out what it has counted. Included by the
// files of run_firmware.hpp only.
#pragma once
#include <utility>

#include "sixstep/control/fixed.hpp"
#include "sixstep/sim/run.hpp"
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/run/faults.hpp"
#include "sixstep/study/run/run_firmware.hpp"

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
  out.turn_ons = rig.modulator().turn_ons();
  out.simulated_s = t_s;
  out.digest = w.digest.after(rig);
  if (w.logic) w.logic->end(rig);
  count_events(rig, out);
  return {};
}

/// The two kernels, for run_chosen().
struct OnLeanPlant {
  template <class Firmware>
  static auto rig(const Compiled& c, const Chip<Firmware>& chip, rig::Timeline timeline) {
    return rig_of<Firmware>(c, chip, std::move(timeline));
  }
};
struct OnGeneralPlant {
  template <class Firmware>
  static auto rig(const Compiled& c, const Chip<Firmware>& chip, rig::Timeline timeline) {
    return general_rig_of<Firmware>(c, chip, std::move(timeline));
  }
};

template <class Kernel, class Firmware>
base::Problems run_in(const Scenario& scenario, Compiled compiled, Observers& w, Outcome& out) {
  const base::Result<Chip<Firmware>> chip = chip_of<Firmware>(scenario, compiled);
  if (!chip) return chip.problems();
  auto rig = Kernel::template rig<Firmware>(compiled, *chip, std::move(compiled.timeline));
  const sim::Run run = sim::run(rig, compiled.end, w);
  out.segments = run.segments;
  return note_end(rig, run.stop, w, out);
}

/// Which arithmetic runs is decided here, once.
template <template <class> class Firmware, class Kernel = OnLeanPlant>
base::Problems run_chosen(const Scenario& s, Compiled compiled, Observers& w, Outcome& out) {
  switch (s.control.arithmetic) {
    case Arithmetic::float64:
      return run_in<Kernel, Firmware<double>>(s, std::move(compiled), w, out);
    case Arithmetic::float32:
      return run_in<Kernel, Firmware<float>>(s, std::move(compiled), w, out);
    case Arithmetic::q15:
      return run_in<Kernel, Firmware<control::Q15>>(s, std::move(compiled), w, out);
    case Arithmetic::q14:
      return run_in<Kernel, Firmware<control::Q14>>(s, std::move(compiled), w, out);
    case Arithmetic::q31:
      return run_in<Kernel, Firmware<control::Q31>>(s, std::move(compiled), w, out);
    case Arithmetic::q30:
      return run_in<Kernel, Firmware<control::Q30>>(s, std::move(compiled), w, out);
  }
  return {};
}

}  // namespace sixstep::study::detail
