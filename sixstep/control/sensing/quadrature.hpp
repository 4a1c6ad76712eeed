// SPDX-License-Identifier: Apache-2.0
// Incremental encoder: decodes the lines A, B and Z to four counts per line, a direction and an angle.
//
//   A = 1 while frac(N theta_m/(2 pi)) < 1/2; B lags A by a quarter of a line (model.md 10)
//   AB forward: 10, 11, 01, 00
//
// N is the number of lines, theta_m the mechanical angle. A change of A and B at once is invalid: one step
// was missed, or a line is disturbed. The decoder then adds two counts in the last direction, so that the
// count stays consistent with the lines. `illegal` counts these changes.
//
// Z is high over one line, beginning at theta_m = 0. Z is evaluated in one of the four quarters of this line.
// Default: the third quarter, where an edge of Z may be nearly two counts early or late. The first index
// defines zero. At each later index, missed counts are detected and corrected.
//
// On a chip whose timer counts in hardware, call quadrature_moved() and quadrature_index() instead.
#pragma once
#include <cstdint>

#include "sixstep/control/sensing/binary_angle.hpp"

namespace sixstep::control {

/// Default: nothing is counted. quadrature_of_lines() returns a configuration.
struct QuadratureConfig {
  std::uint32_t counts = 0;        ///< counts of a turn, 4 N
  TurnParts turn{};                ///< turn_in_parts(counts)
  std::uint8_t index_quarter = 2;  ///< quarter of Z's line, 0..3, in which Z is evaluated
  bool operator==(const QuadratureConfig&) const = default;
};

/// Configuration of an encoder with N lines, N at most 2^28.
constexpr QuadratureConfig quadrature_of_lines(std::uint32_t lines) {
  return {4 * lines, turn_in_parts(4 * lines)};
}

struct QuadratureState {
  std::uint32_t in_turn = 0;  ///< 0..counts-1; relative to the initial position; after the first index
                              ///< relative to zero
  std::int32_t turns = 0;
  std::uint8_t quarter = 0xff;    ///< quarter of the line, 0..3; 0xff before the first reading
  std::int8_t direction = 0;      ///< direction of the last step
  bool referenced = false;        ///< true: an index was found
  std::uint32_t illegal = 0;      ///< number of simultaneous changes of A and B
  std::uint32_t corrections = 0;  ///< number of indexes at which counts were missing
  std::int32_t missed = 0;        ///< true count minus counted value at the last index
};

/// Adds `moved` counts; |moved| must be less than the counts of a turn.
constexpr void quadrature_moved(const QuadratureConfig& config, QuadratureState& state, std::int32_t moved) {
  if (config.counts == 0 || moved == 0) return;
  state.direction = moved > 0 ? std::int8_t{1} : std::int8_t{-1};
  const std::uint32_t way = detail::absolute(moved) % config.counts;
  if (moved > 0) {
    const std::uint32_t to_end = config.counts - state.in_turn;
    if (way >= to_end) ++state.turns;
    state.in_turn = way >= to_end ? way - to_end : state.in_turn + way;
  } else {
    if (way > state.in_turn) --state.turns;
    state.in_turn = way > state.in_turn ? state.in_turn + (config.counts - way) : state.in_turn - way;
  }
}

/// Processes an index that was found at count `at` within the rotor's turn.
constexpr void quadrature_index(const QuadratureConfig& config, QuadratureState& state, std::uint32_t at) {
  if (config.counts == 0) return;
  if (!state.referenced) {
    state.referenced = true;
    state.in_turn = at;
    state.turns = 0;
    return;
  }
  const std::uint32_t ahead = at >= state.in_turn ? at - state.in_turn : at + (config.counts - state.in_turn);
  state.missed = ahead <= config.counts / 2 ? static_cast<std::int32_t>(ahead)
                                            : -static_cast<std::int32_t>(config.counts - ahead);
  if (state.missed == 0) return;
  ++state.corrections;
  const std::int8_t direction = state.direction;
  quadrature_moved(config, state, state.missed);
  state.direction = direction;
}

/// The quarter of a line that the levels of A and B show: 0..3 in forward order.
constexpr std::uint8_t quarter_of_line(bool a, bool b) {
  return a ? (b ? std::uint8_t{1} : std::uint8_t{0}) : (b ? std::uint8_t{2} : std::uint8_t{3});
}

/// One reading of the lines. Call it at each edge of A and B, or often enough that at most one edge occurs
/// between two calls. Returns the counts since the last call, -2..2; the first call returns 0.
constexpr std::int8_t quadrature_step(const QuadratureConfig& config, QuadratureState& state, bool a, bool b,
                                      bool z) {
  const std::uint8_t quarter = quarter_of_line(a, b);
  const std::uint8_t ahead = static_cast<std::uint8_t>((quarter + 4 - state.quarter) & 3);
  const bool first = state.quarter > 3;
  state.quarter = quarter;
  if (first || ahead == 0) return 0;
  if (ahead == 2) ++state.illegal;
  const std::int8_t moved = ahead == 1   ? std::int8_t{1}
                            : ahead == 3 ? std::int8_t{-1}
                                         : static_cast<std::int8_t>(state.direction < 0 ? -2 : 2);
  quadrature_moved(config, state, moved);
  if (z && quarter == config.index_quarter) quadrature_index(config, state, quarter);
  return moved;
}

/// Mechanical angle at the begin of the present count; after the first index it is relative to theta_m = 0.
constexpr BinaryAngle quadrature_angle(const QuadratureConfig& config, const QuadratureState& state) {
  return angle_of_parts(config.turn, state.in_turn);
}

}  // namespace sixstep::control
