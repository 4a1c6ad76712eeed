// SPDX-License-Identifier: Apache-2.0
#include "text/results/design_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/thesis/thesis_figures.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/escape/escape.hpp"
#include "text/results/quantity_text.hpp"
#include "text/results/verdict_table.hpp"

namespace text {
namespace {

using sixstep::analysis::RobustFigure;
using sixstep::control::Mode;
using sixstep::design::DerivationStep;
using sixstep::design::DriveDesign;
using sixstep::design::LoopDesign;
using sixstep::design::LoopFigures;

std::string number(double x) { return fmt::format("{:.6g}", x); }
std::string degrees(double rad) { return fmt::format("{:.1f} deg", rad * 180 / sixstep::base::pi); }
std::string hertz(double rad_s) { return quantity_text(rad_s / (2 * sixstep::base::pi), "Hz", 4); }

/// Cells in columns as wide as their widest, no blanks at the end.
class Rows {
 public:
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  std::string text() const {
    std::vector<std::size_t> widths;
    for (const auto& row : rows_)
      for (std::size_t n = 0; n < row.size(); ++n) {
        if (n == widths.size()) widths.push_back(0);
        widths[n] = std::max(widths[n], row[n].size());
      }
    std::string out;
    for (const auto& row : rows_) {
      std::string line = " ";
      for (std::size_t n = 0; n < row.size(); ++n) line += fmt::format(" {:<{}} ", row[n], widths[n]);
      line.erase(line.find_last_not_of(' ') + 1);
      out += line + "\n";
    }
    return out;
  }

