// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/run_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <mutex>

#include "batch/for_each.hpp"
#include "faces/cli/compare_command.hpp"
#include "faces/cli/report_page.hpp"
#include "faces/cli/series_command.hpp"
#include "faces/cli/settings.hpp"
#include "faces/cli/terminal.hpp"
#include "io/scenario_file.hpp"
#include "io/verdict_table.hpp"
#include "sixstep/study/spread.hpp"

namespace cli {
namespace {

namespace fs = std::filesystem;

void append(base::Problems& to, const base::Problems& more) { to.insert(to.end(), more.begin(), more.end()); }

std::string place(const std::string& file) { return fmt::format("{}:", file); }

std::vector<Job> read_jobs(const RunArguments& arguments, base::Problems& problems) {
  std::vector<Job> jobs;
  const io::ReadOptions options = read_options(arguments.data_dir, arguments.sets, problems);
  if (!problems.empty()) return jobs;
  for (const std::string& file : arguments.files) {
    base::Result<study::Scenario> scenario = io::read_scenario(file, options);
    if (scenario && (arguments.runs > 0 || arguments.drive) && scenario->spread.empty())
      problems.push_back({.where = place(file),
                          .limit = "describes no series: all drives would be the same",
                          .cure = "say in [[spread]] what differs; see: sixstep help spread"});
    if (scenario && arguments.drive) *scenario = study::varied(*scenario, arguments.seed, *arguments.drive);
    if (scenario)
      jobs.emplace_back(file, std::move(*scenario), arguments.command);
    else
      append(problems, scenario.problems());
  }
  return jobs;
}

/// Several files and one page: they are laid over each other.
bool compares(const RunArguments& a) {
  const OutputPaths& p = a.paths;
  return a.files.size() > 1 && !p.html.empty() && p.csv.empty() && p.json.empty() && a.out.empty();
}

/// Contradictions of the arguments themselves.
base::Problems check(const RunArguments& arguments) {
  base::Problems problems;
  const OutputPaths& p = arguments.paths;
  const bool single = !p.csv.empty() || !p.json.empty() || !p.html.empty();
  if (compares(arguments))
    append(problems, check_comparison(arguments));
  else if (single && (arguments.files.size() > 1 || !arguments.out.empty()))
    problems.push_back(
        {.where = "--csv, --json, --html",
         .limit = "name the outputs of one scenario",
         .cure = "with several files or --out use --out DIR alone; --html alone compares the files"});
  if (arguments.runs > 0 && (single || !arguments.out.empty()))
    problems.push_back({.where = "--runs",
                        .limit = "writes no files of single runs",
                        .cure = "write those of one drive with --drive N instead of --runs"});
  std::map<std::string, std::string> stems;
  for (const std::string& file : arguments.files) {
    const auto [other, is_new] = stems.emplace(fs::path(file).stem().string(), file);
    if (!arguments.out.empty() && !is_new)
      problems.push_back({.where = place(file),
                          .limit = fmt::format("would write the same outputs as {}", other->second),
                          .cure = "rename one or run them apart"});
  }
  return problems;
}

OutputPaths paths_of(const RunArguments& arguments, const Job& job) {
  if (arguments.out.empty()) return arguments.paths;
  const std::string base = (fs::path(arguments.out) / job.name()).string();
  return {base + ".csv", base + ".json", base + ".html"};
}

/// Opens all outputs before anything runs. The index is the last to be written and proves the folder now.
base::Problems prepare(const RunArguments& arguments, std::vector<Job>& jobs,
                       std::optional<io::AtomicFile>& index) {
  base::Problems problems;
  if (!arguments.out.empty()) {
    std::error_code error;
    fs::create_directories(arguments.out, error);
    if (error)
      return {{.where = place(arguments.out),
               .limit = fmt::format("cannot be made a folder: {}", error.message()),
               .cure = "choose another --out"}};
    base::Result<io::AtomicFile> file =
        io::AtomicFile::create((fs::path(arguments.out) / "index.html").string());
    if (!file) return file.problems();
    index.emplace(std::move(*file));
  }
  for (Job& job : jobs) append(problems, job.prepare(paths_of(arguments, job)));
  return problems;
}

void run_all(std::vector<Job>& jobs, const RunArguments& arguments) {
  const bool progress = !arguments.quiet && jobs.size() > 1 && ::isatty(STDERR_FILENO) != 0;
  std::mutex guard;
  std::size_t done = 0;
  const auto tell = [&] {
    if (progress) print(fmt::format("\r{} of {} done", done, jobs.size()), stderr);
  };
  tell();
  batch::for_each(jobs.size(), arguments.jobs, [&](std::size_t n) {
    if (!interrupted()) jobs[n].run();
    const std::lock_guard lock(guard);
    ++done;
    tell();
  });
  if (progress) print("\r\x1b[K", stderr);
}

base::Problems write_index(const RunArguments& arguments, const std::vector<Job>& jobs,
                           io::AtomicFile& index) {
  std::vector<ReportLink> links;
  for (const Job& job : jobs)
    if (job.outcome()) links.push_back({job.scenario().title, job.name() + ".html", job.outcome()});
  index.write(report_index(links, arguments.command));
  return index.commit();
}

void print_table(const std::vector<Job>& jobs, const RunArguments& arguments) {
  std::vector<io::TableEntry> entries;
  for (const Job& job : jobs)
    if (job.outcome()) entries.push_back({job.name(), job.outcome()});
  std::FILE* to = arguments.paths.json == "-" ? stderr : stdout;  // standard output is the JSON's alone
  if (entries.empty()) return;
  print(io::verdict_table(entries, may_colour(to)), to);
  // Of runs that were cut short or never began no sum is drawn.
  if (!interrupted() && entries.size() == jobs.size())
    print(io::verdict_summary(entries, may_colour(to)), to);
}

}  // namespace

Exit run_command(const RunArguments& arguments) {
  base::Problems problems = check(arguments);
  std::vector<Job> jobs = problems.empty() ? read_jobs(arguments, problems) : std::vector<Job>();
  if (problems.empty() && arguments.runs > 0) return series_command(arguments, jobs);
  if (problems.empty() && compares(arguments)) return compare_command(arguments, jobs);
  std::optional<io::AtomicFile> index;
  if (problems.empty()) problems = prepare(arguments, jobs, index);
  if (!problems.empty()) {
    complain(problems);
    return Exit::bad_input;
  }
  catch_interrupts();
  run_all(jobs, arguments);
  Exit exit = interrupted() ? Exit::interrupted : Exit::ok;
  for (const Job& job : jobs) {
    if (!interrupted()) exit = graver(exit, job.exit_code());
    complain(job.problems());
  }
  if (!arguments.quiet) print_table(jobs, arguments);
  if (index && !interrupted()) {
    const base::Problems unwritten = write_index(arguments, jobs, *index);
    complain(unwritten);
    if (!unwritten.empty()) exit = graver(exit, Exit::bad_input);
  }
  return exit;
}

}  // namespace cli
