// SPDX-License-Identifier: Apache-2.0
// Keeps the rows of a run for its report in bounded memory. Every event is kept until memory is full. Then an
// envelope, with each column's lowest and highest values, replaces the older rows. The latest rows and those
// of the largest step are kept.
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "report/thinning.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

/// Upper limit of memory for the rows of a report. Including everything made from them, the program stays
/// below 256 MiB.
inline constexpr std::size_t most_row_bytes = 160'000'000;

class KeptRows {
 public:
  /// The scenario must outlive this object. Reports that are made at the same time share the memory.
  explicit KeptRows(const sixstep::study::Scenario& scenario, std::size_t most_bytes = most_row_bytes);

  void add(sixstep::study::Row row);
  /// All columns at every event; `whole` gives the intervals without an envelope.
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
  std::size_t thinned_ = 0;       // number of rows of the envelope, which are the first rows
  std::optional<Interval> step_;  // interval among them that is kept completely
};

/// The message that the report will not keep all rows: an estimate before the run, a fact after it. Empty if
/// the report keeps all rows.
std::string rows_foretold(const sixstep::study::Scenario& scenario, std::size_t most_bytes = most_row_bytes);
std::string rows_told(const sixstep::study::Trace& trace);

}  // namespace report
