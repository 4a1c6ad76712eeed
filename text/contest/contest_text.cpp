// SPDX-License-Identifier: Apache-2.0
#include "text/contest/contest_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "text/escape/escape.hpp"
#include "text/export/core_costs.hpp"
#include "text/results/quantity_text.hpp"
#include "text/results/text_rows.hpp"

namespace text {
namespace {

using analysis::Contest;
using analysis::contest_figures;
using analysis::ContestFigure;
using analysis::ContestGroup;
using analysis::ContestRow;
using Json = nlohmann::ordered_json;

constexpr std::string_view arithmetic = "float";

std::optional<CoreCost> cost_of(const analysis::Contestant& who) {
  if (!who.tick.empty()) return CoreCost{std::string(who.tick), std::string(who.flash_bytes)};
  return core_cost(contest_core, who.core_drive, arithmetic);
}

std::string name_of(const Contest& c, std::size_t row) { return std::string(c.entries[row].who->name); }

/// The least of a column, where there is one.
double least_of(const Contest& c, std::size_t figure, std::vector<double> ContestRow::*values) {
  double least = std::nan("");
  for (const ContestRow& row : c.rows)
    if (!(row.*values).empty() && row.nominal_held) least = std::fmin(least, (row.*values)[figure]);
  return least;
}

std::string lowest_text(const ContestRow& row) {
  return row.lowest_rad_s ? quantity_text(*row.lowest_rad_s, "rad/s", 3) : "-";
}

std::string table(const Contest& c, ContestGroup group, std::vector<double> ContestRow::*values) {
  const bool nominal = values == &ContestRow::values;
  Rows rows(Rows::Side::left);
  std::vector<std::string> head{"controller"};
  for (const ContestFigure& f : contest_figures)
    if (f.group == group) head.emplace_back(f.name);
  if (group == ContestGroup::moving) {
    head.emplace_back(nominal ? "holds" : "hold");
    if (nominal) head.insert(head.end(), {"lowest", "tick", "flash"});
  }
  rows.add(head);
  for (std::size_t n = 0; n < c.rows.size(); ++n) {
    const ContestRow& row = c.rows[n];
    if (!c.entries[n].scenario || (row.*values).empty()) continue;
    std::vector<std::string> cells{name_of(c, n)};
    for (std::size_t f = 0; f < std::size(contest_figures); ++f) {
      if (contest_figures[f].group != group) continue;
      const double x = (row.*values)[f];
      cells.push_back(contest_value(x, contest_figures[f]) + (x == least_of(c, f, values) ? " *" : ""));
    }
    if (group == ContestGroup::moving) {
      cells.push_back(nominal ? (row.nominal_held ? "yes" : "NO")
                              : fmt::format("{} of {}", row.held, row.drives));
      const auto cost = cost_of(*c.entries[n].who);
      if (nominal) cells.push_back(lowest_text(row));
      if (nominal) cells.insert(cells.end(), {cost ? cost->tick : "-", cost ? cost->flash_bytes : "-"});
    }
    rows.add(cells);
  }
  return rows.text();
}

std::string tables(const Contest& c, std::vector<double> ContestRow::*values) {
  return table(c, ContestGroup::moving, values) + "\n" + table(c, ContestGroup::steady, values);
}

/// In lines that a terminal holds, the later ones further in.
std::string paragraph(const std::string& words) {
  constexpr std::size_t width = 118;
  std::string text, line = "  ";
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    const std::string word = words.substr(at, end - at);
    if (line.find_first_not_of(' ') != std::string::npos && line.size() + 1 + word.size() > width) {
      text += line + "\n";
      line = "    ";
    }
    line += (line.find_first_not_of(' ') == std::string::npos ? "" : " ") + word;
    at = end + 1;
  }
  return text + line + "\n";
}

Json figure_json(double x) {
  if (std::isfinite(x)) return x;
  return std::isinf(x) ? Json("never") : Json(nullptr);
}

Json figures_json(const std::vector<double>& values) {
  Json out = Json::object();
  for (std::size_t f = 0; f < values.size(); ++f)
    out[std::string(contest_figures[f].phrase)] = figure_json(values[f]);
  return out;
}

}  // namespace

std::string contest_value(double x, const ContestFigure& figure) {
  if (std::isnan(x)) return "-";
  if (std::isinf(x)) return "never";
  if (figure.unit == "1") return fmt::format("{:.1f} %", 100 * x);
  return quantity_text(x, std::string(figure.unit), 3);
}

