// SPDX-License-Identifier: Apache-2.0
// Runs one scenario from its file to its outputs. Everything that can be refused is refused before the run
// begins.
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

  /// Opens every output. Problems: nothing was written, and the run must not start.
  base::Problems prepare(const OutputPaths& paths) {
    foretold_ = Outputs::foretold(paths, scenario_);
    return outputs_.open(paths, scenario_, origin_);
  }

  /// Sets the core that also runs the drive; null: only the host. Problems: a drive that no core can run.
  base::Problems take_core(const loop::Core* core);
  const loop::Core* core() const { return core_; }
  /// Sets `where`, which is appended to the name of one of two runs of a file.
  void tell_where(std::string where) { where_ = std::move(where); }

  /// Runs and publishes the outputs. `reached` is called repeatedly with the simulated time.
  void run(const std::function<void(double t_s)>& reached);

  Exit exit_code() const;
  std::string name() const;  ///< the file's stem, and the name of the core
  const study::Scenario& scenario() const { return scenario_; }
  const study::Outcome* outcome() const { return outcome_ ? &*outcome_ : nullptr; }
  bool begun() const { return outcome_ || !problems_.empty(); }
  /// Whether it ran to its end or to a fault.
  bool finished() const { return outcome_ && !interrupted_ && !broken_; }
  /// The path of its page, or of the partial page of an interrupted run; empty: none.
  const std::string& page() const { return outputs_.page(); }
  const base::Problems& problems() const { return problems_; }
  /// Messages if an output does not hold the whole run: an estimate before the run, the fact after it. Empty
  /// otherwise.
  std::string foretold() const;
  std::string left_out() const;
  /// The message about an interrupted run: the time, and the files with its results. Empty otherwise.
  std::string cut_short() const;

 private:
  /// Prefixes each problem with the scenario file's name.
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
  bool broken_ = false;       // an output could not be written any more
  bool reader_gone_ = false;  // the reader closed a pipe
};

}  // namespace cli
