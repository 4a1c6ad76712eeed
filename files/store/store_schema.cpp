// SPDX-License-Identifier: Apache-2.0
#include "files/store/store_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "files/store/stored_row.hpp"
#include "files/text_file.hpp"
#include "sixstep/base/written.hpp"
#include "text/escape/escape.hpp"
#include "text/results/plan_columns.hpp"

namespace files {
namespace {

constexpr std::string_view checksum_word = "checksum", version_word = "sixstep";

/// Columns of the table `run` after the columns of every store: k0, k1, .. s0, .. f0, ..
std::vector<std::string> own_columns(const analysis::PlanColumns& c) {
  std::vector<std::string> names;
  for (std::size_t n = 0; n < c.keys.size(); ++n) names.push_back(fmt::format("k{}", n));
  for (std::size_t n = 0; n < c.strayed.size(); ++n) names.push_back(fmt::format("s{}", n));
  for (std::size_t n = 0; n < c.figures.size(); ++n) names.push_back(fmt::format("f{}", n));
  return names;
}

/// A member of StoredPlan, and its name in the table `about`.
using Word = std::pair<std::string_view, std::string*>;
std::vector<Word> words_of(StoredPlan& plan) {
  return {{version_word, &plan.sixstep}, {"plan", &plan.plan},
          {"inputs", &plan.inputs},      {"title", &plan.title},
          {"motor", &plan.motor},        {"scenario", &plan.scenario},
          {"command", &plan.command},    {"scenario_text", &plan.scenario_text}};
}

/// A row of the table `columns`: column, kind, name, unit, required, min, max.
using ColumnRow = std::vector<Cell>;
std::vector<ColumnRow> column_rows(const analysis::PlanColumns& c) {
  const std::vector<std::string> own = own_columns(c);
  std::vector<ColumnRow> rows;
  const auto limit = [](const std::optional<double>& x) { return x ? Cell(*x + 0.0) : Cell(); };
  const auto add = [&](std::string_view kind, const std::string& name, const std::string& unit, bool required,
                       const std::optional<double>& min, const std::optional<double>& max) {
    rows.push_back(
        {own[rows.size()], std::string(kind), name, unit, std::int64_t{required}, limit(min), limit(max)});
  };
  for (const analysis::InputColumn& key : c.keys) add("key", key.key, key.unit, false, {}, {});
  for (const analysis::InputColumn& key : c.strayed) add("strayed", key.key, key.unit, false, {}, {});
  for (const analysis::FigureColumn& f : c.figures) add("figure", f.name, f.unit, f.required, f.min, f.max);
  return rows;
}

/// The checksum of a store's description, without the version: a different version has its own message
/// (PlanStore::resume).
std::uint64_t checksum_of_plan(StoredPlan plan) {
  std::vector<Cell> cells;
  for (const auto& [word, value] : words_of(plan))
    if (word != version_word) cells.insert(cells.end(), {std::string(word), *value});
  for (const ColumnRow& row : column_rows(*plan.columns)) cells.insert(cells.end(), row.begin(), row.end());
  return checksum_of(cells, store_format);
}

void put(Statement& insert, const std::vector<Cell>& cells) {
  for (std::size_t n = 0; n < cells.size(); ++n) insert.bind_cell(static_cast<int>(n) + 1, cells[n]);
  insert.step();
}

/// All rows of a query. Problems: the reason why the query failed.
base::Result<std::vector<std::vector<Cell>>> rows_of(Database& db, const std::string& sql) {
  base::Result<Statement> select = db.prepare(sql);
  if (!select) return select.problems();
  std::vector<std::vector<Cell>> rows;
  while (select->step()) {
    std::vector<Cell>& row = rows.emplace_back();
    for (int n = 0; n < select->columns(); ++n) row.push_back(select->cell(n));
  }
  if (select->failed()) return db.problem();
  return rows;
}

std::string text_of(const Cell& cell) {
  const auto* text = std::get_if<std::string>(&cell);
  return text ? *text : std::string();
}

base::Problems check_format(Database& db) {
  const auto found = rows_of(db, "PRAGMA user_version");
  if (!found) return found.problems();
  const auto* told = found->empty() ? nullptr : std::get_if<std::int64_t>(&found->front().front());
  const std::int64_t format = told ? *told : 0;
  if (format == store_format) return {};
  if (format == 1)
    return {{db.path() + ":", "",
             "was written by an older sixstep without checksums, so damage cannot be detected",
             "finish the runs with the older version, or start again (force)"}};
  return {{db.path() + ":", "",
           fmt::format("has the format {}, and this sixstep reads {}", format, store_format),
           "use the version of sixstep that wrote the store, or start again (force)"}};
}

analysis::PlanColumns columns_from(const std::vector<ColumnRow>& rows) {
  analysis::PlanColumns columns;
  for (const ColumnRow& row : rows) {
    const std::string kind = text_of(row[1]), name = text_of(row[2]), unit = text_of(row[3]);
    const auto limit = [](const Cell& cell) {
      const auto* x = std::get_if<double>(&cell);
      return x ? std::optional(*x) : std::nullopt;
    };
    if (kind == "key") columns.keys.push_back({name, unit});
    if (kind == "strayed") columns.strayed.push_back({name, unit});
    if (kind == "figure")
      columns.figures.push_back({name, unit, row[4] == Cell(std::int64_t{1}), limit(row[5]), limit(row[6])});
  }
  return columns;
}

/// Whether the store contains each table that the statements create. Further tables are allowed.
bool has_tables(const std::vector<std::vector<Cell>>& tables, const StoredPlan& plan) {
  std::set<std::string> there;
  for (const std::vector<Cell>& row : tables) there.insert(text_of(row[0]));
  const std::vector<std::string> wanted = schema_of(plan);
  return std::all_of(wanted.begin(), wanted.end(),
                     [&](const std::string& sql) { return there.contains(sql); });
}

}  // namespace

StoredPlan as_stored(StoredPlan plan) {
  if (plan.sixstep.empty()) plan.sixstep = SIXSTEP_VERSION;
  for (const auto& [word, value] : words_of(plan))
    *value = text::visible(*value, value == &plan.scenario_text ? text::Lines::kept : text::Lines::shown);
  analysis::PlanColumns columns = *plan.columns;
  for (std::vector<analysis::InputColumn>* inputs : {&columns.keys, &columns.strayed})
    for (analysis::InputColumn& input : *inputs) input.key = text::visible(input.key);
  for (analysis::FigureColumn& figure : columns.figures) figure.name = text::visible(figure.name);
  plan.columns = std::make_shared<const analysis::PlanColumns>(std::move(columns));
  return plan;
}

std::vector<std::string> schema_of(const StoredPlan& plan) {
  const std::vector<std::string> own = own_columns(*plan.columns), shown = text::column_names(*plan.columns);
  std::string table =
      "CREATE TABLE run(run INTEGER PRIMARY KEY, \"end\" TEXT NOT NULL, passed INTEGER NOT NULL, problem TEXT, "
      "remarks TEXT, digest TEXT NOT NULL";
  std::string view = "CREATE VIEW runs AS SELECT run, \"end\", passed";
  for (std::size_t n = 0; n < own.size(); ++n) {
    table += fmt::format(", {}{}", own[n], own[n][0] == 'k' ? "" : " REAL");
    view += fmt::format(", {} AS {}", own[n], sql_name(shown[n]));
  }
  return {"CREATE TABLE about(word TEXT PRIMARY KEY, value TEXT NOT NULL)",
          "CREATE TABLE \"columns\"(\"column\" TEXT PRIMARY KEY, kind TEXT NOT NULL, name TEXT NOT NULL, "
          "unit TEXT NOT NULL, required INTEGER NOT NULL, min REAL, max REAL)",
          table + ", checksum INTEGER NOT NULL)", view + ", problem, digest FROM run"};
}

std::string insert_sql(const StoredPlan& plan) {
  std::string sql = "INSERT OR REPLACE INTO run VALUES(?";
  for (std::size_t n = cells_in_row(*plan.columns); n > 0; --n) sql += ",?";
  return sql + ")";
}

std::string select_sql(const StoredPlan& plan) {
  std::string sql = "SELECT run, \"end\", passed, problem, remarks, digest";
  for (const std::string& name : own_columns(*plan.columns)) sql += ", " + name;
  return sql + ", checksum FROM run ORDER BY run";
}

std::uint64_t checksum_begin(const StoredPlan& plan) {
  return text_digest(plan.inputs, text_digest(plan.plan));
}

base::Problems write_plan(Database& db, const StoredPlan& plan) {
  base::Result<Statement> about = db.prepare("INSERT INTO about VALUES(?,?)"),
                          columns = db.prepare("INSERT INTO \"columns\" VALUES(?,?,?,?,?,?,?)");
  if (!about) return about.problems();
  if (!columns) return columns.problems();
  StoredPlan words = plan;
  std::string checksum = base::written_hex(checksum_of_plan(plan));
  std::vector<Word> all = words_of(words);
  all.emplace_back(checksum_word, &checksum);
  for (const auto& [word, value] : all) {
    put(*about, {std::string(word), *value});
    if (about->failed()) return {db.problem()};
  }
  for (const ColumnRow& row : column_rows(*plan.columns)) {
    put(*columns, row);
    if (columns->failed()) return {db.problem()};
  }
  return {};
}

base::Result<StoredPlan> read_plan(Database& db) {
  if (base::Problems wrong = check_format(db); !wrong.empty()) return wrong;
  const auto about = rows_of(db, "SELECT word, value FROM about");
  const auto columns =
      rows_of(db, "SELECT \"column\", kind, name, unit, required, min, max FROM \"columns\" ORDER BY rowid");
  const auto tables = rows_of(db, "SELECT sql FROM sqlite_schema");
  for (const auto* found : {&about, &columns, &tables})
    if (!*found) return found->problems();
  StoredPlan plan;
  plan.columns = std::make_shared<const analysis::PlanColumns>(columns_from(*columns));
  std::string checksum;
  std::vector<Word> words = words_of(plan);
  words.emplace_back(checksum_word, &checksum);
  for (const auto& [word, value] : words)
    for (const std::vector<Cell>& row : *about)
      if (text_of(row[0]) == word) *value = text_of(row[1]);
  if (checksum != base::written_hex(checksum_of_plan(plan)) || column_rows(*plan.columns) != *columns)
    return damaged(db.path(), "its plan differs from the written plan");
  if (!has_tables(*tables, plan)) return damaged(db.path(), "its tables do not match its columns");
  return plan;
}

}  // namespace files
