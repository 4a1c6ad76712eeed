// SPDX-License-Identifier: Apache-2.0
// Scenarios of the product drive, and an observer of its bridge's events.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "sixstep/study/measure/columns.hpp"
#include "tests/support/scenarios.hpp"

namespace sixstep::testing {

/// Phase currents of +-20.48 A in 12 bits, 10 mA per count. The bus range is 40.96 V. Hall edges are captured
/// at 1 MHz.
inline study::Sensors board_sensors(int bits = 12) {
  study::Sensors s;
  s.currents = rig::CurrentMeasurement::phases;
  s.adc_bits = bits;
  s.current_range_A = 20.48;
  s.bus = study::BusSensing::adc;
  s.bus_range_V = 40.96;
  s.rotor = study::RotorSensing::hall;
  s.speed_edges = 1;
  return s;
}

/// The product drive with the reference motor. Normal operation does not reach its limits. The speed loop is
/// slow, because the speed from edges is a sector late.
inline study::Scenario product_scenario(control::Mode mode, double reference) {
  study::Scenario s = maxon_scenario(mode, reference);
  s.control.drive = study::FirmwareKind::product;
  s.control.speed.settle_s = 0.1;
  s.control.speed.damping = 0.9;
  s.control.current.limit_A = 10.0;
  s.load.coulomb_Nm = 0.02;
  s.sensors = board_sensors();
  s.protection.over_current_A = 15.0;
  s.protection.over_voltage_V = 35.0;
  s.protection.under_voltage_V = 10.0;
  s.protection.over_speed_rad_s = 500.0;
  return s;
}

inline std::size_t column(const std::string& name) {
  std::size_t n = 0;
  while (study::all_columns()[n].name != name) ++n;
  return n;
}

/// Stores every event of a run, with both sides of each jump.
struct Witness {
  struct Instant {
    double t = 0.0, speed = 0.0;
    bool any_gate = false, hall_possible = true;
  };
  std::vector<Instant> seen;
  bool both_of_a_leg = false;
  double most_A = 0.0, last_speed = 0.0;

  void operator()(study::Row row) {
    static const std::size_t gates = column("gate_T1"), hall = column("hall"), speed = column("speed_rad_s"),
                             i = column("i_a_A");
    Instant now{row[0], row[speed], false, row[hall] != 0 && row[hall] != 7};
    for (std::size_t k = 0; k < 3; ++k) {
      const bool high = row[gates + 2 * k] != 0, low = row[gates + 2 * k + 1] != 0;
      both_of_a_leg = both_of_a_leg || (high && low);
      now.any_gate = now.any_gate || high || low;
      most_A = std::max(most_A, std::fabs(row[i + k]));
    }
    last_speed = row[speed];
    seen.push_back(now);
  }
  /// First instant with a gate on, or -1 if there is none.
  double first_on() const {
    for (const Instant& n : seen)
      if (n.any_gate) return n.t;
    return -1;
  }
  /// Instant after which no gate is on, or -1 if a gate is on at the end.
  double off_for_good() const {
    double t = seen.back().any_gate ? -1 : seen.back().t;
    for (auto n = seen.rbegin(); n != seen.rend() && !n->any_gate; ++n) t = n->t;
    return t;
  }
  double first_impossible() const {
    for (const Instant& n : seen)
      if (!n.hall_possible) return n.t;
    return -1;
  }
};

/// A drive at 300 rad/s with an energy of 0.6 J in its rotor. The bus has 0.1 mF and is supplied through 0.1
/// ohm. The drive brakes with 2 A when its request to run ends.
inline study::Scenario braking_onto_a_small_bus() {
  study::Scenario s = product_scenario(control::Mode::speed, 300.0);
  s.duration_s = 0.5;
  s.pwm.chopping = control::Chopping::complementary;
  s.pwm.delay_periods = 1;
  s.bridge.dead_time_s = 500e-9;
  s.supply.resistance_ohm = 0.1;
  s.supply.capacitance_F = 1e-4;
  s.protection.brake_current_A = 2.0;
  s.require.push_back({measure(study::MetricKind::maximum, study::Signal::current), {}, 15.0});
  return s;
}

}  // namespace sixstep::testing
