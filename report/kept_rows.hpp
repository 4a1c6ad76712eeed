// SPDX-License-Identifier: Apache-2.0
// The rows of a run while it goes on, for its report, in bounded memory: every event, until they would take
// more. Then the older ones give way to an envelope, which keeps each column's lowest and highest values; the
// latest and those of the largest step stay.
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "report/thinning.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

/// What the rows of a report take at most. With all that is made of them the program stays below 256 MiB.
inline constexpr std::size_t most_row_bytes = 160'000'000;

class KeptRows {
 public:
  /// The scenario must live as long. Where several reports are made at once, each has its part of the memory.
  explicit KeptRows(const sixstep::study::Scenario& scenario, std::size_t most_bytes = most_row_bytes);

  void add(sixstep::study::Row row);
  /// Of all columns at every event; `whole` says where an envelope stands.
  const sixstep::study::Trace& trace() const { return trace_; }

 private:
  std::size_t rows() const { return trace_.values.front().size(); }
  void thin();
  void keep_envelope(std::size_t begin, std::size_t end, std::size_t buckets);
  std::optional<Interval> step_to_keep(std::size_t end) const;
  void say_what_is_whole();

  const sixstep::study::Scenario* scenario_;
  sixstep::study::Trace trace_;
  std::size_t most_;              // rows
  std::size_t thinned_ = 0;       // rows of envelope in front
  std::optional<Interval> step_;  // kept whole among them
};

/// What is told where the rows of a run are more than its report keeps: before the run, as far as can be
/// said, and after it. Empty where they are not.
std::string rows_foretold(const sixstep::study::Scenario& scenario, std::size_t most_bytes = most_row_bytes);
std::string rows_told(const sixstep::study::Trace& trace);

}  // namespace report
