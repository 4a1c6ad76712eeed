// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>

#include "io/rooms.hpp"
#include "sixstep/study/outcome.hpp"

namespace io {

struct TableEntry {
  std::string experiment;  ///< short name
  const study::Outcome* outcome = nullptr;
};

/// One line per requirement: experiment, figure, required, measured, ok. Comparisons beneath, with their
/// deviation.
std::string verdict_table(std::span<const TableEntry> entries, bool colour);

/// "<= 0.001 s", ">= 5 A", "4.9 .. 5.1 A".
std::string required_text(const study::Verdict& verdict);

/// "-0.25 %"; where the source says zero the difference itself.
std::string deviation_text(const study::ComparisonResult& comparison);

}  // namespace io
