// SPDX-License-Identifier: Apache-2.0
#include "report/design_page.hpp"

#include <fmt/format.h>
#include <report_assets.hpp>

#include <cmath>

#include "report/design_charts.hpp"
#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/parameters.hpp"
#include "report/shell.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/design/thesis/thesis_figures.hpp"
#include "text/results/design_loops_text.hpp"
#include "text/results/design_text.hpp"

namespace report {
namespace {

using sixstep::analysis::DesignStudy;
using sixstep::analysis::RobustFigure;
using sixstep::design::LoopDesign;

std::string shown(double x, const std::string& unit) {
  if (std::isfinite(x)) return escaped(computed(x, unit));
  return unit == "s" ? "never" : "–";
}

std::string warnings(const DesignStudy& s) {
  std::string out;
  for (const auto& w : s.warnings)
    out += fmt::format("<p class=\"{}\">{}<b>{}.</b>{}</p>\n", w.grave ? "alert" : "notes",
                       w.grave ? "Grave: " : "", escaped(w.what),
                       w.cure.empty() ? "" : " " + escaped(w.cure) + ".");
  return out;
}

std::string simulated(const DesignStudy& s) {
  std::string out = "<table class=\"comparisons\">" +
                    table_head({"Figure", "#Expected", "#Simulated", "#Deviation", "Expected is"}) +
                    "<tbody>\n";
  for (const auto& told : s.outcome.comparisons) {
    const auto c = text::as_shown(told, s.scenario);
    out += fmt::format("<tr><th scope=\"row\">{}</th>{}{}{}<td class=\"source\">{}</td></tr>\n",
                       escaped(c.figure), number_cell(shown(c.value, c.unit)),
                       number_cell(shown(c.measured, c.unit)),
                       number_cell(escaped(deviation(c.measured, c.value, c.unit))), escaped(c.source));
  }
  return out + "</tbody></table>\n";
}

/// The table of the gains from the derivation; a position loop has one gain.
std::string gain_table(const DesignStudy& s) {
  const sixstep::base::Motion motion = motion_of(s.design.motor);
  const sixstep::base::LinearUnit gain = motion.unit("rad/s per deg");
  std::string rows;
  for (const LoopDesign& loop : s.design.loops) {
    const bool one = loop.name == "position";
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th>{}{}<td>{}</td><td>{}</td></tr>\n", escaped(loop.name),
        number_cell(one ? plain(loop.gains.d1 * gain.factor, 6, true) + "\u00a0" + std::string(gain.linear)
                        : plain(loop.gains.d1, 6, true)),
        number_cell(one ? "–" : plain(loop.gains.d0, 6, true)),
        one ? std::string() : escaped(text::gain_unit(loop.name, motion)), escaped(loop.method));
  }
  return "<table>" + table_head({"Loop", "#d<sub>1</sub>", "#d<sub>0</sub>", "Unit", "Method"}) +
         "<tbody>\n" + rows + "</tbody></table>\n";
}

std::string steps(const LoopDesign& loop) {
  bool thesis = false;
  std::string rows;
  for (const auto& step : loop.steps) {
    const Scale scale = scale_for(step.value, step.unit);
    std::string printed;
    if (loop.placed)
      if (const auto value = sixstep::design::thesis_figure(loop.name, *loop.placed, step.symbol)) {
        printed = plain(*value, 6, true);
        thesis = true;
      }
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"formula\">{}</td>{}{}</tr>\n",
                        typeset(step.symbol), typeset(step.formula),
                        number_cell(plain(step.value * scale.factor, 6, true) +
                                    (scale.unit.empty() ? "" : "\u00a0") + escaped(scale.unit)),
                        number_cell(printed));
  }
  return fmt::format(
      "<div class=\"loop\"><h3>{} loop</h3><p class=\"origin\">{}</p>\n<table class=\"steps\">{}<tbody>{}"
      "</tbody></table></div>\n",
      escaped(loop.name), escaped(loop.method),
      table_head({"Step", "Formula", "#Value", thesis ? "#Thesis" : "#"}), rows);
}

