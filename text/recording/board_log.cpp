// SPDX-License-Identifier: Apache-2.0
#include "text/recording/board_log.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sixstep/study/measure/columns.hpp"
#include "text/keys/bounded.hpp"
#include "text/keys/key_advice.hpp"
#include "text/keys/units.hpp"
#include "text/recording/board_words.hpp"
#include "text/recording/column_formula.hpp"
#include "text/recording/heading.hpp"
#include "text/recording/known_logs.hpp"
#include "text/recording/known_names.hpp"
#include "text/recording/times.hpp"

namespace text {
namespace {

using Values = base::Result<std::vector<double>>;

std::string unit_of_trace(const study::Column& column) { return column.unit == "1" ? "" : column.unit; }

bool fits(const std::string& unit, const study::Column& column) {
  return unit.empty() || conversion(unit, {unit_of_trace(column), "", 1}).operator bool();
}

/// A column of a trace, and the recorded column converted to its unit.
struct Found {
  const study::Column* column = nullptr;
  Picked picked;
};

/// Finds the column of a trace by a heading that a trace itself uses, "i_m_A", else by name and unit. If two
/// columns have one name, such as the bus's voltage and current, the unit decides.
Found column_of(const RecordedColumn& recorded) {
  Found found;
  for (const study::Column& column : study::all_columns()) {
    if (recorded.heading == column.name) return {&column, {&recorded, ""}};
    if (recorded.name == column.name && recorded.unit == unit_of_trace(column))
      return {&column, {&recorded, recorded.unit}};
    const bool letter = recorded.letter && bare_name(recorded.heading) == bare_column(column);
    if (!letter && recorded.bare != bare_column(column)) continue;
    const std::string unit = letter ? std::string() : recorded.unit;
    if (found.column == nullptr || (!fits(found.picked.unit, *found.column) && fits(unit, column)))
      found = {&column, {&recorded, unit}};
  }
  return found;
}

/// Problems of headings such as "i_m_A [mA]": the trace's name contains a unit, and a different unit follows.
/// It is unknown which unit applies.
base::Problems said_twice(const Recording& r) {
  base::Problems found;
  for (const RecordedColumn& recorded : r.columns)
    for (const study::Column& column : study::all_columns()) {
      const std::string unit = unit_of_trace(column);
      if (recorded.name != column.name || recorded.heading == column.name || unit.empty()) continue;
      if (recorded.unit.empty() || recorded.unit == unit) continue;
      found.push_back(of_recording(
          r,
          fmt::format("has a column \"{}\", whose name says {} but whose unit says {}",
                      bounded(recorded.heading, 200), unit, recorded.unit),
          fmt::format("write the heading {} or {} [{}]", column.name,
                      column.name.substr(0, column.name.size() - unit.size() - 1), recorded.unit)));
    }
  return found;
}

/// The column of a trace that a formula names; "bus" needs the name with its unit.
base::Result<const study::Column*> trace_column(const std::string& name) {
  std::vector<std::string> known;
  const study::Column* found = nullptr;
  for (const study::Column& column : study::all_columns()) {
    if (column.name == name) return &column;
    known.push_back(column.name);
    if (!found && bare_name(name) == bare_column(column)) found = &column;
  }
  if (found) return found;
  const std::string near = nearest_word(name, known);
  return bounded({.where = "columns",
                  .value = name,
                  .limit = "is not a column of the simulation",
                  .cure = near.empty()
                              ? "name a column of the trace, for example speed, i_m, u_ab, duty or bus_V"
                              : fmt::format("did you mean {}?", near)});
}

bool is_time(const std::string& name) {
  const std::string bare = bare_name(name);
  return bare == "time" || bare == "t" || bare == "ts";
}

Values formula_values(const Recording& r, const ColumnFormula& formula, const Wanted& wanted,
                      const RecordedColumn*& column) {
  const base::Result<std::vector<Picked>> found = columns_called(r, {formula.column});
  if (!found) return found.problems();
  column = found->front().column;
  // The comparison of headings ignores all characters except letters, and would accept "e*rpm" and "erpm+"
  // for erpm. So a formula must write the name exactly.
  const bool as_headed = formula.column == column->name || formula.column == column->heading;
  if (!as_headed && formula.column.find_first_of("*/+^=") != std::string::npos)
    return of_recording(
        r, fmt::format("has no column \"{}\"", bounded(formula.column, 200)),
        "write constants (numbers or pi) before the column with *, or behind the column with * or /");
  if (!formula.scaled) {
    Values values = values_of(r, found->front(), wanted);
    if (values && formula.factor != 1.0)
      for (double& x : *values) x *= formula.factor;
    return values;
  }
  // A formula with constants uses the numbers as the file has them: without unit, and with the unit's power
  // of ten restored.
  RecordedColumn bare = *column;
  const int ten = bare.unit.empty() ? 0 : unit_of(bare.unit)->ten;
  bare.unit.clear();
  bare.odd_unit.clear();
  Values values = values_of(r, {&bare, ""}, "");
  if (!values) return values;
  double factor = formula.factor;
  for (int n = 0; n < std::abs(ten); ++n) factor = ten < 0 ? factor * 10.0 : factor / 10.0;
  for (double& x : *values) x *= factor;
  return values;
}

class LogReader {
 public:
  LogReader(const Recording& recording, const LogColumns& wanted, const KnownLog* known)
      : r_(recording), wanted_(wanted), known_(known), formulas_(known ? known->formulas : wanted.formulas) {}

