// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/plan_ranks.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "batch/byte_format.hpp"
#include "batch/cluster.hpp"
#include "batch/ranks.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"
#include "files/controller_watch.hpp"
#include "files/scenario_on_disk.hpp"

namespace cli {
namespace {

/// The cluster of this process. A process can initialise MPI only once.
struct Ranks {
  batch::Cluster cluster;
  bool whole = true;  ///< false: a process of the cluster ended unexpectedly
};

Ranks& ranks() {
  static Ranks all;
  return all;
}

// Messages between the processes, as bytes. Only the leader opens files; the other processes request named
// texts from the leader.

std::string bytes_of(const text::PlannedText& of) {
  batch::ByteWriter w;
  w.text(of.name);
  w.text(of.text);
  w.list(of.options.overrides, [&](const text::Setting& set) {
    w.text(set.path);
    w.text(set.text);
  });
  w.whole(of.sheet_tolerances);
  return std::move(w).bytes();
}

text::PlannedText planned_text(const std::string& bytes) {
  batch::ByteReader r(bytes);
  text::PlannedText of;
  of.name = r.text();
  of.text = r.text();
  of.options.overrides = r.list<text::Setting>([&] { return text::Setting{r.text(), r.text()}; });
  of.sheet_tolerances = r.yes();
  return of;
}

std::string bytes_of(const text::Naming& naming) {
  batch::ByteWriter w;
  w.whole(static_cast<std::uint64_t>(naming.kind));
  w.text(naming.name);
  w.text(naming.from);
  return std::move(w).bytes();
}

std::string bytes_of(const base::Result<text::NamedText>& found) {
  batch::ByteWriter w;
  if (found) {
    w.text(found->name);
    w.text(found->text);
  } else {
    w.list(found.problems(), [&](const base::Problem& problem) {
      for (const std::string& word : {problem.where, problem.value, problem.limit, problem.cure})
        w.text(word);
    });
  }
  return (found ? "+" : "-") + std::move(w).bytes();
}

base::Result<text::NamedText> named_text(const std::string& bytes) {
  batch::ByteReader r(std::string_view(bytes).substr(1));
  if (bytes.front() == '+') return text::NamedText{r.text(), r.text()};
  return r.list<base::Problem>([&] { return base::Problem{r.text(), r.text(), r.text(), r.text()}; });
}

std::string answer(const text::Resolve& resolve, const std::string& question) {
  batch::ByteReader r(question);
  return bytes_of(resolve({r.choice<text::Naming::Kind>(4), r.text(), r.text()}));
}

/// The function that returns the run of a number, in a process that receives all texts from the leader.
decltype(batch::PlanRuns::scenario) planned_scenario(const std::string& made_of, const analysis::Plan& plan,
                                                     batch::Ask ask) {
  text::PlannedText of = planned_text(made_of);
  of.options.resolve = [ask = std::move(ask)](const text::Naming& naming) -> base::Result<text::NamedText> {
    if (naming.kind == text::Naming::Kind::controller) return files::on_disk()(naming);
    return named_text(ask(bytes_of(naming)));
  };
  const auto scenarios = std::make_shared<text::PlannedScenarios>(std::move(of), plan);
  return [scenarios](std::size_t n) {
    files::controllers_make_run(n);
    return scenarios->run(n);
  };
}

}  // namespace

Exit among_ranks(const std::function<Exit()>& program) {
  base::Result<batch::Cluster> joined = batch::join_ranks();
  if (!joined) {
    if (batch::started().rank == 0) complain(joined.problems());
    return Exit::bad_input;
  }
  batch::Cluster& cluster = ranks().cluster = std::move(*joined);
  // Switches colours off: mpirun connects the first process to a terminal even if the output goes to a file.
  if (cluster.size > 1) ::setenv("NO_COLOR", "1", 1);
  Exit exit = Exit::ok;
  if (cluster.rank == 0) {
    exit = program();
    if (!ranks().whole) return exit;  // the launcher ends the remaining processes
    batch::dismiss(cluster, static_cast<int>(exit));
  } else {
    catch_interrupts();
    exit = static_cast<Exit>(batch::follow(cluster, planned_scenario, interrupted));
  }
  batch::part();
  return exit;
}

unsigned threads_for_runs(unsigned jobs) {
  const unsigned processes = ranks().cluster.size;
  if (processes > 1) return processes * std::max(1U, jobs);
  return jobs > 0 ? jobs : std::max(1U, std::thread::hardware_concurrency());
}

void make(const batch::PlanRuns& runs, const ReadPlan& plan) {
  if (ranks().cluster.size == 1) return batch::run_plan(runs);
  const text::PlannedText& of = plan.scenarios->made_of();
  const auto answered = [&](const std::string& question) { return answer(of.options.resolve, question); };
  ranks().whole &= batch::lead_plan(ranks().cluster, runs, {bytes_of(of), answered});
}

}  // namespace cli
