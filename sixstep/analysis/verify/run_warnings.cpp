// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/run_warnings.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/verify/board.hpp"
#include "sixstep/analysis/verify/design_scenario.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::analysis {
namespace {

void warn(DesignStudy& s, design::Concern of, std::string what, bool grave) {
  s.warnings.push_back({.what = std::move(what), .cure = "", .grave = grave, .of = of});
}

/// Allowed error of a user's step, as a fraction of the step. With an integral part there is no error unless
/// a limit acts.
constexpr double missed_part = 0.02;

/// Warns of a setpoint that bus and load do not allow, or that is not reached by the end of the run.
void look_at_reach(DesignStudy& s) {
  const std::vector<double>& levels = s.scenario.reference.values;
  const study::ComparisonResult* swing = figure_of(s.outcome, "speed ripple");
  if (s.design.spec.mode != control::Mode::speed || s.outcome.verdicts.empty() || levels.size() < 2 || !swing)
    return;
  const double held = s.outcome.verdicts.front().measured, missed = std::fabs(levels[1] - held);
  if (!(missed > missed_part * std::fabs(levels[1] - levels[0])) || missed < swing->measured / 2) return;
  const std::string target = "the step's target of " + base::rounded(levels[1], 4) + " rad/s";
  const bool stands = swing->measured < missed;
  warn(s, design::Concern::reach,
       stands ? target + " is out of reach: with a load of " + base::three_digits(s.scenario.load.torque_Nm) +
                    " N m and a bus of " + base::three_digits(s.design.bus_V) + " V the speed stays at " +
                    base::rounded(held, 4) + " rad/s"
              : target + " is not reached by the end of the run: the speed is then about " +
                    base::rounded(held, 4) + " rad/s and still moves by " +
                    base::three_digits(swing->measured) + " rad/s",
       true);
}

bool out_of_reach(const DesignStudy& s) {
  return std::any_of(s.warnings.begin(), s.warnings.end(),
                     [](const design::Warning& w) { return w.of == design::Concern::reach; });
}

constexpr const char* within = "within the tolerances";

/// Text for the worst motor within the tolerances, and for the single tolerance with the largest effect.
std::string with_which(const RobustFigure& f) {
  const bool one = f.culprit.empty() || f.culprit == f.at;
  return ": with " + f.at + (one ? "" : ", mainly because of " + f.culprit);
}

/// True for a current loop with hard chopping: the mean voltage then drives the motor only above a duty of
/// one half.
bool from_half_the_bus(const DesignStudy& s) {
  return s.design.spec.mode == control::Mode::current && s.design.spec.chopping == control::Chopping::hard;
}

/// Names the chopping: it decides whether a small negative duty brakes with the duty's voltage or with the
/// whole bus.
std::string in_simulation(const DesignStudy& s) {
  return "in the simulation, with " +
         std::string(base::word(study::chopping_choices, s.design.spec.chopping)) + " chopping,";
}

/// Warns if a loop settles later than designed by a quarter, although no limit acts in its run.
void look_at_settling(DesignStudy& s) {
  const study::ComparisonResult* c = figure_of(s.outcome, "settling time");
  if (!c || s.design.spec.mode == control::Mode::position || out_of_reach(s)) return;
  if (drowned(s))
    warn(
        s, design::Concern::settling,
        "the speed ripple of the commutations, " +
            base::three_digits(figure_of(s.outcome, "speed ripple")->measured) +
            " rad/s, exceeds 2 % of the largest step at which no limit acts: the settling time cannot be measured",
        false);
  else if (!std::isfinite(c->measured))
    warn(s, design::Concern::settling, in_simulation(s) + " the loop never settles", true);
  else if (c->measured > 1.25 * c->value)
    warn(s, design::Concern::settling,
         "in the simulation the loop settles in " + base::three_digits(1e3 * c->measured) +
             " ms instead of the designed " + base::three_digits(1e3 * c->value) + " ms" +
             (from_half_the_bus(s) ? ": with hard chopping the integral must first reach half the bus voltage"
                                   : ""),
         false);
}

/// Warns of a limit cycle: a larger swing than the swing by the commutations.
void look_at_swing(DesignStudy& s) {
  const std::optional<double> allowed = s.allowed_swing_rad_s;
  const study::ComparisonResult* swing = figure_of(s.outcome, "speed ripple");
  if (!allowed || !swing || swing->measured <= *allowed) return;
  warn(s, design::Concern::swing,
       "in the simulation the speed swings by " + base::three_digits(swing->measured) +
           " rad/s without end; with ideal sensors the swing is " + base::three_digits(*s.ideal_swing_rad_s) +
           " rad/s",
       true);
}

/// A second-order loop overshoots by less than its step, whatever its damping. Warns of a larger overshoot:
/// such a loop is hardly stable.
void look_at_overshoot(DesignStudy& s, double overshoot, const std::string& when,
                       const std::string& where = "") {
  const std::vector<double>& levels = s.scenario.reference.values;
  if (s.design.spec.mode != control::Mode::speed || levels.size() < 2 || drowned(s)) return;
  const double step = std::fabs(levels[1] - levels[0]);
  if (!(overshoot > step)) return;
  warn(s, design::Concern::settling,
       when + " a step of the speed overshoots by " + base::three_digits(100 * overshoot / step) + " %" +
           where,
       true);
}

/// Warns of a position that does not come to rest. A drive with Hall probes may stop anywhere within some 60
/// electrical degrees.
void look_at_rest(DesignStudy& s, double swing, const std::string& when, const std::string& where = "") {
  const base::LinearUnit unit = design::motion_of(s.scenario.sheet).unit("deg");
  const double move = std::max(usual_move(s.design), unit.factor * std::fabs(s.scenario.reference.value));
  if (!(swing > move / 10)) return;
  const std::string in_unit = " " + std::string(unit.linear);
  warn(s, design::Concern::requirement,
       when + " the position swings around its target by " + base::three_digits(swing) + in_unit +
           ", more than a tenth of a move of " + base::rounded(move, 4) + in_unit + where,
       true);
}

void look_at_run(DesignStudy& s, bool asked_step) {
  if (s.outcome.fault)
    warn(s, design::Concern::fault, "a fault stopped the simulation: " + base::to_string(*s.outcome.fault),
         true);
  if (asked_step) look_at_reach(s);
  look_at_swing(s);
  look_at_settling(s);
  if (const study::ComparisonResult* start = figure_of(s.outcome, settling_of_start);
      start && !std::isfinite(start->measured) && s.usable())
    warn(s, design::Concern::settling, in_simulation(s) + " the start from rest never settles", true);
  if (const study::ComparisonResult* o = figure_of(s.outcome, "overshoot"))
    look_at_overshoot(s, o->measured, "in the simulation");
  if (const study::ComparisonResult* swing = figure_of(s.outcome, swing_at_target))
    look_at_rest(s, swing->measured, "in the simulation");
  for (const study::Verdict& v : s.outcome.verdicts)
    if (!v.ok && s.usable())  // otherwise another warning gives the reason
      warn(s, design::Concern::requirement,
           "in the simulation the " + v.figure + " is " + base::three_digits(v.measured) + " " + v.unit,
           true);
}

/// Warns of the move with the worst motor.
void look_at_worst_move(DesignStudy& s, const RobustFigure& f, const std::string& where) {
  if (s.design.spec.mode != control::Mode::position) return;
  const base::LinearUnit unit = design::motion_of(s.scenario.sheet).unit("deg");
  const double allowed = unit.factor * allowed_overshoot_deg(s.design, s.scenario.reference.value);
  if (f.figure == "overshoot" && f.worst > allowed)
    warn(s, design::Concern::requirement,
         std::string(within) + " the position overshoots by " + base::three_digits(f.worst) + " " +
             std::string(unit.linear) + where,
         true);
  if (f.figure == swing_at_target && s.usable()) look_at_rest(s, f.worst, within, where);
}

void look_at_worst(DesignStudy& s, const RobustFigure& f) {
  const std::string where = with_which(f);
  const std::optional<double> swing = s.allowed_swing_rad_s;
  const bool lost = std::isfinite(f.nominal) && !std::isfinite(f.worst);
  if (f.figure == "speed ripple" && swing && f.nominal <= *swing && f.worst > *swing)
    warn(s, design::Concern::swing,
         std::string(within) + " the speed swings by " + base::three_digits(f.worst) + " rad/s without end" +
             where,
         true);
  if (f.figure == "settling time" && !drowned(s) && lost)
    warn(s, design::Concern::settling, within + (" the loop never settles" + where), true);
  if (f.figure == settling_of_start && lost && s.usable())
    warn(s, design::Concern::settling, within + (" the start from rest never settles" + where), true);
  if (f.figure == "overshoot" && s.usable()) look_at_overshoot(s, f.worst, within, where);
  look_at_worst_move(s, f, where);
}

void look_at_tolerances(DesignStudy& s) {
  if (!s.robustness) return;
  for (const RobustFigure& f : s.robustness->figures) look_at_worst(s, f);
  for (const RobustFigure& f : s.robustness->phases)
    if (f.nominal > 0.0 && f.worst <= 0.0 && s.design.spec.delay_periods > 0)
      warn(s, design::Concern::settling,
           std::string(within) + " the " + f.figure.substr(f.figure.find(" of the ") + 8) + " is unstable" +
               with_which(f),
           true);
    else if (f.worst < 30.0 && f.nominal >= 30.0)
      warn(s, design::Concern::settling,
           std::string(within) + " the " + f.figure + " falls to " +
               base::three_digits(std::max(f.worst, 0.0)) + " degrees with " +
               design::periods_words(s.design.spec.later_periods()) + " of delay" + with_which(f),
           false);
}

}  // namespace

bool drowned(const DesignStudy& s) {
  if (!s.ideal_swing_rad_s || s.scenario.reference.values.size() < 2) return false;
  const std::vector<double>& levels = s.scenario.reference.values;
  return *s.ideal_swing_rad_s > 2 * design::settling_band(s.design) * std::fabs(levels[1] - levels[0]);
}

const study::ComparisonResult* figure_of(const study::Outcome& outcome, const std::string& figure) {
  for (const study::ComparisonResult& c : outcome.comparisons)
    if (c.figure == figure) return &c;
  return nullptr;
}

void add_run_warnings(DesignStudy& s, bool asked_step) {
  look_at_run(s, asked_step);
  look_at_tolerances(s);
  std::stable_partition(s.warnings.begin(), s.warnings.end(),
                        [](const design::Warning& w) { return w.grave; });
}

}  // namespace sixstep::analysis
