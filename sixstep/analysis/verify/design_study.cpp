// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/design_study.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/verify/advice.hpp"
#include "sixstep/analysis/verify/board.hpp"
#include "sixstep/analysis/verify/linear_study.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/run/keep_going.hpp"
#include "sixstep/study/run/run.hpp"

namespace sixstep::analysis {
namespace {

const study::ComparisonResult* find(const study::Outcome& outcome, const std::string& figure) {
  for (const study::ComparisonResult& c : outcome.comparisons)
    if (c.figure == figure) return &c;
  return nullptr;
}

void warn(DesignStudy& s, design::Concern of, std::string what, bool grave) {
  s.warnings.push_back({.what = std::move(what), .cure = "", .grave = grave, .of = of});
}

/// The torque ripple of the commutations can be wider than the band of a small step: then settling times say
/// nothing.
bool drowned(const DesignStudy& s) {
  if (!s.ideal_swing_rad_s || s.scenario.reference.values.size() < 2) return false;
  const std::vector<double>& levels = s.scenario.reference.values;
  return *s.ideal_swing_rad_s > 2 * design::settling_band(s.design) * std::fabs(levels[1] - levels[0]);
}

/// Where to look out of tolerance.
std::string chiefly(const RobustFigure& f) { return f.culprit.empty() ? "" : ", chiefly for " + f.culprit; }

/// At a duty below a half hard chopping has no mean voltage that drives.
bool from_half_the_bus(const DesignStudy& s) {
  return s.design.spec.mode == control::Mode::current && s.design.spec.chopping == control::Chopping::hard;
}

/// A loop at whose limits the run was not to come must settle as designed; a quarter more is told.
void look_at_settling(DesignStudy& s) {
  const study::ComparisonResult* c = find(s.outcome, "settling time");
  if (!c || s.design.spec.mode == control::Mode::position) return;
  if (drowned(s))
    warn(
        s, design::Concern::settling,
        "the commutations' ripple in speed, " +
            base::three_digits(find(s.outcome, "speed ripple")->measured) +
            " rad/s, is wider than 2 % of the largest step at which no limit acts: its settling time says nothing",
        false);
  else if (!std::isfinite(c->measured))
    warn(s, design::Concern::settling, "in the simulation it never settles", true);
  else if (c->measured > 1.25 * c->value)
    warn(s, design::Concern::settling,
         "in the simulation it settles in " + base::three_digits(1e3 * c->measured) + " ms, designed were " +
             base::three_digits(1e3 * c->value) + " ms" +
             (from_half_the_bus(s)
                  ? ": from rest the integral has to reach half the bus before hard chopping drives"
                  : ""),
         false);
}

/// A limit cycle swings further than the commutations do.
void look_at_swing(DesignStudy& s) {
  const std::optional<double> allowed = s.allowed_swing_rad_s;
  const study::ComparisonResult* swing = find(s.outcome, "speed ripple");
  if (!allowed || !swing || swing->measured <= *allowed) return;
  warn(s, design::Concern::swing,
       "in the simulation the speed swings by " + base::three_digits(swing->measured) +
           " rad/s without end; with ideal sensors by " + base::three_digits(*s.ideal_swing_rad_s) + " rad/s",
       true);
}

void look_at_run(DesignStudy& s) {
  if (s.outcome.fault)
    warn(s, design::Concern::fault, "a fault stopped the simulation: " + base::to_string(*s.outcome.fault),
         true);
  look_at_swing(s);
  look_at_settling(s);
  for (const study::Verdict& v : s.outcome.verdicts)
    if (!v.ok && s.usable())  // else the reason is told
      warn(s, design::Concern::requirement,
           "in the simulation the " + v.figure + " is " + base::three_digits(v.measured) + " " + v.unit,
           true);
}

void look_at_tolerances(DesignStudy& s) {
  if (!s.robustness) return;
  const std::optional<double> swing = s.allowed_swing_rad_s;
  for (const RobustFigure& f : s.robustness->figures) {
    if (f.figure == "speed ripple" && swing && f.nominal <= *swing && f.worst > *swing)
      warn(s, design::Concern::swing,
           "out of tolerance the speed swings by " + base::three_digits(f.worst) +
               " rad/s without end: " + f.at + chiefly(f),
           true);
    if (f.figure == "settling time" && !drowned(s) && std::isfinite(f.nominal) && !std::isfinite(f.worst))
      warn(s, design::Concern::settling, "out of tolerance it never settles: " + f.at + chiefly(f), true);
    const bool position = s.design.spec.mode == control::Mode::position;
    const base::LinearUnit unit = design::motion_of(s.scenario.sheet).unit("deg");
    if (position && f.figure == "overshoot" &&
        f.worst > unit.factor * allowed_overshoot_deg(s.design, s.scenario.reference.value))
      warn(s, design::Concern::requirement,
           "out of tolerance it overshoots by " + base::three_digits(f.worst) + " " +
               std::string(unit.linear) + ": " + f.at + chiefly(f),
           true);
  }
  for (const RobustFigure& f : s.robustness->phases)
    if (f.worst < 30.0 && f.nominal >= 30.0)
      warn(s, design::Concern::settling,
           "out of tolerance the " + f.figure + " falls to " + base::three_digits(std::max(f.worst, 0.0)) +
               " degrees with one period of delay: " + f.at + chiefly(f),
           false);
}

/// Some seconds of computing for a run; a slower drive is to be looked at by hand.
constexpr double most_periods = 2e6;

base::Problems too_long(const study::Scenario& s) {
  if (s.duration_s / s.pwm.period_s <= most_periods) return {};
  return {{"the test", base::three_digits(s.duration_s) + " s",
           "is longer than two million control periods, so slow is the drive beside them",
           "give a shorter settle_s, a smaller step or more torque_limit_Nm, or a longer period_s"}};
}

/// Position: the gain, and the design that has it.
base::Problems find_gain(const DesignOrder& order, DesignStudy& s) {
  if (!(s.design.loop("position").gains.d1 > 0.0))
    return {{"mode", "position", "finds no gain that does not overshoot: the speed loop within is unstable",
             "design the speed loop slower (settle_s) or the current loop faster (current_settle_s, "
             "bandwidth_rad_s)"}};
  if (base::Problems found = too_long(design_scenario(s.design, order.subject)); !found.empty()) return found;
  base::Result<PositionGain> gain =
      largest_position_gain(s.design, order.subject, order.keep_going, order.gain, order.budget);
  if (gain && !order.tolerances.empty())
    gain = lowered_for_tolerances(s.design, order.subject, *gain, order.tolerances, order.for_each,
                                  order.keep_going, order.gain, order.budget);
  if (!gain) return gain.problems();
  s.position = *gain;
  s.design = design::with_position_gain(s.design, gain->gain_rad_s_per_deg);
  return {};
}

/// What the commutations alone make of the speed: the run once more with ideal sensors, where it had others.
std::optional<double> ideal_swing(const DesignStudy& s, const std::function<bool()>& keep_going) {
  const study::ComparisonResult* swing = find(s.outcome, "speed ripple");
  if (!swing) return std::nullopt;
  if (s.scenario.sensors.rotor == study::RotorSensing::ideal) return swing->measured;
  const base::Result<study::Outcome> ideal = study::run(
      with_ideal_sensors(s.scenario),
      {.on_record = {}, .on_event = {}, .keep_going = study::listening(keep_going), .keep_books = false});
  if (!ideal) return std::nullopt;
  const study::ComparisonResult* found = find(*ideal, "speed ripple");
  return found ? std::optional(found->measured) : std::nullopt;
}

/// The board's own scenario says what its sensorless drive comes to.
base::Result<std::vector<design::DerivationStep>> sensorless_steps(const DesignSubject& subject) {
  if (!subject.board || subject.board->control.drive != study::FirmwareKind::sensorless)
    return std::vector<design::DerivationStep>();
  study::Scenario s = *subject.board;
  s.motor = subject.motor;
  s.sheet = subject.sheet;
  if (base::Problems found = study::check(s); !found.empty()) return found;
  const base::Result<study::Compiled> compiled = study::compile(s);
  if (!compiled) return compiled.problems();
  return compiled->sensorless_steps;
}

/// As of a turning motor, but for the numbers of the outcome: those are told in the units of its kind.
base::Result<DesignStudy> studied(const DesignOrder& order) {
  const std::optional<double>& step = order.subject.step;
  if (step && !(std::isfinite(*step) && *step != 0.0))
    return base::Problem{"step", base::three_digits(*step), "must be a number other than 0",
                         "give it in A, rad/s or deg as the mode asks"};
  const base::Result<design::MotorModel> motor = design::motor_model(order.subject.sheet);
  if (!motor) return motor.problems();
  base::Result<design::DriveDesign> design = design::design_drive(*motor, order.spec);
  if (!design) return design.problems();
  DesignStudy s;
  s.design = std::move(*design);
  if (order.spec.mode == control::Mode::position)
    if (base::Problems found = find_gain(order, s); !found.empty()) return found;
  base::Result<std::vector<design::DerivationStep>> sensorless = sensorless_steps(order.subject);
  if (!sensorless) return sensorless.problems();
  s.sensorless = std::move(*sensorless);
  s.scenario = design_scenario(s.design, order.subject);
  if (base::Problems found = too_long(s.scenario); !found.empty()) return found;
  if (base::Problems found = study::check(s.scenario); !found.empty()) {
    for (base::Problem& p : found)  // the spec's, not the scenario's that was made of it
      if (p.where == "supply.voltage_V") p.where = "voltage_V";
    return found;
  }
  base::Result<std::vector<study::Column>> columns = record_columns(s.scenario);
  if (!columns) return columns.problems();
  s.trace = {*columns, std::vector<std::vector<double>>(columns->size()), false};
  const auto record = [&](study::Row row) {
    for (std::size_t n = 0; n < row.size(); ++n) s.trace.values[n].push_back(row[n]);
  };
  base::Result<study::Outcome> outcome =
      study::run(s.scenario, {.on_record = record,
                              .on_event = {},
                              .keep_going = study::listening(order.keep_going),
                              .keep_books = true});
  if (!outcome) return outcome.problems();
  s.outcome = std::move(*outcome);
  // A gain that was lowered until all motors hold says no less.
  if (!order.tolerances.empty() && !(s.position && order.gain.quick))
    s.robustness = robustness(s.design, s.scenario, order.tolerances, order.for_each, order.keep_going);
  s.ideal_swing_rad_s = ideal_swing(s, order.keep_going);
  if (order.budget != nullptr) order.budget->takes(s.scenario, 2 + (s.robustness ? s.robustness->runs : 0));
  if (s.ideal_swing_rad_s && s.scenario.reference.values.size() > 1)
    s.allowed_swing_rad_s = allowed_swing_rad_s(*s.ideal_swing_rad_s, s.scenario.reference.values[1]);
  s.warnings = s.design.warnings;
  look_at_run(s);
  look_at_tolerances(s);
  std::stable_partition(s.warnings.begin(), s.warnings.end(),
                        [](const design::Warning& w) { return w.grave; });
  return s;
}

}  // namespace

bool DesignStudy::usable() const {
  return std::none_of(warnings.begin(), warnings.end(), [](const design::Warning& w) { return w.grave; });
}

base::Result<DesignStudy> study_design(const DesignOrder& order) {
  base::Result<DesignStudy> s = studied(order);
  const bool linear = order.subject.sheet.kind == design::MotorKind::linear;
  if (!s) {
    base::Problems problems = s.problems();
    if (order.advises) advise(order, problems);
    return linear ? told_in_metres(std::move(problems)) : problems;
  }
  if (order.advises) advise(order, *s);
  tell_in_metres(*s);
  return s;
}

}  // namespace sixstep::analysis