std::string margins(const DesignStudy& s) {
  std::string out = "<table><thead><tr><th>Loop</th>";
  for (const LoopDesign& loop : s.design.loops) out += "<th class=\"num\">" + escaped(loop.name) + "</th>";
  out += "</tr></thead><tbody>\n";
  const sixstep::design::DesignSpec& spec = s.design.spec;
  const std::string later = sixstep::design::late_words(spec.later_periods());
  const auto row = [&](const std::string& name, auto value) {
    out += fmt::format("<tr><th scope=\"row\">{}</th>", name);
    for (const LoopDesign& loop : s.design.loops) out += number_cell(value(loop));
    out += "</tr>\n";
  };
  const auto in = [](const std::optional<double>& x, double factor, const char* unit) {
    return x ? escaped(computed(*x * factor, unit)) : std::string("–");
  };
  constexpr double degrees = 180 / sixstep::base::pi, hertz = 1 / (2 * sixstep::base::pi);
  row("crossover", [&](const LoopDesign& l) { return in(l.figures.crossover_rad_s, hertz, "Hz"); });
  row("bandwidth, −3 dB", [&](const LoopDesign& l) { return in(l.figures.bandwidth_rad_s, hertz, "Hz"); });
  row("phase margin, command " + sixstep::design::late_words(spec.sooner_periods()),
      [&](const LoopDesign& l) { return in(s.design.sooner(l).phase_rad, degrees, "deg"); });
  row("phase margin, " + later,
      [&](const LoopDesign& l) { return in(s.design.later(l).phase_rad, degrees, "deg"); });
  row("gain margin, " + later, [&](const LoopDesign& l) {
    const auto& gain = s.design.later(l).gain;
    return gain ? plain(20 * std::log10(*gain), 3) + "\u00a0dB" : std::string("–");
  });
  row("delay margin, " + later, [&](const LoopDesign& l) { return in(s.design.later(l).delay_s, 1, "s"); });
  row("peak of sensitivity, " + later, [&](const LoopDesign& l) {
    return s.design.later(l).stable ? plain(s.design.later(l).sensitivity_peak, 3) : std::string("unstable");
  });
  if (s.design.lag.delay_s() > 0) {
    const std::string with = " with the speed’s sensor";
    row("phase margin" + with, [&](const LoopDesign& l) { return in(l.built.phase_rad, degrees, "deg"); });
    row("crossover" + with, [&](const LoopDesign& l) { return in(l.built.crossover_rad_s, hertz, "Hz"); });
    row("bandwidth" + with, [&](const LoopDesign& l) { return in(l.built.bandwidth_rad_s, hertz, "Hz"); });
    row("gain margin" + with, [&](const LoopDesign& l) {
      return l.built.gain ? plain(20 * std::log10(*l.built.gain), 3) + "\u00a0dB" : std::string("–");
    });
    row("delay margin" + with, [&](const LoopDesign& l) { return in(l.built.delay_s, 1, "s"); });
    row("peak of sensitivity" + with, [&](const LoopDesign& l) {
      return l.built.stable ? plain(l.built.sensitivity_peak, 3) : std::string("unstable");
    });
  }
  const bool two = sixstep::design::settling_band(s.design) != 0.02;
  row(two ? "step: settling" : "step: settling to 2 %", [&](const LoopDesign& l) {
    return shown(l.step.settling_s, "s") +
           (two ? " to " + plain(100 * settling_band(s.design, l), 3) + " %" : "");
  });
  row("step: overshoot", [&](const LoopDesign& l) {
    return std::isfinite(l.step.overshoot) ? plain(100 * l.step.overshoot, 3) + " %" : "without bound";
  });
  return out + "</tbody></table>\n";
}