  base::Result<BoardLog> read() {
    out_.notes = r_.notes;
    if (known_) {
      out_.recognised = known_->name;
      for (const std::string& formula : formulas_)
        out_.recognised += (out_.recognised == known_->name ? ": " : ", ") + spaced(formula);
    }
    if (base::Problems wrong = read_formulas(); !wrong.empty()) return wrong;
    if (base::Problems wrong = said_twice(r_); formulas_.empty() && !wrong.empty()) return wrong;
    base::Result<Times> times = read_times();
    if (!times) return times.problems();
    out_.trace = {.columns = {study::all_columns().front()}, .values = {std::move(times->t_s)}};
    add_named(times->left_out);
    turn_in_reverse();
    if (formulas_.empty()) add_by_headings(*times);
    for (std::string& note : what_the_board_says(r_)) out_.notes.push_back(std::move(note));
    if (!problems_.empty()) return problems_;
    if (out_.trace.columns.size() < 2)
      return of_recording(
          r_, "has no column of the simulation: it has " + headings_of(r_),
          "write the headings of a trace (t [us], i_m [mA], duty, speed [rad/s], hall), or name the columns");
    return std::move(out_);
  }

 private:
  /// A VESC's motor current in blocks is positive while the motor drives, in both directions.
  void turn_in_reverse() {
    if (!known_ || !known_->name.starts_with("a VESC")) return;
    std::vector<double>*i_m = nullptr, *speed = nullptr;
    for (std::size_t n = 0; n < out_.trace.columns.size(); ++n) {
      if (out_.trace.columns[n].name == "i_m_A") i_m = &out_.trace.values[n];
      if (out_.trace.columns[n].name == "speed_rad_s") speed = &out_.trace.values[n];
    }
    if (!i_m || !speed) return;
    std::size_t turned = 0;
    for (std::size_t n = 0; n < i_m->size(); ++n)
      if ((*speed)[n] < 0.0) (*i_m)[n] = -(*i_m)[n], ++turned;
    if (turned > 0)
      out_.notes.push_back(fmt::format(
          "in {} rows with erpm below 0, i_m = -current_motor: it is positive while the motor drives",
          turned));
  }

  base::Problems read_formulas() {
    for (const std::string& text : formulas_) {
      const base::Result<ColumnFormula> formula = column_formula(text);
      if (!formula) return formula.problems();
      if (is_time(formula->name)) {
        time_ = *formula;
        continue;
      }
      const base::Result<const study::Column*> column = trace_column(formula->name);
      if (!column) return column.problems();
      const bool twice =
          std::any_of(named_.begin(), named_.end(), [&](const auto& n) { return n.first == *column; });
      if (twice)
        return {{.where = "columns",
                 .value = bounded(formula->name, 200),
                 .limit = "is named twice",
                 .cure = "assign each column of the simulation only once"}};
      named_.emplace_back(*column, *formula);
    }
    return {};
  }

