// SPDX-License-Identifier: Apache-2.0
// Measures the angles of the six Hall edges from the edge times, while the rotor turns at constant speed.
//
//   fraction of the turn at edge j = (sum over n turns of (t_j - t_0))/(sum of the turns' times)
//   deviation[j] = angle of this fraction - 60 j degrees, minus the mean of all deviations
//
// t_j is the time of the j-th edge after the turn's first edge. The times do not show an angle that is common
// to all edges, because common offset, hysteresis and delay shift all edges alike. This common angle is
// therefore an input of hall_edges(). It is measured from the back-EMF, or by aligning the rotor. For each
// direction of rotation the mean of the measured edges is
//
//   forward = offset + h + w t_d,   backward = offset - (h + w t_d)
//
// with h half of the hysteresis, w the electrical speed and t_d the delay. A run in each direction separates
// offset and h + w t_d. Differences of the hysteresis between edges cancel in the mean of both runs. The
// resulting h contains w t_d at the speed of the runs. Therefore run slowly, or set the delay of
// hall_angle.hpp to 0.
//
// The run is rejected if the time of a turn differs from the time of the first turn by more than the fraction
// 1/steady. If the turn's time changes by the fraction d during the run, the angles change by at most d/(8 n)
// turns (0.022 degrees for steady = 64, n = 32). Speed ripple that repeats with the edges is measured as
// displaced edges. To avoid it, let the rotor coast, or run it fast enough. If the magnets differ from pole
// to pole, choose n as a multiple of the pole pairs.
#pragma once
#include <cstdint>

#include "sixstep/control/sensing/hall_angle.hpp"

namespace sixstep::control {

struct HallCalibrationConfig {
  std::uint16_t turns = 32;   ///< n, electrical turns
  std::uint16_t steady = 64;  ///< reciprocal of the largest allowed relative difference between the time of a
                              ///< turn and that of the first turn
  bool operator==(const HallCalibrationConfig&) const = default;
};

enum class HallCalibration : std::uint8_t {
  running,
  done,
  unsteady,   ///< the time of a turn was too long or too short
  disturbed,  ///< the rotor reversed, or an edge was missed
};

struct HallCalibrationState {
  std::uint64_t after[6]{};  ///< [j]: ticks from a turn's first edge to the j-th edge after it, summed over
                             ///< the turns; [0]: ticks of whole turns
  std::uint32_t began = 0;   ///< time of the present turn's first edge
  std::uint32_t first = 0;   ///< ticks of the first turn
  std::uint16_t turns = 0;   ///< number of completed turns
  std::uint8_t start = no_sector;  ///< the edge at which turns begin
  std::uint8_t passed = 0;         ///< number of edges in the present turn
  std::int8_t direction = 0;
  HallCalibration result = HallCalibration::running;
};

/// Signed angles by which the edges n are ahead of 60 n degrees. The mean of the angles is 0, with an error
/// of at most one unit.
struct HallDeviations {
  std::int32_t at[6]{};
};

/// Adds an edge in `direction` (+1, -1) at counter reading `time`; `edge` is its number as in hall_angle.hpp.
/// After `done` or a rejection the state does not change. For a new run use a new state.
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

/// Edges from a run in one direction. `offset`: mean angle by which the six edges n are ahead of 60 n
/// degrees, averaged over both directions. The hysteresis is from the data sheet.
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
/// the edges n are ahead of 60 n degrees in this run.
constexpr HallEdges hall_edges(const HallDeviations& forward, const HallDeviations& backward,
                               std::int32_t seen_forward, std::int32_t seen_backward) {
  HallDeviations mean{};
  for (std::uint8_t n = 0; n < 6; ++n) mean.at[n] = forward.at[n] / 2 + backward.at[n] / 2;
  const std::int32_t apart = seen_forward / 2 - seen_backward / 2;
  return hall_edges(mean, seen_forward / 2 + seen_backward / 2,
                    apart > 0 ? static_cast<BinaryAngle>(apart) : BinaryAngle{0});
}

}  // namespace sixstep::control
