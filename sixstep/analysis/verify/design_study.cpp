// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/design_study.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/verify/advice.hpp"
#include "sixstep/analysis/verify/blind_shunt.hpp"
#include "sixstep/analysis/verify/board.hpp"
#include "sixstep/analysis/verify/high_speed.hpp"
#include "sixstep/analysis/verify/linear_study.hpp"
#include "sixstep/analysis/verify/run_warnings.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/run/belief_costs.hpp"
#include "sixstep/study/run/keep_going.hpp"
#include "sixstep/study/run/run.hpp"

namespace sixstep::analysis {
namespace {

/// Largest number of control periods of a run: some seconds of computing.
constexpr double most_periods = 2e6;

base::Problems too_long(const study::Scenario& s) {
  if (s.duration_s / s.pwm.period_s <= most_periods) return {};
  return {{"the test", base::three_digits(s.duration_s) + " s",
           "is longer than two million control periods: the drive is too slow for this period",
           "raise torque_limit_Nm or lowest_speed_rad_s, or lengthen period_s"}};
}

/// Finds a position's gain, and writes it into the design.
base::Problems find_gain(const DesignOrder& order, DesignStudy& s) {
  if (!(s.design.loop("position").gains.d1 > 0.0))
    return {{"mode", "position", "has no gain without overshoot: the inner speed loop is unstable",
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

/// Swing of the speed that only the commutations cause. It is measured in a second run with ideal sensors,
/// unless the first run had ideal sensors.
std::optional<double> ideal_swing(const DesignStudy& s, const std::function<bool()>& keep_going) {
  const study::ComparisonResult* swing = figure_of(s.outcome, "speed ripple");
  if (!swing) return std::nullopt;
  if (s.scenario.sensors.rotor == study::RotorSensing::ideal) return swing->measured;
  const base::Result<study::Outcome> ideal = study::run(
      with_ideal_sensors(s.scenario),
      {.on_record = {}, .on_event = {}, .keep_going = study::listening(keep_going), .keep_books = false});
  if (!ideal) return std::nullopt;
  const study::ComparisonResult* found = figure_of(*ideal, "speed ripple");
  return found ? std::optional(found->measured) : std::nullopt;
}

/// Derivation of the sensorless drive in the board's own scenario; empty if the board's drive is not
/// sensorless.
base::Result<std::vector<design::DerivationStep>> sensorless_steps(const DesignSubject& subject) {
  if (!subject.board || subject.board->control.drive != study::FirmwareKind::sensorless)
    return std::vector<design::DerivationStep>();
  study::Scenario s = *subject.board;
  s.motor = subject.motor;
  s.sheet = subject.sheet;
  s.believed = subject.believed();
  if (base::Problems found = study::check(s); !found.empty()) return found;
  const base::Result<study::Compiled> compiled = study::compile(s);
  if (!compiled) return compiled.problems();
  return compiled->sensorless_steps;
}

/// Warns of edge-aligned pulses with samples in the middle of a period. In the linear loop the voltage is
/// constant over a period, and a sample in the middle measures the effect of its first half. A pulse that
/// begins with the period, however, is measured as a whole, or without its end.
void look_at_pulses(DesignStudy& s) {
  if (!s.design.spec.sampled_in_middle || s.scenario.pwm.alignment != study::Alignment::edge) return;
  const double sooner = s.design.spec.late_periods() - 0.5;
  s.warnings.push_back(
      {.what =
           "with edge-aligned pulses the duty decides whether a sample in the middle comes before or after "
           "the pulse's end: the loop is " +
           design::late_words(sooner) + " at duties below a half, and " + design::late_words(sooner + 1) +
           " above",
       .cure = "set pwm.alignment = \"centre\", for which the loop is designed",
       .of = design::Concern::delay});
}

/// The study with the terms of a rotary motor; only the outcome's numbers are in the units of the motor's
/// kind.
base::Result<DesignStudy> studied(const DesignOrder& order) {
  const std::optional<double>& step = order.subject.step;
  if (step && !(std::isfinite(*step) && *step != 0.0))
    return base::Problem{"step", base::three_digits(*step), "must be a number other than 0",
                         "give this value in A, rad/s or deg according to the mode"};
  const base::Result<design::MotorModel> motor = design::motor_model(order.subject.believed_sheet());
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
    for (base::Problem& p : found)  // names the member of the spec, not the scenario's key
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
  if (const auto compiled = study::compile(s.scenario))
    for (study::BeliefCost& cost : study::belief_costs(s.scenario, *compiled))
      s.beliefs.push_back(std::move(cost.text));
  // A quick search has already lowered the gain until it holds for all motors within the tolerances.
  if (!order.tolerances.empty() && !(s.position && order.gain.quick))
    s.robustness = robustness(s.design, s.scenario, order.tolerances, order.for_each, order.keep_going);
  s.ideal_swing_rad_s = ideal_swing(s, order.keep_going);
  if (order.budget != nullptr) order.budget->takes(s.scenario, 2 + (s.robustness ? s.robustness->runs : 0));
  if (s.ideal_swing_rad_s && s.scenario.reference.values.size() > 1)
    s.allowed_swing_rad_s = allowed_swing_rad_s(*s.ideal_swing_rad_s, s.scenario.reference.values[1]);
  s.warnings = s.design.warnings;
  look_at_pulses(s);
  look_at_high_speed(order, s);
  look_at_blind_shunt(order, s);
  add_run_warnings(s, order.subject.step.has_value());
  return s;
}

/// Swing in rad/s that displaced Hall edges may cause at this speed, if the loop follows the measured speed:
/// neighbouring edges are displaced by 3 deg in opposite directions.
double swing_by_edges_rad_s(const design::DriveDesign& d, double speed_rad_s) {
  if (!d.spec.rotor.hall) return 0.0;
  design::RotorSensing placed = d.spec.rotor;
  placed.stray_rad = std::max(placed.stray_rad, 2 * mounted_hall_edge_deg * base::pi / 180);
  return design::speed_step_rad_s(
      placed, d.motor.machine.pole_pairs, std::fabs(speed_rad_s),
      design::speed_crossover_rad_s(d.loops[1].gains.d1, d.torque_limit_Nm / d.motor.shaft.J_kg_m2));
}

}  // namespace

std::string found_against(const DesignStudy& s) {
  for (const design::Warning& w : s.warnings)
    if (w.grave) return w.what;
  return {};
}

bool DesignStudy::usable() const {
  return std::none_of(warnings.begin(), warnings.end(), [](const design::Warning& w) { return w.grave; });
}

void require_swing(const DesignStudy& study, study::Scenario& s) {
  if (!study.allowed_swing_rad_s || s.require.empty()) return;
  study::Measure swing = s.require.front().measure;
  swing.metric = study::MetricKind::peak_to_peak;
  swing.label = "swing of the speed at the end";
  // A drive within the tolerances has displaced Hall edges and must meet the limit, too.
  const double by_edges = swing_by_edges_rad_s(study.design, s.reference.values.back());
  s.require.push_back({swing, std::nullopt, std::max(*study.allowed_swing_rad_s, by_edges)});
}

base::Result<DesignStudy> study_design(const DesignOrder& asked) {
  DesignOrder order = asked;
  order.spec.sampled_in_middle |= samples_in_middle(order.subject);
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
