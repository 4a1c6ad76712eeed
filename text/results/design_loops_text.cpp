// SPDX-License-Identifier: Apache-2.0
#include "text/results/design_loops_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/design/thesis/thesis_figures.hpp"
#include "text/results/quantity_text.hpp"
#include "text/results/text_rows.hpp"

namespace text {
namespace {

using sixstep::base::Motion;
using sixstep::design::DerivationStep;
using sixstep::design::DriveDesign;
using sixstep::design::LoopDesign;

std::string degrees_text(double rad) { return fmt::format("{:.1f} deg", rad * 180 / sixstep::base::pi); }
std::string hertz(double rad_s) { return quantity_text(rad_s / (2 * sixstep::base::pi), "Hz", 4); }

std::string or_none(const std::optional<double>& x, std::string (*shown)(double)) {
  return x ? shown(*x) : "-";
}

bool bands_differ(const DriveDesign& d) { return sixstep::design::settling_band(d) != 0.02; }

std::string band_words(const DriveDesign& d, const LoopDesign& loop) {
  return fmt::format(" to {:g} %", 100 * settling_band(d, loop));
}

}  // namespace

std::string gain_unit(std::string_view loop, const Motion& motion) {
  return loop.starts_with("current") ? "V/A" : motion.words("of the torque limit per rad/s");
}

std::string loop_text(const LoopDesign& loop, const Motion& motion) {
  Rows rows;
  bool thesis = false;
  for (const DerivationStep& step : loop.steps) {
    std::vector<std::string> cells{step.symbol, quantity_text(step.value, step.unit, 6), step.formula};
    if (loop.placed)
      if (const auto printed = sixstep::design::thesis_figure(loop.name, *loop.placed, step.symbol)) {
        cells.push_back("thesis " + sixstep::base::six_digits(*printed));
        thesis = true;
      }
    rows.add(std::move(cells));
  }
  std::string head = fmt::format("\n{} loop, {}", loop.name, loop.method);
  head[1] = static_cast<char>(head[1] - 'a' + 'A');
  std::string text = head + "\n" + rows.text();
  if (loop.name != "position")
    text += fmt::format("  -> d1 = {}, d0 = {} {}; K = {}, K_i = {} per sample\n",
                        sixstep::base::six_digits(loop.gains.d1), sixstep::base::six_digits(loop.gains.d0),
                        gain_unit(loop.name, motion), sixstep::base::six_digits(loop.gains.d1),
                        sixstep::base::six_digits(loop.gains.d1 + loop.gains.d0));
  if (thesis)
    text +=
        "  (the thesis computes the gains from its printed poles, which give a faster loop than the thesis requires)\n";
  return text;
}

std::string beliefs_text(const std::vector<std::string>& costs) {
  std::string text;
  for (const std::string& cost : costs) text += fmt::format("  - {}\n", visible(cost));
  return text.empty() ? text : "\nCosts of wrong beliefs\n" + text;
}

std::string figures_text(const DriveDesign& d) {
  Rows rows;
  std::vector<std::string> head{"loop"};
  for (const LoopDesign& loop : d.loops) head.push_back(loop.name);
  rows.add(head);
  const auto line = [&](const std::string& name, auto cell) {
    std::vector<std::string> cells{name};
    for (const LoopDesign& loop : d.loops) cells.push_back(cell(loop));
    rows.add(std::move(cells));
  };
  const std::string sooner = d.spec.sooner_periods() > 0.0
                                 ? "command " + sixstep::design::late_words(d.spec.sooner_periods())
                                 : "no computation delay",
                    later = sixstep::design::late_words(d.spec.later_periods());
  const auto factor = +[](double x) { return fmt::format("{:.2f}", x); };
  const auto decibels = +[](double x) { return fmt::format("{:.1f} dB", 20 * std::log10(x)); };
  const auto seconds = +[](double s) { return quantity_text(s, "s", 3); };
  line("crossover", [&](const LoopDesign& l) { return or_none(l.figures.crossover_rad_s, hertz); });
  if (d.loops.size() > 1) {
    std::vector<std::string> cells{"ratio of the crossovers"};
    for (std::size_t n = 0; n + 1 < d.loops.size(); ++n) {
      const auto &inner = d.loops[n].figures.crossover_rad_s, &outer = d.loops[n + 1].figures.crossover_rad_s;
      cells.push_back(inner && outer ? fmt::format("{:.1f}", *inner / *outer) : "-");
    }
    rows.add(std::move(cells));
  }
  line("bandwidth, -3 dB", [&](const LoopDesign& l) { return or_none(l.figures.bandwidth_rad_s, hertz); });
  line("phase margin, " + sooner,
       [&](const LoopDesign& l) { return or_none(d.sooner(l).phase_rad, degrees_text); });
  line("phase margin, " + later,
       [&](const LoopDesign& l) { return or_none(d.later(l).phase_rad, degrees_text); });
  line("gain margin, " + later, [&](const LoopDesign& l) { return or_none(d.later(l).gain, decibels); });
  line("delay margin, " + later, [&](const LoopDesign& l) { return or_none(d.later(l).delay_s, seconds); });
  line("peak of sensitivity, " + later, [&](const LoopDesign& l) {
    return d.later(l).stable ? factor(d.later(l).sensitivity_peak) : "unstable";
  });
  const bool sensed = d.lag.delay_s() > 0;
  if (sensed) {
    const std::string with = " with the speed's sensor";
    line("phase margin" + with,
         [&](const LoopDesign& l) { return or_none(l.built.phase_rad, degrees_text); });
    line("crossover" + with, [&](const LoopDesign& l) { return or_none(l.built.crossover_rad_s, hertz); });
    line("bandwidth" + with, [&](const LoopDesign& l) { return or_none(l.built.bandwidth_rad_s, hertz); });
    line("gain margin" + with, [&](const LoopDesign& l) { return or_none(l.built.gain, decibels); });
    line("delay margin" + with, [&](const LoopDesign& l) { return or_none(l.built.delay_s, seconds); });
    line("peak of sensitivity" + with,
         [&](const LoopDesign& l) { return l.built.stable ? factor(l.built.sensitivity_peak) : "unstable"; });
  }
  const bool two = bands_differ(d);
  line(two ? "step: settling" : "step: settling to 2 %", [&](const LoopDesign& l) {
    return quantity_text(l.step.settling_s, "s", 4) + (two ? band_words(d, l) : "");
  });
  line("step: overshoot", [&](const LoopDesign& l) {
    return std::isfinite(l.step.overshoot) ? fmt::format("{:.1f} %", 100 * l.step.overshoot)
                                           : "without bound";
  });
  return std::string("\nLoops, including the PWM's hold and the inner loops") +
         (sensed ? "; with an ideal speed, except in lines that name the speed's sensor\n" : "\n") +
         rows.text();
}

std::string sensing_text(const DriveDesign& d) {
  if (d.sensing.empty()) return "";
  const std::string speed_unit(sixstep::design::motion_of(d.motor).unit("rad/s").linear);
  Rows steps;
  for (const DerivationStep& step : d.sensing)
    steps.add({step.symbol, quantity_text(step.value, step.unit, 6), step.formula});
  Rows table;
  std::vector<std::string> head{"sensor"};
  const std::size_t speeds = sixstep::design::speeds_in(d.limits);
  for (std::size_t n = 0; n < speeds; ++n)
    head.push_back("down to " + quantity_text(d.limits[n].lowest_speed_rad_s, speed_unit, 3));
  table.add(head);
  for (std::size_t n = 0; n < d.limits.size(); n += speeds) {
    std::vector<std::string> cells{sixstep::design::edges_words(d.limits[n].sensing)};
    for (std::size_t k = n; k < n + speeds; ++k)
      cells.push_back(d.limits[k].settle_s ? quantity_text(*d.limits[k].settle_s, "s", 3) : "none");
    table.add(std::move(cells));
  }
  const std::string words = sixstep::design::edges_words(d.spec.rotor);
  return (d.spec.rotor.hall ? "\nSpeed from Hall edges, " + words.substr(6) : "\nSpeed from the " + words) +
         "\n" + steps.text() +
         "\nFastest settling time with 45 degrees of phase margin in the speed loop, for each lowest speed\n" +
         table.text();
}

std::string sensorless_text(const std::vector<sixstep::design::DerivationStep>& steps) {
  if (steps.empty()) return "";
  Rows rows;
  for (const DerivationStep& step : steps)
    rows.add({step.symbol, quantity_text(step.value, step.unit, 6), step.formula});
  return "\nWithout a rotor sensor: threshold, lowest speed, start, highest speed\n" + rows.text() +
         "  the runs of this design use Hall edges in place of zero crossings; run the scenario to simulate the start\n";
}

/// A sentence on a nominal speed above the speed that commutation allows.
std::string nominal_above(const DriveDesign& d, const sixstep::design::Sheet& sheet) {
  if (!sheet.nominal_speed_rpm) return "";
  const double nominal = sheet.nominal_speed_rpm->value / sixstep::base::rpm_per_rad_s;
  return nominal > d.commutation_limit_rad_s
             ? fmt::format(
                   "; the sheet's nominal speed, {:.3g} rad/s, is above this speed; sixstep curve shows the speed that the model reaches",
                   nominal)
             : "";
}

std::string limits_text(const DriveDesign& d, const sixstep::design::Sheet& sheet) {
  std::string text = fmt::format(
      "\nLimits at the nominal current of {}{}\n"
      "  current ripple      {} peak to peak at worst (duty {}); below a mean current of {} {}\n",
      quantity_text(d.nominal_current_A, "A"),
      d.nominal_printed ? "" : ", a tenth of the stall current, because the sheet names no nominal current",
      quantity_text(d.ripple.worst_A, "A", 3), d.ripple.worst_duty,
      quantity_text(d.ripple.continuous_above_A, "A", 3),
      d.spec.chopping == sixstep::control::Chopping::complementary ? "the current reverses within each period"
                                                                   : "the current is discontinuous");
  const Motion motion = sixstep::design::motion_of(d.motor);
  // The speeds of rotary motors are hundreds of rad/s. The speeds of linear motors are about 1 m/s and need
  // digits after the point.
  const auto speed = [&](double w, int decimals) {
    return motion.linear ? fmt::format("{:.4g}", w) : fmt::format("{:.{}f}", w, decimals);
  };
  text += "  voltage left        ";
  for (int n = 0; n <= 4; ++n) {
    const double w = d.bus_V / d.motor.K_t_Nm_A * n / 4;
    text += fmt::format("{}{:.1f} V at {}", n ? ", " : "",
                        sixstep::design::headroom_V(d.motor, d.bus_V, d.nominal_current_A, w), speed(w, 0));
  }
  text += motion.words(
      fmt::format(" rad/s; none above {} rad/s, without commutation time (sixstep curve includes it)\n",
                  speed(d.headroom_end_rad_s, 0)));
  const std::string held = fmt::format(
      "{:.3g} E + 3 R i = U (E: a phase's back-EMF, R: a phase's resistance, i: motor current, U: bus voltage)",
      sixstep::design::commutation_emfs(d.motor.machine));
  text +=
      d.commutation_limit_rad_s > 0
          ? motion.words(
                fmt::format("  commutation         a duty step holds the torque up to {} rad/s, from {}{}\n",
                            speed(d.commutation_limit_rad_s, 1), held, nominal_above(d, sheet)))
          : motion.words(fmt::format(
                "  commutation         at no speed can a step of the duty keep the torque constant during commutation: 3 R i is not below U in {}\n",
                held));
  if (d.spec.chopping == sixstep::control::Chopping::soft)
    text += motion.words(fmt::format(
        "  braking, soft       the braking current is held up to {} rad/s = i R_tt/K_t (R_tt: terminal resistance)\n",
        speed(d.braking_limit_rad_s, 1)));
  text += fmt::format("  control period      up to {} for 45 degrees of phase margin with {} of delay\n",
                      quantity_text(d.longest_period_s, "s", 3),
                      sixstep::design::periods_words(d.spec.later_periods()));
  return text;
}

}  // namespace text
