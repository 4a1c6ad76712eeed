// SPDX-License-Identifier: Apache-2.0
// Makes jobs from the arguments of `sixstep run`, or reports all errors of the arguments.
#pragma once
#include <string>
#include <vector>

#include "faces/cli/job.hpp"
#include "faces/cli/run_command.hpp"

namespace cli {

/// Problems of arguments that contradict each other.
base::Problems contradictions(const RunArguments& arguments);

struct JobsRead {
  std::unique_ptr<loop::Core> own_core;  ///< the core of --on MAP; the jobs point to it
  std::vector<Job> jobs;
  base::Problems problems;
  std::vector<std::string> files;  ///< files that were read, or could not be read
};

JobsRead read_jobs(const RunArguments& arguments);

}  // namespace cli
