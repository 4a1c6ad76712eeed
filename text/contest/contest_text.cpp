// SPDX-License-Identifier: Apache-2.0
#include "text/contest/contest_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>

#include "sixstep/base/written.hpp"
#include "text/escape/csv_cell.hpp"
#include "text/escape/escape.hpp"
#include "text/escape/json_number.hpp"
#include "text/escape/json_text.hpp"
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
using analysis::ContestValues;
using Json = nlohmann::ordered_json;

constexpr std::string_view arithmetic = "float";
constexpr int contest_digits = 3;

std::optional<CoreCost> cost_of(const analysis::Contestant& who) {
  if (!who.tick.empty()) return CoreCost{std::string(who.tick), std::string(who.flash_bytes)};
  return core_cost(contest_core, who.core_drive, arithmetic);
}

std::string controller_name(const Contest& c, std::size_t row) {
  return std::string(c.entries[row].who->name);
}

/// Returns the figures of a row: the figures of the nominal drive (nominal_of), or the worst figures of all
/// drives (worst_of). Null if the row has no such figures.
using FiguresOf = const ContestValues* (*)(const ContestRow& row);
const ContestValues* nominal_of(const ContestRow& row) { return &row.values; }
const ContestValues* worst_of(const ContestRow& row) { return row.worst ? &*row.worst : nullptr; }

/// The least value of a column; NaN if there is none.
double least_of(const Contest& c, std::size_t figure, FiguresOf figures) {
  double least = std::nan("");
  for (std::size_t n = 0; n < c.rows.size(); ++n)
    if (const ContestValues* values = figures(c.rows[n]); values && analysis::may_win(c, n))
      least = std::fmin(least, (*values)[figure]);
  return least;
}

std::string cell_text(double x, const ContestFigure& figure, const SharedPrefix& prefix) {
  const bool alone = !std::isfinite(x) || figure.unit == "1";
  return alone ? contest_value(x, figure) : prefix.text(x, contest_digits);
}

/// The SI prefix that all numbers of a column share.
SharedPrefix column_prefix(const Contest& c, std::size_t figure, FiguresOf figures) {
  std::vector<double> values;
  for (const ContestRow& row : c.rows)
    if (const ContestValues* found = figures(row)) values.push_back((*found)[figure]);
  return {values, std::string(contest_figures[figure].unit)};
}

std::string lowest_text(const ContestRow& row) {
  return row.lowest_rad_s ? quantity_text(*row.lowest_rad_s, "rad/s", 3) : "-";
}

/// A column of a table: its head, and the cell of entry n below it.
struct ContestColumn {
  std::string head;
  std::function<std::string(std::size_t n)> cell;
};

std::vector<ContestColumn> contest_columns(const Contest& c, ContestGroup group, FiguresOf figures) {
  std::vector<ContestColumn> shown{
      {"controller", [&c](std::size_t n) { return visible(controller_name(c, n)); }}};
  for (std::size_t f = 0; f < std::size(contest_figures); ++f)
    if (contest_figures[f].group == group)
      shown.push_back(
          {std::string(contest_figures[f].name), [&c, f, figures, least = least_of(c, f, figures),
                                                  prefix = column_prefix(c, f, figures)](std::size_t n) {
             const double x = (*figures(c.rows[n]))[f];
             const bool wins = x == least && analysis::may_win(c, n);
             const bool plain = !std::isfinite(x) || contest_figures[f].unit == "1";
             return (plain ? contest_value(x, contest_figures[f]) : prefix.text(x, contest_digits)) +
                    (wins ? " *" : "");
           }});
  if (group != ContestGroup::moving) return shown;
  if (figures == worst_of) {
    shown.push_back(
        {"hold", [&c](std::size_t n) { return fmt::format("{} of {}", c.rows[n].held, c.rows[n].drives); }});
    return shown;
  }
  shown.push_back({"holds", [&c](std::size_t n) { return c.rows[n].nominal_held ? "yes" : "NO"; }});
  shown.push_back({"lowest", [&c](std::size_t n) { return lowest_text(c.rows[n]); }});
  const auto cost = [&c](std::string CoreCost::*of) {
    return [&c, of](std::size_t n) {
      const auto found = cost_of(*c.entries[n].who);
      return found ? (*found).*of : "-";
    };
  };
  shown.push_back({"tick", cost(&CoreCost::tick)});
  shown.push_back({"flash", cost(&CoreCost::flash_bytes)});
  return shown;
}

