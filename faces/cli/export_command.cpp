// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/export_command.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <charconv>
#include <optional>

#include "faces/cli/settings.hpp"
#include "faces/cli/terminal.hpp"
#include "io/export/config_header.hpp"
#include "io/files/atomic_file.hpp"
#include "io/keys/key_advice.hpp"
#include "sixstep/base/plausible.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace cli {
namespace {

struct ExportArguments {
  std::string file;                 ///< the scenario
  std::string out;                  ///< empty: standard output
  std::string arithmetic;           ///< empty: the scenario's
  std::vector<std::string> ranges;  ///< "current_A=20"
  std::vector<std::string> sets;    ///< "key=value"
  std::string name_space = "exported";
  std::string data_dir;
  bool single_header = false;
  std::string command;  ///< the command line as it may be typed again
};

std::string meant(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = io::nearest(word, known);
  return near.empty() ? fmt::format("take one of {}", fmt::join(known, ", "))
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

/// A number above 0, plausible in its unit, that is all of the text; else 0.
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
          {fmt::format("--range {}", word), "", "names no quantity of the range", meant(key, known)});
    else if (*to->number = positive(value, to->unit); *to->number == 0.0)
      problems.push_back(
          {fmt::format("--range {}", key), value,
           fmt::format("must be a number above 0 and at most {}", base::plausible(to->unit).most),
           "give the most that may be measured, as in --range current_A=20"});
  }
  return range;
}

Exit export_header(const ExportArguments& a) {
  base::Problems problems;
  const std::optional<study::Arithmetic> arithmetic = arithmetic_of(a.arithmetic, problems);
  const design::OperatingRange range = range_of(a, problems);
  const io::ReadOptions options = read_options(a.data_dir, a.sets, problems);
  if (!problems.empty()) return refused(problems);
  const base::Result<study::Scenario> scenario = io::read_scenario(a.file, options);
  if (!scenario) return refused(scenario.problems());
  const study::Arithmetic number = arithmetic.value_or(scenario->control.arithmetic);
  if (!a.ranges.empty() && (number == study::Arithmetic::float64 || number == study::Arithmetic::float32))
    return refused(
        {{"--range", "", "says what fixed point must hold, and the drive is to be in floating point",
          "add --arithmetic q15 or another fixed point, or leave the range out"}});
  const base::Result<std::string> text = io::config_header({.scenario = *scenario,
                                                            .arithmetic = arithmetic,
                                                            .range = range,
                                                            .name_space = a.name_space,
                                                            .single_header = a.single_header,
                                                            .command = a.command});
  if (!text) {
    problems = text.problems();
    for (base::Problem& problem : problems)
      if (!problem.where.starts_with("--")) problem.where = fmt::format("{}: {}", a.file, problem.where);
    return refused(problems);
  }
  if (a.out.empty() || a.out == "-") {
    print(*text);
    return Exit::ok;
  }
  base::Result<io::AtomicFile> file = io::AtomicFile::create(a.out);
  if (!file) return refused(file.problems());
  file->write(*text);
  if (problems = file->commit(); !problems.empty()) return refused(problems);
  return Exit::ok;
}

void declare_options(CLI::App& header, ExportArguments& a) {
  header.add_option("SCENARIO", a.file, "scenario file")->required();
  header.add_option("--out", a.out, "the file to write; without it standard output");
  header.add_option("--arithmetic", a.arithmetic,
                    "double, float, q15, q14, q31 or q30; without it control.arithmetic");
  header
      .add_option(
          "--range", a.ranges,
          "fixed point: the most that is measured or asked for, as --range current_A=20; also speed_rad_s, "
          "position_deg, bus_V, setpoint; without it what the scenario's motor and bus can reach")
      ->allow_extra_args(false);
  take_sets(header, a.sets);
  header.add_option("--namespace", a.name_space, "C++ namespace of what the header declares")
      ->capture_default_str();
  header.add_flag("--single-header", a.single_header, "include sixstep_control.hpp, not sixstep/control/");
  take_data(header, a.data_dir);
}

}  // namespace

Verb declare_export(CLI::App& app) {
  CLI::App& exports = *app.add_subcommand("export", "a scenario's drive for use elsewhere");
  exports.require_subcommand(1);
  const auto a = std::make_shared<ExportArguments>();
  declare_options(*exports.add_subcommand("header", "gains and scalings as constants for firmware, in C++20"),
                  *a);
  return {&exports, calling(export_header, a)};
}

}  // namespace cli
