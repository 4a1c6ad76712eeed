// SPDX-License-Identifier: Apache-2.0
// Finds the position of a rotor at rest by short voltage pulses on the six pairs. The current I_s at the end
// of the pulse of sector s is V t/L, with voltage V, pulse length t and the pair's inductance L. L depends on
// x, the angle from the magnet's north to the pair's axis, and on the current i (symbols of model.md 7):
//
//   L(x) = L_S + L_D cos 2x - (L_d i/(2 I_sat)) cos^3 x
//   x = 60 s - 30 degrees - theta_d for the pair of sector s
//
// y_s = 1/I_s is proportional to L.
// - The second harmonic of the six values results from saliency. It shows the magnet's axis, but not which
//   end is north.
// - The first harmonic results from saturation. It shows north, and roughly the axis. It also shows along
//   which axis the magnet lies.
//
// Both harmonics are compared with the noise of the readings in the same rounds, and with the converters'
// rounding:
//
//   sigma^2 = s^2/n + 3 s^2/N + 45, in eighths of a count squared
//      s^2/n      n readings of each pair, with the standard deviation s
//      3 s^2/N    three offsets of N samples each
//      45         11 for rounding two phases, 32 for three rounded offsets, 2 for their eighths
//   each component of a harmonic has the standard deviation sigma/sqrt 3, relative to I_0
//
// I_0 is the mean of the six currents. Rounding by itself causes at most 5.1 times this deviation. A first
// harmonic below 6 times the deviation is rejected (`seen` is false): the rotor is round, or the current is
// too small to saturate it. A second harmonic must also exceed the amplifiers' difference of gain; otherwise
// the first harmonic determines the angle. The rotor must not turn: opposite pairs follow each other, so that
// their torques cancel.
#pragma once
#include <cstdint>

#include "sixstep/control/adc.hpp"
#include "sixstep/control/commissioning/vector_angle.hpp"
#include "sixstep/control/commutation.hpp"

