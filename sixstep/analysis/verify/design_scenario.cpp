// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/design_scenario.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/verify/blind_shunt.hpp"
#include "sixstep/analysis/verify/board.hpp"
#include "sixstep/analysis/verify/course_parts.hpp"
#include "sixstep/analysis/verify/linear_study.hpp"
#include "sixstep/analysis/verify/travel.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/measure/figures.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::analysis {
namespace {

using control::Mode;
using design::DriveDesign;
using design::LoopDesign;

/// Fraction of the bus voltage that a first command may use; the rest prevents clamping.
constexpr double part_of_bus = 0.8;

/// The file contains placed poles as settling time and damping. From these two values the run computes the
/// same gains, to the last bit.
template <class Gains>
void set_gains(const LoopDesign& loop, Gains& to) {
  if (loop.placed) {
    to.settle_s = loop.placed->settle_s;
    to.damping = loop.placed->damping;
  } else {
    to.d1 = loop.gains.d1;
    to.d0 = loop.gains.d0;
  }
}

study::Scenario common(const DriveDesign& d, const DesignSubject& subject) {
  study::Scenario s;
  s.motor = subject.motor;
  s.sheet = subject.sheet;
  s.believed = subject.believed();
  if (subject.board && subject.board->motor == subject.motor) s.motor_sheet = subject.board->motor_sheet;
  if (subject.board) {
    s.supply = subject.board->supply;
    s.bridge = subject.board->bridge;
    s.pwm = subject.board->pwm;
    s.sensors = with_rotor(subject.board->sensors, rotor_key(d.spec.rotor), d.spec.period_s);
    s.sensors.speed_edges = d.spec.rotor.edges;
    // The design uses the lean drive. Settings that only other drives use are not copied (carried_over.hpp).
    s.sensors.hall_stable_samples = study::Sensors{}.hall_stable_samples;
    s.sensors.terminal_gain_error.clear();
    s.sensors.comparators = {};
    s.sensors.hall_break = {};  // a fault that belongs to the board's own scenario
    s.control.current.limit_A = d.spec.current_limit_A;
    s.control.position.speed_limit_rad_s = subject.board->control.position.speed_limit_rad_s;
    s.sensors.encoder.referenced = true;  // a move begins at a known position
    s.load.gear = subject.board->load.gear;
  } else {
    s.bridge.dead_time_s = subject.dead_time_s;
    s.sensors = board_sensors(d, subject.step);
  }
  if (subject.currents) sense_currents(d, *subject.currents, subject.step, s.sensors);
  if (d.spec.rotor.shaft.kind != design::ShaftSensorKind::none &&
      s.sensors.shaft == study::SensorShaft::motor)
    s.pwm.commutation = study::CommutationAt::sample;
  const bool shunts = s.sensors.currents == rig::CurrentMeasurement::dc_link ||
                      s.sensors.currents == rig::CurrentMeasurement::low_side;
  if (shunts || (!subject.board && d.spec.sampled_in_middle)) s.pwm.alignment = study::Alignment::centre;
  if (d.spec.sampled_in_middle || samples_in_middle(subject)) s.pwm.sample = study::SampleAt::middle;
  if (d.spec.rotor.shaft.capture_Hz > 0.0) s.sensors.capture_Hz = d.spec.rotor.shaft.capture_Hz;
  if (d.spec.rotor.hall && d.spec.rotor.capture_Hz > 0.0) s.sensors.capture_Hz = d.spec.rotor.capture_Hz;
  s.supply.voltage_V = d.bus_V;
  s.pwm.period_s = d.spec.period_s;
  s.pwm.chopping = d.spec.chopping;
  s.pwm.delay_periods = d.spec.delay_periods;
  s.load.inertia_kg_m2 = d.spec.load_inertia_kg_m2 * s.load.gear * s.load.gear;
  s.control.mode = d.spec.mode;
  set_gains(d.loop("current"), s.control.current);
  if (d.loops.size() > 1) {
    set_gains(d.loop("speed"), s.control.speed);
    s.control.speed.torque_limit_Nm = d.torque_limit_Nm;
  }
  if (d.loops.size() > 2) s.control.position.gain_rad_s_per_deg = d.loop("position").gains.d1;
  return s;
}

/// Ripple in A at a mean current and a mean voltage across the pair. While the chopped switch is off, the
/// leg's diode carries the current. With complementary chopping, the leg's other switch carries it. The dead
/// time is neglected.
double expected_ripple_A(const DriveDesign& d, const study::Bridge& b, double current_A, double mean_V) {
  const double on = b.saturation_V + b.on_resistance_ohm * current_A,
               diode = b.diode_drop_V + b.diode_resistance_ohm * current_A;
  using control::Chopping;
  const double off_V = d.spec.chopping == Chopping::hard            ? -(d.bus_V + 2 * diode)
                       : d.spec.chopping == Chopping::complementary ? -2 * on
                                                                    : -(on + diode);
  return design::ripple_between_A(d.motor, d.bus_V - 2 * on, off_V, mean_V, d.spec.period_s);
}

double settling_of(const LoopDesign& loop, double otherwise) {
  return std::isfinite(loop.step.settling_s) && loop.step.settling_s > 0.0 ? loop.step.settling_s : otherwise;
}

void add_current(const DriveDesign& d, const DesignSubject& subject, study::Scenario& s) {
  const LoopDesign& loop = d.loop("current");
  const double unlimited_A = part_of_bus * d.bus_V / std::fabs(loop.gains.d1);
  const double step =
      subject.step.value_or(plain_number(std::min({d.nominal_current_A, allowed_current_A(d, subject),
                                                   std::max(unlimited_A, 1.5 * unseen_current_A(d, s))})));
  const double settle = settling_of(loop, 100 * d.spec.period_s), end = plain_time(5 * settle);
  const double last = end - 10 * d.spec.period_s, R = 2 * d.motor.machine.R_ohm;
  s.title = "Current loop as designed, rotor held";
  s.duration_s = end;
  s.load.locked = true;
  s.initial.angle_rad = base::sector_rad / 2 / d.motor.machine.pole_pairs;
  s.reference.value = step;
  s.reference.unit.emplace("A");
  study::Measure settling = step_measure(study::MetricKind::settling_time, study::Signal::current, 0, end, 0,
                                         step, "settling time");
  study::Measure overshoot =
      step_measure(study::MetricKind::overshoot, study::Signal::current, 0, end, 0, step, "overshoot");
  settling.sampled = overshoot.sampled = true;
  s.compare = {
      {settling, 0.0, "designed, at the samples, 2 %"},
      {overshoot, 0.0, "designed, at the samples"},
      {window_measure(study::MetricKind::peak_to_peak, study::Signal::current, last, end, "current ripple"),
       expected_ripple_A(d, s.bridge, std::fabs(step), std::fabs(step) * R), "PWM at this duty"},
  };
  expect_step(d, s);
  const double band = 0.02 * std::fabs(step);  // band of the settling time
  study::Measure mean = window_measure(study::MetricKind::mean, study::Signal::current, last, end,
                                       "mean of the last ten samples");
  mean.sampled = true;  // the controller samples and controls the lowest point of the ripple
  s.require = {{mean, step - band, step + band}};
}

/// The test of a speed loop: a start from rest, then a small step.
struct SpeedTest {
  double load_A = 0.0, first = 0.0, step = 0.0;  // load in A; speed and step in rad/s
  double begin = 0.0, end = 0.0, calm = 0.0;     // in s: time of the step, end of the run, begin of the
                                                 // window in which the speed must have settled
};

SpeedTest speed_test(const DriveDesign& d, const DesignSubject& subject) {
  const LoopDesign &speed = d.loop("speed"), &current = d.loop("current");
  const double K = d.motor.K_t_Nm_A, R = 2 * d.motor.machine.R_ohm;
  const design::TestSpeeds speeds = test_speeds(d.motor, d.bus_V, d.most_torque_Nm());
  const double load_A = speeds.load_A;
  SpeedTest t{.load_A = load_A, .first = plain_number(0.15 * d.bus_V / K)};
  const bool lags = d.lag.delay_s() > 0;
  if (lags) t.first = std::min(1.5 * d.lowest_speed_rad_s, speeds.top_rad_s);
  t.first = std::min(t.first, allowed_speed_rad_s(subject));
  // At a step, the speed controller first requests d1 (speed) times the current at full torque. For each
  // ampere of this request, the current loop needs d1 (current) volts at once, and R volts when the current
  // flows. d1: gain of a controller for the present error.
  const double volts = part_of_bus * (d.bus_V - K * t.first - R * t.load_A);
  t.step = subject.step.value_or(
      lags ? d.lowest_speed_rad_s - t.first
           : plain_number(std::min(t.first / 2, volts / (speed.gains.d1 * d.current_at_full_torque_A *
                                                         std::max(current.gains.d1, R)))));
  const double settle = std::max(settling_of(speed, 1000 * d.spec.period_s), 8 * d.lag.delay_s());
  t.begin = plain_time(5 * settle + 2 * start_time(d, t.first, K * t.load_A));
  // Limits may delay a step that the user chose. They also delay any step of a loop that is faster than the
  // torque allows.
  const double travel = travel_time(d, t.first, t.first + t.step, K * t.load_A);
  const double held_up = subject.step || travel > settle ? 2 * travel : 0.0;
  // The window at the end lasts at least an electrical turn, because a shorter window may contain no
  // commutation.
  const double slow = std::fabs(t.first + t.step) * d.motor.machine.pole_pairs;
  const double window = slow > 0.0 ? std::max(settle, 2 * base::pi / slow) : settle;
  t.end = plain_time(t.begin + 4 * settle + held_up + window);
  t.calm = t.end - window;
  return t;
}

/// True if the speed loop requests more than its torque limit at the step. It requests d1 times the step
/// immediately, in addition to the load's torque.
bool step_is_limited(const DriveDesign& d, const SpeedTest& t) {
  const double load = d.motor.K_t_Nm_A * t.load_A / d.torque_limit_Nm;
  return std::fabs(load + d.loop("speed").gains.d1 * t.step) > d.most_torque_Nm() / d.torque_limit_Nm;
}

void add_speed_figures(const DriveDesign& d, const SpeedTest& t, study::Scenario& s) {
  const design::StepResponse& linear = d.loop("speed").step;
  const double K = d.motor.K_t_Nm_A, R = 2 * d.motor.machine.R_ohm, last = t.first + t.step;
  const double within = design::settling_band(d);
  const auto of = [&](study::MetricKind kind, bool small, const char* label) {
    study::Measure m = small ? step_measure(kind, study::Signal::speed, t.begin, t.end, t.first, last, label)
                             : step_measure(kind, study::Signal::speed, 0, t.begin, 0, t.first, label);
    if (kind == study::MetricKind::settling_time) m.band = within;
    return m;
  };
  const std::string unlimited = step_is_limited(d, t) ? ", without limits" : "";
  s.compare = {
      {of(study::MetricKind::settling_time, true, "settling time"), linear.settling_s,
       (within == 0.02 ? "designed, 2 %" : "designed, 10 %") + unlimited},
      {of(study::MetricKind::overshoot, true, "overshoot"), linear.overshoot * std::fabs(t.step),
       "designed" + unlimited},
      {window_measure(study::MetricKind::peak_to_peak, study::Signal::speed, t.calm, t.end, "speed ripple"),
       0.0, "none wanted"},
      {window_measure(study::MetricKind::peak_to_peak, study::Signal::current, t.calm, t.end,
                      "swing of the current"),
       expected_ripple_A(d, s.bridge, t.load_A, K * last + R * t.load_A),
       "ripple of the PWM alone; simulated: also the drop of the measured current at each commutation"},
      {of(study::MetricKind::settling_time, false, settling_of_start), linear.settling_s,
       "as designed, without limits"},
      {of(study::MetricKind::overshoot, false, "overshoot of the start"), linear.overshoot * t.first,
       "as designed, without limits"},
      {window_measure(study::MetricKind::maximum, study::Signal::current_magnitude, 0, t.begin,
                      "peak current of the start"),
       d.most_current_A(), at_most_current(d) + "; simulated: largest phase current"},
      {window_measure(study::MetricKind::maximum, study::Signal::current_magnitude, t.begin, t.end,
                      "peak current of the step"),
       d.most_current_A(), at_most_current(d) + "; simulated: largest phase current, also while braking"},
  };
  const double band = within * std::fabs(t.step);
  s.require = {
      {window_measure(study::MetricKind::mean, study::Signal::speed, t.calm, t.end, "mean speed at the end"),
       last - band, last + band}};
}

void add_speed(const DriveDesign& d, const DesignSubject& subject, study::Scenario& s) {
  const SpeedTest t = speed_test(d, subject);
  s.title = d.nominal_printed ? "Speed cascade as designed, against half the torque of the nominal current"
                              : "Speed cascade as designed, against a twentieth of the stall torque";
  s.duration_s = t.end;
  s.load.torque_Nm = d.motor.K_t_Nm_A * t.load_A * s.load.gear;
  s.reference.shape = study::Shape::steps;
  s.reference.times_s = {0, t.begin};
  s.reference.values = {t.first, t.first + t.step};
  s.reference.unit.emplace(design::motion_of(d.motor).unit("rad/s").linear);
  add_speed_figures(d, t, s);
}

}  // namespace

