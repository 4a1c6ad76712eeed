// SPDX-License-Identifier: Apache-2.0
// Exported drives of scenarios, as in firmware: compile-time constants and the two entries.
#pragma once
#include "sixstep/control/protected_drive.hpp"
#include "tests/target/walk/legs.hpp"
#include "tests/target/walk/sensing.hpp"
#include "tests/target/walk/whole.hpp"

namespace target {

/// The lean drive with random measurements, mostly small currents and a turning rotor.
template <class Scalar, const DriveConfig<Scalar>& config>
struct LeanWalk {
  DriveState<Scalar> state{};
  Telemetry<Scalar> telemetry{};
  Setpoint<Scalar> setpoint{};
  Rotor rotor{};
  bool back = false, wild = false;

  /// The ranges in floating point, in A, rad/s and degrees.
  static constexpr std::uint16_t amperes = 32, speeds = 512, angles = 4096;
  static constexpr std::uint16_t setpoints = config.mode == Mode::current    ? amperes
                                             : config.mode == Mode::position ? angles
                                                                             : speeds;

  void draw(Random& r) {
    if (r.one_in(4)) back = !back;
    wild = r.one_in(4);
    setpoint.value = in_si(Number<Scalar>::part(static_cast<std::int32_t>(r.long_bits()) / 4), setpoints);
  }
  /// A random value of at most 1/32 of the range, often much smaller.
  Scalar calm(Random& r, std::uint16_t whole) {
    const std::int32_t n = static_cast<std::int32_t>(r.long_bits()) / 32;
    return in_si(Number<Scalar>::part(n >> r.below(12)), whole);
  }
  Measurement<Scalar> measured(Random& r) {
    Measurement<Scalar> m = drawn_measurement<Scalar>(r);
    m.hall = r.one_in(256) ? r.below(8) : rotor.code();
    if (wild) return m;
    m.i_a_A = calm(r, amperes);
    m.i_b_A = calm(r, amperes);
    m.i_c_A = calm(r, amperes);
    m.bus_V = in_si(m.bus_V, amperes);
    m.speed_rad_s = calm(r, speeds);
    m.position_deg = calm(r, angles);
    if (config.mode == Mode::speed) m.speed_rad_s = m.speed_rad_s + setpoint.value;
    if (config.mode == Mode::position) m.position_deg = m.position_deg + setpoint.value;
    return m;
  }
  void step(Random& r, Digest& mix) {
    const Measurement<Scalar> m = measured(r);
    if (r.one_in(6)) {
      rotor.move(back);
      mix_command(mix, on_hall(config, state, rotor.code()));
    }
    const BridgeCommand<Scalar> answer = sixstep::control::step(config, state, m, setpoint, telemetry);
    mix_command(mix, answer);
    mix(telemetry.motor_current_A, telemetry.current_reference_A, telemetry.speed_reference_rad_s,
        telemetry.duty);
    saw("a fault", answer.fault);
    saw("forward", answer.enabled && !state.reversed);
    saw("reversed", answer.enabled && state.reversed);
    saw("little duty", answer.enabled && answer.duty < Number<Scalar>::part(0x08000000));
    saw("much duty", answer.enabled && answer.duty > Number<Scalar>::part(0x38000000));
  }
};

/// The product drive with counts, pins and a counter. The walk includes requests, trips and clearing of
/// trips.
template <class Scalar, const ProtectedConfig<Scalar>& config>
struct ProductWalk {
  ProtectedState<Scalar> state{};
  ProtectedTelemetry<Scalar> telemetry{};
  Setpoint<Scalar> setpoint{};
  Request request{};
  BoardInput in{};
  Rotor rotor{};
  std::uint8_t sections = 0, hold = 12, since = 0, glitch = 0;
  bool back = false, wild = false, noisy = false;

  void draw(Random& r) {
    ++sections;
    if (r.one_in(24)) back = !back;
    wild = r.one_in(32);
    noisy = r.one_in(16);
    hold = r.one_in(12) ? 200 : static_cast<std::uint8_t>(9 + r.below(30));
    request.run = sections % 8 > 1;
    request.clear = sections % 2 == 0;
    setpoint.value =
        in_si(Number<Scalar>::part(static_cast<std::int32_t>(r.long_bits()) / 4), std::uint16_t{1024});
  }
  void turn(Random& r, Digest& mix) {
    if (++since < hold && !(wild && r.one_in(4))) return;
    since = r.below(2);
    rotor.move(wild ? r.one_in(2) : back);
    const std::uint8_t pins = wild && r.one_in(4) ? r.below(8) : rotor.code();
    mix_command(mix, protected_on_hall(config, state, pins, in.now - r.below(100)));
  }
  void read(Random& r) {
    const bool still = telemetry.activity == Activity::calibrate;
    for (std::uint8_t k = 0; k < 3; ++k) {
      const auto around = static_cast<std::uint16_t>(r.bits() & (wild ? 4095u : still ? 7u : 127u));
      const auto middle = static_cast<std::uint16_t>(config.current_adc[k].offset_counts);
      in.current_counts[k] = wild ? around : static_cast<std::uint16_t>(middle + around - (still ? 3 : 63));
    }
    in.bus_counts = wild ? r.bits() & 4095u : 1860 + (r.bits() & 63u);
    in.now += 2000 + (r.bits() & 255u);
  }
  /// The code of the pins, sometimes with a glitch. Some glitches are as long as the delay of the filter.
  std::uint8_t pins(Random& r) {
    if (glitch == 0 && noisy && r.one_in(48)) glitch = static_cast<std::uint8_t>(1 + r.below(4));
    if (glitch == 0) return rotor.code();
    --glitch;
    return static_cast<std::uint8_t>(sections & 1 ? 7 : 0);
  }
  void step(Random& r, Digest& mix) {
    read(r);
    turn(r, mix);
    in.hall_pins = pins(r);
    const BridgeCommand<Scalar> answer = protected_step(config, state, in, request, setpoint, telemetry);
    mix_command(mix, answer);
    mix(telemetry.drive.current_reference_A, telemetry.drive.duty, telemetry.measured.speed_rad_s,
        telemetry.measured.position_deg, telemetry.measured.bus_V, telemetry.measured.i_a_A,
        static_cast<std::uint8_t>(telemetry.activity), telemetry.faults, telemetry.first_fault,
        telemetry.hall_line);
    saw("off", telemetry.activity == Activity::off);
    saw("calibrates", telemetry.activity == Activity::calibrate);
    saw("runs", telemetry.activity == Activity::run);
    saw("brakes", telemetry.activity == Activity::brake);
    saw("tripped", telemetry.activity == Activity::fault);
    saw("a Hall fault", (telemetry.first_fault & fault_hall) != 0);
    saw("over current", (telemetry.first_fault & fault_over_current) != 0);
    saw("runs reversed", telemetry.activity == Activity::run && state.drive.reversed);
    saw("measures a speed", telemetry.measured.speed_rad_s != Scalar{});
  }
};

}  // namespace target