ContestTable table(const Contest& c, std::string title, ContestGroup group, FiguresOf figures) {
  const std::vector<ContestColumn> shown = contest_columns(c, group, figures);
  ContestTable table{std::move(title), {}};
  const auto add = [&](const auto& text_of) {
    std::vector<std::string>& cells = table.rows.emplace_back();
    cells.reserve(shown.size());
    for (const ContestColumn& column : shown) cells.push_back(text_of(column));
  };
  add([](const ContestColumn& column) { return column.head; });
  for (std::size_t n = 0; n < c.rows.size(); ++n)
    if (c.entries[n].scenario && figures(c.rows[n]))
      add([n](const ContestColumn& column) { return column.cell(n); });
  return table;
}

/// Breaks a paragraph into lines for a terminal; all lines but the first are indented.
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

Json figures_json(const ContestValues& values) {
  Json out = Json::object();
  for (std::size_t f = 0; f < values.size(); ++f)
    out[std::string(contest_figures[f].phrase)] = figure_json(values[f]);
  return out;
}

/// Describes the first speed requirement that the nominal drive fails: its mean speed and the bounds.
std::string missed_speed(const ContestRow& row) {
  const std::vector<analysis::FigureColumn>& columns = row.nominal->columns().figures;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double x = (*row.nominal)->figures[k];
    if (columns[k].holds(x)) continue;
    const auto speed = [](double rad_s) { return quantity_text(rad_s, "rad/s", 4); };
    return fmt::format("{} is {} on average; the requirement is {} to {}", columns[k].name,
                       std::isnan(x) ? std::string("no value") : speed(x),
                       speed(columns[k].min.value_or(0.0)), speed(columns[k].max.value_or(0.0)));
  }
  return "the run ended early";
}

}  // namespace

std::string contest_value(double x, const ContestFigure& figure) {
  if (std::isnan(x)) return "-";
  if (std::isinf(x)) return "never";
  if (figure.unit == "1") return fmt::format("{:.1f} %", 100 * x);
  return quantity_text(x, std::string(figure.unit), contest_digits);
}

std::string contest_cell(const Contest& c, std::size_t figure, double x) {
  return cell_text(x, contest_figures[figure], column_prefix(c, figure, nominal_of));
}

std::vector<std::string> contest_notes(const Contest& c) {
  std::vector<std::string> notes;
  for (std::size_t n = 0; n < c.rows.size(); ++n) {
    const base::Result<study::Scenario>& scenario = c.entries[n].scenario;
    const std::string problem = c.rows[n].nominal ? (*c.rows[n].nominal)->problem : std::string();
    if (!scenario)
      notes.push_back(fmt::format("{} was not run: {}", controller_name(c, n),
                                  base::to_string(scenario.problems().front())));
    else if (!problem.empty())
      notes.push_back(fmt::format("{} stopped: {}", controller_name(c, n), problem));
    else if (c.rows[n].nominal && !c.rows[n].nominal_held)
      notes.push_back(
          fmt::format("{} does not hold the required speed ({}). None of its figures counts as the least",
                      controller_name(c, n), missed_speed(c.rows[n])));
    else if (c.rows[n].nominal_held && !analysis::may_win(c, n))
      notes.push_back(fmt::format(
          "{} starts with a peak of {}, {:.1f} times the current of the torque limit. Commutation and ripple explain a peak of at most {}. None of the controller's figures counts as the least",
          controller_name(c, n), quantity_text(c.rows[n].values[analysis::peak_figure], "A", 3),
          c.rows[n].values[analysis::peak_figure] / c.bench.design.current_at_full_torque_A,
          quantity_text(analysis::most_peak_A(c.bench), "A", 3)));
    if (scenario && scenario->control.drive == study::FirmwareKind::own)
      notes.push_back(fmt::format(
          "{} runs with the preset numbers of its file, not with the numbers in control.own.number",
          controller_name(c, n)));
    if (scenario && scenario->control.speed.output == study::SpeedOutput::duty)
      notes.push_back(fmt::format(
          "{} has no current loop, so the torque limit does not limit its current. Instead, its setpoint changes only as fast as the torque limit allows",
          controller_name(c, n)));
  }
  return notes;
}

