// SPDX-License-Identifier: Apache-2.0
// A rotor at rest and three current converters, in integers. Voltage pulses give six currents that depend on
// the magnet's angle. This file also contains the drive whose start begins with such pulses.
#pragma once
#include "sixstep/control/commissioning/pulse_start.hpp"
#include "tests/target/walk/sensorless.hpp"
#include "tests/target/walk/surveys.hpp"

namespace target {

constexpr PulsePositionConfig drawn_pulses(Random& r) {
  PulsePositionConfig config{};
  config.current.offset_counts = zero_counts;
  config.current.offset_tolerance = 40;
  config.current.log2_samples = static_cast<std::uint8_t>(1 + r.below(3));
  config.pulse_ticks = static_cast<std::uint16_t>(1 + r.below(2));
  config.rest_ticks = config.pulse_ticks;
  config.rounds = static_cast<std::uint8_t>(2 + r.below(3));
  return config;
}

struct PulsedRotor {
  BinaryAngle electrical = 0;
  std::uint16_t current = 600;  ///< counts of a pulse; 0 for an open wire
  std::int32_t saturates = 0;   ///< counts of cos x, by saturation
  std::int32_t salient = 0;     ///< counts of cos 2 x, by saliency
  std::uint16_t offset[3]{};    ///< offsets of the amplifiers
  std::uint8_t noise = 1;       ///< counts

  constexpr void draw(Random& r) {
    electrical = r.long_bits();
    current = r.one_in(8) ? std::uint16_t{0} : static_cast<std::uint16_t>(300 + r.bits() % 600);
    saturates = r.one_in(3) ? 0 : 20 + r.below(60);
    salient = r.one_in(3) ? 0 : 20 + r.below(100);
    for (std::uint16_t& o : offset) o = static_cast<std::uint16_t>(zero_counts - 16 + r.below(32));
    if (r.one_in(8)) offset[0] = 2300;  // a broken amplifier
    noise = static_cast<std::uint8_t>(1 + r.below(3));
  }
  /// The current of a pulse through the pair of a sector. x is the angle from the magnet's north to the pair
  /// (pulse_position.hpp).
  constexpr std::int32_t through(std::uint8_t sector) const {
    const BinaryAngle x = sector_angle(sector) + sector_angle(2) - electrical;  // 60 s - 30 - (theta_e - 150)
    if (current == 0) return 0;
    return current + wave(x + quarter_turn, saturates) - wave(2 * x + quarter_turn, salient);
  }
  constexpr void sample(Random& r, const PulsePositionState& state, std::uint16_t (&counts)[3]) const {
    const bool on = state.phase == PulsePhase::pulse;
    const Pair pair = pulsed_pair(state);
    const std::int32_t i = on ? through(sector_of_pair(pair)) : 0;
    for (std::uint8_t k = 0; k < 3; ++k) {
      const Leg leg = static_cast<Leg>(k);
      const std::int32_t flows = leg == pair.source ? i : leg == pair.sink ? -i : 0;
      counts[k] = static_cast<std::uint16_t>(offset[k] + flows + r.below(noise));
    }
  }
};

struct PulsePositionWalk {
  PulsePositionConfig config{};
  PulsePositionState state{};
  PulsedRotor rotor{};
  bool begun = false;

