// SPDX-License-Identifier: Apache-2.0
// Lists the output formats of a run, each as an OpenSink.
#pragma once
#include "files/trace/sink.hpp"

namespace files {

base::Result<Sink> csv_sink(const Destination& to, const study::Scenario& scenario,
                            const TraceOrigin& origin);
/// A MAT file of version 5.
base::Result<Sink> mat_sink(const Destination& to, const study::Scenario& scenario,
                            const TraceOrigin& origin);
/// A MAT file of version 7.3, which is HDF5.
base::Result<Sink> mat73_sink(const Destination& to, const study::Scenario& scenario,
                              const TraceOrigin& origin);
base::Result<Sink> vcd_sink(const Destination& to, const study::Scenario& scenario,
                            const TraceOrigin& origin);
/// Verdicts and figures as JSON, without a trace.
base::Result<Sink> json_sink(const Destination& to, const study::Scenario& scenario,
                             const TraceOrigin& origin);

/// A file whose whole text is written after the run.
base::Result<Sink> page_sink(const Destination& to, std::function<std::string(const RunStory&)> page);

}  // namespace files
