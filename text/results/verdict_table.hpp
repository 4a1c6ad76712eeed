// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>

#include "sixstep/study/measure/outcome.hpp"
#include "text/rooms.hpp"

namespace text {

struct TableEntry {
  std::string experiment;  ///< short name of the experiment
  const study::Outcome* outcome = nullptr;
};

/// Each experiment's name, and below it one line per requirement and per comparison: figure, required or
/// expected value, measured value, ok or deviation, source.
std::string verdict_table(std::span<const TableEntry> entries, bool colour);

/// The last line: "22 experiments: all 43 requirements hold", or the number of requirements that fail.
std::string verdict_summary(std::span<const TableEntry> entries, bool colour);

/// One line for each experiment that a fault stopped, for callers that print no table.
std::string faults_text(std::span<const TableEntry> entries);

/// Of a recording: "within +- 1.2 us", or "beyond by 0.2 A (+- 0.1 A)" with the deviation in per cent.
std::string recorded_verdict(const study::ComparisonResult& comparison);

/// The deviation: "-0.25 %", "x 12", or the difference if a percentage has no meaning. "not comparable" if
/// the measured value is not finite. Empty if the expected value is zero, because the measured value is then
/// itself the difference. Of a recording with its verdict.
std::string deviation_text(const study::ComparisonResult& comparison);

}  // namespace text
