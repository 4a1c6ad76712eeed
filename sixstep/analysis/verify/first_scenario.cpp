// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/first_scenario.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/verify/advice.hpp"
#include "sixstep/analysis/verify/design_changes.hpp"
#include "sixstep/analysis/verify/design_study.hpp"
#include "sixstep/analysis/verify/few_digits.hpp"
#include "sixstep/analysis/verify/linear_study.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/range_text.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/design_warnings.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/measure/figures.hpp"
#include "sixstep/study/run/run.hpp"

namespace sixstep::analysis {
namespace {

using control::Mode;

/// Tolerance of the straight line that predicts the speed. The line neglects commutation time and PWM ripple,
/// which change the speed by some per cent. A run with a different duty does not meet the requirement.
constexpr double line_tolerance = 0.05;

constexpr double longest_run_up_s = 600;

/// Largest number of control periods of a trial, and of all trials together: half a second, and one and a
/// half seconds, of one core. If no trial succeeded, a last round of five seconds follows.
constexpr double trial_periods = 3.5e5, all_trials_periods = 1.2e6, last_trial_periods = 4e6;

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
  // The commutation acts like a three-phase rectifier: the voltage falls by 3/pi w_el L_s per ampere, with
  // the electrical speed w_el at the end of the run-up and the phase inductance L_s. For a motor with many
  // pole pairs this exceeds R.
  const auto line = [&](double duty, double ohm) {
    return (K * duty * U / ohm - motor.shaft.coulomb_Nm) / (K * K / ohm + motor.shaft.B_Nm_s);
  };
  // During the dead time the current continues through a diode. If the current keeps its sign, the duty is
  // reduced by the dead time's fraction of the period. If the current changes its sign in every period, the
  // duty is not reduced.
  const double speed = line(d, R),
               commutating = R + 3 / base::pi * motor.machine.pole_pairs * speed * motor.machine.L_H;
  const double least = line(d - usual_dead_time_s / s.pwm.period_s, commutating);
  if (!(least > 0.0))
    return base::Problem{"voltage_V", "", "is too low: at a duty of 1/2 friction holds the rotor",
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
  const double tau = motor.shaft.J_kg_m2 / (K * K / commutating + motor.shaft.B_Nm_s);
  if (!(10 * tau < longest_run_up_s))
    return base::Problem{"the motor", spec.motor,
                         "takes " + base::rounded(10 * tau, 3) + " s to run up, more than the allowed 600 s",
                         "correct the unit of inertia or torque constant in the motor file"};
  s.duration_s = std::ceil(10 * tau * 1e3) / 1e3;  // when the window begins, exp(-9) of the change remains
  const double calm = 0.9 * s.duration_s;
  const study::Measure mean =
      measure(study::MetricKind::mean, study::Signal::speed, calm, "speed at the end");
  s.require = {{mean, (1 - line_tolerance) * least, (1 + line_tolerance) * speed}};
  s.compare = {{mean, speed, "straight line of the sheet, with its friction"},
               {measure(study::MetricKind::maximum, study::Signal::current, 0, "peak current of the start"),
                d * U / R, "half the voltage divided by the winding's resistance"}};
  return s;
}

DesignOrder order_of(const FirstScenarioSpec& spec) {
  DesignOrder order{.subject = {.motor = spec.motor, .sheet = spec.sheet, .dead_time_s = usual_dead_time_s},
                    .spec = design::on_a_board(),
                    .tolerances = sheet_tolerances(spec.sheet, spec.mode),
                    .for_each = spec.for_each,
                    .gain = {.quick = true, .longest_periods = 2e5, .periods = trial_periods},
                    .advises = false};
  order.spec.mode = spec.mode;
  order.spec.voltage_V = spec.voltage_V;
  return order;
}

/// Largest mechanical angle between Hall edges for a position drive. With larger steps the rotor stops tens
/// of degrees from its setpoint.
constexpr double coarsest_step_deg = 20.0;

/// Specifications to try, in this order: the usual design, then changes for motors for which the usual design
/// is unsuitable.
std::vector<design::DesignSpec> candidates(const DesignOrder& order, const design::DriveDesign& usual) {
  std::vector<design::DesignSpec> all;
  if (usual.ripple.worst_A < usable_ripple * usual.nominal_current_A) all.push_back(order.spec);
  for (const design::DesignSpec& spec : joint_changes(order, usual)) all.push_back(spec);
  const double hall_step_deg = 60.0 / usual.motor.machine.pole_pairs;
  const bool coarse = usual.motor.kind == design::MotorKind::rotary && hall_step_deg > coarsest_step_deg;
  if (order.spec.mode == Mode::position && coarse)
    std::erase_if(all, [](const design::DesignSpec& s) { return s.rotor.hall; });
  return all;
}

/// The two tolerances with the largest effect: inductance, because a winding saturates, and inertia, because
/// the load is unknown.
std::vector<Tolerance> chief(std::vector<Tolerance> tolerances) {
  std::erase_if(tolerances, [](const Tolerance& t) {
    return t.quantity != Strays::inductance && t.quantity != Strays::inertia;
  });
  return tolerances;
}

/// Reduces the number of periods of a trial to `longest`. The means are a higher lowest speed, whose loop is
/// faster; fewer motors within the tolerances; a shorter move; or a longer period. The design in closed form
/// takes a tenth of a second for each specification.
bool shorten_trial(DesignOrder& order, const design::MotorModel& motor, double longest) {
  base::Result<design::DriveDesign> d = design::design_drive(motor, order.spec);
  const auto fits = [&] { return d && periods_of(order, *d) <= longest; };
  if (!d || fits()) return static_cast<bool>(d);
  const double lowest = d->lowest_speed_rad_s;
  if (order.spec.mode == Mode::speed && order.spec.rotor.lags() && !order.spec.lowest_speed_rad_s)
    for (const double times : {2.0, 3.0}) {
      order.spec.lowest_speed_rad_s = base::shortened(times * lowest, 2, base::Towards::up);
      d = design::design_drive(motor, order.spec);
      if (fits()) return true;
    }
  if (!d) return false;
  order.tolerances = chief(order.tolerances);
  if (fits()) return true;
  order.tolerances.clear();
  if (fits()) return true;
  if (order.spec.mode == Mode::position && d->motor.kind == design::MotorKind::rotary)
    for (const double step_deg : {300.0, 100.0}) {
      order.subject.step = step_deg;
      if (fits()) return true;
    }
  const double ripple_A = usable_ripple * d->nominal_current_A;
  if (period_for_ripple_s(d->motor, d->bus_V, order.spec.chopping, ripple_A) < unhurried_period_s)
    return false;
  order.spec = unhurried(order.spec, motor);
  d = design::design_drive(motor, order.spec);
  return fits();
}

bool runs_and_passes(const study::Scenario& s) {
  const base::Result<study::Outcome> outcome = study::run(s);
  return outcome && outcome->passed() && !outcome->fault;
}

/// Text that offers an alternative if this mode has no usable design: a bus that drives the nominal current,
/// or a run without a loop.
std::string way_out(const FirstScenarioSpec& spec, const design::MotorModel& motor,
                    const design::DriveDesign& usual) {
  std::string more = "a design of the motor shows the cause";
  DesignOrder order = order_of(spec);
  order.tolerances.clear();
  TrialBudget budget{trial_periods};
  for (const design::DesignSpec& candidate : single_changes(order, usual)) {
    if (candidate.voltage_V == order.spec.voltage_V) continue;
    const std::optional<DesignStudy> study = tried(order, candidate, budget);
    if (study && study->usable())
      return "give a higher bus voltage, " + words_of_change(order.spec, candidate) + "; " + more;
  }
  base::Result<study::Scenario> open = run_up(spec, motor);
  if (open && runs_and_passes(*open)) return "start with mode = duty; " + more;
  return more;
}

/// Predicts the step for the same gains with samples in the middle of a period, by the linear loop with half
/// a period more delay. Returns false if this loop is not usable.
bool foretell_in_middle(design::DesignSpec spec, study::Scenario& s) {
  spec.sampled_in_middle = true;
  const base::Result<design::MotorModel> motor = design::motor_model(s.sheet);
  if (!motor) return false;
  const base::Result<design::DriveDesign> late = design::design_drive(*motor, spec);
  if (!late) return false;
  expect_step(*late, s);
  return std::none_of(late->warnings.begin(), late->warnings.end(),
                      [](const design::Warning& w) { return w.grave; });
}

/// Sets the upper limit of the mean of the whole signal. The samples are at the ripple's lowest point, so
/// that the limit is half of the ripple above them. The ripple is computed at the duty of the held rotor. If
/// the run exceeds this limit, it is computed at the worst duty.
void judge_above_the_samples(study::Scenario& s, const DesignStudy& study) {
  s.notes =
      "The current is sampled at the start of each period, where the ripple is lowest. With samples in the middle of centred pulses the answer comes half a period later, and this drive does not meet its requirements. Therefore the upper limit of the mean includes half of the ripple.";
  study::Requirement& mean = s.require.front();
  mean.measure.sampled = false;
  mean.measure.label = "mean of the last ten periods, upper limit with half the ripple";
  if (!mean.max) return;
  const design::DriveDesign& d = study.design;
  const double held_V = 2 * d.motor.machine.R_ohm * std::fabs(s.reference.value),
               duty = design::duty_for_voltage(s.pwm.chopping, held_V / s.supply.voltage_V);
  const double samples_most = *mean.max,
               here_A = design::current_ripple_A(d.motor, s.supply.voltage_V, s.pwm.period_s, s.pwm.chopping,
                                                 duty);
  *mean.max = samples_most + std::min(here_A, d.ripple.worst_A) / 2;
  if (!runs_and_passes(s)) *mean.max = samples_most + d.ripple.worst_A / 2;
}

/// Sets the requirement on the mean current. The controller's samples are at the lowest point of the ripple,
/// and the controller controls their mean. Samples in the middle of a centred pulse equal the mean of the
/// signal, but the output then acts half a period later; this sampling is therefore kept only if the run
/// passes. If a pulse begins a dead time late, its middle is half a dead time late. The sample is then below
/// the mean by the current's rise in this time; for a winding of small inductance the difference exceeds the
/// requirement's band.
void judge_the_mean(study::Scenario& s, const DesignStudy& study) {
  study::Scenario middle = s;
  const bool stands = foretell_in_middle(study.design.spec, middle);
  middle.pwm.alignment = study::Alignment::centre;
  middle.pwm.sample = study::SampleAt::middle;
  middle.require.front().measure.sampled = false;
  middle.require.front().measure.label = "mean of the last ten periods";
  if (stands && runs_and_passes(middle)) {
    s = middle;
    return;
  }
  study::Requirement& mean = middle.require.front();
  mean.measure.label = "mean of the last ten periods, dead time included";
  if (mean.max)
    *mean.max += s.bridge.dead_time_s / 2 * s.supply.voltage_V / (2 * study.design.motor.machine.L_H);
  if (stands && runs_and_passes(middle)) {
    s = middle;
    return;
  }
  judge_above_the_samples(s, study);
}

/// The design's test as a scenario for the user.
study::Scenario own_scenario(const FirstScenarioSpec& spec, const DesignStudy& study) {
  study::Scenario s = study.scenario;
  s.record = {};  // the user's run records everything
  s.compare.resize(std::min<std::size_t>(s.compare.size(), 2));
  if (spec.mode == Mode::current) judge_the_mean(s, study);
  require_swing(study, s);
  write_in_few_digits(s);
  return s;
}

/// A design that is usable with a board's sensors and over the sheet's tolerances, as far as a short trial
/// can show.
base::Result<study::Scenario> usable_design(const FirstScenarioSpec& spec, const design::MotorModel& motor) {
  const DesignOrder order = order_of(spec);
  const base::Result<design::DriveDesign> usual = design::design_drive(motor, order.spec);
  if (!usual) return usual.problems();
  std::string why;
  for (const design::Warning& w : usual->warnings)
    if (w.grave) why = w.what;
  // The longest trial is for slow motors for which no shorter trial succeeded.
  for (const double longest : {trial_periods, all_trials_periods, last_trial_periods}) {
    TrialBudget budget{std::max(longest, all_trials_periods)};
    for (const design::DesignSpec& candidate : candidates(order, *usual)) {
      DesignOrder next = order;
      next.spec = candidate;
      next.gain.periods = longest;
      next.gain.longest_periods = std::max(next.gain.longest_periods, longest / 2);
      if (longest == last_trial_periods) next.tolerances.clear();
      if (!shorten_trial(next, motor, longest)) continue;
      std::optional<DesignStudy> study = tried(next, next.spec, budget);
      if (!study) continue;
      if (study->usable() && study->outcome.passed()) {
        study::Scenario s = own_scenario(spec, *study);
        if (runs_and_passes(s)) return s;
        why = "with the values rounded for a file, the run does not meet its requirements";
      }
      for (const design::Warning& w : study->warnings)
        if (w.grave) why = w.what;
    }
  }
  return base::Problem{"the motor", spec.motor,
                       "has no usable design in this mode" + (why.empty() ? "" : ": " + why),
                       way_out(spec, motor, *usual)};
}

base::Result<study::Scenario> begun(const FirstScenarioSpec& spec) {
  const base::Result<design::MotorModel> motor = design::motor_model(spec.sheet);
  if (!motor) return motor.problems();
  if (spec.voltage_V)
    if (base::Problems out = base::out_of_range("voltage_V", *spec.voltage_V, base::above(0), "V",
                                                "give the bus voltage in volts");
        !out.empty())
      return out;
  base::Result<study::Scenario> s =
      spec.mode == Mode::duty ? run_up(spec, *motor) : usable_design(spec, *motor);
  if (!s) return s.problems();
  if (spec.mode == Mode::duty) write_in_few_digits(*s);
  const base::Result<study::Outcome> outcome = study::run(*s);
  if (!outcome) return outcome.problems();
  if (outcome->fault)
    return base::Problem{"the motor", spec.motor,
                         "is stopped by a fault: " + base::to_string(*outcome->fault),
                         "start with another mode"};
  for (const study::Verdict& v : outcome->verdicts)
    if (!v.ok)
      return base::Problem{"the motor", spec.motor,
                           "does not run as its sheet predicts: the " + v.figure + " is " +
                               base::three_digits(v.measured) + " " + v.unit,
                           "start with another mode, or compare with the torque-speed curve of the motor"};
  return s;
}

}  // namespace

base::Result<study::Scenario> first_scenario(const FirstScenarioSpec& spec) {
  base::Result<study::Scenario> s = begun(spec);
  if (s || spec.sheet.kind == design::MotorKind::rotary) return s;
  return told_in_metres(s.problems());
}

}  // namespace sixstep::analysis
