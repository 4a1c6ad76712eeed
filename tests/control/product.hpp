// SPDX-License-Identifier: Apache-2.0
// The product's drive for the tests: per-unit gains of the reference motor, and a simple motor model whose
// values fill the registers.
#pragma once
#include <cmath>
#include <cstdint>

#include "sixstep/control/protected_drive.hpp"
#include "sixstep/plant/hall.hpp"
#include "tests/control/scalars.hpp"

namespace sixstep::control {

// Bases: the physical values of 1.0. The range of signals is 2, so the difference of two full-scale signals
// is still within the range.
inline constexpr double base_A = 20, base_V = 25, base_rad_s = 500, base_deg = 2000;
// The motor is maxon 251601 at its terminals (model.md 6). The period is the thesis's period. The timer runs
// at 1 MHz.
inline constexpr double R = 1.03, L = 0.572e-3, K_t = 33.5e-3, J = 135e-7, T = 30e-6, U = 24;
inline constexpr int pole_pairs = 8;

/// Gains of the thesis's chapter 6 (model.md 13), relative to the bases.
template <class S>
ProtectedConfig<S> product() {
  const auto s = [](double x) { return static_cast<S>(x); };
  const auto g = [](double x) { return static_cast<Gain<S>>(x); };
  ProtectedConfig<S> c;
  c.drive.mode = Mode::speed;
  c.drive.chopping = Chopping::complementary;
  c.drive.current = pi<S>(4.0956 * base_A / base_V, 0.4016 * base_A / base_V, U / base_V);
  c.drive.nominal_bus_V = static_cast<Divisor<S>>(U / base_V);
  c.drive.speed = pi<S>(0.0158299 * base_rad_s, 0.00013378 * base_rad_s, 1.0);
  c.drive.current_at_full_torque_A = g(0.78 / K_t / base_A);
  c.drive.current_limit_A = s(10 / base_A);
  c.setpoint_limit = s(1.0);
  for (AdcConfig<S>& adc : c.current_adc) adc = {per_count<S>(40.0 / 4096 / 8 / base_A), 2048, 40, 4};
  c.bus_adc = {per_count<S>(40.0 / 4096 / 8 / base_V), 0, 0, 0};
  c.speed = {TickRatio<S>(M_PI / 3 / pole_pairs * 1e6 / base_rad_s), 100000, 1};
  c.position = {per_count<S>(60.0 / pole_pairs / base_deg), g(60.0 / pole_pairs / base_deg)};
  c.faults = {s(15 / base_A), s(30 / base_V), s(10 / base_V), s(450 / base_rad_s), s(8 / base_A), 3000, 3};
  c.brake_current_A = s(5 / base_A);
  c.short_below_rad_s = s(100 / base_rad_s);
  c.standing_rad_s = s(5 / base_rad_s);
  return c;
}

/// A simple motor that is sufficient to close the loops: an R-L circuit between the driven terminals, with a
/// constant back-EMF.
struct Motor {
  double i = 0, w = 0, theta_e = 0.3, t = 0;  // theta_e in sectors
  int sector() const { return static_cast<int>(std::floor(theta_e)); }
  std::uint8_t pins() const { return plant::hall_code((sector() % 6 + 6) % 6); }

  template <class S>
  void run(const BridgeCommand<S>& c) {
    const Pair positive = positive_pair(sector_of_hall(pins()));
    double u = K_t * w;  // bridge off: no current flows, and the terminals float
    if (c.enabled) {
      const bool forward = c.pair == positive, backward = c.pair == swapped(positive);
      u = (forward ? 1 : backward ? -1 : 0) * static_cast<double>(c.duty) * U;
    } else {
      i = 0;
    }
    const double h = T / 10;
    for (int n = 0; n < 10; ++n) {
      i += h * (u - R * i - K_t * w) / L;
      w += h * (K_t * i - 1e-5 * w) / J;
      theta_e += h * w * pole_pairs * 3 / M_PI;
    }
    t += T;
  }
};

template <class S>
struct Plant {
  ProtectedConfig<S> config = product<S>();
  ProtectedState<S> state{};
  ProtectedTelemetry<S> telemetry{};
  Motor motor;
  BridgeCommand<S> command{};
  Request request{};
  double setpoint = 0;
  std::uint8_t stuck_low = 0, stuck_high = 0;

  BoardInput registers() const {
    BoardInput in;
    const Pair p = positive_pair(sector_of_hall(motor.pins()));
    for (int k = 0; k < 3; ++k) {
      const Leg leg = static_cast<Leg>(k);
      const double i = leg == p.source ? motor.i : leg == p.sink ? -motor.i : 0;
      in.current_counts[k] = static_cast<std::uint16_t>(std::lround(2055 + i * 4096 / 40));
    }
    if (config.sensing == CurrentSensing::one_shunt) {
      const bool visible = command.enabled && static_cast<double>(command.duty) > 0.05;
      const double driven = !visible ? 0 : state.drive.reversed ? -motor.i : motor.i;
      in.current_counts[0] = static_cast<std::uint16_t>(std::lround(2055 + driven * 4096 / 40));
    }
    in.bus_counts = static_cast<std::uint16_t>(std::lround(U * 4096 / 40));
    in.hall_pins = static_cast<std::uint8_t>((motor.pins() | stuck_high) & ~stuck_low);
    in.now = static_cast<std::uint32_t>(std::llround(motor.t * 1e6));
    return in;
  }
  void tick() {
    command =
        protected_step(config, state, registers(), request, Setpoint<S>{static_cast<S>(setpoint)}, telemetry);
    const int before = motor.sector();
    motor.run(command);
    if (motor.sector() != before) {
      const BoardInput in = registers();
      command = protected_on_hall(config, state, in.hall_pins, in.now);
    }
  }
  void ticks(int n) {
    for (int k = 0; k < n; ++k) tick();
  }
};

}  // namespace sixstep::control
