// SPDX-License-Identifier: Apache-2.0
// Makes jobs from the arguments of `sixstep run`, or reports everything that is wrong with these.
#pragma once
#include <string>
#include <vector>

#include "faces/cli/job.hpp"
#include "faces/cli/run_command.hpp"

namespace cli {

/// Problems of arguments that contradict each other.
base::Problems contradictions(const RunArguments& arguments);

struct JobsRead {
  std::unique_ptr<loop::Core> own_core;  ///< the core of --on MAP, to which the jobs point
  std::vector<Job> jobs;
  base::Problems problems;
  std::vector<std::string> files;  ///< files that were read, or could not be read
};

JobsRead read_jobs(const RunArguments& arguments);

}  // namespace cli
