// SPDX-License-Identifier: Apache-2.0
#include "text/scenario/scenario_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "sixstep/base/linear.hpp"
#include "sixstep/design/sheet/sheet_constants.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"
#include "sixstep/design/sheet/sheet_override.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/scenario_description.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/motor/motor_library.hpp"
#include "text/scenario/motion_words.hpp"
#include "text/scenario/reference_file.hpp"
#include "text/scenario/scenario_family.hpp"
#include "text/toml/file_kind.hpp"
#include "text/toml/table_reader.hpp"

namespace text {
namespace {

struct SheetSource {
  Document document;
  design::Sheet sheet;
};

/// The points of a back-EMF, from the file that the text at `path` names.
void read_shape(const Document& document, const std::string& path, const Resolve& resolve,
                design::Sheet& sheet, Complaints& complaints, base::Problems& of_other_files) {
  const toml::node* node = document.find(path);
  if (!node || sheet.back_emf_file.empty()) return;
  const auto complain = [&](base::Problem problem) {
    problem.where = path;
    complaints.later(std::move(problem));
    complaints.told_elsewhere(path);
  };
  if (!sheet.back_emf_angle_deg.empty() || !sheet.back_emf_shape.empty())
    return complain({.limit = "contradicts back_emf_angle_deg and back_emf_shape: the points are given twice",
                     .cure = "keep one of the two"});
  const base::Result<NamedText> file =
      find_text(resolve, {Naming::Kind::rows, sheet.back_emf_file, document.file_of(*node, path)});
  if (!file) return complain(file.problems().front());
  base::Result<ShapeRows> rows = shape_rows(file->name, file->text);
  if (!rows) {
    append(of_other_files, rows.problems());
    return complaints.told_elsewhere(path);
  }
  sheet.back_emf_angle_deg = std::move(rows->angles_deg);
  sheet.back_emf_shape = std::move(rows->values);
}

/// As the table says it in one of the ways, else as `sheet` has it. What is wrong with it is told elsewhere.
std::optional<int> pole_pairs_in(const Document& document, const std::string& table,
                                 const design::Sheet& sheet) {
  const auto whole = [&](std::string_view key) {
    const toml::node* node = document.find(table + std::string(key));
    const std::optional<std::int64_t> count = node ? node->value_exact<std::int64_t>() : std::nullopt;
    return count && std::in_range<int>(*count) ? std::optional(static_cast<int>(*count)) : std::nullopt;
  };
  const toml::node* code = document.find(table + "winding");
  design::Sheet poles;
  poles.pole_pairs = whole("pole_pairs");
  for (const base::Spelling& spelling : design::spellings::pole_pairs)
    if (!poles.pole_pairs) poles.pole_pairs = whole(spelling.key);
  poles.poles = whole("poles");
  poles.winding = code ? code->value<std::string>().value_or("") : "";
  const bool given = poles.pole_pairs || poles.poles || !poles.winding.empty();
  return design::sheet_constants(given ? poles : sheet).pole_pairs;
}

base::Result<SheetSource> sheet_of(Document document, const Resolve& resolve) {
  Complaints complaints(document);
  base::Problems of_other_files;
  design::Sheet sheet;
  complaints.set_pole_pairs(pole_pairs_in(document, "", sheet));
  read_root(document, sheet, complaints);
  complaints.set_linear_motor(sheet.kind == design::MotorKind::linear);
  refuse_other_motion(sheet_keys(), complaints);
  read_shape(document, "back_emf_file", resolve, sheet, complaints, of_other_files);
  if (complaints.empty() && !of_other_files.empty()) return of_other_files;
  if (complaints.empty()) return SheetSource{std::move(document), std::move(sheet)};
  if (std::optional<base::Problem> problem = taken_for(FileKind::motor, document)) return *problem;
  return complaints.in_order();
}

/// The sheet that the scenario's `motor` names. What is wrong in the motor's own file is told of that file,
/// what is wrong with the name at the name.
std::optional<SheetSource> named_sheet(const Document& scenario, const Resolve& resolve,
                                       Complaints& complaints, base::Problems& of_other_files) {
  const toml::node* name = scenario.find("motor");
  if (!name || !name->is_string()) return {};  // told by the description
  base::Result<Document> document =
      find_motor(name->as_string()->get(), scenario.file_of(*name, "motor"), resolve);
  if (!document) {
    for (const base::Problem& problem : document.problems())
      problem.where.empty() ? complaints.value(*name, "motor", problem) : of_other_files.push_back(problem);
    return {};
  }
  base::Result<SheetSource> source = sheet_of(std::move(*document), resolve);
  if (!source) {
    append(of_other_files, source.problems());
    return {};
  }
  return std::move(*source);
}

/// In any of the key's spellings.
bool overridden(const Document& document, std::string_view key) {
  if (document.find(fmt::format("motor_override.{}", key))) return true;
  const std::vector<KeyEntry>& keys = sheet_keys();
  const KeyEntry* entry = find_key(keys, key);
  return entry && std::any_of(entry->about.also.begin(), entry->about.also.end(), [&](const auto& spelling) {
           return document.find(fmt::format("motor_override.{}", spelling.key)) != nullptr;
         });
}

/// Whether a check speaks of the motor's sheet, whose keys it names without a table.
bool is_sheet_key(const std::string& where) {
  const std::vector<KeyEntry>& keys = sheet_keys();
  return find_key(keys, where) != nullptr;
}

/// A sheet's check speaks in the standard key's unit: what stands in another spelling is quoted from the
/// file.
base::Problem as_written(const Document& document, const std::string& table, base::Problem problem) {
  const std::vector<KeyEntry>& keys = sheet_keys();
  const KeyEntry* entry = find_key(keys, problem.where);
  if (!entry || entry->path == problem.where) return problem;
  for (const char* part : {".value", ""}) {
    const std::string path = table + problem.where + part;
    const toml::node* node = document.find(path);
    if (!node) continue;
    problem.value = document.quote(*node, path);
    break;
  }
  return problem;
}

/// What study::check found, each told where it stands: in the scenario, its overrides, or the motor's file.
void run_checks(const Document& document, const SheetSource& source, const study::Scenario& scenario,
                Complaints& complaints, base::Problems& of_other_files) {
  Complaints of_motor(source.document);
  base::Problems of_scenario;
  for (base::Problem& problem : study::check(scenario)) {
    if (is_sheet_key(problem.where)) {
      const std::string in_override = fmt::format("motor_override.{}", problem.where);
      if (!document.find(in_override)) {
        of_motor.later(as_written(source.document, "", std::move(problem)));
        continue;
      }
      problem = as_written(document, "motor_override.", std::move(problem));
      problem.where = in_override;
    }
    // What follows from a mistake told already would only hide it.
    if (!complaints.about_table_of(problem.where)) of_scenario.push_back(std::move(problem));
  }
  for (base::Problem& problem : of_scenario) complaints.later(std::move(problem));
  for (base::Problem& problem : of_motor.in_order()) of_other_files.push_back(std::move(problem));
}

/// The rows of a csv reference, from the file that it names.
void read_rows(const Document& document, const std::string& path, sixstep::control::Mode mode,
               const Resolve& resolve, study::Reference& r, Complaints& complaints,
               base::Problems& of_other_files) {
  if (r.file.empty() || r.shape != study::Shape::csv) return;
  const std::string key = path + ".file";
  const auto complain = [&](base::Problem problem) {
    problem.where = key;
    complaints.later(std::move(problem));
  };
  if (!r.times_s.empty() || !r.values.empty())
    return complain(
        {.limit = "contradicts times_s and values: the rows are given twice", .cure = "keep one of the two"});
  const toml::node* node = document.find(key);
  if (!node) return;
  const base::Result<NamedText> file =
      find_text(resolve, {Naming::Kind::rows, r.file, document.file_of(*node, key)});
  if (!file) return complain(file.problems().front());
  const std::string_view of_mode = study::reference_unit(mode);
  const base::LinearUnit unit =
      complaints.linear_motor() ? base::in_linear(of_mode) : base::LinearUnit{of_mode, of_mode};
  // A duty is a plain number.
  base::Result<ReferenceRows> rows =
      reference_rows(file->name, file->text, r.column, unit.linear == "1" ? "" : std::string(unit.linear));
  if (!rows) {
    append(of_other_files, rows.problems());
    return complaints.told_elsewhere(key);
  }
  r.times_s = std::move(rows->times_s);
  r.values = std::move(rows->values);
  for (double& value : r.values) value /= unit.factor;
}

void read_all_rows(const Document& document, const Resolve& resolve, study::Scenario& scenario,
                   Complaints& complaints, base::Problems& of_other_files) {
  read_rows(document, "reference", scenario.control.mode, resolve, scenario.reference, complaints,
            of_other_files);
  const std::vector<sixstep::control::Mode> modes = study::modes_from(scenario);
  for (std::size_t n = 0; n < scenario.at.size(); ++n)
    if (scenario.at[n].reference)
      read_rows(document, fmt::format("at[{}].reference", n), modes[n], resolve, *scenario.at[n].reference,
                complaints, of_other_files);
}

/// The shared object of a controller of one's own.
void load_controller(const Document& document, const Resolve& resolve, study::Own& own,
                     Complaints& complaints) {
  constexpr const char* key = "control.own.controller";
  const toml::node* node = document.find(key);
  if (!node || own.controller.empty()) return;
  const base::Result<NamedText> file =
      find_text(resolve, {Naming::Kind::controller, own.controller, document.file_of(*node, key)});
  if (file && file->controller) {
    own.loaded = file->controller;
    return;
  }
  base::Problem problem = file ? base::Problem{.limit = "is machine code, and none is loaded here",
                                               .cure = "run it by the program on this machine"}
                               : file.problems().front();
  problem.where = key;
  complaints.later(std::move(problem));
  complaints.told_elsewhere(key);
}

/// The sheet's kind, or the one that [motor_override] makes of it.
bool is_linear(const Document& document, const design::Sheet& sheet) {
  const toml::node* kind = document.find("motor_override.kind");
  const std::optional<std::string> word = kind ? kind->value<std::string>() : std::nullopt;
  return word.value_or(std::string(base::word(design::kind_choices, sheet.kind))) == "linear";
}

base::Problems apply_overrides(Document& document, const std::vector<Setting>& overrides) {
  for (const Setting& setting : overrides)
    if (path_words(setting.path) == std::vector<std::string>{"extends"})
      return {{.where = "--set extends",
               .value = setting.text,
               .limit = "comes too late: the files are joined already",
               .cure = "write extends in the scenario"}};
  return document.set(overrides);
}

}  // namespace

base::Result<design::Sheet> read_sheet(const std::string& name, const Resolve& resolve) {
  base::Result<Document> document = find_motor(name, "", resolve);
  if (!document) {
    base::Problems problems = document.problems();
    for (base::Problem& problem : problems)
      if (problem.where.empty()) problem.where = name;
    return problems;
  }
  base::Result<SheetSource> source = sheet_of(std::move(*document), resolve);
  if (!source) return source.problems();
  Complaints complaints(source->document);
  for (base::Problem& problem : design::sheet_constants(source->sheet).problems)
    complaints.later(as_written(source->document, "", std::move(problem)));
  if (!complaints.empty()) return complaints.in_order();
  return std::move(source->sheet);
}

base::Result<study::Scenario> read_scenario_text(const std::string& name, std::string text,
                                                 const ReadOptions& options) {
  base::Result<Document> parsed = read_family(name, std::move(text), options.resolve);
  if (!parsed) return parsed.problems();
  Document& document = *parsed;
  if (base::Problems problems = apply_overrides(document, options.overrides); !problems.empty())
    return problems;

  Complaints complaints(document);
  base::Problems of_other_files;
  std::optional<SheetSource> source = named_sheet(document, options.resolve, complaints, of_other_files);
  study::Scenario scenario;
  if (source) {
    scenario.sheet = source->sheet;
    scenario.motor_sheet = source->sheet;
  }
  complaints.set_linear_motor(is_linear(document, scenario.sheet));
  complaints.set_pole_pairs(pole_pairs_in(document, "motor_override.", scenario.sheet));
  read_root(document, scenario, complaints);
  refuse_other_motion(scenario_keys(), complaints);
  read_spread_keys(scenario, complaints);
  drop_stale(scenario.sheet, [&](std::string_view key) { return overridden(document, key); });
  read_shape(document, "motor_override.back_emf_file", options.resolve, scenario.sheet, complaints,
             of_other_files);
  // A duration that is wrong has been told: nothing shall lie behind its end besides.
  if (!(scenario.duration_s > 0.0)) scenario.duration_s = study::longest_s;
  read_all_rows(document, options.resolve, scenario, complaints, of_other_files);
  load_controller(document, options.resolve, scenario.control.own, complaints);
  for (base::Problem& problem : study::check_columns(scenario)) complaints.later(std::move(problem));
  if (source) run_checks(document, *source, scenario, complaints, of_other_files);

  base::Problems problems = complaints.in_order();
  append(problems, of_other_files);
  if (!problems.empty()) {
    if (std::optional<base::Problem> problem = taken_for(FileKind::scenario, document)) return *problem;
    return problems;
  }
  if (scenario.title.empty()) scenario.title = stem_of(name);
  return scenario;
}

}  // namespace text