std::vector<ContestTable> contest_tables(const Contest& c) {
  std::vector<ContestTable> all{table(c, {}, ContestGroup::moving, nominal_of),
                                table(c, {}, ContestGroup::steady, nominal_of)};
  if (c.plan.drives == 0) return all;
  all.push_back(table(
      c, fmt::format("Worst of the nominal motor and {} drives within the sheet's tolerances", c.plan.drives),
      ContestGroup::moving, worst_of));
  all.push_back(table(c, {}, ContestGroup::steady, worst_of));
  return all;
}

std::vector<std::string> contest_legend(const Contest& c) {
  return {
      fmt::format(
          "* least value of all controllers that hold the course and start with a current peak of at most {}. This peak is 1.5 times the current of the torque limit, plus the PWM ripple",
          quantity_text(analysis::most_peak_A(c.bench), "A", 3)),
      fmt::format(
          "load settles: 0 s if after the load step the speed stays within {:g} % of {} rad/s, which is {} rad/s",
          100 * analysis::settled_part, base::rounded(c.bench.course.high_rad_s, 4),
          base::rounded(analysis::settled_part * c.bench.course.high_rad_s, 3)),
      "lowest: slowest speed that the controller holds against the full load; each try halves the speed",
      fmt::format(
          "columns from ripple to turn-ons: measured at the high speed against half of the full load; columns slow swing and slow ripple: measured at {} rad/s against the full load",
          base::rounded(c.bench.course.slow_rad_s, 4)),
      fmt::format(
          "tick: largest number of instructions in one tick; flash: bytes of code, both on {} in {}. A dash means not counted. To count your own controller, run tools/own_cost.sh.",
          contest_core, arithmetic)};
}

std::string compared_controllers(const Contest& c) {
  const auto run = std::count_if(c.entries.begin(), c.entries.end(),
                                 [](const auto& entry) { return static_cast<bool>(entry.scenario); });
  const auto all = static_cast<std::ptrdiff_t>(c.entries.size());
  return run == all ? fmt::format("{} controllers", all) : fmt::format("{} of {} controllers", run, all);
}

std::string contest_text(const Contest& c) {
  std::string text = fmt::format("{}: {}, each designed by its rule for\n", visible(c.bench.scenario.motor),
                                 compared_controllers(c));
  for (const std::string& rule : c.bench.rules) text += "  - " + rule + "\n";
  for (const ContestTable& one : contest_tables(c)) {
    text += one.title.empty() ? "\n" : "\n" + one.title + "\n\n";
    Rows rows(Rows::Side::left);
    for (const std::vector<std::string>& cells : one.rows) rows.add(cells);
    text += rows.text();
  }
  text += "\n";
  for (const std::string& line : contest_legend(c)) text += "  " + line + "\n";
  text += "\n";
  for (const std::string& note : contest_notes(c)) text += paragraph(note);
  for (const std::string& line : contest_words(c)) text += paragraph(line);
  return text;
}

std::string contest_csv(const Contest& c) {
  std::string text = "controller,drive,holds,lowest speed [rad/s]";
  for (const ContestFigure& f : contest_figures)
    text += "," + csv_cell(fmt::format("{} [{}]", f.phrase, f.unit));
  text += "\n";
  const auto line = [&](std::size_t n, const char* drive, bool holds, const std::optional<double>& lowest,
                        const ContestValues& values) {
    text += fmt::format("{},{},{},{}", csv_cell(controller_name(c, n)), drive, holds ? 1 : 0,
                        lowest ? fmt::format("{}", *lowest) : "");
    for (const double x : values) text += "," + csv_cell(x);
    text += "\n";
  };
  for (std::size_t n = 0; n < c.rows.size(); ++n) {
    const ContestRow& row = c.rows[n];
    line(n, "nominal", row.nominal_held, row.lowest_rad_s, row.values);
    if (row.worst) line(n, "worst", row.nominal_held && row.held == row.drives, {}, *row.worst);
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
    if (row.worst) {
      one["worst"] = figures_json(*row.worst);
      one["drives"] = row.drives;
      one["drives_that_hold"] = row.held;
    }
    if (row.nominal && !(*row.nominal)->problem.empty()) one["problem"] = (*row.nominal)->problem;
    if (const auto cost = cost_of(*entry.who))
      one["cost"] = {{"core", contest_core},
                     {"arithmetic", arithmetic},
                     {"tick_instructions", cost->tick},
                     {"flash_bytes", cost->flash_bytes}};
    json["controllers"].push_back(std::move(one));
  }
  json["words"] = contest_words(c);
  json["notes"] = contest_notes(c);
  return json_text(json) + "\n";
}

}  // namespace text
