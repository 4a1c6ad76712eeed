// SPDX-License-Identifier: Apache-2.0
// From a firmware's type to a run: builds the rig, runs it, reads out what it has counted. Included by the
// files of run_firmware.hpp only.
#pragma once
#include <type_traits>

#include "sixstep/control/fixed.hpp"
#include "sixstep/sim/run.hpp"
#include "sixstep/study/compile/arithmetic.hpp"
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

template <class Rig>
base::Problems run_rig(Rig& rig, const Compiled& compiled, Observers& w, Outcome& out) {
  const sim::Run run = sim::run(rig, compiled.end, w);
  const double t_s = rig.now().seconds();
  const bool away = has_run_away(rig.plant());
  if (!away && (run.stop == sim::Stop::unsettled || run.stop == sim::Stop::no_progress || w.crowded))
    return {{"t = " + std::to_string(t_s) + " s", "",
             run.stop == sim::Stop::unsettled ? "no consistent conduction mode was found"
                                              : "events repeat without time going on",
             "this is a defect of sixstep: please report it with the scenario file"}};
  if (away)
    out.fault = ran_away(rig.plant(), t_s);
  else if (run.stop == sim::Stop::fault)
    out.fault = stopped_by(rig.fault(), rig.firmware().diagnosis(), t_s);
  else
    note_trip(rig.firmware().diagnosis(), out);
  out.segments = run.segments;
  out.turn_ons = rig.modulator().turn_ons();
  out.simulated_s = t_s;
  out.digest = w.digest.after(rig);
  if (w.logic) w.logic->end(rig);
  count_events(rig, out);
  return {};
}

template <class Scalar>
auto chip_for(std::type_identity<rig::ProductDrive<Scalar>>, const Scenario& s, const Compiled& c) {
  return product_in<Scalar>(s, c);
}
template <class Firmware>
auto chip_for(std::type_identity<Firmware>, const Scenario& s, const Compiled& c) {
  return drive_in<typename Firmware::Number>(s, c);
}

template <class Firmware>
base::Problems run_in(const Scenario& scenario, const Compiled& compiled, Observers& w, Outcome& out) {
  const auto chip = chip_for(std::type_identity<Firmware>{}, scenario, compiled);
  if (!chip) return chip.problems();
  const plant::Plant<double> plant(compiled.motor.machine, compiled.shaft, compiled.devices, compiled.supply,
                                   compiled.start);
  rig::BoardConfig board = compiled.board;
  board.bases = chip->bases;
  rig::Rig<double, Firmware> rig(plant, chip->config, board, compiled.timeline);
  return run_rig(rig, compiled, w, out);
}

/// Which arithmetic runs is decided here, once.
template <template <class> class Firmware>
base::Problems run_chosen(const Scenario& s, const Compiled& compiled, Observers& w, Outcome& out) {
  switch (s.control.arithmetic) {
    case Arithmetic::float64:
      return run_in<Firmware<double>>(s, compiled, w, out);
    case Arithmetic::float32:
      return run_in<Firmware<float>>(s, compiled, w, out);
    case Arithmetic::q15:
      return run_in<Firmware<control::Q15>>(s, compiled, w, out);
    case Arithmetic::q14:
      return run_in<Firmware<control::Q14>>(s, compiled, w, out);
    case Arithmetic::q31:
      return run_in<Firmware<control::Q31>>(s, compiled, w, out);
    case Arithmetic::q30:
      return run_in<Firmware<control::Q30>>(s, compiled, w, out);
  }
  return {};
}

}  // namespace sixstep::study::detail
