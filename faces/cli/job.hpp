// SPDX-License-Identifier: Apache-2.0
// One scenario from file to files. Everything that can be refused is refused before the run begins.
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

  /// Opens every output; Problems mean that nothing was written and nothing must run.
  base::Problems prepare(const OutputPaths& paths) {
    foretold_ = Outputs::foretold(paths, scenario_);
    return outputs_.open(paths, scenario_, origin_);
  }

  /// Runs its drive on a core too; null: on the host alone. Problems: a drive that none can run.
  base::Problems take_core(const loop::Core* core);
  const loop::Core* core() const { return core_; }
  /// One of two runs of a file: `where` follows its name.
  void tell_where(std::string where) { where_ = std::move(where); }

  /// Runs and puts the outputs in place. `reached` hears the simulated time now and then.
  void run(const std::function<void(double t_s)>& reached);

  Exit exit_code() const;
  std::string name() const;  ///< the file's stem, and where it ran
  const study::Scenario& scenario() const { return scenario_; }
  const study::Outcome* outcome() const { return outcome_ ? &*outcome_ : nullptr; }
  bool begun() const { return outcome_ || !problems_.empty(); }
  /// It ran to its end, or to a fault.
  bool finished() const { return outcome_ && !interrupted_ && !broken_; }
  /// The path of its page, or of what a run that was cut short left of one; empty where there is none.
  const std::string& page() const { return outputs_.page(); }
  const base::Problems& problems() const { return problems_; }
  /// Where an output does not hold all of it: said before it runs, about, and after it. Empty else.
  std::string foretold() const;
  std::string left_out() const;
  /// Of a run that was ended before its time: when, and what stands where. Empty else.
  std::string cut_short() const;

 private:
  /// With the file in front: of many, which.
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
  bool broken_ = false;       // an output could be written no longer
  bool reader_gone_ = false;  // a pipe was closed at its other end
};

}  // namespace cli