namespace sixstep::control {

struct PulsePositionConfig {
  AdcConfig<Q30> current{};       ///< offset: counts without current; the gain is not used
  std::uint16_t pulse_ticks = 0;  ///< control ticks of a pulse; 0: no pulses
  std::uint16_t rest_ticks = 0;   ///< ticks after a pulse until the current is 0: at least pulse_ticks
  std::uint8_t rounds = 8;        ///< n, the number of rounds; at least two
  std::uint8_t certain =
      6;  ///< least ratio of a harmonic to the noise; noise alone reaches 6 once in e^18 results
  std::uint16_t amplifiers = 20;  ///< largest difference of gain between two amplifiers, 1/1000
  bool operator==(const PulsePositionConfig&) const = default;
};

enum class PulsePhase : std::uint8_t { zeroing, pulse, rest, done };

struct PulsePositionState {
  PulsePhase phase = PulsePhase::zeroing;
  AdcState adc[3]{};
  std::uint8_t step = 0;  ///< index of the pulse in its round
  std::uint8_t round = 0;
  std::uint16_t ticks = 0;
  bool lost = false;         ///< true: an offset was out of tolerance
  std::int32_t sum[6]{};     ///< sum for each sector's pair, eighths of a count: source current minus sink
                             ///< current
  std::int64_t squares = 0;  ///< sum of the squares of all readings
};

struct PulsePositionReading {
  bool seen = false;           ///< true: north was found
  bool axis_seen = false;      ///< true: saliency determines the angle, which is more exact
  BinaryAngle electrical = 0;  ///< theta_e, electrical angle of the rotor
  std::uint8_t sector = no_sector;
  std::uint32_t north_16 = 0, axis_16 = 0;  ///< ratios of the two signals to the noise, in 16ths
};

namespace detail {

/// Sector whose pair is pulsed at a step of a round. Each sector is followed by the opposite sector.
constexpr std::uint8_t pulsed_sector(std::uint8_t step) {
  return static_cast<std::uint8_t>((step / 2 + (step % 2) * 3) % 6);
}

constexpr void take_pulse(PulsePositionState& state, const std::uint16_t (&counts)[3]) {
  const std::uint8_t sector = pulsed_sector(state.step);
  const Pair pair = positive_pair(sector);
  const auto eighths = [&](Leg leg) {
    const auto k = static_cast<std::uint8_t>(leg);
    return std::int32_t{8} * counts[k] - state.adc[k].offset_eighths;
  };
  const std::int32_t current = eighths(pair.source) - eighths(pair.sink);
  state.sum[sector] += current;
  state.squares += static_cast<std::int64_t>(current) * current;
}

/// The two components of a harmonic of the six values, multiplied by six.
struct PulseHarmonic {
  std::int64_t c = 0, s = 0;
};

constexpr std::int64_t times_root_3(std::int64_t x) { return shifted_down(x * 113512, 16); }

constexpr PulseHarmonic first_harmonic(const std::int64_t (&y)[6]) {
  return {2 * (y[0] - y[3]) + y[1] - y[2] - y[4] + y[5], times_root_3(y[1] + y[2] - y[4] - y[5])};
}
constexpr PulseHarmonic second_harmonic(const std::int64_t (&y)[6]) {
  return {2 * (y[0] + y[3]) - y[1] - y[2] - y[4] - y[5], times_root_3(y[1] - y[2] + y[4] - y[5])};
}

/// Amplitude of a harmonic relative to the mean y_0, in 2^-20; `total` is the sum of the six values.
constexpr std::int64_t relative_20(const PulseHarmonic& h, std::int64_t total) {
  const std::int64_t length = length_of(static_cast<std::int32_t>(shifted_down(h.c, 8)),
                                        static_cast<std::int32_t>(shifted_down(h.s, 8)));
  return divided<std::int64_t>(length << 28, total);
}

constexpr std::uint32_t over_noise_16(std::int64_t relative, std::int64_t I_0, std::int64_t variance_8) {
  const std::int64_t signal = shifted_down(relative * I_0, 16);  // in 2^-4 of an eighth of a count
  return static_cast<std::uint32_t>(whole_root(static_cast<std::uint64_t>(
      divided<std::int64_t>(3 * signal * signal * 256, variance_8 == 0 ? 1 : variance_8))));
}

/// sigma^2, in 2^-8 of an eighth of a count squared.
constexpr std::int64_t pulse_variance(const PulsePositionState& state, std::int64_t n,
                                      std::uint8_t log2_samples) {
  std::int64_t within = n * state.squares;
  for (const std::int32_t sum : state.sum) within -= static_cast<std::int64_t>(sum) * sum;
  const std::int64_t of_one = divided<std::int64_t>(within * 256, 6 * n * (n - 1));
  constexpr std::int64_t rounding = std::int64_t{45} * 256;
  return rounding + divided<std::int64_t>(of_one, n) + shifted_down(3 * of_one, log2_samples);
}

}  // namespace detail

constexpr void pulses_begin(PulsePositionState& state) { state = PulsePositionState{}; }

/// One control tick with its samples. In phase `pulse` the pair of pulsed_pair() must be on; in the other
/// phases the bridge must be off.
constexpr void pulses_tick(const PulsePositionConfig& config, PulsePositionState& state,
                           const std::uint16_t (&counts)[3]) {
  if (state.phase == PulsePhase::done) return;
  if (state.phase == PulsePhase::zeroing) {
    Calibration last = Calibration::running;
    for (std::uint8_t k = 0; k < 3; ++k) {
      last = adc_calibrate(config.current, state.adc[k], counts[k]);
      state.lost = state.lost || last == Calibration::failed;
    }
    if (state.lost)
      state.phase = PulsePhase::done;
    else if (last == Calibration::done)
      state.phase = PulsePhase::pulse;
    return;
  }
  ++state.ticks;
  if (state.phase == PulsePhase::pulse) {
    if (state.ticks < config.pulse_ticks) return;
    detail::take_pulse(state, counts);
    state.ticks = 0;
    state.phase = PulsePhase::rest;
    return;
  }
  if (state.ticks < config.rest_ticks) return;
  state.ticks = 0;
  state.phase = PulsePhase::pulse;
  if (++state.step < 6) return;
  state.step = 0;
  if (++state.round >= config.rounds) state.phase = PulsePhase::done;
}

constexpr Pair pulsed_pair(const PulsePositionState& state) {
  return positive_pair(detail::pulsed_sector(state.step));
}

/// Result of the rounds; call it in phase `done`.
constexpr PulsePositionReading pulse_position(const PulsePositionConfig& config,
                                              const PulsePositionState& state) {
  PulsePositionReading reading{};
  const std::int64_t n = state.round;
  if (state.lost || n < 2) return reading;
  std::int64_t y[6]{}, total_y = 0, total_I = 0;
  for (std::uint8_t s = 0; s < 6; ++s) {
    if (state.sum[s] < std::int64_t{512} * n)
      return reading;  // less than 32 counts per phase: a wire is open, or the pulse is too short
    y[s] = detail::divided<std::int64_t>(std::int64_t{1} << 46, state.sum[s]);
    total_y += y[s];
    total_I += state.sum[s];
  }
  const std::int64_t I_0 = total_I / (6 * n),
                     variance = detail::pulse_variance(state, n, config.current.log2_samples);
  const detail::PulseHarmonic north = detail::first_harmonic(y), axis = detail::second_harmonic(y);
  const std::int64_t axis_20 = detail::relative_20(axis, total_y);
  reading.north_16 = detail::over_noise_16(detail::relative_20(north, total_y), I_0, variance);
  reading.axis_16 = detail::over_noise_16(axis_20, I_0, variance);
  const std::uint32_t certain_16 = std::uint32_t{16} * config.certain;
  reading.seen = reading.north_16 >= certain_16;
  reading.axis_seen =
      reading.axis_16 >= certain_16 && axis_20 * 1000 > static_cast<std::int64_t>(config.amplifiers) << 20;
  if (!reading.seen) return reading;
  // The inductance is least along d. The angle is relative to the axis of sector 0's pair, at -30 degrees.
  // theta_e is 150 degrees ahead of theta_d.
  BinaryAngle d = vector_angle(-north.c, -north.s);
  if (reading.axis_seen) {
    const BinaryAngle half = vector_angle(axis.c, axis.s) / 2;
    const BinaryAngle steps = (d - half + quarter_turn / 2) / quarter_turn;
    d = half + steps * quarter_turn;
  }
  reading.electrical = d + sector_angle(2);
  reading.sector = sector_of_angle(reading.electrical);
  return reading;
}

}  // namespace sixstep::control
