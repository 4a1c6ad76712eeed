// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/run_reading.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <optional>

#include "faces/cli/choose.hpp"
#include "faces/cli/compare_command.hpp"
#include "faces/cli/duplicate_outputs.hpp"
#include "faces/cli/plan_reading.hpp"
#include "faces/cli/settings.hpp"
#include "faces/loop/own_firmware.hpp"
#include "files/scenario_on_disk.hpp"
#include "files/text_file.hpp"

namespace cli {
namespace {

std::string place(const std::string& file) { return fmt::format("{}:", file); }

/// Digest of all files read for a scenario and of the settings of the command line.
std::uint64_t inputs_digest(const files::ReadLog& log, const RunArguments& a) {
  std::uint64_t digest = log.digest();
  for (const std::string& set : a.sets) digest = files::text_digest(set, digest);
  return digest;
}

std::optional<Job> read_job(const std::string& file, const RunArguments& arguments,
                            const files::ReadOptions& options, JobsRead& into) {
  const files::ReadLog log;
  base::Result<study::Scenario> scenario = files::read_scenario(file, options);
  into.files.insert(into.files.end(), log.paths().begin(), log.paths().end());
  if (!scenario) {
    append(into.problems, scenario.problems());
    return {};
  }
  files::TraceOrigin origin{.scenario = file,
                            .digest = inputs_digest(log, arguments),
                            .title = scenario->title,
                            .motor = scenario->sheet.name,
                            .command = arguments.command,
                            .text = log.first_text()};
  return Job(std::move(*scenario), std::move(origin));
}

/// The job of one run of a plan, with all outputs that a scenario has.
std::optional<Job> read_one_of_a_plan(const std::string& file, const RunArguments& arguments,
                                      JobsRead& into) {
  const files::ReadLog log;
  base::Result<ReadPlan> plan = read_plan(file, arguments);
  into.files.insert(into.files.end(), log.paths().begin(), log.paths().end());
  if (!plan) {
    append(into.problems, plan.problems());
    return {};
  }
  const std::size_t runs = analysis::runs_of(plan->scenarios->plan());
  const std::uint64_t number = arguments.drive ? *arguments.drive : *arguments.plan.only;
  if (number >= runs) {
    into.problems.push_back(
        {.where = "--only",
         .value = std::to_string(number),
         .limit = fmt::format("is not a run of this plan, whose runs have the numbers 0 to {}", runs - 1),
         .cure = "choose one of these numbers"});
    return {};
  }
  base::Result<analysis::PlannedRun> run = plan->scenarios->run(number);
  if (!run) {
    append(into.problems, run.problems());
    return {};
  }
  return Job(std::move(run->scenario), origin_of_run(*plan, number));
}

base::Problems same_outputs(const RunArguments& arguments) {
  base::Problems problems;
  std::map<std::string, std::string> stems;
  for (const std::string& file : arguments.files) {
    const auto [other, is_new] = stems.emplace(std::filesystem::path(file).stem().string(), file);
    if (arguments.out.empty()) continue;
    if (other->first == "index")
      problems.push_back({.where = place(file),
                          .limit = "would write index.html, which lists all reports",
                          .cure = "rename this file, or run the file without --out"});
    if (!is_new)
      problems.push_back({.where = place(file),
                          .limit = fmt::format("would write the same outputs as {}", other->second),
                          .cure = "rename one of the files, or run the files one by one"});
  }
  std::vector<std::pair<std::string, std::string>> files = arguments.paths.files();
  files.emplace_back("--junit", arguments.junit);
  append(problems, duplicate_outputs(files));
  return problems;
}

struct NamedCore {
  std::string_view word;
  const loop::Core* value;
};

/// The core that --on names; null if only the host runs the drive.
const loop::Core* core_of(const RunArguments& arguments, JobsRead& read) {
  const loop::Core* core = nullptr;
  if (names_own_firmware(arguments)) {
    const base::Result<std::string> text = files::read_text(arguments.on);
    base::Result<loop::Core> own =
        text ? loop::own_firmware(arguments.on, *text) : base::Result<loop::Core>(text.problems());
    if (own) return (read.own_core = std::make_unique<loop::Core>(std::move(*own))).get();
    append(read.problems, own.problems());
    return nullptr;
  }
  std::vector<NamedCore> known;
  for (const loop::Core& one : loop::cores()) known.push_back({one.name, &one});
  if (!arguments.on.empty()) choose("--on", arguments.on, known, core, read.problems);
  return core;
}

}  // namespace

base::Problems contradictions(const RunArguments& arguments) {
  base::Problems problems;
  const bool single = arguments.paths.any();
  if (compares(arguments))
    append(problems, check_comparison(arguments));
  else if (single && (arguments.files.size() > 1 || !arguments.out.empty()))
    problems.push_back({.where = all_options(),
                        .limit = "apply to one scenario only",
                        .cure = "for several files use only --out DIR, or only --html to compare the files"});
  if (!arguments.paths.of(uart_option).empty() && !on_a_chip(arguments))
    problems.push_back({.where = std::string(uart_option),
                        .limit = "writes the serial output of a chip, but this run has no chip",
                        .cure = "add --on avr, or the map of your own firmware"});
  append(problems, same_outputs(arguments));
  return problems;
}

JobsRead read_jobs(const RunArguments& arguments) {
  JobsRead read;
  const files::ReadOptions options = read_options(arguments.data_dir, arguments.sets, read.problems);
  const loop::Core* const core = core_of(arguments, read);
  if (!read.problems.empty()) return read;
  const bool one_of_a_plan = arguments.drive || arguments.plan.only;
  const bool twice = compares(arguments) && lays_over(arguments);
  std::vector<std::string> files = arguments.files;
  if (twice) files.push_back(files.front());
  for (const std::string& file : files)
    if (std::optional<Job> job = one_of_a_plan ? read_one_of_a_plan(file, arguments, read)
                                               : read_job(file, arguments, options, read))
      read.jobs.push_back(std::move(*job));
  if (twice && read.jobs.size() == 2) {
    read.jobs[0].tell_where(" on the host");
    read.jobs[1].tell_where(fmt::format(" on the {}", core->title));
    append(read.problems, read.jobs[1].take_core(core));
    return read;
  }
  for (Job& job : read.jobs) append(read.problems, job.take_core(core));
  return read;
}

}  // namespace cli
