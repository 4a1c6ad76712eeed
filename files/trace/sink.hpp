// SPDX-License-Identifier: Apache-2.0
// One output of a run, whatever its format: opened before the run begins, filled while it goes on, put in
// place at its end.
#pragma once
#include <functional>
#include <string>

#include "files/atomic_file.hpp"
#include "files/trace/trace_origin.hpp"
#include "sixstep/study/run/run.hpp"

namespace files {

/// A run and what it came to, as the outputs that are written at its end tell it.
struct RunStory {
  const study::Scenario& scenario;
  const study::Outcome& outcome;
  const TraceOrigin& origin;
};

struct Sink {
  std::function<void(study::Row)> on_record, on_event;  ///< empty: it needs none
  study::LogicSink on_logic;                            ///< likewise
  std::function<bool()> failed;                         ///< it can be written no longer; empty: never
  /// Puts it in place; of a run that was cut short under its partial name.
  std::function<base::Problems(const RunStory&, bool whole)> finish;
  std::function<std::string()> left_out;  ///< what it has not of the run, once finished; empty: nothing
};

/// Problems mean that it cannot be written: nothing must run.
using OpenSink = base::Result<Sink> (*)(const Destination&, const study::Scenario&, const TraceOrigin&);

}  // namespace files
