// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/export_command.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <charconv>
#include <optional>

#include "faces/cli/open_or_report.hpp"
#include "faces/cli/progress.hpp"
#include "faces/cli/settings.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"
#include "faces/cli/unit_export.hpp"
#include "files/atomic_file.hpp"
#include "sixstep/base/plausible.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/escape/escape.hpp"
#include "text/export/config_header.hpp"
#include "text/export/core_costs.hpp"
#include "text/keys/key_advice.hpp"

namespace cli {
namespace {

struct ExportArguments {
  std::string file;                 ///< the scenario
  std::string out;                  ///< path of the output; empty: standard output
  std::string arithmetic;           ///< arithmetic of the target; empty: the scenario's arithmetic
  std::vector<std::string> ranges;  ///< operating range, such as "current_A=20"
  std::vector<std::string> sets;    ///< settings of the scenario: "key=value"
  std::string name_space = "exported";
  std::string data_dir;
  bool single_header = false, force = false;
  std::optional<std::string> despite;  ///< reason for writing the output of a drive that is not cleared
  std::string command;                 ///< the command line as it can be typed again
};

std::string meant(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = text::nearest(word, known);
  return near.empty() ? fmt::format("write one of {}", fmt::join(known, ", "))
                      : fmt::format("did you mean {}?", near);
}

std::optional<study::Arithmetic> arithmetic_of(const std::string& word, base::Problems& problems) {
  if (word.empty()) return {};
  std::vector<std::string> known;
  for (const auto& choice : study::arithmetic_choices) {
    if (choice.word == word) return choice.value;
    known.emplace_back(choice.word);
  }
  problems.push_back(
      {"--arithmetic", word, fmt::format("must be one of {}", fmt::join(known, ", ")), meant(word, known)});
  return {};
}

/// The number if the whole text is a number above 0 and plausible in its unit; else 0.
double positive(const std::string& text, std::string_view unit) {
  double x = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), x);
  const bool whole = end.ec == std::errc{} && end.ptr == text.data() + text.size();
  return whole && base::allowed(base::above(0), unit).holds(x) ? x : 0.0;
}

design::OperatingRange range_of(const ExportArguments& a, base::Problems& problems) {
  design::OperatingRange range;
  struct Member {
    std::string name;
    std::string_view unit;
    double* number;
  };
  const std::vector<Member> members = {{"current_A", "A", &range.current_A},
                                       {"speed_rad_s", "rad/s", &range.speed_rad_s},
                                       {"position_deg", "deg", &range.position_deg},
                                       {"bus_V", "V", &range.bus_V},
                                       {"setpoint", "", &range.setpoint}};
  std::vector<std::string> known;
  known.reserve(members.size());
  for (const Member& member : members) known.push_back(member.name);
  for (const std::string& word : a.ranges) {
    const std::size_t cut = std::min(word.find('='), word.size());
    const std::string key = word.substr(0, cut), value = word.substr(std::min(cut + 1, word.size()));
    const auto to = std::find_if(members.begin(), members.end(),
                                 [&key](const Member& member) { return member.name == key; });
    if (to == members.end())
      problems.push_back(
          {fmt::format("--range {}", word), "", "is not a quantity of the range", meant(key, known)});
    else if (*to->number = positive(value, to->unit); *to->number == 0.0)
      problems.push_back(
          {fmt::format("--range {}", key), value,
           fmt::format("must be a number above 0 and at most {}", base::plausible(to->unit).most),
           "give the largest value that the drive may measure, for example --range current_A=20"});
  }
  return range;
}

/// The scenario with the chip's drive, or the problems of the arguments.
base::Result<study::Scenario> scenario_of(const ExportArguments& a) {
  base::Problems problems;
  const std::optional<study::Arithmetic> arithmetic = arithmetic_of(a.arithmetic, problems);
  const files::ReadOptions options = read_options(a.data_dir, a.sets, problems);
  if (a.despite && a.despite->find_first_not_of(" \t\r\n") == std::string::npos)
    problems.push_back(
        {"--despite", "", "gives no reason",
         "give the reason for which you write the header anyway; the header quotes this reason"});
  if (!problems.empty()) return problems;
  base::Result<study::Scenario> scenario = files::read_scenario(a.file, options);
  if (!scenario) return scenario;
  if (arithmetic) scenario->control.arithmetic = *arithmetic;
  const study::Arithmetic number = scenario->control.arithmetic;
  if (!a.ranges.empty() && (number == study::Arithmetic::float64 || number == study::Arithmetic::float32))
    return base::Problem{"--range", "", "applies to fixed point only, and the drive is in floating point",
                         "add --arithmetic q15 or another fixed-point format, or leave --range out"};
  return scenario;
}

base::Problems within(const std::string& file, base::Problems problems) {
  for (base::Problem& problem : problems)
    if (!problem.where.starts_with("--")) problem.where = fmt::format("{}: {}", file, problem.where);
  return problems;
}

/// Makes the run that decides about the clearance, and shows its progress.
base::Result<study::Clearance> cleared(const study::Scenario& scenario) {
  Progress progress({.seconds = {scenario.duration_s}}, false);
  const auto keep_going = [&progress](double t_s) {
    progress.reached(0, t_s);
    return !interrupted();
  };
  return study::clear_for_export(
      scenario,
      {.on_record = {}, .on_event = {}, .on_logic = {}, .keep_going = keep_going, .keep_books = false});
}

