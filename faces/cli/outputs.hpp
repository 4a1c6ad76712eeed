// SPDX-License-Identifier: Apache-2.0
// The files of one run: opened before it begins, filled while it goes on, put in place at its end.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "faces/cli/rooms.hpp"
#include "files/trace/csv_writer.hpp"
#include "files/trace/mat_writer.hpp"
#include "files/trace/vcd_writer.hpp"
#include "report/kept_rows.hpp"
#include "sixstep/study/run/run.hpp"

namespace cli {

struct OutputPaths {
  std::string csv, mat, mat73, vcd, json, html;  ///< empty: not wanted; json "-": standard output
  bool force = false;                            ///< over whatever is there

  /// Each that is wanted with its option, standard output left out.
  std::vector<std::pair<std::string, std::string>> files() const;
};

/// A run and what it came to, as the summary and the report tell it.
struct RunStory {
  const study::Scenario& scenario;
  const study::Outcome& outcome;
  const files::TraceOrigin& origin;
};

class Outputs {
 public:
  /// Problems mean that nothing was written and nothing must run.
  base::Problems open(const OutputPaths& paths, const study::Scenario& scenario,
                      const files::TraceOrigin& origin);

  /// The scenario must live as long as the run.
  void listen(const study::Scenario& scenario, study::Listeners& listeners);

  /// What the report has of the run, where it has not all; known once it is published.
  const std::string& rows_told() const { return rows_told_; }

  /// One of them can be written no longer: a disk is full, or the reader of a pipe has gone.
  bool failed() const;

  /// A run that was cut short leaves NAME.partial.EXT of each, and nothing on standard output.
  base::Problems publish(const RunStory& story, bool whole);

  /// Where the report stands in the end; empty where there is none.
  const std::string& report() const { return report_; }

  /// The names under which a cut run's files stand.
  const std::vector<std::string>& partial_files() const { return partial_files_; }

 private:
  template <class File, class... Facts>
  std::string put(std::optional<File>& file, const std::string& path, bool whole, Facts... facts);

  OutputPaths paths_;
  std::optional<files::CsvWriter> csv_;
  std::optional<files::MatWriter> mat_, mat73_;
  std::optional<files::VcdWriter> vcd_;
  std::optional<files::AtomicFile> json_, html_;
  std::optional<report::KeptRows> events_;  // for the report only
  base::Problems problems_;
  std::string report_, rows_told_;
  std::vector<std::string> partial_files_;
};

}  // namespace cli
