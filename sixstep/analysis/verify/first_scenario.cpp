// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/first_scenario.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/verify/design_study.hpp"
#include "sixstep/analysis/verify/linear_study.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/range_text.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/measure/figures.hpp"
#include "sixstep/study/run/run.hpp"

namespace sixstep::analysis {
namespace {

using control::Mode;

/// What the straight line leaves out is commutation time and PWM ripple: some percent. Who starts with
/// another duty sees the requirement fail.
constexpr double line_tolerance = 0.05;
/// What gate drivers of small bridges ask for.
constexpr double usual_dead_time_s = 0.5e-6;

constexpr double longest_run_up_s = 600;

study::Measure measure(study::MetricKind metric, study::Signal signal, double from_s, const char* label) {
  study::Measure m;
  m.metric = metric;
  m.signal = signal;
  m.from_s = from_s;
  m.label = label;
  return m;
}

base::Result<study::Scenario> run_up(const FirstScenarioSpec& spec, const design::MotorModel& motor) {
  const double U = spec.voltage_V.value_or(motor.nominal_voltage_V);
  if (!(U > 0.0))
    return base::Problem{"voltage_V", "", "is missing, and the motor's sheet has no nominal voltage",
                         "give the bus voltage in V"};
  const double K = motor.K_t_Nm_A, R = 2 * motor.machine.R_ohm, d = 0.5;
  study::Scenario s;
  const double slope = K * K / R + motor.shaft.B_Nm_s;
  const auto line = [&](double duty) { return (K * duty * U / R - motor.shaft.coulomb_Nm) / slope; };
  // While a switch waits the current flows on through a diode: that much of the duty is lost where the
  // current keeps its sign, and nothing where it changes it in every period.
  const double speed = line(d), least = line(d - usual_dead_time_s / s.pwm.period_s);
  if (!(least > 0.0))
    return base::Problem{"voltage_V", "", "does not turn the rotor: friction holds it at half the voltage",
                         "give a higher bus voltage in V"};
  s.motor = spec.motor;
  s.sheet = spec.sheet;
  s.title = "Run-up at half the voltage";
  s.supply.voltage_V = U;
  s.pwm.chopping = control::Chopping::complementary;
  s.pwm.delay_periods = 1;
  s.bridge.dead_time_s = usual_dead_time_s;
  s.control.mode = Mode::duty;
  s.reference.value = d;
  s.reference.unit.emplace("1");
  const double tau = motor.shaft.J_kg_m2 / slope;
  if (!(10 * tau < longest_run_up_s))
    return base::Problem{"the motor", spec.motor,
                         "takes " + base::rounded(10 * tau, 3) + " s to run up, and minutes to simulate it",
                         "look at the inertia and the torque constant of its sheet"};
  s.duration_s = std::ceil(10 * tau * 1e3) / 1e3;  // exp(-9) of the way is left where the window begins
  const double calm = 0.9 * s.duration_s;
  const study::Measure mean =
      measure(study::MetricKind::mean, study::Signal::speed, calm, "speed at the end");
  s.require = {{mean, (1 - line_tolerance) * least, (1 + line_tolerance) * speed}};
  s.compare = {{mean, speed, "straight line of the sheet, with its friction"},
               {measure(study::MetricKind::maximum, study::Signal::current, 0, "peak current of the start"),
                d * U / R, "half the voltage over the winding's resistance"}};
  return s;
}

/// On a board's sensors and over the sheet's tolerances: the settling time that the design chooses, then
/// slower ones.
base::Result<DesignStudy> usable_design(const FirstScenarioSpec& spec) {
  base::Problems told;
  std::optional<double> chosen_s;
  for (const double times : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    DesignOrder order{.subject = {.motor = spec.motor, .sheet = spec.sheet},
                      .spec = design::on_a_board(),
                      .tolerances = sheet_tolerances(spec.sheet, spec.mode),
                      .for_each = spec.for_each};
    order.spec.mode = spec.mode;
    order.spec.voltage_V = spec.voltage_V;
    if (chosen_s) order.spec.settle_s = times * *chosen_s;
    base::Result<DesignStudy> study = study_design(order);
    if (!chosen_s) chosen_s = study ? study->design.spec.settle_s : std::nullopt;
    if (!chosen_s) chosen_s = spec.mode == Mode::current ? 1e-3 : 10e-3;
    if (!study) {
      if (told.empty()) told = study.problems();
    } else if (study->usable() && study->outcome.passed()) {
      return study;
    }
  }
  if (told.empty())
    told.push_back({"the motor", spec.motor, "has no usable design with the usual settling times",
                    "a design of it tells why; or start with mode = duty"});
  return told;
}

/// Few digits as they are told: of a linear motor in mm for degrees.
double shortened(double x, double factor, int digits, base::Towards towards) {
  return base::shortened(x * factor, digits, towards) / factor;
}

/// Times move on together: their order stays, and so do windows that meet. What a window holds anyhow is left
/// out.
void shorten(study::Measure& m, double duration_s) {
  for (std::optional<double>* time : {&m.from_s, &m.to_s})
    if (*time) *time = base::shortened(**time, 3, base::Towards::up);
  if (m.from_s == 0.0) m.from_s.reset();
  if (m.to_s == duration_s) m.to_s.reset();
}

void shorten(study::Scenario& s) {
  s.duration_s = base::shortened(s.duration_s, 3, base::Towards::up);
  for (double& time : s.reference.times_s) time = base::shortened(time, 3, base::Towards::up);
  for (study::Requirement& r : s.require) {
    shorten(r.measure, s.duration_s);
    const double factor = unit_in(s, figure_unit(r.measure)).factor;
    if (r.min) r.min = shortened(*r.min, factor, 4, base::Towards::down);
    if (r.max) r.max = shortened(*r.max, factor, 4, base::Towards::up);
  }
  for (study::Comparison& c : s.compare) {
    shorten(c.measure, s.duration_s);
    c.value = shortened(c.value, unit_in(s, figure_unit(c.measure)).factor, 4, base::Towards::down);
  }
  s.load.torque_Nm = base::shortened(s.load.torque_Nm, 2, base::Towards::down);
  s.initial.angle_rad = base::shortened(s.initial.angle_rad, 4, base::Towards::down);
  if (std::optional<double>& limit = s.control.speed.torque_limit_Nm)
    limit = base::shortened(*limit, 3, base::Towards::down);
  if (s.control.mode != Mode::position) return;
  double& gain = s.control.position.gain_rad_s_per_deg;
  const double of_gain = design::motion_of(s.sheet).unit("rad/s/deg").factor;
  gain = shortened(gain, of_gain, 2, base::Towards::down);  // a lower one overshoots less
}

/// The design's test as a scenario of one's own.
base::Result<study::Scenario> designed(const FirstScenarioSpec& spec) {
  const base::Result<DesignStudy> study = usable_design(spec);
  if (!study) return study.problems();
  study::Scenario s = study->scenario;
  s.record = {};  // a reader wants to see everything
  s.compare.resize(std::min<std::size_t>(s.compare.size(), 2));
  // A loop too fast for its sensor swings without end, and its mean may be right all the same.
  if (const std::optional<double> allowed = study->allowed_swing_rad_s) {
    study::Measure swing = s.require.front().measure;
    swing.metric = study::MetricKind::peak_to_peak;
    swing.label = "swing of the speed at the end";
    s.require.push_back({swing, std::nullopt, *allowed});
  }
  return s;
}

base::Result<study::Scenario> begun(const FirstScenarioSpec& spec) {
  const base::Result<design::MotorModel> motor = design::motor_model(spec.sheet);
  if (!motor) return motor.problems();
  if (spec.voltage_V)
    if (base::Problems out = base::out_of_range("voltage_V", *spec.voltage_V, base::above(0), "V",
                                                "give the bus voltage in volts");
        !out.empty())
      return out;
  base::Result<study::Scenario> s = spec.mode == Mode::duty ? run_up(spec, *motor) : designed(spec);
  if (!s) return s.problems();
  shorten(*s);
  const base::Result<study::Outcome> outcome = study::run(*s);
  if (!outcome) return outcome.problems();
  if (!outcome->passed() || outcome->fault)
    return base::Problem{"the motor", spec.motor, "does not do what its sheet foretells",
                         "hold its sheet against itself; or start with another mode"};
  return s;
}

}  // namespace

base::Result<study::Scenario> first_scenario(const FirstScenarioSpec& spec) {
  base::Result<study::Scenario> s = begun(spec);
  if (s || spec.sheet.kind == design::MotorKind::rotary) return s;
  return told_in_metres(s.problems());
}

}  // namespace sixstep::analysis
