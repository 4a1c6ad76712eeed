// SPDX-License-Identifier: Apache-2.0
// From the words behind `sixstep run` to jobs, or to everything that is wrong with them.
#pragma once
#include <string>
#include <vector>

#include "faces/cli/job.hpp"
#include "faces/cli/run_command.hpp"

namespace cli {

/// Contradictions of the arguments themselves.
base::Problems contradictions(const RunArguments& arguments);

struct JobsRead {
  std::unique_ptr<loop::Core> own_core;  ///< of --on MAP, which its jobs point to
  std::vector<Job> jobs;
  base::Problems problems;
  std::vector<std::string> files;  ///< all that were read, or could not be
};

JobsRead read_jobs(const RunArguments& arguments);

}  // namespace cli
