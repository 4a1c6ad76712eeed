// SPDX-License-Identifier: Apache-2.0
#include "files/store/store_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "sixstep/base/written.hpp"
#include "text/keys/decimal_number.hpp"

namespace files {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Columns of `run` behind its fixed ones: k0, k1, .. s0, .. f0, ..
std::vector<std::string> own_columns(const analysis::PlanColumns& c) {
  std::vector<std::string> names;
  for (std::size_t n = 0; n < c.keys.size(); ++n) names.push_back(fmt::format("k{}", n));
  for (std::size_t n = 0; n < c.strayed.size(); ++n) names.push_back(fmt::format("s{}", n));
  for (std::size_t n = 0; n < c.figures.size(); ++n) names.push_back(fmt::format("f{}", n));
  return names;
}

std::string with_unit(std::string_view name, std::string_view unit) {
  return unit.empty() ? std::string(name) : fmt::format("{} [{}]", name, unit);
}

/// What each of them is called in the view; a name that is taken gets a number.
std::vector<std::string> shown_names(const StoredPlan& plan) {
  const analysis::PlanColumns& c = plan.columns;
  std::vector<std::string> names;
  const auto add = [&](std::string name) {
    const std::string wanted = name;
    for (int n = 2; std::find(names.begin(), names.end(), name) != names.end(); ++n)
      name = fmt::format("{} ({})", wanted, n);
    names.push_back(std::move(name));
  };
  for (std::size_t n = 0; n < c.keys.size(); ++n) add(with_unit(c.keys[n], plan.units[n]));
  for (std::size_t n = 0; n < c.strayed.size(); ++n)
    add(with_unit("drive: " + c.strayed[n], plan.units[c.keys.size() + n]));
  for (const analysis::FigureColumn& f : c.figures) add(with_unit(f.name, f.unit));
  return names;
}

/// A number as a number, "soft" without its quotes.
void bind_value(Statement& insert, int place, const std::string& written) {
  if (const std::optional<double> x = text::number_alone(written)) return insert.bind(place, *x);
  insert.bind(place, analysis::bare(written));
}

std::uint64_t from_hex(const std::string& text) {
  std::uint64_t bits = 0;
  std::from_chars(text.data(), text.data() + text.size(), bits, 16);
  return bits;
}

}  // namespace

std::string schema_sql(const StoredPlan& plan) {
  const std::vector<std::string> own = own_columns(plan.columns), shown = shown_names(plan);
  std::string table =
      "CREATE TABLE run(number INTEGER PRIMARY KEY, \"end\" TEXT NOT NULL, passed INTEGER NOT NULL, problem TEXT, "
      "digest TEXT NOT NULL";
  std::string view = "CREATE VIEW runs AS SELECT number, \"end\", passed";
  for (std::size_t n = 0; n < own.size(); ++n) {
    table += fmt::format(", {}{}", own[n], own[n][0] == 'k' ? "" : " REAL");
    view += fmt::format(", {} AS {}", own[n], sql_name(shown[n]));
  }
  return fmt::format(
      "PRAGMA application_id={}; PRAGMA user_version={};"
      "CREATE TABLE about(word TEXT PRIMARY KEY, value TEXT NOT NULL);"
      "CREATE TABLE \"columns\"(\"column\" TEXT PRIMARY KEY, kind TEXT NOT NULL, name TEXT NOT NULL, unit TEXT NOT NULL, "
      "required INTEGER NOT NULL, min REAL, max REAL);"
      "{});{}, problem, digest FROM run;",
      0x53495853, store_format, table, view);  // store_mark
}

std::string insert_sql(const StoredPlan& plan) {
  std::string sql = "INSERT OR REPLACE INTO run VALUES(?,?,?,?,?";
  for (std::size_t n = own_columns(plan.columns).size(); n > 0; --n) sql += ",?";
  return sql + ")";
}

void bind_row(Statement& insert, const analysis::RunRecord& record, const analysis::PlanColumns& columns) {
  insert.bind(1, static_cast<std::int64_t>(record.number));
  insert.bind(2, base::word(analysis::run_ends, record.end));
  insert.bind(3, std::int64_t{analysis::passed(record, columns)});
  insert.bind(4, record.problem);
  insert.bind(5, base::written_hex(record.digest));
  int place = 6;
  for (const std::string& value : record.point) bind_value(insert, place++, value);
  for (const double x : record.strayed) insert.bind(place++, x);
  for (const double x : record.figures) insert.bind(place++, x);
}