 private:
  std::vector<std::vector<std::string>> rows_;
};

const study::ComparisonResult* find(const analysis::DesignStudy& s, const char* figure) {
  for (const auto& c : s.outcome.comparisons)
    if (c.figure == figure) return &c;
  return nullptr;
}

std::string motor_line(const DriveDesign& d, const study::Scenario& s) {
  const auto& m = d.motor;
  const std::string chopping(sixstep::base::word(sixstep::study::chopping_choices, d.spec.chopping));
  return fmt::format(
      "{} on {} V: terminal R = {} ohm, L = {} mH, K_t = {} mNm/A, J = {} g cm2, B = {} N m s\n"
      "control and PWM period {}, {} chopping, a command counts {}\n",
      visible(s.sheet.name.empty() ? s.motor : s.sheet.name), number(d.bus_V), number(2 * m.machine.R_ohm),
      number(2e3 * m.machine.L_H), number(1e3 * m.K_t_Nm_A), number(1e7 * m.shaft.J_kg_m2),
      number(m.shaft.B_Nm_s), quantity_text(d.spec.period_s, "s"), chopping,
      d.spec.delay_periods == 1 ? "one period late" : "at once");
}

std::string gain_unit(const LoopDesign& loop) { return loop.name == "current" ? "V/A" : "per rad/s"; }

std::string loop_text(const LoopDesign& loop) {
  Rows rows;
  bool thesis = false;
  for (const DerivationStep& step : loop.steps) {
    std::vector<std::string> cells{step.symbol, quantity_text(step.value, step.unit, 6), step.formula};
    if (loop.placed)
      if (const auto printed = sixstep::design::thesis_figure(loop.name, *loop.placed, step.symbol)) {
        cells.push_back("thesis " + number(*printed));
        thesis = true;
      }
    rows.add(std::move(cells));
  }
  std::string head = fmt::format("\n{} loop, {}", loop.name, loop.method);
  head[1] = static_cast<char>(head[1] - 'a' + 'A');
  std::string text = head + "\n" + rows.text();
  if (loop.name != "position")
    text += fmt::format("  -> d1 = {}, d0 = {} {}; K = {}, K_i = {} per sample\n", number(loop.gains.d1),
                        number(loop.gains.d0), gain_unit(loop), number(loop.gains.d1),
                        number(loop.gains.d1 + loop.gains.d0));
  if (thesis)
    text +=
        "  (the thesis's gains follow from the poles that it prints; those are a faster loop's than it asks "
        "for)\n";
  return text;
}

std::string or_none(const std::optional<double>& x, std::string (*shown)(double)) {
  return x ? shown(*x) : "-";
}

std::string figures_text(const DriveDesign& d) {
  Rows rows;
  std::vector<std::string> head{"loop"};
  for (const LoopDesign& loop : d.loops) head.push_back(loop.name);
  rows.add(head);
  const auto line = [&](const char* name, auto cell) {
    std::vector<std::string> cells{name};
    for (const LoopDesign& loop : d.loops) cells.push_back(cell(loop));
    rows.add(std::move(cells));
  };
  const bool late = d.spec.delay_periods == 1;
  const auto at_once = [&](const LoopDesign& l) -> const LoopFigures& { return late ? l.other : l.figures; };
  const auto delayed = [&](const LoopDesign& l) -> const LoopFigures& { return late ? l.figures : l.other; };
  const auto factor = +[](double x) { return fmt::format("{:.2f}", x); };
  const auto decibels = +[](double x) { return fmt::format("{:.1f} dB", 20 * std::log10(x)); };
  const auto seconds = +[](double s) { return quantity_text(s, "s", 3); };
  line("crossover", [&](const LoopDesign& l) { return or_none(l.figures.crossover_rad_s, hertz); });
  if (d.loops.size() > 1) {
    std::vector<std::string> cells{"times the loop around it"};
    for (std::size_t n = 0; n + 1 < d.loops.size(); ++n) {
      const auto &inner = d.loops[n].figures.crossover_rad_s, &outer = d.loops[n + 1].figures.crossover_rad_s;
      cells.push_back(inner && outer ? fmt::format("{:.1f}", *inner / *outer) : "-");
    }
    rows.add(std::move(cells));
  }
  line("bandwidth, -3 dB", [&](const LoopDesign& l) { return or_none(l.figures.bandwidth_rad_s, hertz); });
  line("phase margin, command at once",
       [&](const LoopDesign& l) { return or_none(at_once(l).phase_rad, degrees); });
  line("phase margin, one period late",
       [&](const LoopDesign& l) { return or_none(delayed(l).phase_rad, degrees); });
  line("gain margin, one period late",
       [&](const LoopDesign& l) { return or_none(delayed(l).gain, decibels); });
  line("delay margin, one period late",
       [&](const LoopDesign& l) { return or_none(delayed(l).delay_s, seconds); });
  line("peak of sensitivity, one period late", [&](const LoopDesign& l) {
    return delayed(l).stable ? factor(delayed(l).sensitivity_peak) : "unstable";
  });
  if (d.lag.delay_s() > 0)
    line("phase margin with the speed's sensor",
         [&](const LoopDesign& l) { return or_none(l.built.phase_rad, degrees); });
  line(d.lag.delay_s() > 0 ? "step: settling" : "step: settling to 2 %",
       [&](const LoopDesign& l) { return quantity_text(l.step.settling_s, "s", 4); });
  line("step: overshoot",
       [&](const LoopDesign& l) { return fmt::format("{:.1f} %", 100 * l.step.overshoot); });
  return "\nLoops, with the hold of the PWM and the loops within\n" + rows.text();
}

/// What the sensor of the speed costs, and what each way of sensing allows.
std::string sensing_text(const DriveDesign& d) {
  if (d.sensing.empty()) return "";
  Rows steps;
  for (const DerivationStep& step : d.sensing)
    steps.add({step.symbol, quantity_text(step.value, step.unit, 6), step.formula});
  Rows table;
  std::vector<std::string> head{"sensor"};
  for (std::size_t n = 0; n < 3 && n < d.limits.size(); ++n)
    head.push_back("down to " + quantity_text(d.limits[n].lowest_speed_rad_s, "rad/s", 3));
  table.add(head);
  for (std::size_t n = 0; n + 3 <= d.limits.size(); n += 3) {
    std::vector<std::string> cells{sixstep::design::edges_words(d.limits[n].sensing)};
    for (std::size_t k = n; k < n + 3; ++k)
      cells.push_back(d.limits[k].settle_s ? quantity_text(*d.limits[k].settle_s, "s", 3) : "none");
    table.add(std::move(cells));
  }
  return "\nSpeed from Hall edges, " + sixstep::design::edges_words(d.spec.rotor).substr(6) + "\n" +
         steps.text() + "\nFastest settling of the speed loop that keeps 45 degrees of phase\n" +
         table.text();
}

std::string limits_text(const DriveDesign& d) {
  std::string text = fmt::format(
      "\nLimits at the nominal current of {}{}\n"
      "  current ripple      {} peak to peak at worst (duty {}); gaps in the current below {}\n",
      quantity_text(d.nominal_current_A, "A"),
      d.nominal_printed ? "" : ", a tenth of the stall current: the sheet names none",
      quantity_text(d.ripple.worst_A, "A", 3), d.ripple.worst_duty,
      quantity_text(d.ripple.continuous_above_A, "A", 3));
  text += "  voltage left        ";
  for (int n = 0; n <= 4; ++n) {
    const double w = d.bus_V / d.motor.K_t_Nm_A * n / 4;
    text += fmt::format("{}{:.1f} V at {:.0f}", n ? ", " : "",
                        sixstep::design::headroom_V(d.motor, d.bus_V, d.nominal_current_A, w), w);
  }
  text += fmt::format(" rad/s; none above {:.0f} rad/s\n", d.headroom_end_rad_s);
  text += fmt::format("  braking, soft       held up to {:.1f} rad/s, (i/K_t) R\n", d.braking_limit_rad_s);
  text += fmt::format("  control period      up to {} for 45 degrees with one period of delay\n",
                      quantity_text(d.longest_period_s, "s", 3));
  return text;
}

std::string simulated_text(const analysis::DesignStudy& s) {
  Rows rows;
  rows.add({"figure", "expected", "simulated", "", ""});
  for (const auto& c : s.outcome.comparisons)
    rows.add({c.figure, quantity_text(c.value, c.unit),
              quantity_text(sixstep::analysis::as_read(c, s.scenario), c.unit), deviation_text(c), c.source});
  const study::Scenario& n = s.scenario;
  std::string how;
  if (n.control.mode == Mode::current)
    how = fmt::format("rotor held, a step to {} A", number(n.reference.value));
  else if (n.control.mode == Mode::speed)
    how = fmt::format("load {} N m, from rest to {} rad/s, then to {} rad/s", number(n.load.torque_Nm),
                      number(n.reference.values.at(0)), number(n.reference.values.at(1)));
  else
    how = fmt::format("a move of {} deg", number(n.reference.value));
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

std::string robust_text(const analysis::Robustness& r) {
  Rows rows;
  rows.add({"figure", "nominal", "worst", "where", "chiefly"});
  for (const RobustFigure& f : r.figures) add_robust(rows, f, 4);
  for (const RobustFigure& f : r.phases) add_robust(rows, f, 3);
  return fmt::format("\nTolerances, the controller as designed, {} motors (phase margins one period late)\n",
                     r.runs) +
         rows.text();
}

std::string position_text(const analysis::PositionGain& p) {
  std::string text = fmt::format(
      "  found by {} simulations between {} (full torque stops it from top speed) and {} (no limit acts)\n",
      p.runs, number(p.estimate), number(p.linear));
  if (p.gain_rad_s_per_deg < p.nominal)
    text += fmt::format("  the sheet's motor alone would stand {} rad/s/deg; the tolerances do not\n",
                        number(p.nominal));
  return text;
}

std::string counted(std::size_t n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

/// What the motor worst off makes of a figure.
std::string at_worst(const analysis::DesignStudy& s, const char* figure, double nominal, int digits) {
  if (!s.robustness) return "";
  for (const RobustFigure& f : s.robustness->figures)
    if (f.figure == figure && f.worst > nominal)
      return fmt::format(", {} at worst", quantity_text(f.worst, f.unit, digits));
  return "";
}

/// What the verdict holds for.
std::string conditions(const analysis::DesignStudy& s) {
  const DriveDesign& d = s.design;
  std::string text =
      !d.spec.rotor.hall   ? "with an ideal rotor sensor"
      : d.loops.size() < 2 ? "with Hall probes"
      : d.spec.mode == Mode::speed
          ? fmt::format("with Hall probes, down to {}", quantity_text(d.lowest_speed_rad_s, "rad/s", 3))
          : "with Hall probes";
  return text +
         (s.robustness ? fmt::format(", over {} motors", s.robustness->runs) : ", tolerances not looked at");
}

}  // namespace

std::string design_verdict(const analysis::DesignStudy& s) {
  const std::string mode = s.design.loops.back().name;
  std::string text = s.warnings.empty() ? "good"
                     : s.usable()       ? "usable, " + counted(s.warnings.size(), "warning")
                                        : "NOT USABLE";
  if (!s.usable())
    for (const auto& w : s.warnings)
      if (w.grave) return text + ": " + w.what;
  const auto *settling = find(s, "settling time"), *overshoot = find(s, "overshoot");
  if (settling && !std::isfinite(settling->measured)) {
    text += fmt::format(": the {} loop's settling cannot be told", mode);
  } else if (settling) {
    text += fmt::format(": the {} loop settles in {}", mode, quantity_text(settling->measured, "s", 4));
    const auto& placed = s.design.loops.back().placed;
    if (placed) text += fmt::format(" ({} asked for)", quantity_text(placed->settle_s, "s", 4));
    text += at_worst(s, "settling time", settling->measured, 4);
  }
  if (overshoot) {
    const double measured = sixstep::analysis::as_read(*overshoot, s.scenario);
    text += measured == 0.0 ? ", no overshoot" : ", overshoot " + quantity_text(measured, overshoot->unit, 3);
    text += at_worst(s, "overshoot", measured, 3);
  }
  if (const auto* swing = find(s, "swing around the target"))
    text += ", then swings by " + quantity_text(swing->measured, swing->unit, 3) +
            at_worst(s, "swing around the target", swing->measured, 3);
  return text + "; " + conditions(s);
}

std::string design_text(const analysis::DesignStudy& s, bool colour) {
  std::string verdict = design_verdict(s);
  if (colour) verdict = fmt::format("\x1b[{}m{}\x1b[0m", s.usable() ? "32" : "31;1", verdict);
  std::string text = verdict + "\n\n" + motor_line(s.design, s.scenario);
  for (const LoopDesign& loop : s.design.loops) text += loop_text(loop);
  if (s.position) text += position_text(*s.position);
  text += figures_text(s.design) + sensing_text(s.design) + limits_text(s.design) + simulated_text(s);
  if (s.robustness) text += robust_text(*s.robustness);
  if (!s.warnings.empty()) text += "\nWarnings\n";
  for (const auto& w : s.warnings)
    text += fmt::format("  - {}{}\n    {}\n", w.grave ? "GRAVE: " : "", visible(w.what), visible(w.cure));
  return text;
}

std::vector<std::string> design_lines(const analysis::DesignStudy& s) {
  std::vector<std::string> lines;
  for (const LoopDesign& loop : s.design.loops) {
    std::string line = fmt::format("{} loop, {}: ", loop.name, loop.method);
    line += loop.name == "position" ? fmt::format("{} rad/s per deg", number(loop.gains.d1))
                                    : fmt::format("d1 = {}, d0 = {} {}", number(loop.gains.d1),
                                                  number(loop.gains.d0), gain_unit(loop));
    lines.push_back(line);
  }
  return lines;
}

}  // namespace text
