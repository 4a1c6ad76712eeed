// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "faces/cli/job.hpp"
#include "faces/cli/verb.hpp"

namespace cli {

/// Of many runs.
struct PlanArguments {
  std::vector<std::string> vary;  ///< "key=from:to:points" or "key=value,value"
  std::string sampling;           ///< one of analysis::sampling_choices; empty: the plan's own
  std::size_t points = 0;
  bool tolerances = false;  ///< drives stray in what the sheet does not promise, too
  std::string store;
  bool resume = false, dry_run = false;
  std::optional<std::uint64_t> only;  ///< the run that is made alone, as any other scenario
};

/// What a board sent over its serial line while it ran, or what somebody recorded of it.
struct LogArguments {
  std::string path;                  ///< empty: none
  std::optional<double> shift_s;     ///< that is added to its times; without it they are fitted
  std::vector<std::string> columns;  ///< "speed=erpm*2*pi/60/7"; empty: by the headings
  std::optional<double> interval_s;  ///< of its rows, where none is a time
};

struct RunArguments {
  std::vector<std::string> files;
  std::string out;                ///< folder for the outputs of each file, and index.html of scenarios
  OutputPaths paths;              ///< for one file only
  std::vector<std::string> sets;  ///< "key=value"
  std::string data_dir;
  bool quiet = false;
  bool watch = false;
  unsigned jobs = 0;     ///< 0: one per core
  std::size_t runs = 0;  ///< of a series; 0: the nominal run alone
  std::optional<std::uint64_t> seed;
  std::optional<std::uint64_t> drive;  ///< the one of the series that is run alone
  PlanArguments plan;
  bool bode = false;                ///< the loop's frequency response, instead of a run
  std::optional<double> amplitude;  ///< of its multisine, in the mode's unit
  std::string junit;                ///< verdicts for build servers
  std::string on;       ///< the core that runs the drive, beside the host or in its place; empty: none
  LogArguments log;     ///< to lay over the run
  std::string command;  ///< the command line as it may be typed again
};

/// `sixstep run FILE ..`: runs scenarios, judges them, writes what is asked for.
Verb declare_run(CLI::App& app);

}  // namespace cli
