// SPDX-License-Identifier: Apache-2.0
#include "report/wiring_page.hpp"

#include <fmt/format.h>

#include <cmath>
#include <report_assets.hpp>

#include "report/commutation_picture.hpp"
#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/parameters.hpp"
#include "report/shell.hpp"
#include "report/wiring_grid.hpp"
#include "report/wiring_picture.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "text/results/wiring_words.hpp"

namespace report {
namespace {

namespace analysis = sixstep::analysis;
using analysis::WiringCase;
using analysis::WiringDoes;
using analysis::WiringStudy;

std::string percent(double part) {
  return plain(static_cast<double>(std::lround(100 * part)), 3, true) + "\u00a0%";
}

std::string recipe() {
  std::string rows;
  for (const auto& [seen, step] : text::recipe_steps())
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escaped(seen), escaped(step));
  return "<table>" + table_head({"Symptom", "Cure"}) + "<tbody>\n" + rows +
         "</tbody></table>\n<p class=\"notes\">" + escaped(text::recipe_note()) + "</p>\n";
}

std::string table(const WiringStudy& s) {
  std::string rows;
  for (const WiringCase& c : s.cases) {
    const analysis::Symptom seen = s.symptom(c);
    std::string cures;
    for (const analysis::Cure& cure : c.cures)  // of the three equivalent cures with four wires, one is
                                                // printed
      if (cures.empty() || cure.wires() < 4) cures += (cures.empty() ? "" : "; or ") + text::cure_text(cure);
    const bool runs = analysis::direction_of(c.measured.does) != 0;
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td>{}{}{}{}<td>{}</td></tr>\n",
        text::phases_word(c.wiring), text::hall_lines_word(c.wiring), text::does_text(c.theory.does),
        c.agrees() ? "the same" : text::does_text(c.measured.does), number_cell(percent(c.theory.part)),
        number_cell(percent(c.measured.part)),
        number_cell(runs ? escaped(text::wiring_speed_text(s, seen.speed_rad_s)) : "–"),
        number_cell(escaped(computed(seen.phase_rms_A, "A"))), escaped(cures));
  }
  const sixstep::base::Motion motion = sixstep::design::motion_of(s.subject.sheet);
  return "<table>" +
         motion.words(table_head({"Phases at a, b, c", "Probes at H1, H2, H3", "Theory", "Simulation",
                                  "#Torque per A,<br>theory", "#simulated", "#Speed", "#Phase rms",
                                  "Fewest wires to move"})) +
         "<tbody>\n" + rows + "</tbody></table>\n";
}

std::string symptoms(const WiringStudy& s) {
  std::string rows;
  for (const WiringDoes does : text::told_order()) {
    const WiringCase* const example = s.example(does);
    if (!example) continue;
    const analysis::Symptom here = s.symptom(does);
    const bool runs = analysis::direction_of(does) != 0;
    rows +=
        fmt::format("<tr><th scope=\"row\">{}</th>{}{}{}{}{}{}{}<td>{}</td></tr>\n", text::does_text(does),
                    number_cell(fmt::format("{}", here.ways)),
                    number_cell(runs ? percent(example->theory.least_part) : "–"),
                    number_cell(percent(example->theory.idle_current_part)),
                    number_cell(runs ? escaped(text::wiring_speed_text(s, here.speed_rad_s)) : "–"),
                    number_cell(escaped(computed(here.phase_rms_A, "A"))),
                    number_cell(escaped(computed(here.peak_A, "A"))),
                    number_cell(escaped(computed(here.supply_A, "A"))), escaped(text::symptom_text(s, does)));
  }
  const sixstep::base::Motion motion = sixstep::design::motion_of(s.subject.sheet);
  return "<table>" +
         motion.words(table_head({"", "#Ways", "#Least torque,<br>theory",
                                  "#No-load current, part of<br>stalled current, theory", "#Speed",
                                  "#Phase rms", "#Peak", "#Supply", "Symptom"})) +
         "<tbody>\n" + rows + "</tbody></table>\n";
}

}  // namespace

std::string render_wiring(const WiringPageInput& in) {
  const WiringStudy& s = in.study;
  const bool all = s.agreeing() == s.cases.size();
  const std::string title = escaped(s.subject.sheet.name);
  const Panel grid = wiring_grid(s);
  const sixstep::base::Motion motion = sixstep::design::motion_of(s.subject.sheet);
  const std::string body = filled(
      assets::wiring_html(),
      {{"title", title},
       {"subtitle", escaped(text::bench_text(s))},
       {"class", all ? "pass" : "fail"},
       {"word", fmt::format("{} of {}", s.agreeing(), s.cases.size())},
       {"line", "move in simulation as theory predicts"},
       {"grid",
        in_figure(
            grid,
            motion.words("Torque of each wiring over an electrical turn, and its motion from six starts"))},
       {"cards", in_figure(wiring_cards(s, grid.height), "Symptoms of each kind at the bench")},
       {"recipe", recipe()},
       {"commutation",
        in_figure(commutation_picture(s), "Hall lines, back-EMF and legs over an electrical turn")},
       {"table", table(s)},
       {"symptoms", symptoms(s)},
       {"sheet", sheet_section(s.subject.sheet)},
       {"model", model_section(s.bench.motor)},
       {"scenario", escaped(in.scenario)}});
  return in_shell({.title = "Wirings · " + title,
                   .body = fmt::format("<style>{}</style>\n", wiring_style()) + body,
                   .command = in.command,
                   .version = in.version});
}

}  // namespace report
