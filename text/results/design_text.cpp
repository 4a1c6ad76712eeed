// SPDX-License-Identifier: Apache-2.0
#include "text/results/design_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/verify/run_warnings.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/design_warnings.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/measure/figures.hpp"
#include "sixstep/study/scenario/believed_motor.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/escape/escape.hpp"
#include "text/results/design_loops_text.hpp"
#include "text/results/quantity_text.hpp"
#include "text/results/text_rows.hpp"
#include "text/results/verdict_table.hpp"

namespace text {
namespace {

using sixstep::analysis::RobustFigure;
using sixstep::base::Motion;
using sixstep::control::Mode;
using sixstep::design::DriveDesign;
using sixstep::design::LoopDesign;

const study::ComparisonResult* find(const analysis::DesignStudy& s, const char* figure) {
  for (const auto& c : s.outcome.comparisons)
    if (c.figure == figure) return &c;
  return nullptr;
}

std::string motor_words(const sixstep::design::MotorModel& m) {
  const std::string winding =
      fmt::format("terminal R = {} ohm, L = {} mH", sixstep::base::six_digits(2 * m.machine.R_ohm),
                  sixstep::base::six_digits(2e3 * m.machine.L_H));
  if (sixstep::design::motion_of(m).linear)
    return fmt::format("{}, K_f = {} N/A, m = {} kg, B = {} N s/m, tau = {} mm", winding,
                       sixstep::base::six_digits(m.K_t_Nm_A), sixstep::base::six_digits(m.shaft.J_kg_m2),
                       sixstep::base::six_digits(m.shaft.B_Nm_s),
                       sixstep::base::six_digits(1e3 * sixstep::base::pi / m.machine.pole_pairs));
  return fmt::format(
      "{}, K_t = {} mNm/A, J = {} g cm2, B = {} N m s", winding, sixstep::base::six_digits(1e3 * m.K_t_Nm_A),
      sixstep::base::six_digits(1e7 * m.shaft.J_kg_m2), sixstep::base::six_digits(m.shaft.B_Nm_s));
}

std::string designed_motor_line(const DriveDesign& d, const study::Scenario& s) {
  const std::string chopping(sixstep::base::word(sixstep::study::chopping_choices, d.spec.chopping));
  const std::string believed = motor_words(d.motor);
  std::string itself = believed;
  auto motor = sixstep::design::motor_model(s.sheet);
  const auto drives = sixstep::study::believed_motor(s);
  if (motor && drives && sixstep::study::believes_a_motor(s.believed)) {
    motor->shaft.J_kg_m2 += d.motor.shaft.J_kg_m2 - drives->shaft.J_kg_m2;  // the load
    itself = motor_words(*motor);
  }
  return fmt::format("{} on {} V: {}\n{}control and PWM period {}, {} chopping, a command acts {}\n",
                     visible(s.sheet.name.empty() ? s.motor : s.sheet.name),
                     sixstep::base::six_digits(d.bus_V), itself,
                     believed == itself ? "" : "the drive believes " + believed + "\n",
                     quantity_text(d.spec.period_s, "s"), chopping,
                     sixstep::design::late_words(d.spec.late_periods()) +
                         (d.spec.sampled_in_middle ? ", sampled in the middle of a period" : ""));
}

std::string simulated_text(const analysis::DesignStudy& s) {
  Rows rows;
  rows.add({"figure", "expected", "simulated", "", ""});
  for (const auto& told : s.outcome.comparisons) {
    const study::ComparisonResult c = as_shown(told, s.scenario);
    // If the source of a design value contains "without" (limits, commutation), the value is only a bound for
    // this drive.
    const bool same = c.source.find("without") == std::string::npos;
    rows.add({c.figure, quantity_text(c.value, c.unit), quantity_text(c.measured, c.unit),
              same ? deviation_text(c) : "", c.source});
  }
  const study::Scenario& n = s.scenario;
  const Motion motion = sixstep::design::motion_of(n.sheet);
  const sixstep::base::LinearUnit deg = motion.unit("deg");
  std::string how;
  if (n.control.mode == Mode::current)
    how =
        motion.words(fmt::format("rotor held, a step to {} A", sixstep::base::six_digits(n.reference.value)));
  else if (n.control.mode == Mode::speed)
    how = motion.words(fmt::format("load {} N m, from rest to {} rad/s, then to {} rad/s",
                                   sixstep::base::six_digits(n.load.torque_Nm),
                                   sixstep::base::six_digits(n.reference.values.at(0)),
                                   sixstep::base::six_digits(n.reference.values.at(1))));
  else
    how =
        fmt::format("a move of {} {}", sixstep::base::six_digits(n.reference.value * deg.factor), deg.linear);
  return fmt::format("\nSimulated with all switching: {}\n", how) + rows.text();
}

void add_robust(Rows& rows, const RobustFigure& f, int digits) {
  const bool same = f.at.empty();
  rows.add({f.figure, quantity_text(f.nominal, f.unit, digits),
            same ? "none worse" : quantity_text(f.worst, f.unit, digits), f.at,
            f.culprit.empty()
                ? ""
                : fmt::format("{} alone: {}", f.culprit, quantity_text(f.alone, f.unit, digits))});
}

std::string robust_text(const analysis::Robustness& r, const DriveDesign& d) {
  Rows rows;
  rows.add({"figure", "nominal", "worst", "of the motor with", "largest effect of one deviation"});
  for (const RobustFigure& f : r.figures) add_robust(rows, f, 4);
  for (const RobustFigure& f : r.phases) add_robust(rows, f, 3);
  return fmt::format(
             "\nTolerances: the designed controller on {} motors with one or several deviations (phase margins {})\n",
             r.runs, sixstep::design::late_words(d.spec.later_periods())) +
         rows.text();
}

std::string position_text(const analysis::PositionGain& p, const Motion& motion) {
  const sixstep::base::LinearUnit gain = motion.unit("rad/s/deg");
  // A drive with a low top speed may brake faster than its linear loop. The smaller of the two gains comes
  // first, each with its own explanation.
  const std::string braking = sixstep::base::six_digits(p.estimate * gain.factor) +
                              " (full torque stops the drive from top speed)",
                    linear = sixstep::base::six_digits(p.linear * gain.factor) + " (no limit acts)";
  const bool rising = p.estimate <= p.linear;
  std::string text = motion.words(fmt::format("  found by {}; the search began between {} and {}\n",
                                              counted(static_cast<std::size_t>(p.runs), "simulation"),
                                              rising ? braking : linear, rising ? linear : braking));
  if (p.gain_rad_s_per_deg < p.nominal)
    text += fmt::format("  the nominal motor allows {} {}, but motors within the tolerances do not\n",
                        sixstep::base::six_digits(p.nominal * gain.factor), gain.linear);
  return text;
}

/// The figure with the worst motor within the tolerances.
std::string at_worst(const analysis::DesignStudy& s, const char* figure, double nominal, int digits) {
  if (!s.robustness) return "";
  for (const RobustFigure& f : s.robustness->figures)
    if (f.figure == figure && f.worst > nominal)
      return fmt::format(", {} at worst", quantity_text(f.worst, f.unit, digits));
  return "";
}

/// The settling band of the design's run, in per cent of the step.
double settled_percent(const analysis::DesignStudy& s) {
  for (const study::Comparison& c : s.scenario.compare)
    if (c.measure.label == "settling time") return 100 * c.measure.band;
  return 100 * sixstep::design::settling_band(s.design);
}

/// Why the speed's band is wider than the usual 2 %.
std::string band_reason(const analysis::DesignStudy& s) {
  const bool wide = s.design.spec.mode == Mode::speed && sixstep::design::settling_band(s.design) > 0.02;
  return wide ? "; within 10 %, because the resolution of a speed from Hall edges is coarse" : "";
}

/// "with little phase margin (30.5 deg, 24 deg at worst), ": the least phase margin of all loops, if it is
/// below the margin of a sound loop.
std::string margin_words(const analysis::DesignStudy& s) {
  constexpr double tenth_of_a_degree = 0.1;
  double nominal = HUGE_VAL, worst = HUGE_VAL;
  const bool sensed = s.design.lag.delay_s() > 0.0;
  for (const auto& loop : s.design.loops) {
    const auto& phase = loop.figures.phase_rad;
    if (phase) nominal = std::min(nominal, *phase);
    if (sensed && loop.built.phase_rad) nominal = std::min(nominal, *loop.built.phase_rad);
  }
  nominal *= 180.0 / sixstep::base::pi;
  if (!(nominal < sixstep::design::least_phase_deg - tenth_of_a_degree)) return "";
  if (s.robustness)
    for (const RobustFigure& f : s.robustness->phases) worst = std::min(worst, f.worst);
  return fmt::format("with little phase margin ({}{}), ", quantity_text(nominal, "deg", 3),
                     worst < nominal ? fmt::format(", {} at worst", quantity_text(worst, "deg", 3)) : "");
}

/// The conditions of the verdict.
std::string conditions(const analysis::DesignStudy& s) {
  const DriveDesign& d = s.design;
  const Motion motion = sixstep::design::motion_of(d.motor);
  std::string text = d.spec.rotor.shaft.kind != sixstep::design::ShaftSensorKind::none
                         ? "with the " + sixstep::design::edges_words(d.spec.rotor)
                     : !d.spec.rotor.hall   ? motion.words("with an ideal rotor sensor")
                     : s.sensorless.empty() ? "with Hall probes"
                                            : "with Hall edges in place of zero crossings";
  if (d.spec.rotor.hall && d.loops.size() > 1 && d.spec.mode == Mode::speed)
    text += fmt::format(", down to {}",
                        quantity_text(d.lowest_speed_rad_s, std::string(motion.unit("rad/s").linear), 3));
  return text + (s.robustness ? fmt::format(", over {} motors within the tolerances", s.robustness->runs)
                              : ", tolerances not simulated");
}

}  // namespace

study::ComparisonResult as_shown(study::ComparisonResult c, const study::Scenario& scenario) {
  double height = std::fabs(scenario.reference.value);
  for (const double value : scenario.reference.values) height = std::max(height, std::fabs(value));
  height *= study::unit_in(scenario, study::reference_unit(scenario.control.mode)).factor;
  const bool of_the_reference =
      c.unit == study::unit_in(scenario, study::reference_unit(scenario.control.mode)).linear;
  if (of_the_reference && std::fabs(c.value) <= 1e-9 * height) c.value = 0.0;
  c.measured = sixstep::analysis::as_read(c, scenario);
  return c;
}

std::string design_verdict(const analysis::DesignStudy& s) {
  const std::string mode = s.design.loops.back().name;
  std::string text = s.warnings.empty() ? "good"
                     : s.usable()       ? "usable, " + margin_words(s) + counted(s.warnings.size(), "warning")
                                        : "NOT USABLE";
  if (!s.usable())
    for (const auto& w : s.warnings)
      if (w.grave) return text + ": " + w.what;
  const auto *settling = find(s, "settling time"), *overshoot = find(s, "overshoot");
  if (settling && (!std::isfinite(settling->measured) || sixstep::analysis::drowned(s))) {
    text += fmt::format(": the settling time of the {} loop cannot be measured", mode);
  } else if (settling) {
    text += fmt::format(": the {} loop settles within {:g} % in {}", mode, settled_percent(s),
                        quantity_text(settling->measured, "s", 4));
    text += at_worst(s, "settling time", settling->measured, 4);
    if (s.design.loops.back().placed)
      text += fmt::format(" (designed: {}{})", quantity_text(settling->value, "s", 4), band_reason(s));
  }
  if (overshoot) {
    const double measured = sixstep::analysis::as_read(*overshoot, s.scenario);
    text += measured == 0.0 ? ", no overshoot" : ", overshoot " + quantity_text(measured, overshoot->unit, 3);
    text += at_worst(s, "overshoot", measured, 3);
  }
  if (const auto* swing = find(s, analysis::swing_at_target))
    text += ", then swings by " + quantity_text(swing->measured, swing->unit, 3) +
            at_worst(s, analysis::swing_at_target, swing->measured, 3);
  return text + "; " + conditions(s);
}

std::string design_text(const analysis::DesignStudy& s, bool colour) {
  std::string verdict = design_verdict(s);
  if (colour) verdict = fmt::format("\x1b[{}m{}\x1b[0m", s.usable() ? "32" : "31;1", verdict);
  const Motion motion = sixstep::design::motion_of(s.design.motor);
  std::string text = verdict + "\n\n" + designed_motor_line(s.design, s.scenario) + beliefs_text(s.beliefs);
  for (const LoopDesign& loop : s.design.loops) text += loop_text(loop, motion);
  if (s.position) text += position_text(*s.position, motion);
  text += figures_text(s.design) + sensing_text(s.design) + sensorless_text(s.sensorless) +
          limits_text(s.design, s.scenario.sheet) + simulated_text(s);
  if (s.robustness) text += robust_text(*s.robustness, s.design);
  if (!s.warnings.empty()) text += "\nWarnings\n";
  for (const auto& w : s.warnings)
    text += fmt::format("  - {}{}\n{}", w.grave ? "GRAVE: " : "", visible(w.what),
                        w.cure.empty() ? "" : fmt::format("    {}\n", visible(w.cure)));
  return text;
}

std::vector<std::string> design_lines(const analysis::DesignStudy& s, bool of_a_board) {
  const Motion motion = sixstep::design::motion_of(s.design.motor);
  const sixstep::base::LinearUnit gain = motion.unit("rad/s per deg");
  std::vector<std::string> lines;
  for (const LoopDesign& loop : s.design.loops) {
    std::string line = fmt::format("{} loop, {}: ", loop.name, loop.method);
    line += loop.name == "position"
                ? fmt::format("{} {}", sixstep::base::six_digits(loop.gains.d1 * gain.factor), gain.linear)
                : fmt::format("d1 = {}, d0 = {} {}", sixstep::base::six_digits(loop.gains.d1),
                              sixstep::base::six_digits(loop.gains.d0), gain_unit(loop.name, motion));
    lines.push_back(line);
  }
  if (!of_a_board && s.scenario.bridge.dead_time_s == analysis::usual_dead_time_s)
    lines.push_back(
        "bridge.dead_time_s: the design used 0.5 us, the usual value of small bridges; write the value of your gate drivers");
  return lines;
}

}  // namespace text