/// Prints all reasons why the drive is not cleared.
Exit not_cleared(const ExportArguments& a, const study::Control& control, const study::Clearance& c) {
  complain(within(a.file, c.unmeasured));
  complain(within(a.file, c.unheld));
  // Another sensor requires a new design of the loops.
  const bool of_sensor = std::any_of(c.unmeasured.begin(), c.unmeasured.end(),
                                     [](const base::Problem& p) { return p.where == "sensors.rotor"; });
  using Mode = sixstep::control::Mode;
  const bool cascade = control.mode == Mode::speed || control.mode == Mode::position;
  if (of_sensor && cascade && control.drive != study::FirmwareKind::field)
    print("after setting these keys, design the loops again: sixstep design --scenario " +
              text::visible(a.file) + " --toml NEW.toml\n",
          stderr);
  print(
      "no header was written; to write the header anyway, add --despite REASON; the header then states these reasons\n",
      stderr);
  const Exit told = !c.unmeasured.empty() ? Exit::bad_input : c.unheld.empty() ? Exit::ok : Exit::failed;
  return graver(cli::exit_of(c.outcome), told);
}

/// Prints each condition of the clearance that the header's comment states.
void tell_conditions(const study::Scenario& scenario, const study::Clearance& c) {
  const auto tell = [](const char* kind, const std::string& text) {
    print(fmt::format("{}: {}\n", kind, text::visible(text)), stderr);
  };
  for (const base::Problems* problems : {&c.unmeasured, &c.unheld})
    for (const base::Problem& p : *problems) tell("overridden", to_string(p));
  for (const std::string& remark : c.outcome.remarks) tell("warning", remark);
  for (const std::string& note : c.notes) tell("note", note);
  for (const std::string& note : text::notes_for_images(scenario)) tell("note", note);
}

Exit export_header(const ExportArguments& a) {
  base::Problems problems;
  const design::OperatingRange range = range_of(a, problems);
  const base::Result<study::Scenario> scenario = scenario_of(a);
  if (!scenario) append(problems, scenario.problems());
  if (!problems.empty()) return refused(problems);
  text::ConfigHeader wanted{.scenario = *scenario,
                            .arithmetic = {},
                            .range = range,
                            .name_space = a.name_space,
                            .single_header = a.single_header,
                            .command = a.command,
                            .clearance = nullptr,
                            .despite = a.despite.value_or("")};
  // Values that do not fit the format are reported before the run; an unwritable file as well.
  if (const auto unrun = text::config_header(wanted); !unrun)
    return refused(within(a.file, unrun.problems()));
  catch_interrupts();
  std::optional<files::AtomicFile> file;
  if (!a.out.empty() && a.out != "-")
    open_or_report(file, files::AtomicFile::create({a.out, a.force}), problems);
  if (!problems.empty()) return refused(problems);
  const base::Result<study::Clearance> clearance = cleared(*scenario);
  if (interrupted()) return told_interrupted("export " + a.file);
  if (!clearance) return refused(within(a.file, clearance.problems()));
  if (!clearance->clear() && !a.despite) return not_cleared(a, scenario->control, *clearance);
  if (a.despite && clearance->clear())
    print("--despite was not needed: the run holds every requirement, and the header states this\n", stderr);
  tell_conditions(*scenario, *clearance);
  wanted.clearance = &*clearance;
  const base::Result<std::string> text = text::config_header(wanted);
  if (!text) return refused(within(a.file, text.problems()));
  if (!file) {
    print(*text);
    return Exit::ok;
  }
  file->write(*text);
  if (problems = file->commit(); !problems.empty()) return refused(problems);
  return Exit::ok;
}

void declare_options(CLI::App& header, ExportArguments& a) {
  header.add_option("SCENARIO", a.file, "scenario file")->required();
  header.add_option("--out", a.out, "file to write. Default: standard output");
  take_force(header, a.force);
  std::string words;
  for (const auto& choice : study::arithmetic_choices)
    words += (words.empty() ? "" : ", ") + std::string(choice.word);
  header.add_option("--arithmetic", a.arithmetic, words + ". Default: control.arithmetic");
  header
      .add_option(
          "--range", a.ranges,
          "fixed point: largest value that the drive measures or receives, as --range current_A=20; also for speed_rad_s, position_deg, bus_V and setpoint. Default: twice the requested or limiting current, and the speed that the bus allows")
      ->allow_extra_args(false);
  take_sets(header, a.sets);
  header.add_option("--namespace", a.name_space, "C++ namespace of the header's declarations")
      ->capture_default_str();
  header.add_option(
      "--despite", a.despite,
      "write the header although the run fails or neglects effects of a real board; the header states this reason and the findings that the reason overrides");
  header.add_flag("--single-header", a.single_header,
                  "include the single header sixstep_control.hpp instead of the folder sixstep/control/");
  take_data(header, a.data_dir);
}

}  // namespace

Verb declare_export(CLI::App& app) {
  CLI::App& exports = *app.add_subcommand("export", "export a scenario's drive");
  exports.require_subcommand(1);
  const auto a = std::make_shared<ExportArguments>();
  declare_options(
      *exports.add_subcommand(
          "header",
          "write gains and scalings as constants for firmware, in C++20, if the run meets every requirement"),
      *a);
  const Verb unit = declare_unit_export(exports);
  const auto header = calling(export_header, a);
  return {&exports, [header, unit](const std::string& command) {
            return *unit.app ? unit.call(command) : header(command);
          }};
}

}  // namespace cli
