// SPDX-License-Identifier: Apache-2.0
// Represents one output of a run in any format: opened before the run, filled during it, finished at its end.
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
  std::function<void(study::Row)> on_record, on_event;  ///< empty: not needed
  study::LogicSink on_logic;                            ///< empty: not needed
  std::function<bool()> failed;                         ///< it cannot be written any more; empty: never
  /// Puts the file under its name; under its partial name if the run was interrupted.
  std::function<base::Problems(const RunStory&, bool whole)> finish;
  std::function<std::string()>
      left_out;  ///< parts of the run that the file lacks, once finished; empty: none
};

/// Problems: it cannot be written; the run must not start.
using OpenSink = base::Result<Sink> (*)(const Destination&, const study::Scenario&, const TraceOrigin&);

}  // namespace files
