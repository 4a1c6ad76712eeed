// SPDX-License-Identifier: Apache-2.0
// One scenario from file to files. Everything that can be refused is refused before the run begins.
#pragma once
#include <optional>
#include <string>

#include "faces/cli/exit_code.hpp"
#include "faces/cli/rooms.hpp"
#include "io/atomic_file.hpp"
#include "io/csv_writer.hpp"
#include "sixstep/study/run.hpp"

namespace cli {

struct OutputPaths {
  std::string csv, json, html;  ///< empty: not wanted; json "-": standard output
};

class Job {
 public:
  Job(std::string file, study::Scenario scenario, std::string command)
      : file_(std::move(file)), scenario_(std::move(scenario)), command_(std::move(command)) {}

  /// Opens every output; Problems mean that nothing was written and nothing must run.
  base::Problems prepare(const OutputPaths& paths);

  /// Runs and puts the outputs in place.
  void run();

  Exit exit_code() const;
  std::string name() const;  ///< the file's stem
  const study::Scenario& scenario() const { return scenario_; }
  const study::Outcome* outcome() const { return outcome_ ? &*outcome_ : nullptr; }
  const base::Problems& problems() const { return problems_; }

 private:
  study::Listeners listeners();
  void publish();
  void note(base::Problems problems);

  std::string file_;
  study::Scenario scenario_;
  std::string command_;
  std::optional<io::CsvWriter> csv_;
  std::optional<io::AtomicFile> json_, html_;
  bool json_to_stdout_ = false;
  study::Trace events_;  // for the report only
  std::optional<study::Outcome> outcome_;
  base::Problems problems_;
  bool interrupted_ = false;
};

}  // namespace cli
