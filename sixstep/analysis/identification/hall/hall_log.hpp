// SPDX-License-Identifier: Apache-2.0
// A recording of a motor whose shaft is turned: Hall lines, and voltages if probes were connected.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "sixstep/base/problem.hpp"

namespace sixstep::analysis {

enum class RecordedVoltages : std::uint8_t {
  none,
  lines,     ///< voltages u_ab, u_bc, u_ca of the board's legs; u_ca may be missing
  terminals  ///< voltages u_a, u_b, u_c against a common point
};

/// A log with one row per sample, or one per change of a line, as logic analyzers export it.
struct HallLog {
  std::vector<double> t_s;          ///< rising times
  std::vector<std::uint8_t> codes;  ///< H1, H2, H3 in bits 2, 1, 0
  RecordedVoltages voltages = RecordedVoltages::none;
  std::array<std::vector<double>, 3> u_V{};  ///< empty, or as long as t_s
};

/// Problems: columns of different lengths, times that do not rise, codes above 7, no numbers.
base::Problems check(const HallLog& log);

/// Least number of electrical turns in a log.
inline constexpr int least_turns = 3;

}  // namespace sixstep::analysis
