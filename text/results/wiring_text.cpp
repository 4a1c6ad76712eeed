// SPDX-License-Identifier: Apache-2.0
#include "text/results/wiring_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <vector>

#include "sixstep/design/sheet/motion.hpp"
#include "text/escape/escape.hpp"
#include "text/results/quantity_text.hpp"
#include "text/results/text_rows.hpp"
#include "text/results/wiring_words.hpp"

namespace text {
namespace {

using analysis::WiringCase;
using analysis::WiringDoes;
using analysis::WiringStudy;

std::string commutation_text() {
  Rows rows;
  rows.add({"sector", "electrical", "H1 H2 H3", "code", "high", "low", "floating"});
  for (std::uint8_t sector = 0; sector < 6; ++sector) {
    const auto [code, high, low, floating] = analysis::commutation(sector);
    rows.add({fmt::format("{}", sector), fmt::format("{:3}..{:3} deg", 60 * sector, 60 * sector + 60),
              fmt::format(" {}  {}  {}", code >> 2, code >> 1 & 1, code & 1), fmt::format("{}", code),
              std::string(leg_names[high]), std::string(leg_names[low]), std::string(leg_names[floating])});
  }
  return "The drive's commutation, forward; backward swaps high and low\n" + rows.text();
}

/// One row per order of the phases, one column per order of the Hall lines.
std::string grid(const WiringStudy& s, const std::function<std::string(const WiringCase&)>& cell) {
  Rows rows;
  std::vector<std::string> head = {"legs a b c"};
  for (std::size_t n = 0; n < 6; ++n) head.emplace_back(hall_lines_word(s.cases[n].wiring));
  rows.add(head);
  for (std::size_t row = 0; row < 6; ++row) {
    std::vector<std::string> cells = {std::string(phases_word(s.cases[6 * row].wiring))};
    for (std::size_t n = 0; n < 6; ++n) cells.push_back(cell(s.cases[6 * row + n]));
    rows.add(cells);
  }
  return rows.text();
}

std::string share_text(double part) { return fmt::format("{:5} %", std::lround(100 * part)); }

std::string amperes(double A) { return quantity_text(A, "A", 3); }

Rows symptom_rows(const WiringStudy& s, const base::Motion& motion) {
  Rows rows;
  rows.add(
      {"", "ways", motion.words("torque/A"), "theory", "speed", "phase rms", "peak", "supply", "symptom"});
  for (const WiringDoes does : told_order()) {
    const analysis::WiringCase* const example = s.example(does);
    if (!example) continue;
    const analysis::Symptom here = s.symptom(does);
    rows.add({std::string(does_text(does)), fmt::format("{:4}", here.ways), share_text(here.part),
              share_text(example->theory.part),
              analysis::direction_of(does) != 0 ? wiring_speed_text(s, here.speed_rad_s) : "swings",
              amperes(here.phase_rms_A), amperes(here.peak_A), amperes(here.supply_A),
              symptom_text(s, does)});
  }
  return rows;
}

std::string symptoms(const WiringStudy& s, const base::Motion& motion) {
  std::string text = symptom_rows(s, motion).text();
  const analysis::Symptom hum = s.symptom(WiringDoes::hums);
  if (hum.swing_Hz > 0)
    text += motion.words(fmt::format(
        "On average, a humming motor swings by {} at {:.0f} Hz about one of two angles in each electrical turn.\n",
        way_text(s, hum.swing_deg), hum.swing_Hz));
  const WiringCase* const early = s.example(WiringDoes::forward_early);
  if (!early) return text;
  const auto of = [](double part) { return std::lround(100 * part); };
  return text +
         motion.words(fmt::format(
             "Early and late: each pair is driven 60 degrees too early or too late. At every edge the torque falls to {} %.\nWithout a load the motor draws {} % of the stalled current by theory, and {} % with straight wires.\n",
             of(early->theory.least_part), of(early->theory.idle_current_part),
             of(s.cases.front().theory.idle_current_part)));
}

/// Breaks text into lines of at most 118 characters.
std::string broken(std::string_view text) {
  constexpr std::size_t width = 118;
  std::string out;
  while (text.size() > width) {
    const std::size_t end = text.rfind(' ', width);
    out += std::string(text.substr(0, end)) + "\n";
    text.remove_prefix(end + 1);
  }
  return out + std::string(text) + "\n";
}

std::string recipe() {
  std::string text = "If the wires are not labelled\n";
  Rows rows;
  for (const auto& [seen, step] : recipe_steps()) rows.add({std::string(seen), std::string(step)});
  return text + rows.text() + broken(recipe_note());
}

/// Whether theory and measurement agree. The measurement does not use the theory, so that this is a result.
std::string agreement(const WiringStudy& s) {
  if (s.agreeing() == s.cases.size())
    return fmt::format("All {} wirings move in simulation as theory predicts.\n", s.cases.size());
  std::string text;
  for (const WiringCase& c : s.cases)
    if (!c.agrees())
      text += fmt::format("phases {}, Hall lines {}: {} by theory, {} in simulation\n", phases_word(c.wiring),
                          hall_lines_word(c.wiring), does_text(c.theory.does), does_text(c.measured.does));
  return text +
         fmt::format(
             "{} of {} wirings move in simulation as theory predicts; friction or cogging stops the rotor in the other wirings. Give a larger --current.\n",
             s.agreeing(), s.cases.size());
}

}  // namespace

std::string wiring_text(const WiringStudy& s) {
  const base::Motion motion = design::motion_of(s.subject.sheet);
  const std::string columns = " at legs a b c (rows), probes at Hall pins H1 H2 H3 (columns)\n";
  std::string text = visible(s.subject.sheet.name) + "\n\n" + commutation_text() +
                     "\nThe 36 ways to connect the motor: phases" + columns;
  text += grid(s, [](const WiringCase& c) { return std::string(does_text(c.measured.does)); });
  text += agreement(s) + "\n";
  text += "At the bench: " + bench_text(s) + "\n" + symptoms(s, motion);
  text += "\nThe fewest wires to move until the motor runs FORWARD: phases" + columns;
  text += grid(s, [](const WiringCase& c) { return cure_mark(c.cures.front()); });
  text +=
      "b-c: swap the wires at legs b and c; a>b>c: move the wire at a to b, the wire at b to c, the wire at c to a.\n";
  return text + "\n" + recipe();
}

}  // namespace text
