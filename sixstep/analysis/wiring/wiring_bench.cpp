// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/wiring/wiring_bench.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/range_text.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/measure/columns.hpp"

namespace sixstep::analysis {
namespace {

/// Largest number of control periods of a run with rows for a picture. All runs together then take some
/// seconds.
constexpr double most_periods = 3e5;
constexpr double rows = 1500;

/// Duration of the run-up in time constants: six, multiplied by three. With half the torque the run-up lasts
/// three times as long (wiring_theory.hpp, mean(g^2)).
constexpr double run_up = 18;
/// Electrical turns of an ideal motor during the measured part of a run. Every motor that runs makes more
/// than one turn in this time.
constexpr double watched_turns = 6;

constexpr double most_back_emf = 0.05;
/// Least duration of a slow electrical turn in multiples of L/R: about sixteen in each sector.
constexpr double least_turn = 100;

/// Least number of PWM periods in L/R during the slow turn: enough current then remains at the end of a
/// period. The slow back-EMF does not change the remaining fraction.
constexpr double periods_in_winding = 3;

/// Rounds a time up to a whole number of PWM periods: all rows are then at the same phase of a period.
double on_grid(double s, double period_s) { return std::ceil(s / period_s - 1e-9) * period_s; }

base::Problems set_current(const WiringSubject& subject, WiringBench& b) {
  const double stall_A = b.voltage_V / (2 * b.motor.machine.R_ohm);
  const double nominal_A = b.motor.nominal_current_A;
  const bool printed = nominal_A > 0.0 && nominal_A <= stall_A;
  b.from = subject.current_A ? BenchCurrent::asked_for
           : printed         ? BenchCurrent::nominal
                             : BenchCurrent::tenth_of_stall;
  b.current_A = subject.current_A.value_or(printed ? nominal_A : stall_A / 10);
  if (!(b.current_A > 0.0 && b.current_A <= stall_A))
    return {{"current_A", base::written(b.current_A),
             "must be above 0 and at most " + base::rounded(stall_A, 4) +
                 " A, which the bus drives through the stalled motor",
             printed ? "leave the current out: the default is the sheet's nominal current"
                     : "leave the current out: the default is a tenth of the current at full duty"}};
  b.duty = b.current_A / stall_A;
  return {};
}

void set_times(WiringBench& b) {
  const plant::Machine& m = b.motor.machine;
  const double K = b.motor.K_t_Nm_A, R = 2 * m.R_ohm, period = study::Pwm{}.period_s;
  b.ideal_rad_s = b.duty * b.voltage_V / K;
  const double watched = watched_turns * electrical_turn_rad / (m.pole_pairs * b.ideal_rad_s);
  b.watched_from_s = on_grid(run_up * R * b.motor.shaft.J_kg_m2 / (K * K) + watched / watched_turns, period);
  b.row_s = on_grid((b.watched_from_s + watched) / rows, period);
  b.watched_from_s = on_grid(b.watched_from_s, b.row_s);
  b.free_s = b.watched_from_s + on_grid(watched, b.row_s);
  const double slow = electrical_turn_rad / (m.pole_pairs * most_back_emf * b.ideal_rad_s);
  const double turn = std::max(slow, least_turn * m.L_H / m.R_ohm);
  const double short_of = base::shortened(m.L_H / m.R_ohm / periods_in_winding, 2, base::Towards::down);
  b.turned_pwm_s = std::min(period, std::max(short_of, turn / most_periods));
  const double row = on_grid(turn / turned_rows, b.turned_pwm_s);
  b.turned_s = turned_rows * row;
  b.turned_from_s = b.turned_s / 6;
  b.turned_rad_s = electrical_turn_rad / (m.pole_pairs * b.turned_s);
}

study::Measure over(study::MetricKind metric, study::Signal signal, double from_s) {
  study::Measure m;
  m.metric = metric;
  m.signal = signal;
  m.from_s = from_s;
  return m;
}

void ask(study::Scenario& s, const study::Measure& m) { s.compare.push_back({m, 0.0, ""}); }

const std::string& column(const study::Scenario& s, study::ColumnId id) {
  return study::all_columns(s.sheet.kind)[static_cast<std::size_t>(id)].name;
}

study::Scenario on_bench(const WiringBench& b, const WiringSubject& subject, const rig::Wiring& wiring) {
  study::Scenario s;
  s.motor = subject.motor;
  s.sheet = subject.sheet;
  s.supply.voltage_V = b.voltage_V;
  s.bridge.phases = wiring.phases;
  s.sensors.hall_lines = wiring.probes;
  s.control.mode = control::Mode::duty;
  s.reference.value = b.duty;
  return s;
}

}  // namespace

base::Result<WiringBench> wiring_bench(const WiringSubject& subject) {
  base::Result<design::MotorModel> motor = design::motor_model(subject.sheet);
  if (!motor) return motor.problems();
  WiringBench b;
  b.motor = std::move(*motor);
  b.voltage_V = subject.voltage_V.value_or(b.motor.nominal_voltage_V);
  if (!subject.voltage_V && !(b.voltage_V > 0.0))
    return base::Problem{"voltage_V", "", "is missing, and the sheet prints no nominal voltage",
                         "give the bus voltage in volts"};
  if (base::Problems found =
          base::out_of_range("voltage_V", b.voltage_V, base::above(0), "V", "give the bus voltage in volts");
      !found.empty())
    return found;
  if (base::Problems found = set_current(subject, b); !found.empty()) return found;
  set_times(b);
  const double longest = std::max(b.free_s, b.turned_from_s + b.turned_s);
  if (!(longest <= most_periods * study::Pwm{}.period_s))
    return base::Problem{
        "current_A", base::written(b.current_A),
        "makes each of the 252 runs last " + base::rounded(longest, 3) +
            " s: the motor is too slow with this current",
        "give a higher current, or correct the units of inertia and torque constant in the motor file"};
  return b;
}

study::Scenario free_run(const WiringBench& b, const WiringSubject& subject, const rig::Wiring& wiring,
                         double electrical_deg) {
  using enum study::MetricKind;
  using study::Signal;
  study::Scenario s = on_bench(b, subject, wiring);
  s.title = "Released from rest, connected as in bridge.phases and sensors.hall_lines";
  s.duration_s = b.free_s;
  s.initial.angle_rad = electrical_deg * base::pi / 180 / b.motor.machine.pole_pairs;
  s.record.grid_s = b.row_s;
  s.record.columns = {column(s, study::ColumnId::angle), column(s, study::ColumnId::speed), "i_a_A", "i_b_A",
                      "i_c_A"};
  ask(s, over(mean, Signal::speed, b.watched_from_s));
  for (const Signal phase : {Signal::phase_a, Signal::phase_b, Signal::phase_c})
    ask(s, over(rms, phase, b.watched_from_s));
  ask(s, over(maximum, Signal::current_magnitude, b.watched_from_s));
  ask(s, over(mean, Signal::bus_current, b.watched_from_s));
  return s;
}

study::Scenario turned_run(const WiringBench& b, const WiringSubject& subject, const rig::Wiring& wiring) {
  study::Scenario s = on_bench(b, subject, wiring);
  s.title = "Turned slowly by a dynamometer, connected as in bridge.phases and sensors.hall_lines";
  s.duration_s = b.turned_from_s + b.turned_s;
  // Each row lies in the middle of an interval of two degrees. No row is then on a sector's edge, where the
  // torque has two values.
  constexpr double first_deg = -60 + 180.0 / turned_rows;
  s.pwm.period_s = b.turned_pwm_s;
  s.initial.angle_rad = first_deg * base::pi / 180 / b.motor.machine.pole_pairs;
  s.load.dynamometer_times_s = {0};
  s.load.dynamometer_rad_s = {b.turned_rad_s};
  s.record.grid_s = b.turned_s / turned_rows;
  s.record.columns = {column(s, study::ColumnId::torque), "i_a_A", "i_b_A", "i_c_A"};
  return s;
}

}  // namespace sixstep::analysis
