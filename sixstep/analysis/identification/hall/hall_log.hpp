// SPDX-License-Identifier: Apache-2.0
// What was recorded of a motor that someone or something turned: Hall lines, and voltages where a probe hung there.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "sixstep/base/problem.hpp"

namespace sixstep::analysis {

enum class RecordedVoltages : std::uint8_t {
  none,
  lines,     ///< u_ab, u_bc, u_ca of the board's legs; the last may be left out
  terminals  ///< u_a, u_b, u_c against any one point
};

/// One row per sample, or one per change of a line, as logic analyzers export it.
struct HallLog {
  std::vector<double> t_s;          ///< rising
  std::vector<std::uint8_t> codes;  ///< H1 H2 H3 as bits 2, 1, 0
  RecordedVoltages voltages = RecordedVoltages::none;
  std::array<std::vector<double>, 3> u_V{};  ///< empty, or as long as t_s
};

/// What no reader of a file lets through: columns of different lengths, times that do not rise, no numbers.
base::Problems check(const HallLog& log);

/// Electrical turns that a log must hold at the least.
inline constexpr int least_turns = 3;

}  // namespace sixstep::analysis
