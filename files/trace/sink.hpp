// SPDX-License-Identifier: Apache-2.0
// One output of a run in any format. It is opened before the run, filled during the run, and finished at the
// run's end.
#pragma once
#include <functional>
#include <string>

#include "files/atomic_file.hpp"
#include "files/trace/trace_origin.hpp"
#include "sixstep/study/run/run.hpp"

namespace files {

/// A run and its results, for outputs that are written at its end.
struct RunStory {
  const study::Scenario& scenario;
  const study::Outcome& outcome;
  const TraceOrigin& origin;
};

struct Sink {
  std::function<void(study::Row)> on_record, on_event;  ///< empty if the output does not need rows
  study::LogicSink on_logic;                            ///< empty if the output does not need logic signals
  std::function<bool()>
      failed;  ///< returns true if the output can no longer be written; empty: it never fails
  /// Renames the file to its final name, or to its partial name if the run was interrupted.
  std::function<base::Problems(const RunStory&, bool whole)> finish;
  std::function<std::string()> left_out;  ///< parts of the run that the finished file lacks; empty: none
};

/// Opens an output. Problems: the output cannot be written, and the run must not start.
using OpenSink = base::Result<Sink> (*)(const Destination&, const study::Scenario&, const TraceOrigin&);

}  // namespace files