bool samples_in_middle(const DesignSubject& subject) {
  if (subject.board && subject.board->pwm.sample == study::SampleAt::middle) return true;
  if (subject.currents) return *subject.currents == rig::CurrentMeasurement::dc_link;
  return subject.board && subject.board->sensors.currents == rig::CurrentMeasurement::dc_link;
}

void expect_step(const DriveDesign& design, study::Scenario& s) {
  const design::StepResponse& step = design.loop("current").step;
  // The setpoint steps at a period's start. The first sample after the step is in the middle of this period.
  const double first_s = design.spec.sampled_in_middle ? design.spec.period_s / 2 : 0.0;
  for (study::Comparison& c : s.compare) {
    if (c.measure.metric == study::MetricKind::settling_time) {
      c.value = first_s + step.settling_s;
      if (first_s > 0.0) c.source = "designed, and T_s/2 to the first sample, 2 %";
    }
    if (c.measure.metric == study::MetricKind::overshoot) {
      c.value = step.overshoot > 1e-9 ? step.overshoot * std::fabs(s.reference.value) : 0.0;
      if (s.bridge.dead_time_s > 0.0) c.source = "designed, at the samples, without dead time";
    }
  }
}

study::Scenario design_scenario(const DriveDesign& design, const DesignSubject& subject) {
  study::Scenario s = common(design, subject);
  if (design.spec.mode == Mode::current) add_current(design, subject, s);
  if (design.spec.mode == Mode::speed) add_speed(design, subject, s);
  if (design.spec.mode == Mode::position) add_position(design, subject, s);
  s.record.columns = {"i_m_A"};
  if (design.spec.mode != Mode::current) s.record.columns.push_back("speed_rad_s");
  if (design.spec.mode == Mode::position) s.record.columns.push_back("angle_rad");
  // Record some 2000 rows, at the instants of samples.
  const double periods = std::ceil(s.duration_s / 2000 / s.pwm.period_s);
  if (periods > 1) s.record.grid_s = periods * s.pwm.period_s;
  // For an unstable loop the design predicts no values; its comparisons are removed.
  std::erase_if(s.compare, [](const study::Comparison& c) { return !std::isfinite(c.value); });
  say_in_metres(s);
  return s;
}

double as_read(const study::ComparisonResult& c, const study::Scenario& scenario) {
  const double height = scenario.reference.value *
                        study::unit_in(scenario, study::reference_unit(scenario.control.mode)).factor;
  const bool rounding = c.value == 0.0 && std::fabs(c.measured) <= 1e-9 * std::fabs(height);
  return rounding ? 0.0 : c.measured;
}

}  // namespace sixstep::analysis
