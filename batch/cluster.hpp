// SPDX-License-Identifier: Apache-2.0
// Makes a plan's runs with several processes on one or more machines. The first process, the leader, reads,
// distributes run numbers, stores the rows, prints and writes. The other processes make runs and send rows;
// they open no file. The transport of messages is exchangeable: MPI in batch/ranks.hpp, threads in the tests.
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

/// One process of the cluster. Only one thread may call `send` and `receive`.
struct Cluster {
  unsigned rank = 0;  ///< 0 is the leader
  unsigned size = 1;
  /// Sends a message without blocking. Messages arrive in the order in which they were sent.
  std::function<void(unsigned to, std::string bytes)> send;
  /// Returns the next message, if one has arrived.
  std::function<std::optional<Mail>()> receive;
};

/// The leader's data about the plan for the other processes: bytes that only the command-line program
/// interprets.
struct Briefing {
  std::string made_of;
  /// Answers the other processes' questions during the work, on the leading thread.
  std::function<std::string(const std::string& question)> answer;
};

/// run_plan() with the help of the other processes. Rows arrive in any order; `take` is called as in
/// run_plan(). If `jobs` is 0, each process has one thread for runs. Returns false if a process ended
/// unexpectedly; then no function may wait for this process.
bool lead_plan(Cluster& cluster, const PlanRuns& runs, const Briefing& briefing);

/// Ends the other processes with this exit code.
void dismiss(Cluster& cluster, int exit);

/// Sends a question to the leader, from any thread, and waits for the answer.
using Ask = std::function<std::string(std::string question)>;

/// The work of a process that is not the leader: plan after plan, until the leader dismisses it. Returns the
/// leader's exit code. `prepare` returns, for a briefing, the function that returns the run of a number. If
/// `told_to_end` returns true, the process starts no more runs and waits for the dismissal.
using Prepare = std::function<decltype(PlanRuns::scenario)(const std::string& made_of,
                                                           const analysis::Plan& plan, Ask ask)>;
int follow(Cluster& cluster, const Prepare& prepare, const std::function<bool()>& told_to_end);

}  // namespace batch