std::vector<std::string> contest_notes(const Contest& c) {
  std::vector<std::string> notes;
  for (std::size_t n = 0; n < c.rows.size(); ++n) {
    const base::Result<study::Scenario>& scenario = c.entries[n].scenario;
    const std::string& problem = c.rows[n].nominal.problem;
    if (!scenario)
      notes.push_back(
          fmt::format("{} is left out: {}", name_of(c, n), base::to_string(scenario.problems().front())));
    else if (!problem.empty())
      notes.push_back(fmt::format("{} stopped: {}", name_of(c, n), problem));
    else if (!c.rows[n].nominal_held)
      notes.push_back(
          fmt::format("{} does not hold the speed that is asked for, and wins nothing", name_of(c, n)));
  }
  return notes;
}

std::string contest_text(const Contest& c) {
  std::string text = fmt::format("{}: {} controllers, designed by rule for\n",
                                 visible(c.bench.scenario.motor), c.entries.size());
  for (const std::string& rule : c.bench.rules) text += "  - " + rule + "\n";
  text += "\n" + tables(c, &ContestRow::values);
  if (c.drives > 0)
    text +=
        fmt::format("\nWorst of the nominal motor and {} drives of the sheet's tolerances\n\n", c.drives) +
        tables(c, &ContestRow::worst);
  text += fmt::format(
      "\n  * least of those that hold the course; lowest: speed still held against the rated torque, by halves; tick, flash: {} {}, instructions at worst and bytes\n\n",
      contest_core, arithmetic);
  for (const std::string& note : contest_notes(c)) text += paragraph(note);
  for (const std::string& line : contest_words(c)) text += paragraph(line);
  return text;
}

std::string contest_csv(const Contest& c) {
  std::string text = "controller,drive,holds,lowest speed [rad/s]";
  for (const ContestFigure& f : contest_figures) text += fmt::format(",{} [{}]", f.phrase, f.unit);
  text += "\n";
  const auto line = [&](std::size_t n, const char* drive, bool holds, const std::vector<double>& values) {
    const bool of_nominal = drive == std::string_view("nominal") && c.rows[n].lowest_rad_s;
    text += fmt::format("\"{}\",{},{},{}", name_of(c, n), drive, holds ? 1 : 0,
                        of_nominal ? fmt::format("{}", *c.rows[n].lowest_rad_s) : "");
    for (const double x : values) text += std::isnan(x) ? "," : fmt::format(",{}", x);
    text += "\n";
  };
  for (std::size_t n = 0; n < c.rows.size(); ++n) {
    const ContestRow& row = c.rows[n];
    line(n, "nominal", row.nominal_held, row.values);
    if (!row.worst.empty()) line(n, "worst", row.nominal_held && row.held == row.drives, row.worst);
  }
  return text;
}

std::string contest_json(const Contest& c) {
  Json json = {
      {"sixstep", SIXSTEP_VERSION}, {"motor", c.bench.scenario.motor}, {"same_for_all", c.bench.rules}};
  for (const ContestFigure& f : contest_figures) json["units"][std::string(f.phrase)] = f.unit;
  json["controllers"] = Json::array();
  for (std::size_t n = 0; n < c.rows.size(); ++n) {
    const analysis::ContestEntry& entry = c.entries[n];
    const ContestRow& row = c.rows[n];
    Json one = {{"name", entry.who->name}, {"is", entry.who->sentence}, {"keys", Json::object()}};
    for (const analysis::ContestKey& key : entry.keys) one["keys"][key.path] = key.value;
    one["runs"] = static_cast<bool>(entry.scenario);
    one["holds"] = row.nominal_held;
    one["nominal"] = figures_json(row.values);
    one["lowest_speed_rad_s"] = row.lowest_rad_s ? Json(*row.lowest_rad_s) : Json(nullptr);
    if (!row.worst.empty()) {
      one["worst"] = figures_json(row.worst);
      one["drives"] = row.drives;
      one["drives_that_hold"] = row.held;
    }
    if (!row.nominal.problem.empty()) one["problem"] = row.nominal.problem;
    if (const auto cost = cost_of(*entry.who))
      one["cost"] = {{"core", contest_core},
                     {"arithmetic", arithmetic},
                     {"tick_instructions", cost->tick},
                     {"flash_bytes", cost->flash_bytes}};
    json["controllers"].push_back(std::move(one));
  }
  json["words"] = contest_words(c);
  json["notes"] = contest_notes(c);
  return json.dump(2) + "\n";
}

}  // namespace text
