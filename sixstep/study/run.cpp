// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run.hpp"

#include <cmath>

#include "sixstep/control/fixed.hpp"
#include "sixstep/sim/run.hpp"
#include "sixstep/study/arithmetic.hpp"
#include "sixstep/study/compile.hpp"
#include "sixstep/study/digest.hpp"
#include "sixstep/study/figures.hpp"
#include "sixstep/study/recorder.hpp"

namespace sixstep::study {

namespace {

/// Curves drawn from row to row need about this many points over a run.
constexpr double drawn_points = 2000.0;

/// All who watch a run, in one observer.
struct Watchers {
  std::optional<plant::Audit<double>> audit;
  Digest digest;
  Figures figures;
  std::optional<GridRecorder> grid;
  std::optional<EventRecorder> events, report;
  std::function<bool(double)> keep_going;
  std::int64_t segments = 0;

  template <class Rig>
  void segment(const Rig& rig, double s) {
    if (audit) audit->segment(rig.plant(), s);
    digest.segment(rig, s);
    figures.segment(rig, s);
    if (grid) grid->segment(rig, s);
    if (events) events->segment(rig, s);
    if (report) report->segment(rig, s);
    ++segments;
  }
  /// Asked often enough to answer a person at once, and seldom enough to cost nothing.
  template <class Rig>
  bool done(const Rig& rig) const {
    return keep_going && segments % 256 == 0 && !keep_going(rig.now().seconds());
  }
};

Watchers watchers(const Scenario& s, const Compiled& compiled, const Listeners& listeners,
                  const std::vector<std::size_t>& indices) {
  const control::Mode mode = s.control.mode;
  const double gap_s = s.duration_s / drawn_points;
  Watchers w{.figures = Figures(s, reference_levels(s.reference, s.duration_s)),
             .keep_going = listeners.keep_going};
  if (listeners.keep_books) w.audit.emplace();
  if (listeners.on_record && s.record.events)
    w.events.emplace(gap_s, mode, indices, listeners.on_record);
  else if (listeners.on_record)
    w.grid.emplace(sim::to_instant(s.record.grid_s.value_or(s.pwm.period_s)).ticks, compiled.end, mode,
                   indices, listeners.on_record);
  std::vector<std::size_t> every(column_count);
  for (std::size_t c = 0; c < column_count; ++c) every[c] = c;
  if (listeners.on_event) w.report.emplace(gap_s, mode, every, listeners.on_event);
  return w;
}

template <class Rig>
void report_events(const Rig& rig, Outcome& out) {
  using rig::Happening;
  constexpr std::pair<Happening, const char*> names[] = {{Happening::sector_edge, "sector edges"},
                                                         {Happening::diode_off, "diode stops"},
                                                         {Happening::comparator, "comparator switches"},
                                                         {Happening::standstill, "rotor stops"},
                                                         {Happening::breakaway, "rotor breaks away"},
                                                         {Happening::tick, "control ticks"},
                                                         {Happening::pwm_edge, "PWM edges"}};
  for (const auto& [what, name] : names) out.events.push_back({name, rig.happened(what)});
  out.events.push_back({"diode starts to conduct", rig.plant().diodes_started()});
}

base::Problem fault_problem(rig::Fault fault, int line, double t_s) {
  const std::string when = "t = " + std::to_string(t_s) + " s";
  if (fault == rig::Fault::shoot_through)
    return {when, "", "both switches of a leg were on: shoot-through",
            "look at the command that names one leg twice"};
  const std::string text = "the Hall code is impossible (000 or 111)";
  if (line == 0) return {when, "", text, "look at the probes and their wires"};
  return {when, "", text + ": line H" + std::to_string(line) + " does not follow the rotor",
          "look at its probe and its wire"};
}

template <class Rig>
base::Problems run_rig(Rig& rig, const Compiled& compiled, Watchers& w, Outcome& out) {
  const sim::Run run = sim::run(rig, compiled.end, w);
  const double t_s = rig.now().seconds();
  if (run.stop == sim::Stop::fault) out.fault = fault_problem(rig.fault(), rig.sensors().broken_line(), t_s);
  if (run.stop == sim::Stop::unsettled || run.stop == sim::Stop::no_progress)
    return {{"t = " + std::to_string(t_s) + " s", "",
             run.stop == sim::Stop::unsettled ? "no consistent conduction mode was found"
                                              : "events repeat without time going on",
             "this is a defect of sixstep: please report it with the scenario file"}};
  out.segments = run.segments;
  out.simulated_s = t_s;
  out.digest = w.digest.after(rig);
  report_events(rig, out);
  return {};
}

template <class Scalar>
base::Problems run_in(const Scenario& scenario, const Compiled& compiled, Watchers& w, Outcome& out) {
  const base::Result<DriveIn<Scalar>> drive = drive_in<Scalar>(scenario, compiled);
  if (!drive) return drive.problems();
  const plant::Plant<double> plant(compiled.motor.machine, compiled.shaft, compiled.devices, compiled.supply,
                                   compiled.start);
  rig::BoardConfig board = compiled.board;
  board.units = drive->units;
  rig::Rig<double, Scalar> rig(plant, drive->drive, board, compiled.timeline);
  return run_rig(rig, compiled, w, out);
}

/// Each arithmetic is a program of its own; which one runs is decided here, once.
base::Problems run_chosen(const Scenario& s, const Compiled& compiled, Watchers& w, Outcome& out) {
  switch (s.control.arithmetic) {
    case Arithmetic::float64:
      return run_in<double>(s, compiled, w, out);
    case Arithmetic::float32:
      return run_in<float>(s, compiled, w, out);
    case Arithmetic::q15:
      return run_in<control::Q15>(s, compiled, w, out);
    case Arithmetic::q14:
      return run_in<control::Q14>(s, compiled, w, out);
    case Arithmetic::q31:
      return run_in<control::Q31>(s, compiled, w, out);
    case Arithmetic::q30:
      return run_in<control::Q30>(s, compiled, w, out);
  }
  return {};
}

}  // namespace

base::Result<Outcome> run(const Scenario& scenario, const Listeners& listeners) {
  if (base::Problems problems = check(scenario); !problems.empty()) return problems;
  const base::Result<Compiled> compiled = compile(scenario);
  if (!compiled) return compiled.problems();
  const base::Result<std::vector<std::size_t>> indices = record_indices(scenario);
  if (!indices) return indices.problems();

  Outcome out;
  out.motor = compiled->motor;
  out.gains = compiled->gains;
  Watchers w = watchers(scenario, *compiled, listeners, *indices);
  const base::Problems problems = run_chosen(scenario, *compiled, w, out);
  if (!problems.empty()) return problems;
  if (w.audit) {
    out.energy = w.audit->energy();
    out.laws = w.audit->laws();
  }
  w.figures.judge(scenario, out);
  return out;
}

}  // namespace sixstep::study