/// The table of the speed measurement's delay and the fastest possible loop, for each kind of sensor.
std::string sensing(const DesignStudy& s) {
  const sixstep::design::DriveDesign& d = s.design;
  if (d.limits.empty()) return "";
  std::vector<std::string> heads{"Sensor"};
  const std::size_t speeds = sixstep::design::speeds_in(d.limits);
  for (std::size_t n = 0; n < speeds; ++n)
    heads.push_back("#down to " +
                    computed(d.limits[n].lowest_speed_rad_s, motion_of(d.motor).unit("rad/s").linear));
  std::string rows;
  for (std::size_t n = 0; n < d.limits.size(); n += speeds) {
    rows += "<tr><th scope=\"row\">" + escaped(edges_words(d.limits[n].sensing)) + "</th>";
    for (std::size_t k = n; k < n + speeds; ++k)
      rows += number_cell(d.limits[k].settle_s ? computed(*d.limits[k].settle_s, "s") : "–");
    rows += "</tr>\n";
  }
  std::string table = "<table><thead><tr>";
  for (const std::string& text : heads)
    table +=
        text[0] == '#' ? "<th class=\"num\">" + escaped(text.substr(1)) + "</th>" : "<th>" + text + "</th>";
  return fmt::format(
      "<h3>Fastest settling time of the speed loop</h3><p class=\"origin\">with 45 degrees of phase margin, for "
      "each lowest speed; at this design's lowest speed the measured speed is {} old</p>\n{}</tr></thead><tbody>\n{}</tbody></table>\n",
      escaped(computed(d.lag.delay_s(), "s")), table, rows);
}

/// The derivations of the speed measurement's delay, and of a drive without a rotor position sensor.
std::string sensing_steps(const DesignStudy& s) {
  const bool linear = s.design.motor.kind == sixstep::design::MotorKind::linear;
  const auto loop = [&](const std::string& title, const char* origin, const auto& steps) {
    if (steps.empty()) return std::string();
    return fmt::format("<div class=\"loop\"><h3>{}</h3><p class=\"origin\">{}</p>\n{}</div>\n",
                       escaped(title), origin, derivation_table(steps, linear));
  };
  return loop("Speed from " + edges_words(s.design.spec.rotor), "delay and resolution", s.design.sensing) +
         loop("Without a rotor sensor", "the runs of this design use Hall edges in place of zero crossings",
              s.sensorless);
}

std::string robust_row(const RobustFigure& f) {
  return fmt::format("<tr><th scope=\"row\">{}</th>{}{}<td>{}</td><td>{}</td></tr>\n",
                     with_subscripts(f.figure), number_cell(shown(f.nominal, f.unit)),
                     number_cell(shown(f.worst, f.unit)), with_subscripts(f.at),
                     f.culprit.empty() ? "" : with_subscripts(f.culprit) + ": " + shown(f.alone, f.unit));
}

std::string tolerances(const DesignStudy& s) {
  if (!s.robustness) return "";
  std::string out = fmt::format(
      "<h2>Tolerances</h2><p class=\"origin\">{} motors, the controller as designed; phase margins {}</p>\n"
      "<table>{}<tbody>\n",
      s.robustness->runs, sixstep::design::late_words(s.design.spec.later_periods()),
      table_head({"Figure", "#Nominal", "#Worst", "Where", "Largest effect of one deviation"}));
  for (const RobustFigure& f : s.robustness->figures) out += robust_row(f);
  for (const RobustFigure& f : s.robustness->phases) out += robust_row(f);
  return out + "</tbody></table>\n";
}

}  // namespace

std::string render_design(const DesignPage& page) {
  const DesignStudy& s = page.study;
  std::string derivation;
  for (const LoopDesign& loop : s.design.loops) derivation += steps(loop);
  derivation += sensing_steps(s);
  const std::size_t colon = page.verdict.find(':');
  const std::string word = page.verdict.substr(0, colon),
                    line = colon == page.verdict.npos ? "" : page.verdict.substr(colon + 1);
  const std::string body =
      filled(assets::design_html(),
             {{"title", escaped(s.scenario.title)},
              {"subtitle", escaped(s.scenario.sheet.name) + " · " + escaped(given(s.design.bus_V, "V"))},
              {"standing_class", s.usable() ? "pass" : "fail"},
              {"standing", escaped(word)},
              {"standing_line", escaped(line)},
              {"warnings", warnings(s)},
              {"simulated", simulated(s)},
              {"step_charts", step_charts(s)},
              {"gains", gain_table(s)},
              {"derivation", derivation},
              {"margins", margins(s) + sensing(s)},
              {"loop_charts", loop_charts(s)},
              {"limit_charts", limit_charts(s)},
              {"tolerances", tolerances(s)},
              {"scenario", escaped(page.scenario)}});
  return in_shell({.title = escaped(word + " · " + s.scenario.title),
                   .body = body,
                   .command = page.command,
                   .version = page.version});
}

}  // namespace report
