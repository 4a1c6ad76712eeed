// SPDX-License-Identifier: Apache-2.0
// A synthetic run that does not use the engine: a coarse six-step drive with a fixed step and a current PI.
// It serves tests of outputs, and no test relies on its physics.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep_tests {

struct SyntheticRun {
  sixstep::study::Scenario scenario;
  sixstep::study::Outcome outcome;
  sixstep::study::Trace trace;
};

/// State and equations of the synthetic drive. It records a row whenever a gate, a diode or a Hall bit
/// changes.
class SyntheticDrive {
 public:
  SyntheticDrive(sixstep::study::Trace& trace, double duration_s, double speed_rad_s)
      : trace_(trace), duration_(duration_s), speed_(speed_rad_s) {
    static constexpr std::array<std::array<const char*, 3>, 28> names{
        {{"t_s", "s", ""},
         {"i_a_A", "A", "phase"},
         {"i_b_A", "A", "phase"},
         {"i_c_A", "A", "phase"},
         {"u_ab_V", "V", "line"},
         {"u_bc_V", "V", "line"},
         {"u_ca_V", "V", "line"},
         {"e_a_V", "V", "phase"},
         {"e_b_V", "V", "phase"},
         {"e_c_V", "V", "phase"},
         {"speed_rad_s", "rad/s", "mechanical"},
         {"angle_rad", "rad", "mechanical"},
         {"torque_Nm", "Nm", ""},
         {"bus_V", "V", ""},
         {"bus_A", "A", ""},
         {"duty", "1", ""},
         {"i_m_A", "A", "driven pair"},
         {"i_ref_A", "A", "driven pair"},
         {"speed_ref_rad_s", "rad/s", "mechanical"},
         {"position_ref_deg", "deg", "mechanical"},
         {"load_Nm", "Nm", ""},
         {"gate_T1", "1", ""},
         {"gate_T2", "1", ""},
         {"gate_T3", "1", ""},
         {"gate_T4", "1", ""},
         {"gate_T5", "1", ""},
         {"gate_T6", "1", ""},
         {"hall", "1", ""}}};
    for (const auto& n : names) trace_.columns.push_back({n[0], n[1], n[2], std::string("column ") + n[0]});
    trace_.values.resize(names.size());
    trace_.every_event = true;
  }

  void run() {
    const long steps = std::lround(duration_ / dt);
    for (long n = 0; n <= steps; ++n) {
      t_ = static_cast<double>(n) * dt;
      if (n % steps_per_period == 0) control();
      phase_ = static_cast<double>(n % steps_per_period) / steps_per_period;
      switch_bridge();
      const auto state = gates_and_diodes();
      const bool event = state != last_;
      if (event && n > 0) record(held_);  // left side of the jump, with the previous gates
      held_ = {gates_, hall_, volts_};
      last_ = state;
      solve_voltages();
      held_.volts = volts_;
      if (event || n == steps) record(held_);
      advance();
    }
  }

 private:
  static constexpr double dt = 0.25e-6, R = 0.515, L = 0.286e-3, K_e = 0.01675, J = 1.35e-5, U = 24.0;
  static constexpr int steps_per_period = 120;
  static constexpr std::array<std::array<int, 2>, 6> pairs{{{0, 1}, {0, 2}, {1, 2}, {1, 0}, {2, 0}, {2, 1}}};
  static constexpr std::array<int, 6> hall_codes{4, 6, 2, 3, 1, 5};
  struct Held {
    std::array<int, 6> gates{};
    int hall = 4;
    std::array<double, 3> volts{};
  };

  static double trapezoid(double theta_deg) {
    const double x = theta_deg - 360.0 * std::floor(theta_deg / 360.0);
    if (x < 120) return 1;
    if (x < 180) return 1 - (x - 120) / 30;
    return x < 300 ? -1 : -1 + (x - 300) / 30;
  }
  int sector() const {
    const double deg = theta_ * 8.0 * 180.0 / 3.14159265358979;
    return static_cast<int>(std::floor((deg - 360.0 * std::floor(deg / 360.0)) / 60.0)) % 6;
  }

  void control() {
    i_ref_ = std::fmod(t_, 0.01) < 0.005 ? 5.0 : -5.0;
    const double error = i_ref_ - i_m();
    u_ = std::clamp(u_ + 4.5 * error - 4.04 * last_error_, -U, U);
    last_error_ = error;
    duty_ = u_ / U;
  }

