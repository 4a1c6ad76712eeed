// SPDX-License-Identifier: Apache-2.0
// Measures the angles of the six Hall edges from their times, while the rotor turns steadily.
//
//   fraction of the turn at edge j = sum over n turns of (t_j - t_0)/sum of the turns' times
//   deviation[j] = angle of this fraction - 60 j degrees, minus the mean of all deviations
//
// t_j is the time of the j-th edge after the turn's first edge. The times cannot show an angle that is common
// to all edges: the probes' common offset, hysteresis and delay shift all edges alike. This common angle is
// therefore an input of hall_edges(). It is measured from the back-EMF, or by aligning the rotor: one mean of
// the measured edges for each direction,
//
//   forward = offset + h + w t_d,   backward = offset - (h + w t_d)
//
// with h half of the hysteresis, w the electrical speed and t_d the delay. A run in each direction separates
// offset and h + w t_d. Differences of the hysteresis between edges cancel in the mean of both runs. The
// resulting h contains w t_d at the speed of the run: run slowly, or set hall_angle's delay to 0.
//
// Requirement: the time of each turn differs from the time of the first turn by at most 1/steady of it, or
// the run is rejected. A drift d of the turn's time over the run changes the angles by at most d/(8 n) turns
// (0.022 degrees for steady 64, n 32). Speed ripple that repeats with the edges is measured as displaced
// edges: let the rotor coast, or run it fast enough. If the magnets differ from pole to pole, choose n as a
// multiple of the pole pairs.
#pragma once
#include <cstdint>

#include "sixstep/control/sensing/hall_angle.hpp"

namespace sixstep::control {

struct HallCalibrationConfig {
  std::uint16_t turns = 32;   ///< n, electrical turns
  std::uint16_t steady = 64;  ///< a turn may differ from the first turn by 1/steady of its time
  bool operator==(const HallCalibrationConfig&) const = default;
};

enum class HallCalibration : std::uint8_t {
  running,
  done,
  unsteady,   ///< the time of a turn was too long or too short
  disturbed,  ///< the rotor reversed, or an edge was missed
};

struct HallCalibrationState {
  std::uint64_t after[6]{};  ///< sums over the turns of the ticks from the turn's first edge to the j-th edge
                             ///< after it; [0]: to the turn's end
  std::uint32_t began = 0;   ///< time of the present turn's first edge
  std::uint32_t first = 0;   ///< ticks of the first turn
  std::uint16_t turns = 0;   ///< whole turns so far
  std::uint8_t start = no_sector;  ///< the edge at which turns begin
  std::uint8_t passed = 0;         ///< edges that have passed in the present turn
  std::int8_t direction = 0;
  HallCalibration result = HallCalibration::running;
};

/// Signed angles by which the edges are ahead of 60 n degrees; their mean is 0 to one unit.
struct HallDeviations {
  std::int32_t at[6]{};
};

/// Adds an edge in `direction` (+1, -1) at counter reading `time`; `edge` is its number as in hall_angle.hpp.
/// After `done` or a rejection the state does not change; begin again with a new state.
constexpr HallCalibration hall_calibrate(const HallCalibrationConfig& config, HallCalibrationState& state,
                                         std::uint8_t edge, std::int8_t direction, std::uint32_t time) {
  if (state.result != HallCalibration::running || edge > 5) return state.result;
  if (state.start == no_sector) {
    state.start = edge;
    state.direction = direction;
    state.began = time;
    return state.result;
  }
  ++state.passed;
  const int due = state.start + (state.direction < 0 ? 6 - state.passed : state.passed);
  if (direction != state.direction || edge != due % 6) return state.result = HallCalibration::disturbed;
  const std::uint32_t ticks = static_cast<std::uint32_t>(time - state.began);
  if (state.passed < 6) {
    state.after[state.passed] += ticks;
    return state.result;
  }
  state.after[0] += ticks;
  state.passed = 0;
  state.began = time;
  if (state.turns == 0) state.first = ticks;
  const std::uint32_t off = ticks > state.first ? ticks - state.first : state.first - ticks;
  const std::uint16_t parts = config.steady == 0 ? std::uint16_t{1} : config.steady;
  if (off > state.first / parts) return state.result = HallCalibration::unsteady;
  ++state.turns;
  if (state.turns >= config.turns) state.result = HallCalibration::done;
  return state.result;
}

/// Deviations that a finished run measured; all 0 for any other state.
constexpr HallDeviations hall_deviations(const HallCalibrationState& state) {
  HallDeviations deviations{};
  if (state.result != HallCalibration::done || state.after[0] == 0) return deviations;
  std::uint8_t down = 0;  // shifts until a turn's ticks fit in 32 bits
  while ((state.after[0] >> down) > 0xffffffffu) ++down;
  std::int64_t sum = 0;
  for (std::uint8_t j = 1; j < 6; ++j) {
    const auto part = static_cast<BinaryAngle>(((state.after[j] >> down) << 32) / (state.after[0] >> down));
    const std::int32_t ahead = way_between(sector_angle(j), part);
    const int edge = (state.start + (state.direction < 0 ? 6 - j : j)) % 6;
    deviations.at[edge] = state.direction < 0 ? -ahead : ahead;
    sum += deviations.at[edge];
  }
  const std::int32_t mean = static_cast<std::int32_t>(sum / 6);
  for (std::int32_t& at : deviations.at) at -= mean;
  return deviations;
}

/// Edges from a run in one direction. `offset`: mean angle by which the six edges are ahead of 60 n degrees,
/// each edge taken halfway between both directions. The data sheet gives the hysteresis.
constexpr HallEdges hall_edges(const HallDeviations& deviations, std::int32_t offset,
                               BinaryAngle half_hysteresis) {
  HallEdges edges{};
  for (std::uint8_t n = 0; n < 6; ++n)
    edges.at[n] =
        sector_angle(n) + static_cast<BinaryAngle>(offset) + static_cast<BinaryAngle>(deviations.at[n]);
  edges.half_hysteresis = half_hysteresis;
  return edges;
}

/// Edges from one run in each direction at the same speed. seen_forward, seen_backward: mean angle by which
/// the edges are ahead of 60 n degrees in each run.
constexpr HallEdges hall_edges(const HallDeviations& forward, const HallDeviations& backward,
                               std::int32_t seen_forward, std::int32_t seen_backward) {
  HallDeviations mean{};
  for (std::uint8_t n = 0; n < 6; ++n) mean.at[n] = forward.at[n] / 2 + backward.at[n] / 2;
  const std::int32_t apart = seen_forward / 2 - seen_backward / 2;
  return hall_edges(mean, seen_forward / 2 + seen_backward / 2,
                    apart > 0 ? static_cast<BinaryAngle>(apart) : BinaryAngle{0});
}

}  // namespace sixstep::control
