// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/bode_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "faces/cli/run_reading.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"
#include "files/atomic_file.hpp"
#include "files/own_file.hpp"
#include "report/bode_page.hpp"
#include "sixstep/analysis/bode/bode_study.hpp"
#include "text/escape/escape.hpp"
#include "text/results/bode_text.hpp"

namespace cli {
namespace {

struct BodeFile {
  std::string option;
  files::AtomicFile file;
};

/// Refuses options of ordinary runs that a measurement does not use.
base::Problems strangers(const RunArguments& a) {
  base::Problems problems;
  const auto refuse = [&](const char* option, bool given) {
    if (given)
      problems.push_back({.where = option,
                          .limit = "has no effect with --bode",
                          .cure = "leave this option out; --bode writes only --html, --json and --csv"});
  };
  refuse("--out", !a.out.empty());
  refuse("--junit", !a.junit.empty());
  refuse("--watch", a.watch);
  refuse("--mat", !a.paths.of("--mat").empty());
  refuse("--vcd", !a.paths.of("--vcd").empty());
  refuse("--runs", a.runs > 0);
  refuse("--vary", !a.plan.vary.empty());
  refuse("--store", !a.plan.store.empty());
  refuse("--dry-run", a.plan.dry_run);
  if (a.amplitude && !(*a.amplitude > 0.0 && std::isfinite(*a.amplitude)))
    problems.push_back({.where = "--amplitude",
                        .value = fmt::format("{}", *a.amplitude),
                        .limit = "must be above 0",
                        .cure = "give the multisine's peak, in the unit of control.mode"});
  return problems;
}

base::Result<std::vector<BodeFile>> opened(const OutputPaths& paths) {
  std::vector<BodeFile> out;
  for (const auto& [option, path] : paths.files()) {
    if (option == "--csv" && path == "-") continue;  // the CSV is printed, like the JSON
    base::Result<files::AtomicFile> file = files::AtomicFile::create({path, paths.force});
    if (!file) return file.problems();
    out.push_back({option, std::move(*file)});
  }
  return out;
}

std::string content(const std::string& option, const std::string& name, const analysis::BodeStudy& s,
                    const RunArguments& a) {
  if (option == "--csv") return files::csv_head(a.command) + text::bode_csv(s);
  if (option == "--json") return text::bode_json(name, s);
  return report::render_bode({name, s, a.command, SIXSTEP_VERSION});
}

base::Problems write(std::vector<BodeFile>& files, const std::string& name, const analysis::BodeStudy& s,
                     const RunArguments& a) {
  base::Problems unwritten;
  for (BodeFile& f : files) {
    f.file.write(content(f.option, name, s, a));
    const base::Problems wrong = f.file.commit();
    unwritten.insert(unwritten.end(), wrong.begin(), wrong.end());
  }
  return unwritten;
}

/// In problems, names the keys of the file, and the option --amplitude.
base::Problems told(base::Problems problems, const std::string& name) {
  for (base::Problem& p : problems) {
    p.where = name + ": " + p.where;
    if (p.cure.starts_with("give an amplitude"))
      p.cure = "give --amplitude in the unit of control.mode, or set a final reference other than zero";
  }
  return problems;
}

Exit measure(const Job& job, const RunArguments& a, std::vector<BodeFile>& files) {
  const base::Result<analysis::BodeStudy> s = analysis::study_bode(
      job.scenario(), {.amplitude = a.amplitude, .keep_going = [](double) { return !interrupted(); }});
  if (interrupted()) return told_interrupted("the measurement of " + job.name());
  if (!s) return refused(told(s.problems(), job.name()));
  if (const base::Problems unwritten = write(files, job.name(), *s, a); !unwritten.empty())
    return refused(unwritten);
  for (const char* option : {"--csv", "--json"})
    if (a.paths.of(option) == "-") print(content(option, job.name(), *s, a));
  const bool prints = a.paths.prints() || a.paths.of("--csv") == "-";
  if (!a.quiet) print(text::bode_text(job.name(), *s), prints ? stderr : stdout);
  // A quiet run prints only one message, if no line of the spectrum has a coherence of at least 0.9.
  const bool answered = analysis::answered(s->points);
  if (a.quiet && !answered)
    print(
        text::visible(job.name()) +
            ": NOTHING WAS MEASURED: no line reaches a coherence of 0.9; run without --quiet for the reason\n",
        stderr);
  return answered ? Exit::ok : Exit::failed;
}

}  // namespace

Exit bode_command(const RunArguments& a) {
  if (const base::Problems problems = strangers(a); !problems.empty()) return refused(problems);
  const JobsRead read = read_jobs(a);
  if (!read.problems.empty()) return refused(read.problems);
  base::Result<std::vector<BodeFile>> files = opened(a.paths);
  if (!files) return refused(files.problems());
  Exit exit = Exit::ok;
  for (const Job& job : read.jobs) {
    if (interrupted()) break;
    exit = graver(exit, measure(job, a, *files));
  }
  return exit;
}

}  // namespace cli
