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

/// Arguments of a plan.
struct PlanArguments {
  std::vector<std::string> vary;  ///< "key=from:to:points" or "key=value,value"
  std::string sampling;           ///< one of analysis::sampling_choices; empty: as in the plan
  std::size_t points = 0;
  bool tolerances = false;  ///< true: drives also differ within the sheet's tolerances
  std::string store;
  bool resume = false, dry_run = false;
  std::optional<std::uint64_t> only;  ///< number of the plan's only run to make, with the outputs of a
                                      ///< scenario
};

/// Arguments of a board's log or of another recording.
struct LogArguments {
  std::string path;                  ///< path of the log; empty: none
  std::optional<double> shift_s;     ///< time added to the log's times, s; empty: fitted
  std::vector<std::string> columns;  ///< formulas such as "speed=erpm*2*pi/60/7"; empty: columns by their
                                     ///< headings
  std::optional<double> interval_s;  ///< interval of the log's rows, if no column is a time
  std::optional<int> esc;            ///< number of the ESC in a log of several ESCs
};

struct RunArguments {
  std::vector<std::string> files;
  std::string out;                ///< folder for the outputs of each file, and for index.html of scenarios
  OutputPaths paths;              ///< output paths, for a single file only
  std::vector<std::string> sets;  ///< settings of the scenario: "key=value"
  std::string data_dir;
  bool quiet = false;
  bool watch = false;
  unsigned jobs = 0;     ///< number of threads; 0: one per core
  std::size_t runs = 0;  ///< number of drives of a series; 0: only the nominal run
  std::optional<std::uint64_t> seed;
  std::optional<std::uint64_t> drive;  ///< number of the only drive of the series to run
  PlanArguments plan;
  bool bode = false;                ///< true: measures the loop's frequency response instead of a run
  std::optional<double> amplitude;  ///< amplitude of the multisine, in the mode's unit; empty: the default
  std::string junit;                ///< file with verdicts for build servers
  std::string
      on;  ///< core that runs the drive, beside the host or instead of it; empty: only the host runs the drive
  LogArguments log;     ///< log to compare with the run
  std::string command;  ///< the command line as it can be typed again
};

/// `sixstep run FILE ..`: runs scenarios, judges them, writes the requested outputs.
Verb declare_run(CLI::App& app);

}  // namespace cli