std::string select_sql(const StoredPlan& plan) {
  std::string sql = "SELECT number, \"end\", problem, digest";
  for (const std::string& name : own_columns(plan.columns)) sql += ", " + name;
  return sql + " FROM run ORDER BY number";
}

analysis::RunRecord row_of(const Statement& select, const analysis::PlanColumns& columns) {
  analysis::RunRecord record;
  record.number = static_cast<std::size_t>(select.whole(0));
  const std::string end = select.text(1);
  for (const auto& choice : analysis::run_ends)
    if (choice.word == end) record.end = choice.value;
  record.problem = select.text(2);
  record.digest = from_hex(select.text(3));
  int column = 4;
  for (std::size_t n = 0; n < columns.keys.size(); ++n, ++column)
    record.point.push_back(select.is_number(column) ? base::written(*select.number(column))
                                                    : select.text(column));
  for (std::size_t n = 0; n < columns.strayed.size(); ++n)
    record.strayed.push_back(select.number(column++).value_or(none));
  for (std::size_t n = 0; n < columns.figures.size(); ++n)
    record.figures.push_back(select.number(column++).value_or(none));
  return record;
}

base::Problems write_plan(Database& db, const StoredPlan& plan) {
  base::Result<Statement> about = db.prepare("INSERT INTO about VALUES(?,?)"),
                          columns = db.prepare("INSERT INTO \"columns\" VALUES(?,?,?,?,?,?,?)");
  if (!about) return about.problems();
  if (!columns) return columns.problems();
  const std::pair<std::string_view, std::string_view> words[] = {
      {"sixstep", SIXSTEP_VERSION}, {"plan", plan.plan},
      {"inputs", plan.inputs},      {"title", plan.title},
      {"motor", plan.motor},        {"scenario", plan.scenario},
      {"command", plan.command},    {"scenario_text", plan.scenario_text}};
  for (const auto& [word, value] : words) {
    about->bind(1, word);
    about->bind(2, value);
    about->step();
    if (about->failed()) return {db.problem()};
  }
  const std::vector<std::string> own = own_columns(plan.columns);
  std::size_t at = 0;
  const auto add = [&](std::string_view kind, const analysis::FigureColumn& f) {
    columns->bind(1, own[at++]);
    columns->bind(2, kind);
    columns->bind(3, f.name);
    columns->bind(4, f.unit);
    columns->bind(5, std::int64_t{f.required});
    columns->bind(6, f.min.value_or(none));
    columns->bind(7, f.max.value_or(none));
    columns->step();
  };
  const auto of_key = [&](const std::string& key) {
    return analysis::FigureColumn{.name = key, .unit = plan.units[at], .min = {}, .max = {}};
  };
  for (const std::string& key : plan.columns.keys) add("key", of_key(key));
  for (const std::string& key : plan.columns.strayed) add("strayed", of_key(key));
  for (const analysis::FigureColumn& f : plan.columns.figures) add("figure", f);
  if (columns->failed()) return {db.problem()};
  return {};
}

base::Result<StoredPlan> read_plan(Database& db) {
  StoredPlan plan;
  base::Result<Statement> about = db.prepare("SELECT word, value FROM about"),
                          columns = db.prepare(
                              "SELECT kind, name, unit, required, min, max FROM \"columns\" ORDER BY rowid");
  if (!about) return about.problems();
  if (!columns) return columns.problems();
  const std::pair<std::string_view, std::string*> words[] = {{"plan", &plan.plan},
                                                             {"inputs", &plan.inputs},
                                                             {"title", &plan.title},
                                                             {"motor", &plan.motor},
                                                             {"scenario", &plan.scenario},
                                                             {"command", &plan.command},
                                                             {"scenario_text", &plan.scenario_text}};
  while (about->step())
    for (const auto& [word, value] : words)
      if (about->text(0) == word) *value = about->text(1);
  while (columns->step()) {
    const std::string kind = columns->text(0);
    if (kind == "figure") {
      plan.columns.figures.push_back({columns->text(1), columns->text(2), columns->whole(3) != 0,
                                      columns->number(4), columns->number(5)});
      continue;
    }
    (kind == "key" ? plan.columns.keys : plan.columns.strayed).push_back(columns->text(1));
    plan.units.push_back(columns->text(2));
  }
  if (about->failed() || columns->failed()) return db.problem();
  return plan;
}

}  // namespace files
