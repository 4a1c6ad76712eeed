// SPDX-License-Identifier: Apache-2.0
// Processes on one machine or many that make a plan's runs together. The first one leads: it reads, hands out numbers of runs,
// keeps the rows, prints and writes; the others make runs and send rows, and open no file. Nothing here knows what carries the
// letters between them: batch/ranks.hpp brings MPI, the tests bring threads.
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "batch/plan_runs.hpp"

namespace batch {

struct Mail {
  unsigned from = 0;
  std::string bytes;
};

/// A process as one of them. Both functions are called by one thread alone.
struct Cluster {
  unsigned rank = 0;  ///< 0 leads
  unsigned size = 1;
  /// Comes back at once. Letters arrive in the order in which they were sent.
  std::function<void(unsigned to, std::string bytes)> send;
  /// The next letter that has arrived, if one has.
  std::function<std::optional<Mail>()> receive;
};

/// What the leader's face tells the others' of the plan: bytes that only faces read.
struct Briefing {
  std::string made_of;
  /// Of what they ask while they work; on the thread that leads.
  std::function<std::string(const std::string& question)> answer;
};

/// run_plan() with the others' help: rows come in whatever order, `take` is called as there. Without `jobs` each process has one
/// thread for runs. False where somebody left without a word, and there is no waiting for him.
bool lead_plan(Cluster& cluster, const PlanRuns& runs, const Briefing& briefing);

/// The leader's last word: the others end, too.
void dismiss(Cluster& cluster, int exit);

/// Asks the leader, from any thread, and waits for what it answers.
using Ask = std::function<std::string(std::string question)>;

/// What another process than the leader's does: plan after plan, until it is dismissed with the leader's exit. `prepare` makes of
/// a briefing what turns a number into a run. Where `told_to_end` says so, it makes no more runs and waits for the last word.
using Prepare = std::function<decltype(PlanRuns::scenario)(const std::string& made_of,
                                                           const analysis::Plan& plan, Ask ask)>;
int follow(Cluster& cluster, const Prepare& prepare, const std::function<bool()>& told_to_end);

}  // namespace batch
