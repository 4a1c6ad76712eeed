// SPDX-License-Identifier: Apache-2.0
// Random motors on a bench: scenarios of common recordings, and the recordings with the errors of
// instruments.
#pragma once
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "batch/fit/fit.hpp"
#include "tests/analysis/identification/normal.hpp"
#include "tests/support/sessions.hpp"

namespace sixstep::testing {

/// Constants of a motor in the units of its sheet's standard keys.
struct BenchMotor {
  double R_ohm = 1.0, L_mH = 0.5, K_mNm_A = 30.0, J_gcm2 = 50.0, viscous_Nm_s = 1e-6, coulomb_mNm = 1.0;

  double tau_e_s() const { return 1e-3 * L_mH / R_ohm; }
  double tau_m_s() const { return J_gcm2 * 1e-7 * R_ohm / (K_mNm_A * K_mNm_A * 1e-6); }
  double no_load_rad_s(double volt) const { return volt / (1e-3 * K_mNm_A); }
};

inline base::Quantity of_value(double value, std::string frame = "") {
  return {value, std::move(frame), "drawn", base::Trust::measured};
}

inline design::Sheet sheet_of(const BenchMotor& m) {
  design::Sheet s;
  s.name = "drawn";
  s.pole_pairs = 4;
  s.nominal_voltage_V = of_value(24.0);
  s.resistance_ohm = of_value(m.R_ohm, "terminal");
  s.inductance_mH = of_value(m.L_mH, "terminal");
  s.torque_constant_mNm_A = of_value(m.K_mNm_A);
  s.inertia_gcm2 = of_value(m.J_gcm2);
  s.viscous_friction_Nm_s = of_value(m.viscous_Nm_s);
  s.coulomb_friction_mNm = of_value(m.coulomb_mNm);
  return s;
}

/// A motor with the constants of small servo motors: electrical time constants of 0.2 to 1 ms, mechanical
/// time constants of 5 to 20 ms.
inline BenchMotor drawn_motor(Draw& draw) {
  BenchMotor m;
  m.K_mNm_A = draw.decades(10.0, 60.0);
  m.R_ohm = draw.decades(0.3, 3.0);
  m.L_mH = 1e3 * draw.decades(2e-4, 1e-3) * m.R_ohm;
  m.J_gcm2 = 1e7 * draw.decades(5e-3, 20e-3) * m.K_mNm_A * m.K_mNm_A * 1e-6 / m.R_ohm;
  const double stall_mNm = m.K_mNm_A * 24.0 / m.R_ohm;
  m.coulomb_mNm = draw.between(0.005, 0.02) * stall_mNm;
  m.viscous_Nm_s = draw.between(0.005, 0.02) * stall_mNm * 1e-3 / m.no_load_rad_s(24.0);
  return m;
}

/// Constants as a data sheet prints them for another sample of the motor. Each constant is wrong by up to
/// `part`.
inline BenchMotor printed(const BenchMotor& m, Draw& draw, double part) {
  const auto off = [&] { return std::exp(draw.between(-part, part)); };
  return {m.R_ohm * off(),  m.L_mH * off(),         m.K_mNm_A * off(),
          m.J_gcm2 * off(), m.viscous_Nm_s * off(), m.coulomb_mNm * off()};
}

enum class Bench { locked_pulse, run_up, coast_down, no_load_steps, turned };

inline study::Scenario bench_scenario(Bench kind, const BenchMotor& m) {
  study::Scenario s;
  s.sheet = sheet_of(m);
  s.supply.voltage_V = 24.0;
  s.pwm.period_s = 50e-6;
  s.control.mode = control::Mode::duty;
  s.bridge.diode_drop_V = 0.8;
  switch (kind) {
    case Bench::locked_pulse:
      s.load.locked = true;
      s.reference = {.shape = study::Shape::steps, .times_s = {0.0, 0.5e-3}, .values = {0.0, 0.3}};
      s.duration_s = 8e-3;
      break;
    case Bench::run_up:
      s.reference.value = 0.5;
      s.duration_s = 0.06;
      break;
    case Bench::coast_down:
      s.control.mode = control::Mode::off;
      s.initial.speed_rad_s = 0.7 * m.no_load_rad_s(24.0);
      s.duration_s = 0.25;
      break;
    case Bench::no_load_steps:
      s.reference = {.shape = study::Shape::steps, .times_s = {0.0, 0.08, 0.16}, .values = {0.3, 0.6, 0.9}};
      s.duration_s = 0.24;
      break;
    case Bench::turned:
      s.control.mode = control::Mode::off;
      s.load.dynamometer_times_s = {0.0};
      s.load.dynamometer_rad_s = {0.4 * m.no_load_rad_s(24.0)};
      s.duration_s = 0.05;
  }
  return s;
}

/// Errors that an instrument adds to a column.
struct Instrument {
  double noise = 0.0,
         step = 0.0;  ///< standard deviation, and width of a converter's step, in the column's unit
  double gain = 1.0, offset = 0.0;
  double shift_s = 0.0,
         drift = 0.0;    ///< of the recording's clock: its time t is t (1 + drift) + shift_s of the run
  double dropped = 0.0;  ///< part of the rows that are missing
};

/// A recording of some columns of the scenario's run, with the errors of the instruments `by`.
inline study::Trace recorded(const study::Scenario& s, const std::vector<study::ColumnId>& columns,
                             double interval_s, const std::vector<Instrument>& by, Draw& draw) {
  study::Trace log;
  log.columns.push_back(study::all_columns()[0]);
  for (const study::ColumnId id : columns)
    log.columns.push_back(study::all_columns()[static_cast<std::size_t>(id)]);
  log.values.resize(log.columns.size());
  study::Session session = opened(s);
  for (double t_s = 0.0;; t_s += interval_s) {
    const double at_s = t_s * (1.0 + by[0].drift) + by[0].shift_s;
    if (at_s >= s.duration_s) return log;
    if (at_s < 0.0 || draw.chance(by[0].dropped)) continue;
    session.advance(at_s);
    log.values[0].push_back(t_s);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const Instrument& probe = by[c];
      double x = probe.gain * session.present().signals[static_cast<std::size_t>(columns[c])] + probe.offset;
      x += probe.noise * normal(draw);
      log.values[c + 1].push_back(probe.step > 0 ? probe.step * std::round(x / probe.step) : x);
    }
  }
}

}  // namespace sixstep::testing