  base::Result<Times> read_times() {
    if (!time_) return times_of(r_, wanted_.interval_s, out_.notes);
    const RecordedColumn* column = nullptr;
    Values values = formula_values(r_, *time_, "s", column);
    if (!values) return values.problems();
    used_.push_back(column);
    if (wanted_.interval_s)
      return times_at_interval(r_, std::move(*values), *column, *wanted_.interval_s, out_.notes);
    return rising_times(r_, std::move(*values), *column, out_.notes);
  }

  Wanted wanted(const study::Column& column) const { return {unit_of_trace(column), "", wanted_.pole_pairs}; }

  void add(const study::Column& column, Values values, const std::vector<std::size_t>& left_out) {
    if (!values) return base::append(problems_, values.problems());
    out_.trace.columns.push_back(column);
    out_.trace.values.push_back(without_rows(std::move(*values), left_out));
  }

  void add_named(const std::vector<std::size_t>& left_out) {
    for (const auto& [column, formula] : named_) {
      const RecordedColumn* used = nullptr;
      add(*column, formula_values(r_, formula, wanted(*column), used), left_out);
      used_.push_back(used);
    }
    if (known_) out_.not_used = known_->not_used;
    if (named_.empty() || known_) return;
    for (const RecordedColumn& recorded : r_.columns)
      if (recorded.filled && std::find(used_.begin(), used_.end(), &recorded) == used_.end() &&
          &recorded != time_column(r_) && !is_the_boards_word(recorded))
        out_.not_used.push_back({recorded.name, "not named"});
  }

  void add_by_headings(const Times& times) {
    for (const RecordedColumn& recorded : r_.columns) {
      if (&recorded == times.column || !recorded.filled || is_the_boards_word(recorded)) continue;
      const Found found = column_of(recorded);
      if (!found.column || found.column->name == "t_s") {
        out_.not_used.push_back({recorded.name, !recorded.has_numbers() ? "holds no numbers"
                                                : found.column          ? "another time"
                                                               : "the simulation has no such column"});
        continue;
      }
      const auto& columns = out_.trace.columns;
      if (std::any_of(columns.begin(), columns.end(),
                      [&](const study::Column& c) { return c.name == found.column->name; }))
        problems_.push_back(
            of_recording(r_, fmt::format("has two columns of {}", found.column->name),
                         "rename one of the two columns, or name the intended column with --columns"));
      else
        add(*found.column, values_of(r_, found.picked, wanted(*found.column)), times.left_out);
    }
  }

  /// "time = ms_today/1000" for "time=ms_today/1000".
  static std::string spaced(const std::string& formula) {
    const std::size_t equals = formula.find('=');
    return formula.substr(0, equals) + " = " + formula.substr(equals + 1);
  }

  const Recording& r_;
  const LogColumns& wanted_;
  const KnownLog* known_;
  const std::vector<std::string>& formulas_;
  std::optional<ColumnFormula> time_;
  std::vector<std::pair<const study::Column*, ColumnFormula>> named_;
  std::vector<const RecordedColumn*> used_;
  base::Problems problems_;
  BoardLog out_;
};

}  // namespace

base::Result<BoardLog> read_board_log(const std::string& name, std::string_view bytes,
                                      const LogColumns& wanted) {
  const base::Result<Recording> recording = read_recording(name, bytes, RowsFrom::last_start);
  if (!recording) return recording.problems();
  if (!wanted.formulas.empty()) return LogReader(*recording, wanted, nullptr).read();
  const base::Result<std::optional<KnownLog>> known = known_log(*recording, bytes, wanted);
  if (!known) return known.problems();
  if (!*known) return LogReader(*recording, wanted, nullptr).read();
  if ((*known)->escs.empty()) return LogReader(*recording, wanted, &**known).read();
  const base::Result<Recording> rows = rows_of_esc(*recording, (*known)->escs, wanted.esc);
  if (!rows) return rows.problems();
  return LogReader(*rows, wanted, &**known).read();
}

}  // namespace text
