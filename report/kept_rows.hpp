// SPDX-License-Identifier: Apache-2.0
// Keeps the rows of a run for its report in bounded memory. Until the memory is full, every event is kept.
// Then an envelope replaces the older rows: each column's lowest and highest values. The latest rows and the
// rows of the largest step are kept.
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "report/thinning.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

/// Largest memory for the rows of a report, bytes. With all data that are computed from the rows, the program
/// needs less than 256 MiB.
inline constexpr std::size_t most_row_bytes = 160'000'000;

class KeptRows {
 public:
  /// The scenario must outlive this object. Reports that are written at the same time share the memory.
  explicit KeptRows(const sixstep::study::Scenario& scenario, std::size_t most_bytes = most_row_bytes);

  void add(sixstep::study::Row row);
  /// All columns at every event; trace().whole lists the intervals in which no envelope replaces rows.
  const sixstep::study::Trace& trace() const { return trace_; }

 private:
  std::size_t rows() const { return trace_.values.front().size(); }
  void thin();
  void keep_envelope(std::size_t begin, std::size_t end, std::size_t buckets);
  std::optional<Interval> step_to_keep(std::size_t end) const;
  void say_what_is_whole();

  const sixstep::study::Scenario* scenario_;
  sixstep::study::Trace trace_;
  std::size_t most_;              // largest number of rows
  std::size_t thinned_ = 0;       // number of rows of the envelope; they are at the beginning
  std::optional<Interval> step_;  // interval within the envelope whose rows are all kept
};

/// The message that the report will not contain all rows: rows_foretold() before the run, rows_told() after
/// it. Empty if the report contains all rows.
std::string rows_foretold(const sixstep::study::Scenario& scenario, std::size_t most_bytes = most_row_bytes);
std::string rows_told(const sixstep::study::Trace& trace);

}  // namespace report
