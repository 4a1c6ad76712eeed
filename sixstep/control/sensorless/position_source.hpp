// SPDX-License-Identifier: Apache-2.0
// Selects the source of the commutation: Hall probes, or the back-EMF. The drive always follows both. It can
// therefore change the source while the motor turns, if both sources agree, or if a Hall line fails.
//
//   Hall to back-EMF   `agreed` consecutive sectors with a crossing between the two Hall edges
//   back-EMF to Hall   `agreed` consecutive Hall edges within a quarter of a sector from the commutation
//   a line fails       (invalid code, hall.hpp) to the back-EMF at once; if no crossings were found before,
//                      through the phase `catching` of sensorless.hpp
#pragma once
#include <cstdint>

#include "sixstep/control/hall.hpp"
#include "sixstep/control/sensorless/sensorless.hpp"

namespace sixstep::control {

enum class RotorSource : std::uint8_t { hall, back_emf };

/// Default: no probes.
struct PositionSourceConfig {
  bool has_hall = false;
  RotorSource wanted = RotorSource::back_emf;
  bool falls_back = true;   ///< true: a failed line changes to the back-EMF; false: it stops the drive
  std::uint8_t agreed = 6;  ///< number of consecutive sectors, or edges, that must agree before a change
  HallConfig hall{};
  bool operator==(const PositionSourceConfig&) const = default;
};

struct PositionSourceState {
  RotorSource source = RotorSource::back_emf;
  HallState hall{};
  HallSpeedState edges{};  ///< times of the probes' edges
  std::uint8_t agreed = 0;
  std::uint8_t line = 0;  ///< 1..3: the line that failed; 0: none, or unknown
  bool broken = false;    ///< true: a line has failed since the drive started
  bool started = false;
};

namespace detail {

/// True if a Hall edge into `sector` is within a quarter of a sector from the commutation by the back-EMF.
template <class Scalar>
constexpr bool edge_agrees(const SensorlessConfig<Scalar>& config, const SensorlessState& sensorless,
                           std::uint8_t sector, std::uint32_t now) {
  const std::uint32_t quarter = sector_ticks(config.clock, sensorless.clock) / 4;
  if (sensorless.phase != SensorlessPhase::running) return false;
  if (sensorless.sector == sector)
    return static_cast<std::uint32_t>(now - sensorless.commutated_at) < quarter;
  return sectors_on(sensorless.sector, sensorless.direction) == sector && sensorless.clock.scheduled &&
         static_cast<std::uint32_t>(sensorless.clock.next - now) < quarter;
}

template <class Scalar>
constexpr void line_died(const PositionSourceConfig& config,
                         const SensorlessConfig<Scalar>& sensorless_config, PositionSourceState& state,
                         SensorlessState& sensorless, std::uint8_t line, std::uint32_t now) {
  if (line != 0) state.line = line;
  state.broken = true;
  state.agreed = 0;
  if (state.source != RotorSource::hall || !config.falls_back) return;
  state.source = RotorSource::back_emf;
  const bool known = sector_ticks(sensorless_config.clock, sensorless.clock) != 0;
  if (!known) return catch_spin(sensorless, now);
  sensorless.phase = SensorlessPhase::running;
  lock_begin(sensorless.lock);
}

}  // namespace detail

/// Processes a change of the Hall pins at a captured time. Returns true if the probes commutate and the code
/// is valid.
template <class Scalar>
constexpr bool source_hall_edge(const PositionSourceConfig& config,
                                const SensorlessConfig<Scalar>& sensorless_config, PositionSourceState& state,
                                SensorlessState& sensorless, std::uint8_t pins, std::uint32_t now) {
  if (!config.has_hall || state.broken) return false;
  const HallReading reading = hall_step(config.hall, state.hall, pins, sector_time(state.edges, 1, now));
  hall_speed_edge(state.edges, now, reading.moved);
  if (reading.fault != HallFault::none) {
    detail::line_died(config, sensorless_config, state, sensorless, reading.line, now);
    return false;
  }
  if (reading.moved == 0) return false;
  if (state.source == RotorSource::back_emf) {
    const bool agrees = detail::edge_agrees(sensorless_config, sensorless, reading.sector, now);
    state.agreed =
        agrees ? static_cast<std::uint8_t>(state.agreed < 255 ? state.agreed + 1 : 255) : std::uint8_t{0};
    if (config.wanted != RotorSource::hall || state.agreed < config.agreed) return false;
    state.source = RotorSource::hall;
    state.agreed = 0;
    sensorless.phase = SensorlessPhase::following;
  }
  const bool saw = sensorless.crossing.done;
  sensorless_follow_edge(sensorless_config, sensorless, reading.sector, reading.moved, now);
  state.agreed =
      saw ? static_cast<std::uint8_t>(state.agreed < 255 ? state.agreed + 1 : 255) : std::uint8_t{0};
  return true;
}

/// Call it once per control tick, before the steps. The first call selects the initial source. Later calls
/// change the source from Hall probes to the back-EMF if this is requested.
template <class Scalar>
constexpr void source_step(const PositionSourceConfig& config,
                           const SensorlessConfig<Scalar>& sensorless_config, PositionSourceState& state,
                           SensorlessState& sensorless, std::uint8_t pins, std::uint32_t now) {
  if (!config.has_hall || state.broken) return;
  if (!state.started) {
    state.started = true;
    const HallReading reading = hall_step(config.hall, state.hall, pins, SectorTime::unknown);
    if (reading.fault != HallFault::none) {
      state.broken = true;
      return;
    }
    state.source = config.wanted;
    if (state.source == RotorSource::hall)
      sensorless_follow_edge(sensorless_config, sensorless, reading.sector, 0, now);
    return;
  }
  // The source changes only after a crossing whose commutation is scheduled. This sector then needs no
  // further crossing.
  if (state.source != RotorSource::hall || config.wanted != RotorSource::back_emf) return;
  if (state.agreed < config.agreed || !sensorless.clock.scheduled) return;
  if (sector_ticks(sensorless_config.clock, sensorless.clock) > sensorless_config.start.trusted_ticks) return;
  state.source = RotorSource::back_emf;
  state.agreed = 0;
  sensorless.phase = SensorlessPhase::running;
  lock_begin(sensorless.lock);
}

}  // namespace sixstep::control
