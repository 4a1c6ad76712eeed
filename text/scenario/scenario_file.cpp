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
#include "sixstep/design/sheet/winding_description.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/reference_description.hpp"
#include "sixstep/study/scenario/scenario_description.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/motor/motor_library.hpp"
#include "text/scenario/motion_words.hpp"
#include "text/scenario/recorded_rows.hpp"
#include "text/scenario/reference_file.hpp"
#include "text/scenario/scenario_family.hpp"
#include "text/scenario/sheet_source.hpp"
#include "text/toml/file_kind.hpp"
#include "text/toml/table_reader.hpp"

namespace text {
namespace {

/// Reports the problems that study::check finds, at their places: in the scenario, in its overrides, or in
/// the motor's file. If the sheet has mistakes, only the problems that concern the scenario alone are
/// reported.
void run_checks(const Document& document, const std::optional<SheetSource>& source,
                const study::Scenario& scenario, Complaints& complaints, base::Problems& of_other_files) {
  const bool sound = source && source->problems.empty();
  base::Problems of_scenario, of_sheet;
  for (base::Problem& problem : study::check(scenario)) {
    if (is_sheet_key(problem.where)) {
      const std::string in_override = fmt::format("motor_override.{}", problem.where);
      if (!document.find(in_override)) {
        if (sound) of_sheet.push_back(as_written(source->document, "", std::move(problem)));
        continue;
      }
      // A problem that only follows from a reported mistake would distract from the mistake.
      if (!sound || follows(problem, "motor_override.", complaints)) continue;
      problem = as_written(document, "motor_override.", std::move(problem));
      problem.where = in_override;
      of_scenario.push_back(std::move(problem));
      continue;
    }
    const bool of_unread_sheet = !sound && problem.limit.find("motor's sheet") != std::string::npos;
    if (!of_unread_sheet && !complaints.about_table_of(problem.where))
      of_scenario.push_back(std::move(problem));
  }
  for (base::Problem& problem : of_scenario) complaints.later(std::move(problem));
  if (!sound) return;
  Complaints of_motor(source->document);
  for (base::Problem& problem : of_sheet) of_motor.later(std::move(problem));
  append(of_other_files, of_motor.in_order());
}

/// Reads the rows of a csv reference from the file that the reference names.
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
    return complain({.limit = "contradicts times_s and values: give the rows only once",
                     .cure = "keep file, or times_s and values"});
  const toml::node* node = document.find(key);
  if (!node) return;
  const base::Result<NamedText> file =
      find_text(resolve, {Naming::Kind::rows, r.file, document.file_of(*node, key)});
  if (!file) return complain(file.problems().front());
  const std::string_view of_mode = study::reference_unit(mode);
  const base::LinearUnit unit =
      complaints.linear_motor() ? base::in_linear(of_mode) : base::LinearUnit{of_mode, of_mode};
  // A duty's unit is "1": it is a plain number.
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

/// Loads the shared object of a user's own controller.
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
  base::Problem problem =
      file ? base::Problem{.limit = "is a compiled controller, which this program does not load",
                           .cure = "run the scenario with the sixstep program on this machine"}
           : file.problems().front();
  problem.where = key;
  complaints.later(std::move(problem));
  complaints.told_elsewhere(key);
}

/// The sheet's kind, unless [motor_override] changes it.
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
               .limit = "cannot be set: the files are joined before --set",
               .cure = "write extends in the scenario file"}};
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
  SheetSource source = sheet_of(std::move(*document), resolve);
  if (!source.problems.empty()) return source.problems;
  Complaints complaints(source.document);
  for (base::Problem& problem : design::sheet_constants(source.sheet).problems)
    complaints.later(as_written(source.document, "", std::move(problem)));
  if (!complaints.empty()) return complaints.in_order();
  return std::move(source.sheet);
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
  // A wrong duration has already been reported. Times after the run's end must not cause further problems.
  if (!(scenario.duration_s > 0.0)) scenario.duration_s = study::longest_s;
  read_all_rows(document, options.resolve, scenario, complaints, of_other_files);
  read_recordings(document, options.resolve, scenario, complaints, of_other_files);
  load_controller(document, options.resolve, scenario.control.own, complaints);
  for (base::Problem& problem : study::check_columns(scenario)) complaints.later(std::move(problem));
  run_checks(document, source, scenario, complaints, of_other_files);

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
