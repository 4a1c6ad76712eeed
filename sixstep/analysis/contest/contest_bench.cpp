// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/contest/contest_bench.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/verify/design_scenario.hpp"
#include "sixstep/analysis/verify/scenario_spec.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/scenario/switching_law.hpp"

namespace sixstep::analysis {
namespace {

/// The course's high speed, as a fraction of the speed up to which the bus drives the nominal current.
constexpr double high_part = 0.6;
/// Largest deviation of a mean speed from its reference, as a fraction: at the high speed, at the low speed.
constexpr double holds_high = 0.02, holds_slow = 0.05;
constexpr double electrical_turns = 10.0;

/// Rounded up to three digits.
double plain(double x) { return base::shortened(x, 3, base::Towards::up); }

design::DesignSpec wanted(const ContestSpec& c) {
  design::DesignSpec spec = c.board ? analysis::spec_of(*c.board) : design::on_a_board();
  spec.mode = control::Mode::speed;
  spec.chopping = control::Chopping::soft;
  spec.lowest_speed_rad_s.reset();
  if (!c.board || c.voltage_V) spec.voltage_V = c.voltage_V;
  spec.settle_s = c.settle_s;
  spec.current_settle_s = c.current_settle_s;
  spec.torque_limit_Nm.reset();
  spec.load_inertia_kg_m2 = 0.0;
  spec.period_s = c.period_s.value_or(spec.period_s);
  return spec;
}

bool is_grave(const design::DriveDesign& d) {
  return std::any_of(d.warnings.begin(), d.warnings.end(), [](const design::Warning& w) { return w.grave; });
}

/// Designs the drive with the design's settling time. If this design has a grave warning, uses the shortest
/// of 2, 5, 10 .. times this time without a grave warning.
base::Result<design::DriveDesign> drive_design(const design::MotorModel& motor, const ContestSpec& c) {
  design::DesignSpec spec = wanted(c);
  base::Result<design::DriveDesign> first = design::design_drive(motor, spec);
  if (!first) return first;
  if (!(first->headroom_end_rad_s > 0.0))
    return base::Problem{"voltage_V", base::rounded(first->bus_V, 4),
                         "cannot drive the nominal current even at standstill",
                         "give a higher bus voltage in V"};
  if (c.settle_s || !is_grave(*first)) return first;
  const double chosen_s = first->spec.settle_s.value_or(10e-3);
  for (const double times : {2.0, 5.0, 10.0, 20.0}) {
    spec.settle_s = times * chosen_s;
    base::Result<design::DriveDesign> next = design::design_drive(motor, spec);
    if (next && !is_grave(*next)) return next;
  }
  return base::Problem{
      "the motor", c.motor,
      "has no usable speed loop with Hall probes, not even with 20 times the design's settling time",
      "find the reason with a design of this motor's speed loop, or give a settling time"};
}

Course course_of(const design::DriveDesign& d) {
  const double K = d.motor.K_t_Nm_A, J = d.motor.shaft.J_kg_m2, R = 2 * d.motor.machine.R_ohm;
  const double settle = d.spec.settle_s.value_or(10e-3), turn = 2 * base::pi / d.motor.machine.pole_pairs;
  Course c;
  c.load_Nm = base::shortened(K * d.nominal_current_A, 3, base::Towards::down);
  c.high_rad_s = base::shortened(high_part * d.headroom_end_rad_s, 2, base::Towards::down);
  c.slow_rad_s = plain(d.lowest_speed_rad_s);
  c.calm_s = plain(std::max(settle, electrical_turns * turn / c.high_rad_s));
  c.slow_calm_s = plain(std::max(settle, electrical_turns * turn / c.slow_rad_s));
  // Mean torque during the start: half of the torque that limit and bus allow at the end of the start, minus
  // half of the load. The first factor is a half because commutation reduces the torque.
  const double drives =
      0.5 * std::min(d.torque_limit_Nm, K * (d.bus_V - K * c.high_rad_s) / R) - c.load_Nm / 2;
  const double start = J * c.high_rad_s / std::max(drives, 0.2 * c.load_Nm);
  c.load_at_s = plain(start + 5 * settle + c.calm_s);
  c.slow_at_s = plain(c.load_at_s + 5 * settle);
  const double fall = J * (c.high_rad_s - c.slow_rad_s) / c.load_Nm;  // time in which only the load brakes
                                                                      // the motor
  c.end_s = plain(c.slow_at_s + fall + 5 * settle + c.slow_calm_s);
  return c;
}

study::Measure measure_of(const ContestGauge& gauge, const Course& c) {
  study::Measure m;
  m.metric = gauge.metric;
  m.signal = gauge.signal;
  m.label = gauge.label;
  const auto window = [&m](double from_s, double to_s) {
    m.from_s = from_s;
    m.to_s = to_s;
  };
  switch (gauge.part) {
    case CoursePart::start:
      window(0.0, c.load_at_s);
      break;
    case CoursePart::high:
      window(c.load_at_s - c.calm_s, c.load_at_s);
      break;
    case CoursePart::load_step:
      window(c.load_at_s, c.slow_at_s);
      break;
    case CoursePart::brake:
      window(c.slow_at_s, c.end_s);
      break;
    case CoursePart::slow:
      window(c.end_s - c.slow_calm_s, c.end_s);
      break;
  }
  const study::MetricKind k = gauge.metric;
  if (k == MetricKind::settling_time || k == MetricKind::overshoot || k == MetricKind::largest_error)
    m.level = c.high_rad_s;
  if (k == MetricKind::settling_time || k == MetricKind::overshoot) m.start = 0.0;
  if (k == MetricKind::settling_time) m.band = settled_part;
  return m;
}

study::Requirement holds(const char* label, double from_s, double to_s, double speed_rad_s, double part) {
  study::Measure m;
  m.metric = MetricKind::mean;
  m.signal = Signal::speed;
  m.from_s = from_s;
  m.to_s = to_s;
  m.label = label;
  return {m, (1 - part) * speed_rad_s, (1 + part) * speed_rad_s};
}

void add_course(const Course& c, study::Scenario& s) {
  s.title = "Start, load step and low speed";
  s.duration_s = c.end_s;
  s.reference = {};
  s.reference.shape = study::Shape::steps;
  s.reference.times_s = {0.0, c.slow_at_s};
  s.reference.values = {c.high_rad_s, c.slow_rad_s};
  s.load.times_s = {0.0, c.load_at_s};
  s.load.torques_Nm = {c.load_Nm / 2, c.load_Nm};
  s.load.torque_Nm = 0.0;
  const double loaded = c.slow_at_s - c.load_at_s;
  s.require = {
      holds("high speed held", c.load_at_s - c.calm_s, c.load_at_s, c.high_rad_s, holds_high),
      holds("held under the full load", c.slow_at_s - loaded / 5, c.slow_at_s, c.high_rad_s, holds_high),
      holds("low speed held", c.end_s - c.slow_calm_s, c.end_s, c.slow_rad_s, holds_slow)};
  s.compare.clear();
  for (const ContestGauge& gauge : contest_gauges)
    s.compare.push_back({measure_of(gauge, c), 0.0, "figure that compares controllers"});
  s.record = {};
}

/// Sets the keys that all scenarios share, and keys that suit every controller: the angle between Hall edges,
/// the range of the converters, pulses in the middle of the period.
void make_common(const design::DriveDesign& d, bool board, study::Scenario& s) {
  s.pwm.alignment = study::Alignment::centre;
  s.control.speed.torque_limit_Nm = base::shortened(d.torque_limit_Nm, 4, base::Towards::down);
  const study::Bridge usual = usual_bridge(d);
  if (board) {
    if (!study::switching_law(s.bridge).any()) {  // every controller's switching must cause losses
      s.bridge.energies_at_V = usual.energies_at_V;
      s.bridge.energies_at_A = usual.energies_at_A;
      s.bridge.turn_on_J = usual.turn_on_J;
      s.bridge.turn_off_J = usual.turn_off_J;
    }
    return;
  }
  s.bridge = usual;
  s.sensors.hall_angle = rig::HallAngleFrom::angle;
  s.sensors.current_range_A = plain(2.0 * (d.current_at_full_torque_A + 2 * d.ripple.worst_A));
}

std::vector<std::string> rules_of(const ContestBench& b) {
  const study::Scenario& s = b.scenario;
  const auto n = [](double x) { return base::rounded(x, 4); };
  return {"one sample and one PWM period, " + n(s.pwm.period_s * 1e6) + " us, and " +
              (s.pwm.delay_periods == 1 ? "one period" : "no period") + " from a sample to its answer",
          "one bus, " + n(s.supply.voltage_V) + " V, one bridge, one set of sensors",
          "one torque limit, " + n(s.control.speed.torque_limit_Nm.value_or(0) * 1e3) + " mN m, " +
              n(b.design.current_at_full_torque_A) + " A",
          "one speed loop, designed to settle in " + n(b.design.spec.settle_s.value_or(0) * 1e3) +
              " ms, and one current loop, in " + n(s.control.current.settle_s.value_or(0) * 1e3) +
              " ms, by pole placement with damping " + n(b.design.spec.damping),
          "one full load, " + n(b.course.load_Nm * 1e3) + " mN m: K_t times " +
              design::nominal_current_words(b.design) + ", " + n(b.design.nominal_current_A) + " A",
          "one high speed, " + n(b.course.high_rad_s) + " rad/s: " + n(high_part) +
              " of the highest speed at which the bus drives this current",
          "one course: a start to the high speed against " + n(b.course.load_Nm * 500) +
              " mN m, a load step to " + n(b.course.load_Nm * 1e3) + " mN m at " +
              n(b.course.load_at_s * 1e3) + " ms, a deceleration to " + n(b.course.slow_rad_s) +
              " rad/s at " + n(b.course.slow_at_s * 1e3) + " ms"};
}

}  // namespace

study::Bridge usual_bridge(const design::DriveDesign& d) {
  constexpr double edge_s = 50e-9;
  study::Bridge b;
  b.on_resistance_ohm = base::shortened(0.01 * 2 * d.motor.machine.R_ohm, 2, base::Towards::up);
  b.diode_drop_V = 0.8;
  b.dead_time_s = 0.5e-6;
  b.energies_at_V = d.bus_V;
  b.energies_at_A = base::shortened(d.nominal_current_A, 3, base::Towards::up);
  b.turn_on_J = b.turn_off_J =
      base::shortened(0.5 * b.energies_at_V * b.energies_at_A * edge_s, 3, base::Towards::up);
  return b;
}

base::Result<ContestBench> contest_bench(const ContestSpec& spec) {
  if (spec.sheet.kind == design::MotorKind::linear)
    return base::Problem{"the motor", spec.motor, "is a linear motor, and only rotary motors can be compared",
                         "design each controller separately, without a comparison"};
  const base::Result<design::MotorModel> motor = design::motor_model(spec.sheet);
  if (!motor) return motor.problems();
  base::Result<design::DriveDesign> d = drive_design(*motor, spec);
  if (!d) return d.problems();
  ContestBench bench{.design = *d, .course = course_of(*d), .scenario = {}, .rules = {}};
  const DesignSubject subject{.motor = spec.motor, .sheet = spec.sheet, .board = spec.board};
  bench.scenario = design_scenario(*d, subject);
  make_common(*d, spec.board.has_value(), bench.scenario);
  add_course(bench.course, bench.scenario);
  bench.rules = rules_of(bench);
  return bench;
}

std::vector<std::pair<std::string, double>> contest_values(const ContestBench& bench) {
  const design::DriveDesign& d = bench.design;
  const design::MotorModel& m = d.motor;
  const Course& c = bench.course;
  // The leaving phase's current falls under the voltage (U + 2 e)/3. U: bus voltage; e = K_t w/2: back-EMF of
  // a phase at the high speed w.
  const double falls_V = (d.bus_V + m.K_t_Nm_A * c.high_rad_s) / 3;
  const double commutes_s = m.machine.L_H * d.nominal_current_A / falls_V;
  const study::SpeedLoop& speed = bench.scenario.control.speed;
  return {{"settle_s", speed.settle_s.value_or(0.0)},
          {"damping", speed.damping.value_or(0.0)},
          {"limit_Nm", speed.torque_limit_Nm.value_or(0.0)},
          {"band_A", plain(d.ripple.worst_A / 2)},  // half of the largest PWM ripple
          {"advance", plain(commutes_s / 2 * m.machine.pole_pairs * 180 / base::pi)},
          {"trip_A", plain(1.9 * (d.current_at_full_torque_A + 2 * d.ripple.worst_A))},
          {"trip_rad_s", plain(1.5 * d.bus_V / m.K_t_Nm_A)},
          {"high_V", plain(1.25 * d.bus_V)},
          {"low_V", plain(0.5 * d.bus_V)},
          {"slew", plain((d.torque_limit_Nm - c.load_Nm / 2) / m.shaft.J_kg_m2)}};
}

base::Result<std::vector<ContestKey>> keys_of(const Contestant& contestant, const ContestBench& bench) {
  std::vector<ContestKey> out;
  std::string keys(contestant.keys);
  for (const auto& [name, value] : contest_values(bench)) {
    const std::string mark = '<' + name + '>';
    for (std::size_t at = keys.find(mark); at != std::string::npos; at = keys.find(mark))
      keys.replace(at, mark.size(), base::written(value));
  }
  if (const std::size_t at = keys.find('<'); at != std::string::npos)
    return base::Problem{std::string(contestant.name), keys.substr(at, keys.find('>', at) + 1 - at),
                         "is a placeholder for which no rule computes a value",
                         "use a placeholder that contest_values() lists"};
  std::string_view rest = keys;
  while (!rest.empty()) {
    const std::string_view one = rest.substr(0, rest.find("; "));
    rest.remove_prefix(std::min(one.size() + 2, rest.size()));
    const std::size_t equals = one.find(" = ");
    if (equals == std::string_view::npos)
      return base::Problem{std::string(contestant.name), std::string(one), "is not a key with a value",
                           "write each part as key = value"};
    out.push_back({std::string(one.substr(0, equals)), std::string(one.substr(equals + 3))});
  }
  return out;
}

}  // namespace sixstep::analysis