  void switch_bridge() {
    auto [p, n] = pairs[static_cast<std::size_t>(sector())];
    if (duty_ < 0) std::swap(p, n);
    gates_ = {};
    gates_[static_cast<std::size_t>(2 * n + 1)] = 1;
    if (phase_ < std::abs(duty_)) gates_[static_cast<std::size_t>(2 * p)] = 1;
    hall_ = hall_codes[static_cast<std::size_t>(sector())];
  }

  std::array<int, 10> gates_and_diodes() {
    std::array<int, 10> state{};
    for (std::size_t k = 0; k < 3; ++k) {
      const int up = gates_[2 * k], low = gates_[2 * k + 1];
      leg_[k] = up ? 1 : low ? 0 : i_[k] > 1e-9 ? 0 : i_[k] < -1e-9 ? 1 : -1;
      state[6 + k] = leg_[k];
    }
    for (std::size_t k = 0; k < 6; ++k) state[k] = gates_[k];
    state[9] = hall_;
    return state;
  }

  void solve_voltages() {
    for (std::size_t k = 0; k < 3; ++k)
      e_[k] =
          K_e * speed_ * trapezoid(theta_ * 8.0 * 180.0 / 3.14159265358979 - 120.0 * static_cast<double>(k));
    double sum = 0.0;
    int connected = 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (leg_[k] >= 0) sum += U * leg_[k] - e_[k], ++connected;
    star_ = connected > 0 ? sum / connected : 0.0;
    for (std::size_t k = 0; k < 3; ++k) volts_[k] = leg_[k] >= 0 ? U * leg_[k] : star_ + e_[k];
  }

  void advance() {
    torque_ = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double before = i_[k];
      if (leg_[k] >= 0) i_[k] += dt * (volts_[k] - star_ - e_[k] - R * i_[k]) / L;
      const bool diode = !gates_[2 * k] && !gates_[2 * k + 1];
      if (diode && before * i_[k] <= 0.0) i_[k] = 0.0;
      torque_ +=
          i_[k] * K_e * trapezoid(theta_ * 8.0 * 180.0 / 3.14159265358979 - 120.0 * static_cast<double>(k));
    }
    speed_ += dt * (torque_ - 7.3e-6 * speed_) / J;
    theta_ += dt * speed_;
  }

  double i_m() const {
    const auto [p, n] = pairs[static_cast<std::size_t>(sector())];
    return 0.5 * (i_[static_cast<std::size_t>(p)] - i_[static_cast<std::size_t>(n)]);
  }

  void record(const Held& h) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto& u = h.volts;
    const std::array<double, 28> row{t_,
                                     i_[0],
                                     i_[1],
                                     i_[2],
                                     u[0] - u[1],
                                     u[1] - u[2],
                                     u[2] - u[0],
                                     e_[0],
                                     e_[1],
                                     e_[2],
                                     speed_,
                                     theta_,
                                     torque_,
                                     U,
                                     0.0,
                                     duty_,
                                     i_m(),
                                     i_ref_,
                                     nan,
                                     nan,
                                     0.0,
                                     1.0 * h.gates[0],
                                     1.0 * h.gates[1],
                                     1.0 * h.gates[2],
                                     1.0 * h.gates[3],
                                     1.0 * h.gates[4],
                                     1.0 * h.gates[5],
                                     1.0 * h.hall};
    for (std::size_t c = 0; c < row.size(); ++c) trace_.values[c].push_back(row[c]);
  }

  sixstep::study::Trace& trace_;
  double duration_, speed_, t_ = 0.0, phase_ = 0.0;
  std::array<double, 3> i_{}, e_{}, volts_{};
  double star_ = 0.0, theta_ = 0.0, torque_ = 0.0;
  double i_ref_ = 5.0, u_ = 0.0, last_error_ = 0.0, duty_ = 0.0;
  std::array<int, 6> gates_{};
  std::array<int, 3> leg_{};
  int hall_ = 4;
  std::array<int, 10> last_{};
  Held held_;
};

