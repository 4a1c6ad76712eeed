// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/new_command.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <filesystem>
#include <optional>

#include "faces/cli/choose.hpp"
#include "faces/cli/new_file.hpp"
#include "faces/cli/side_by_side.hpp"
#include "faces/cli/spec_words.hpp"
#include "faces/cli/terminal.hpp"
#include "files/scenario_on_disk.hpp"
#include "files/text_file.hpp"
#include "sixstep/analysis/verify/first_scenario.hpp"
#include "sixstep/design/sheet/sheet_check.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/escape/escape.hpp"
#include "text/export/core_costs.hpp"
#include "text/scenario/json_schema.hpp"
#include "text/scenario/starter_scenario.hpp"

namespace cli {
namespace {

namespace fs = std::filesystem;

struct NewArguments {
  std::string name, mode = "speed", motor = "maxon-251601", data_dir;
  std::optional<double> voltage_V;
  bool full = false;
  std::string command;
};

/// Replaces the library's words for other studies by the commands that make them.
base::Problems with_commands(base::Problems problems, const NewArguments& a) {
  const std::string motor = text::shell_word(a.motor);
  const std::pair<std::string_view, std::string> commands[] = {
      {"a design of the motor", fmt::format("sixstep design {} --mode {}", motor, a.mode)},
      {"the torque-speed curve of the motor", fmt::format("sixstep curve {}", motor)}};
  for (base::Problem& p : problems)
    for (const auto& [words, command] : commands)
      if (const std::size_t at = p.cure.find(words); at != std::string::npos)
        p.cure.replace(at, words.size(), command);
  return problems;
}

base::Result<study::Scenario> scenario_of(const NewArguments& a, const std::string& path) {
  base::Problems found;
  analysis::FirstScenarioSpec spec;
  // The modes of a first scenario: without `off`, because the motor should move.
  constexpr base::Choice<sixstep::control::Mode> modes[] = {study::mode_choices[3], study::mode_choices[2],
                                                            study::mode_choices[4], study::mode_choices[1]};
  choose("--mode", a.mode, modes, spec.mode, found);
  const base::Result<design::Sheet> sheet = files::read_sheet(a.motor, a.data_dir);
  if (!sheet) append(found, sheet.problems());
  if (!found.empty()) return found;
  spec.motor = motor_beside(a.motor, path);
  spec.sheet = *sheet;
  spec.voltage_V = a.voltage_V;
  spec.for_each = side_by_side(0, true, "motors");
  base::Result<study::Scenario> scenario = analysis::first_scenario(spec);
  if (!scenario) return with_commands(in_options(scenario.problems()), a);
  return scenario;
}

/// Writes the schema into the scenario's folder, where the scenario's first line refers to it. An existing
/// schema is not changed; a message reports if it differs.
base::Result<std::string> write_schema(const std::string& path) {
  if (taken(path).empty()) {
    const base::Problems problems = write_new(path, text::scenario_schema());
    if (!problems.empty()) return problems;
  } else if (const base::Result<std::string> there = files::read_text(path);
             !there || *there != text::scenario_schema()) {
    return fmt::format(
        "; the existing {} beside it differs and was kept: for editors, replace it by the output of sixstep schema scenario",
        text::visible(path));
  }
  return fmt::format(", and {}, with which editors complete and check the scenario", text::visible(path));
}

Exit new_command(const NewArguments& a) {
  const std::string path = a.name.empty() ? "" : toml_path(a.name);
  base::Problems found = taken(path);
  const base::Result<study::Scenario> scenario = scenario_of(a, path);
  if (!scenario) append(found, scenario.problems());
  if (!found.empty()) return refused(found);
  const std::string file = path.empty() ? "FILE.toml" : path;
  const std::string text = text::starter_text(*scenario, {.file = file, .full = a.full});
  if (path.empty()) {
    print(text);
    return Exit::ok;
  }
  const std::string schema = (fs::path(path).parent_path() / text::scenario_schema_file).string();
  base::Problems problems = write_new(path, text);
  if (!problems.empty()) return refused(problems);
  const base::Result<std::string> beside = write_schema(schema);
  if (!beside) return refused(beside.problems());
  print(
      fmt::format("wrote {}{}\n"
                  "next: sixstep run {} --html {}\n",
                  text::visible(path), *beside, text::shell_word(path),
                  text::shell_word(fs::path(path).replace_extension(".html").string())));
  if (const auto sheet = design::check_sheet(scenario->sheet); sheet && !sheet->consistent)
    print(fmt::format("note: {}; see the contradiction with: sixstep motor check {}\n",
                      text::visible(design::contradiction_words(*sheet)), text::shell_word(a.motor)));
  if (!scenario->notes.empty()) print(fmt::format("note: {}\n", text::visible(scenario->notes)));
  if (const std::string note = text::starter_note(*scenario); !note.empty())
    print(fmt::format("note: {}\n", note));
  if (scenario->pwm.period_s < text::stm32_least_period_s)
    print(fmt::format(
        "note: {}. The current ripple of this winding requires this period; a choke in each motor lead, added to the sheet's inductance, allows a longer period\n",
        text::too_short_for_images(scenario->pwm.period_s)));
  return Exit::ok;
}

}  // namespace

Verb declare_new(CLI::App& app) {
  CLI::App& fresh = *app.add_subcommand("new", "write a scenario to start from, with a comment on each line");
  const auto a = std::make_shared<NewArguments>();
  fresh.add_option("NAME", a->name, "file to write, NAME.toml. Default: standard output");
  fresh.add_option("--mode", a->mode, "controlled quantity: speed, current, position or duty")
      ->capture_default_str();
  fresh.add_option("--motor", a->motor, "motor's name or file")->capture_default_str();
  fresh.add_option("--voltage", a->voltage_V, "bus voltage in V. Default: the sheet's nominal voltage");
  fresh.add_flag("--full", a->full, "write all keys instead of only the keys of a first scenario");
  take_data(fresh, a->data_dir);
  return {&fresh, calling(new_command, a)};
}

}  // namespace cli
