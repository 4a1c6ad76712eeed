// SPDX-License-Identifier: Apache-2.0
// Runs one scenario and writes its outputs. Invalid inputs are refused before the run.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "faces/cli/exit_code.hpp"
#include "faces/cli/outputs.hpp"
#include "faces/loop/cores.hpp"

namespace cli {

class Job {
 public:
  Job(study::Scenario scenario, files::TraceOrigin origin)
      : scenario_(std::move(scenario)), origin_(std::move(origin)) {}

  /// Opens every output. If it returns problems, nothing was written, and the run must not start.
  base::Problems prepare(const OutputPaths& paths) {
    foretold_ = Outputs::foretold(paths, scenario_);
    return outputs_.open(paths, scenario_, origin_);
  }

  /// Sets the core that also runs the drive; null: only the host runs the drive. Returns problems if the core
  /// cannot run this drive.
  base::Problems take_core(const loop::Core* core);
  const loop::Core* core() const { return core_; }
  /// Sets a word that is appended to the name if a file is run both on the host and on a chip.
  void tell_where(std::string where) { where_ = std::move(where); }

  /// Runs the scenario and publishes the outputs. `reached` is called repeatedly with the simulated time in
  /// s.
  void run(const std::function<void(double t_s)>& reached);

  Exit exit_code() const;
  std::string name() const;  ///< stem of the file's name, and the word of tell_where()
  const study::Scenario& scenario() const { return scenario_; }
  const study::Outcome* outcome() const { return outcome_ ? &*outcome_ : nullptr; }
  bool begun() const { return outcome_ || !problems_.empty(); }
  /// Whether the run reached its end or a fault.
  bool finished() const { return outcome_ && !interrupted_ && !broken_; }
  /// The path of the run's page, or of the partial page of an interrupted run; empty if there is none.
  const std::string& page() const { return outputs_.page(); }
  const base::Problems& problems() const { return problems_; }
  /// foretold(): before the run, a message if an output will not contain the whole run. left_out(): after the
  /// run, a message if an output does not contain it. Empty otherwise.
  std::string foretold() const;
  std::string left_out() const;
  /// The message about an interrupted run: it states the reached time and the files with the results. Empty
  /// if the run was not interrupted.
  std::string cut_short() const;

 private:
  /// Adds the scenario file's name in front of each problem.
  base::Problems told(base::Problems problems) const;
  void fail(const base::Problems& problems);

  study::Scenario scenario_;
  files::TraceOrigin origin_;
  Outputs outputs_;
  std::optional<study::Outcome> outcome_;
  base::Problems problems_;
  std::string foretold_;
  const loop::Core* core_ = nullptr;
  std::string where_;
  bool interrupted_ = false;
  bool broken_ = false;       // true: writing an output failed
  bool reader_gone_ = false;  // true: the reader of a pipe closed it
};

}  // namespace cli