inline sixstep::study::Outcome synthetic_outcome() {
  sixstep::study::Outcome o;
  o.verdicts = {{"settling time of current", "s", 0.000927, std::nullopt, 1e-3, true},
                {"largest current", "A", 5.4163, std::nullopt, 5.5, true},
                {"mean current from 2 ms to 5 ms", "A", 4.9871, 4.95, 5.05, true}};
  o.comparisons = {{"overshoot of current", "%", 8.33, 7.0, "discrete design, no ripple"},
                   {"rise time", "s", 0.000241, 0.00025, "thesis, figure 7.4"},
                   {"speed at the end", "rad/s", 71.2, 70.0, "hand calculation"}};
  o.energy = sixstep::study::EnergyBook{.supplied = 1.0312,
                                        .copper = 0.5010,
                                        .devices = 0.0,
                                        .magnetic = 0.0071,
                                        .air_gap = 0.5231,
                                        .friction = 0.0101,
                                        .load = 0.0,
                                        .kinetic = 0.5130,
                                        .moved = 1.5543,
                                        .scale = 1.5543,
                                        .electrical_residual = 3.1e-15,
                                        .mechanical_residual = 8.8e-16};
  o.events = {{"PWM edge", 1334}, {"Hall edge", 21}, {"diode current zero", 42}, {"control tick", 667}};
  o.segments = 2087;
  o.turn_ons = 667;
  o.motor = {.machine = {.R_ohm = 0.515, .L_H = 0.286e-3, .K_e_V_s = 0.01675, .pole_pairs = 8},
             .shaft = {.J_kg_m2 = 1.35e-5, .B_Nm_s = 7.3e-6},
             .K_t_Nm_A = 0.0335,
             .nominal_voltage_V = 24.0};
  sixstep::design::PolePlacement d{.settle_s = 1e-3, .damping = 0.9, .period_s = 30e-6};
  d.gains = {4.0956, -3.6940};
  d.steps = {{"T_reg", "settling time asked for", 1e-3, "s"},
             {"ξ", "damping asked for", 0.9, ""},
             {"ω0", "4.6/(ξ T_reg)", 5111.11, "rad/s"},
             {"s", "−ξ ω0 (real part)", -4600.0, "1/s"},
             {"s", "ω0 √(1−ξ²) (imaginary part)", 2227.9, "1/s"},
             {"z", "Re exp(s T_s)", 0.869154, ""},
             {"z", "Im exp(s T_s)", 0.058178, ""},
             {"a0", "−exp(−R T_s/L)", -0.9474, ""},
             {"b0", "(1 + a0)/R", 0.0511, "A/V"},
             {"d1", "(1 − a0 − 2 Re z)/b0", 4.0956, "V/A"},
             {"d0", "(a0 + |z|²)/b0", -3.6940, "V/A"}};
  o.gains = {{"current", 4.5, -4.04, "given as d1, d0", d}};
  return o;
}

inline sixstep::study::Scenario synthetic_scenario(double duration_s) {
  sixstep::study::Scenario s;
  s.title = "Current PI, square wave 5 A at 100 Hz";
  s.motor = "maxon-251601";
  s.duration_s = duration_s;
  s.notes =
      "The current settles within the settling time of the design; at each reversal the rotor's speed "
      "decides how much voltage is left.";
  s.control.mode = sixstep::control::Mode::current;
  s.reference = {.shape = sixstep::study::Shape::square, .high = 5, .low = -5, .period_s = 0.01};
  s.sheet.name = "EC 45 flat 251601";
  s.sheet.maker = "maxon";
  s.sheet.nominal_voltage_V = {24, "", "data sheet, line 1"};
  s.sheet.resistance_ohm = {1.03, "terminal", "data sheet, line 10"};
  s.sheet.inductance_mH = {0.572, "terminal", "data sheet, line 11"};
  s.sheet.torque_constant_mNm_A = sixstep::base::Quantity{33.5, "terminal", "data sheet, line 12"};
  s.sheet.inertia_gcm2 = {135, "", "data sheet, line 16"};
  s.sheet.viscous_friction_Nm_s = sixstep::base::Quantity{7.3e-6, "", "thesis, chapter 6"};
  s.sheet.no_load_speed_rpm = sixstep::base::Quantity{6710, "", "data sheet, line 2"};
  return s;
}

inline SyntheticRun synthetic_run(double duration_s, double speed_rad_s = 60.0) {
  SyntheticRun run;
  run.scenario = synthetic_scenario(duration_s);
  run.outcome = synthetic_outcome();
  run.outcome.simulated_s = duration_s;
  SyntheticDrive(run.trace, duration_s, speed_rad_s).run();
  return run;
}

}  // namespace sixstep_tests
