// SPDX-License-Identifier: Apache-2.0
// Speed and position from Hall edges. The angle is extrapolated between edges
// (control/sensing/hall_angle.hpp). Optionally the drive measures the edge positions while it turns
// (hall_calibration.hpp). A drive that commutates at samples uses this angle.
//
// The drive uses hysteresis and delay from the probes' data sheet. The number of edges over which a speed is
// averaged:
// - before the positions are learned: SensorsConfig::edges (over six edges the position errors cancel), or
//   one edge if these edges need longer than the window
// - afterwards: SensorsConfig::learned_edges
#pragma once
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/drive.hpp"
#include "sixstep/control/sensing/hall_calibration.hpp"
#include "sixstep/rig/board_config.hpp"
#include "sixstep/rig/raw_unit.hpp"

namespace sixstep::rig {

template <class Scalar>
class HallInterpolator {
 public:
  HallInterpolator(const SensorsConfig& config, const Bases& bases, const PowerUp& power_up);

  /// Processes the decoder's reading in the interrupt of an edge.
  void edge(const control::HallReading& reading, std::uint32_t now);
  void measure(control::Measurement<Scalar>& m, std::uint32_t now);
  bool learned() const { return learned_; }
  /// Angle at the last sample; the middle of the sector if the speed is unknown.
  control::BinaryAngle electrical_angle() const { return seen_.angle; }
  const control::HallEdges& edges() const { return config_.edges; }

 private:
  /// Number of edges over which the speed is averaged at the next edge.
  std::uint8_t span() const;
  void learn(std::int8_t moved, std::uint32_t now);

  control::HallAngleConfig<Scalar> config_{};
  control::HallAngleState state_{};
  control::HallCalibrationConfig calibration_config_{};
  control::HallCalibrationState calibration_{};
  control::UnwrappedAngle seen_{};
  control::Gain<Scalar> per_sector_{}, per_half_turn_{};
  std::uint32_t window_ticks_ = 0;
  std::uint8_t edges_ = 1, learned_edges_ = 1;
  bool learns_ = false, learned_ = false, commutates_ = false;
};

template <class Scalar>
HallInterpolator<Scalar>::HallInterpolator(const SensorsConfig& config, const Bases& bases,
                                           const PowerUp& power_up)
    : window_ticks_(window_ticks(config)),
      edges_(config.edges),
      learned_edges_(config.learned_edges),
      learns_(config.hall_angle == HallAngleFrom::learned_edges),
      commutates_(config.commutates_by_angle) {
  if (config.hall_angle == HallAngleFrom::sectors) return;
  const double sector_deg = 60.0 / power_up.pole_pairs / bases.position_deg;
  config_.turn_rad_s_ticks =
      control::TickRatio<Scalar>(2 * base::pi / power_up.pole_pairs * config.capture_Hz / bases.speed_rad_s);
  config_.timeout_ticks = static_cast<std::uint32_t>(config.timeout_s * config.capture_Hz);
  config_.delay_ticks = static_cast<std::uint32_t>(std::floor(config.hall_delay_s * config.capture_Hz + 0.5));
  config_.edges.half_hysteresis = control::binary_degrees(config.hall_hysteresis_deg / 2);
  // The margin is -1 unit of the angle, so that the extrapolated angle never passes the next Hall edge.
  config_.margin = ~control::BinaryAngle{0};
  calibration_config_.turns = config.calibration_turns;
  per_sector_ = control::Gain<Scalar>(sector_deg / raw_unit<Scalar>());
  per_half_turn_ = control::Gain<Scalar>(3 * sector_deg);
  const std::int64_t sector = power_up.sector, in_turn = ((sector % 6) + 6) % 6;
  seen_ = {control::sector_angle(static_cast<std::uint8_t>(in_turn)) + control::sector_angle(1) / 2,
           static_cast<std::int32_t>((sector - in_turn) / 6)};
  control::hall_angle_edge(config_, state_, static_cast<std::uint8_t>(in_turn), 0, 0);
}

template <class Scalar>
std::uint8_t HallInterpolator<Scalar>::span() const {
  if (learned_) return learned_edges_;
  if (window_ticks_ == 0) return edges_;
  return state_.turn_ticks != 0 && state_.turn_ticks <= window_ticks_ ? edges_ : std::uint8_t{1};
}

template <class Scalar>
void HallInterpolator<Scalar>::edge(const control::HallReading& reading, std::uint32_t now) {
  config_.span = span();
  control::hall_angle_edge(config_, state_, reading.sector, reading.moved, now);
  if (learns_ && !learned_ && reading.moved != 0) learn(reading.moved, now);
}

/// Uses an edge to learn the positions. If the calibration rejects the series of edges, for example because
/// the rotor accelerated, a new series starts with this edge.
template <class Scalar>
void HallInterpolator<Scalar>::learn(std::int8_t moved, std::uint32_t now) {
  using control::HallCalibration;
  const auto result = control::hall_calibrate(calibration_config_, calibration_, state_.edge, moved, now);
  if (result == HallCalibration::running) return;
  if (result == HallCalibration::done) {
    learned_ = true;
    config_.edges =
        control::hall_edges(control::hall_deviations(calibration_), 0, config_.edges.half_hysteresis);
    return;
  }
  calibration_ = {};
  control::hall_calibrate(calibration_config_, calibration_, state_.edge, moved, now);
}

/// Measures speed, position and sector at a sample. While the speed is unknown, as at the start, the sector
/// follows from the probes' code.
template <class Scalar>
void HallInterpolator<Scalar>::measure(control::Measurement<Scalar>& m, std::uint32_t now) {
  using T = control::ScalarTraits<Scalar>;
  const control::HallAngle<Scalar> seen = control::hall_angle(config_, state_, now);
  m.speed_rad_s = seen.speed;
  if (state_.sector <= 5) control::unwrap(seen_, seen.angle);
  const std::uint8_t sector = control::sector_of_angle(seen_.angle);
  const auto in_sector = static_cast<std::int32_t>(seen_.angle - control::sector_angle(sector));
  m.position_deg = T::counts(seen_.turns * 6 + sector, per_sector_) +
                   T::product(control::AngleTraits<Scalar>::half_turns(in_sector), per_half_turn_);
  if (commutates_ && state_.sector <= 5 && state_.turn_ticks != 0) m.hall = control::hall_of_sector(sector);
}

}  // namespace sixstep::rig