  void begin(Random& r) {
    config = drawn_pulses(r);
    rotor.draw(r);
    pulses_begin(state);
    begun = true;
  }
  void draw(Random& r) {
    if (!begun) begin(r);
  }
  void step(Random& r, Digest& mix) {
    std::uint16_t counts[3]{};
    rotor.sample(r, state, counts);
    counted<0>("pulses_tick", [&] { pulses_tick(config, state, counts); });
    const Pair pair = pulsed_pair(state);
    mix(static_cast<std::uint8_t>(state.phase), state.step, state.round, state.squares,
        static_cast<std::uint8_t>(pair.source), static_cast<std::uint8_t>(pair.sink));
    if (state.phase != PulsePhase::done) return;
    const PulsePositionReading reading =
        counted<1>("pulse_position", [&] { return pulse_position(config, state); });
    mix(reading.seen, reading.axis_seen, reading.electrical, reading.sector, reading.north_16,
        reading.axis_16);
    const std::int32_t off = way_between(rotor.electrical, reading.electrical);
    saw("an offset that is wrong", state.lost);
    saw("an open wire", !state.lost && rotor.current == 0);
    saw("a round rotor", !state.lost && rotor.current != 0 && !reading.seen);
    saw("north alone", reading.seen && !reading.axis_seen);
    saw("north and axis", reading.seen && reading.axis_seen);
    saw("within 15 degrees of the rotor", reading.seen && off < 0x0aaaaaaa && off > -0x0aaaaaaa);
    begin(r);
  }
};

/// The drive without a rotor sensor. Its start begins with pulses.
template <class Scalar>
struct PulsedDriveWalk {
  PulsedDriveConfig<Scalar> config{};
  PulsedDriveState<Scalar> state{};
  Telemetry<Scalar> telemetry{};
  Setpoint<Scalar> setpoint{};
  Course course{};
  PulsedRotor pulsed{};

  void draw(Random& r) {
    course.draw(r);
    if (!state.pulsing) pulsed.draw(r);
    setpoint.value = positive<Scalar>(r);
    if (course.wanted == 0) setpoint.value = Scalar{};
    if (course.wanted < 0) setpoint.value = -setpoint.value;
    if (course.sections % 4 != 1) return;
    config = {drawn_sensorless_drive<Scalar>(r), drawn_pulses(r)};
    config.drive.source.has_hall = false;
    config.drive.source.wanted = RotorSource::back_emf;
    state = {};
  }
  PulsedDriveInput<Scalar> input(Random& r) {
    PulsedDriveInput<Scalar> in{};
    in.drive.measured = drawn_measurement<Scalar>(r);
    in.drive.measured.i_a_A = SensorlessDriveWalk<Scalar>::calm(r);
    in.drive.measured.i_b_A = SensorlessDriveWalk<Scalar>::calm(r);
    in.drive.measured.i_c_A = SensorlessDriveWalk<Scalar>::calm(r);
    in.drive.on = !r.one_in(64);
    const BridgeCommand<Scalar>& was = state.drive.drive.command;
    in.drive.terminals = course.tick(r, {was.enabled && !state.pulsing, was.pair}, in.drive.on);
    if (!state.pulsing) pulsed.electrical = course.rotor.angle;  // during the pulses the rotor is at rest
    pulsed.sample(r, state.pulses, in.current_counts);
    return in;
  }
  void commutate(Random& r) {
    std::uint32_t at = 0;
    if (!next_commutation(state.drive, at) || !comes_before(at, course.now + tick_ticks) || r.one_in(32))
      return;
    sensorless_drive_commutate(config.drive, state.drive, at);
  }
  void step(Random& r, Digest& mix) {
    commutate(r);
    const PulsedDriveInput<Scalar> in = input(r);
    const bool pulsed_before = state.pulsing;
    const BridgeCommand<Scalar> answer = counted<0>(
        "pulsed_drive_step", [&] { return pulsed_drive_step(config, state, in, setpoint, telemetry); });
    mix_command(mix, answer);
    mix_sensorless(mix, state.drive.sensorless);
    mix(state.pulsing, static_cast<std::uint8_t>(state.pulses.phase), state.found.seen,
        state.found.electrical, state.found.north_16, telemetry.motor_current_A, telemetry.duty);
    const bool told = pulsed_before && !state.pulsing;
    const SensorlessPhase phase = state.drive.sensorless.phase;
    saw("pulses", state.pulsing && answer.enabled);
    saw("ramps from where the rotor stands", told && state.found.seen && phase == SensorlessPhase::ramping);
    saw("aligns, since north was not seen", told && !state.found.seen && phase == SensorlessPhase::aligning);
  }
};

}  // namespace target
