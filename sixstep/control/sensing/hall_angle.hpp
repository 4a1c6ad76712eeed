// SPDX-License-Identifier: Apache-2.0
// Computes the electrical angle between Hall edges, and the speed from the measured widths of the sectors.
//
//   at an edge n        theta = edge[n] + h forward, edge[n] - h backward; h: half of the hysteresis, which
//                       delays the edge
//   between edges       theta + way, way = 2^32 since/turn_ticks, up to the next edge and a margin; plus the
//                       rotation within the delay of an edge, 2^32 delay/turn_ticks
//   turn_ticks          ticks of the last k sectors x 2^32/(calibrated width of these sectors)
//   w                   +-(2 pi/p) timer_Hz/turn_ticks, at most the speed of a rotor just before its next
//                       edge
//
// Default edges are 60 degrees apart (model.md 3); hall_calibration.hpp measures the true edges. Edge n is
// the border between the sectors n-1 and n. With true widths, one sector (k = 1) suffices for the speed. More
// sectors average jitter but delay the speed. While the speed is unknown (at the start, after a reversal or a
// time-out), the angle is the sector's middle, with an error of at most 30 degrees.
#pragma once
#include <cstdint>

#include "sixstep/control/hall.hpp"
#include "sixstep/control/hall_speed.hpp"
#include "sixstep/control/sensing/binary_angle.hpp"

namespace sixstep::control {

/// Electrical angles of the edges, and half of their hysteresis.
struct HallEdges {
  BinaryAngle at[6] = {sector_angle(0), sector_angle(1), sector_angle(2),
                       sector_angle(3), sector_angle(4), sector_angle(5)};
  BinaryAngle half_hysteresis = 0;
  bool operator==(const HallEdges&) const = default;
};

/// Default: the speed is always 0, and the angle is the middle of the sector.
template <class Scalar>
struct HallAngleConfig {
  HallEdges edges{};
  BinaryAngle margin = 0;                ///< angle allowed beyond the next edge, for jitter and misplaced
                                         ///< edges
  TickRatio<Scalar> turn_rad_s_ticks{};  ///< (2 pi/p) timer_Hz: product of speed and ticks of an electrical
                                         ///< turn
  std::uint32_t timeout_ticks = 0;       ///< ticks without an edge after which the rotor counts as at rest;
                                         ///< below 2^31
  std::uint32_t delay_ticks = 0;         ///< delay of an edge: filter, glitch suppression, interrupt
  std::uint8_t span = 1;                 ///< k, number of sectors over which the speed is measured, 1..6
  bool operator==(const HallAngleConfig&) const = default;
};

struct HallAngleState {
  HallSpeedState times{};
  std::uint8_t sector = no_sector;
  std::uint8_t edge = 0;         ///< the last edge passed
  std::uint32_t turn_ticks = 0;  ///< ticks of an electrical turn; 0: the speed is unknown
  TurnParts turn{};              ///< turn_in_parts(turn_ticks)
};

template <class Scalar>
struct HallAngle {
  BinaryAngle angle = 0;  ///< electrical; 0 without a sector
  Scalar speed{};         ///< mechanical rad/s
};

/// Distance from edge `from` to the edge `sectors` sectors (1..5) further in `direction`; always positive.
constexpr BinaryAngle way_over_edges(const HallEdges& edges, std::uint8_t from, std::int8_t direction,
                                     std::uint8_t sectors) {
  const std::uint8_t to = static_cast<std::uint8_t>((from + (direction < 0 ? 6 - sectors : sectors)) % 6);
  return direction < 0 ? edges.at[from] - edges.at[to] : edges.at[to] - edges.at[from];
}

namespace detail {

/// Ticks of a turn, if the angle `width` lasts `ticks`: ticks 2^32/width, rounded to nearest, saturated.
constexpr std::uint32_t ticks_of_turn(std::uint32_t ticks, BinaryAngle width) {
  if (width == 0) return 0xffffffffu;
  const std::uint64_t turn = ((static_cast<std::uint64_t>(ticks) << 32) + width / 2) / width;
  return turn > 0xffffffffu ? 0xffffffffu : static_cast<std::uint32_t>(turn);
}

}  // namespace detail

/// Processes the result of hall_step. Call it in the interrupt of an edge, with the captured time. A fault,
/// or a new sector without an edge, clears the history of times.
template <class Scalar>
constexpr void hall_angle_edge(const HallAngleConfig<Scalar>& config, HallAngleState& state,
                               std::uint8_t sector, std::int8_t moved, std::uint32_t time) {
  if (sector == state.sector && moved == 0) return;
  state.sector = sector;
  state.turn_ticks = 0;
  if (moved == 0 || sector > 5) {
    state.times = {};
    return;
  }
  hall_speed_edge(state.times, time, moved);
  state.edge = moved > 0 ? sector : static_cast<std::uint8_t>((sector + 1) % 6);
  const std::uint8_t k = hall_speed_edges(config.span, state.times.known);
  if (k == 0) return;
  const std::uint32_t ticks = static_cast<std::uint32_t>(state.times.times[0] - state.times.times[k]);
  const std::uint8_t from = static_cast<std::uint8_t>((state.edge + (moved > 0 ? 6 - k : k)) % 6);
  const std::uint32_t turn =
      k == 6 ? ticks : detail::ticks_of_turn(ticks, way_over_edges(config.edges, from, moved, k));
  state.turn_ticks = turn < 2 ? 2 : turn;
  state.turn = turn_in_parts(state.turn_ticks);
}

/// Angle and speed at counter reading `now`. Call it at least once per timeout_ticks, because only this call
/// detects standstill.
template <class Scalar>
constexpr HallAngle<Scalar> hall_angle(const HallAngleConfig<Scalar>& config, HallAngleState& state,
                                       std::uint32_t now) {
  if (state.sector > 5) return {};
  const HallEdges& edges = config.edges;
  const std::uint32_t since = static_cast<std::uint32_t>(now - state.times.times[0]);
  if (since > config.timeout_ticks) {
    state.times = {};
    state.turn_ticks = 0;
  }
  if (state.turn_ticks == 0)
    return {edges.at[state.sector] + way_over_edges(edges, state.sector, 1, 1) / 2, Scalar{}};
  const std::int8_t direction = state.times.direction;
  const BinaryAngle width = way_over_edges(edges, state.edge, direction, 1);
  BinaryAngle way = since < state.turn_ticks ? angle_of_parts(state.turn, since) : ~BinaryAngle{0};
  if (way > width + config.margin) way = width + config.margin;
  way += angle_of_parts(state.turn, config.delay_ticks);
  way += edges.half_hysteresis;
  const std::uint32_t past = since == 0 ? 0 : since - 1;  // the edge occurred up to one timer tick after the
                                                          // captured reading
  const bool late = past >= state.turn_ticks || angle_of_parts(state.turn, past) > width;
  const std::uint32_t at_least = late ? detail::ticks_of_turn(past, width) : 0;
  const Scalar w = ScalarTraits<Scalar>::per_ticks(config.turn_rad_s_ticks,
                                                   at_least > state.turn_ticks ? at_least : state.turn_ticks);
  return direction < 0 ? HallAngle<Scalar>{edges.at[state.edge] - way, -w}
                       : HallAngle<Scalar>{edges.at[state.edge] + way, w};
}

}  // namespace sixstep::control
