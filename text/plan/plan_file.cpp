// SPDX-License-Identifier: Apache-2.0
#include "text/plan/plan_file.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "sixstep/analysis/plan/plan_description.hpp"
#include "sixstep/base/written.hpp"
#include "text/escape/escape.hpp"
#include "text/escape/json_text.hpp"
#include "text/keys/decimal_number.hpp"
#include "text/keys/key_advice.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/keys/units.hpp"
#include "text/sources.hpp"
#include "text/toml/complaints.hpp"
#include "text/toml/table_reader.hpp"

namespace text {
namespace {

using Json = nlohmann::ordered_json;

/// A value of an axis as a file writes it. Entries of a mixed list are kept as text.
std::string axis_as_written(const toml::node& node) {
  if (const auto* text = node.as_string()) return toml_text(text->get());
  if (const auto* whole = node.as_integer()) return fmt::format("{}", whole->get());
  if (const auto* number = node.as_floating_point()) return base::written(number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  return "";
}

/// Writes each value of vary[n].values as text if the description expects a list of words.
void values_as_words(Document& document) {
  toml::array* entries = document.root()["vary"].as_array();
  if (!entries) return;
  for (toml::node& entry : *entries) {
    toml::array* values = entry.is_table() ? (*entry.as_table())["values"].as_array() : nullptr;
    if (!values) continue;
    for (std::size_t n = 0; n < values->size(); ++n) {
      const std::string text = axis_as_written((*values)[n]);
      if (!text.empty()) values->replace(values->cbegin() + static_cast<std::ptrdiff_t>(n), text);
    }
  }
}

analysis::Axis axis_from(const analysis::AxisEntry& entry, const std::string& where, Complaints& complaints) {
  const bool range = entry.from || entry.to;
  if (range && !entry.values.empty())
    complaints.later({.where = where + ".values",
                      .limit = "contradicts from and to, which also give the values",
                      .cure = "remove values, or remove from, to and points"});
  if (!range && entry.values.empty())
    complaints.later(
        {.where = where, .limit = "has no values", .cure = "give values = [..], or from, to and points"});
  if (range && !(entry.from && entry.to))
    complaints.later({.where = where + (entry.from ? ".from" : ".to"),
                      .limit = "is one end of a range, and the other end is missing",
                      .cure = entry.from ? "give to" : "give from"});
  return {.key = entry.key,
          .values = entry.values,
          .from = entry.from.value_or(0.0),
          .to = entry.to.value_or(0.0),
          .points = static_cast<std::size_t>(entry.points),
          .spacing = entry.spacing,
          .strays = entry.strays};
}

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(at, begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// A value with a unit becomes a number in the key's own unit; other values stay as written.
std::string in_keys_unit(const std::string& written, const std::string& unit) {
  const std::string text(analysis::bare(written));
  const std::optional<Written> parts = split_number(text);
  if (unit.empty() || !parts || parts->unit.empty()) return written;
  const base::Result<double> x = in_unit(text, unit);
  return x ? base::written(*x) : written;
}

/// Converts an axis to its key's unit. An unknown key is reported later, when the key is set.
void in_keys_unit(analysis::Axis& axis) {
  const base::Result<std::string> unit = unit_of_key(axis.key);
  if (!unit) return;
  for (std::string& value : axis.values) value = in_keys_unit(value, *unit);
}

/// A value in a unique spelling: a number with the fewest digits, a word without quotes. A whole number stays
/// unchanged, because it may have more digits than a double.
std::string one_spelling(const std::string& value) {
  const std::string word(analysis::bare(value));
  const std::optional<double> x = number_alone(word);
  const bool whole = word.find_first_not_of("-0123456789") == std::string::npos;
  return x && !whole ? base::written(*x) : word;
}

struct Ends {
  std::string_view whole;
  const std::string& unit;
  base::Problems problems{};

  double end(const std::string& text) {
    if (const std::optional<double> plain = number_alone(text)) return *plain;
    const base::Result<double> x = in_unit(text, unit);
    if (x) return *x;
    problems.push_back({std::string(whole), text, x.problems().front().limit, x.problems().front().cure});
    return 0.0;
  }
};

base::Result<analysis::Axis> range_of(const std::string& key, const std::vector<std::string>& parts,
                                      std::string_view whole) {
  const base::Result<std::string> known = unit_of_key(key);
  if (!known) {
    base::Problem problem = known.problems().front();
    problem.where = whole;
    return problem;
  }
  Ends ends{whole, *known};
  analysis::Axis axis{.key = key, .values = {}};
  axis.from = ends.end(parts[0]);
  axis.to = ends.end(parts[1]);
  if (!ends.problems.empty()) return ends.problems;
  if (parts.size() > 2) {
    const double count = number_alone(parts[2]).value_or(0.0);
    if (count < 2 || count > 1e9 || count != static_cast<double>(static_cast<std::size_t>(count)))
      return base::Problem{std::string(whole), parts[2], "is not a number of points",
                           "write a whole number of at least 2 after the second colon"};
    axis.points = static_cast<std::size_t>(count);
  }
  if (parts.size() > 3 && parts[3] != "log" && parts[3] != "linear")
    return base::Problem{std::string(whole), parts[3], "is no spacing", "write log or linear"};
  if (parts.size() > 3 && parts[3] == "log") axis.spacing = analysis::Spacing::logarithmic;
  return axis;
}

}  // namespace

base::Result<std::string> unit_of_key(const std::string& key) {
  const std::vector<KeyEntry>& keys = scenario_keys();
  if (std::optional<std::string> unit = key_unit(keys, shown(key))) return std::move(*unit);
  std::vector<std::string> known;
  known.reserve(keys.size());
  for (const KeyEntry& entry : keys) known.push_back(entry.path);
  const std::string near = nearest(key, known);
  return base::Problem{.value = key,
                       .limit = "is not a key of a scenario",
                       .cure = near.empty() ? "name a key as table.key, for example pwm.period_s"
                                            : fmt::format("did you mean {}?", near)};
}

bool is_plan(const std::string& text) {
  const base::Result<Document> document = Document::parse("", text);
  return document && document->root().contains("scenario") && !document->root().contains("motor") &&
         !document->root().contains("duration_s");
}

base::Result<PlanFile> read_plan_text(const std::string& name, std::string text) {
  base::Result<Document> document = Document::parse(name, std::move(text));
  if (!document) return document.problems();
  values_as_words(*document);
  Complaints complaints(*document);
  analysis::PlanEntry entry;
  read_root(*document, entry, complaints);
  PlanFile file{.title = entry.title.empty() ? stem_of(name) : entry.title,
                .notes = entry.notes,
                .scenario = entry.scenario,
                .sheet_tolerances = entry.sheet_tolerances,
                .minimise = entry.minimise,
                .evaluations = static_cast<std::size_t>(entry.evaluations),
                .plan = {}};
  file.plan = {.axes = {},
               .sampling = entry.sampling,
               .points = static_cast<std::size_t>(entry.points),
               .drives = static_cast<std::size_t>(entry.drives),
               .seed = static_cast<std::uint64_t>(entry.seed)};
  for (std::size_t n = 0; n < entry.vary.size(); ++n)
    in_keys_unit(
        file.plan.axes.emplace_back(axis_from(entry.vary[n], fmt::format("vary[{}]", n), complaints)));
  if (!entry.minimise.empty()) {  // with `minimise`, the search chooses the points
    file.plan.sampling = analysis::Sampling::sobol;
    file.plan.points = file.evaluations;
  }
  if (complaints.empty())
    for (base::Problem& problem : analysis::check(file.plan)) complaints.later(std::move(problem));
  if (!complaints.empty()) return complaints.in_order();
  return file;
}

base::Result<analysis::Axis> axis_of(std::string_view text) {
  const std::size_t cut = text.find('=');
  if (cut == std::string_view::npos || cut == 0 || cut + 1 == text.size())
    return base::Problem{
        std::string(text), "", "does not name a key and its values",
        "write KEY=FROM:TO:POINTS or KEY=VALUE,VALUE, for example pwm.period_s=20us:100us:9"};
  const std::string key(text.substr(0, cut));
  const std::string_view values = text.substr(cut + 1);
  const std::vector<std::string> parts = split(values, ':');
  if (parts.size() > 4)
    return base::Problem{std::string(text), "", "has more than FROM:TO:POINTS:SPACING",
                         "remove everything behind SPACING"};
  if (parts.size() > 1) return range_of(key, parts, text);
  analysis::Axis axis{.key = key, .values = split(values, ',')};
  in_keys_unit(axis);
  return axis;
}

std::string plan_identity(const analysis::Plan& plan) {
  using analysis::Sampling;
  Json axes = Json::array();
  for (const analysis::Axis& axis : plan.axes) {
    Json a = {{"key", axis.key}};
    if (axis.strays) a["strays"] = true;
    for (const std::string& value : axis.values) a["values"].push_back(one_spelling(value));
    if (axis.values.empty())
      a.update(Json{{"from", axis.from},
                    {"to", axis.to},
                    {"spacing", base::word(analysis::spacing_choices, axis.spacing)}});
    if (plan.sampling == Sampling::grid && axis.values.empty()) a["points"] = axis.points;
    axes.push_back(std::move(a));
  }
  Json identity = {{"vary", axes}, {"seed", plan.seed}};
  if (!plan.axes.empty()) {
    identity["sampling"] = base::word(analysis::sampling_choices, plan.sampling);
    if (plan.sampling == Sampling::latin_hypercube) identity["points"] = plan.points;
    identity["drives"] = plan.drives;
  }
  return json_text(identity, -1);
}

}  // namespace text
