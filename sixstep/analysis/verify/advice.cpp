// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/advice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sixstep/analysis/verify/board.hpp"
#include "sixstep/analysis/verify/design_changes.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/design_warnings.hpp"

namespace sixstep::analysis {
namespace {

using control::Mode;
using design::Concern;
using design::DesignSpec;
using design::DriveDesign;
using design::Warning;

/// Largest number of control periods of all trials together: some seconds of computing for an unusable
/// design, about one second for a usable design.
constexpr double rescue_periods = 4e6, advice_periods = 8e5;
bool is_grave(const std::vector<Warning>& warnings) {
  return std::any_of(warnings.begin(), warnings.end(), [](const Warning& w) { return w.grave; });
}

bool warns_of(const std::vector<Warning>& warnings, Concern of) {
  return std::any_of(warnings.begin(), warnings.end(), [of](const Warning& w) { return w.of == of; });
}

/// True if only a run can show the concern.
bool of_a_run(Concern of) { return of >= Concern::settling; }

/// True if a changed design may remove a warning, judged in closed form without a run.
bool promises(const std::vector<Warning>& found, const DriveDesign& next) {
  return std::any_of(found.begin(), found.end(), [&](const Warning& w) {
    return w.cure.empty() && (of_a_run(w.of) || !warns_of(next.warnings, w.of));
  });
}

/// Cost of a study as a number of runs of full length. A position's gain needs a search.
double runs_of_study(const DesignOrder& order) {
  const double motors =
      order.tolerances.empty() ? 1.0 : static_cast<double>(variations(order.tolerances).size());
  if (order.spec.mode != Mode::position) return 2.0 + motors;
  return order.gain.quick ? 3.0 + motors : 20.0 + 6.0 * motors;
}

std::optional<DriveDesign> in_closed_form(const DesignOrder& order, const DesignSpec& spec) {
  const base::Result<design::MotorModel> motor = design::motor_model(order.subject.believed_sheet());
  if (!motor) return std::nullopt;
  base::Result<DriveDesign> d = design::design_drive(*motor, spec);
  if (!d || is_grave(d->warnings)) return std::nullopt;
  return std::move(*d);
}

void add_cure(std::string& cure, const std::string& words) {
  cure += (cure.empty() ? "with " : ", or with ") + words + " the design gives no such warning";
}

/// Finds changes of a usable design that remove one of its warnings and add none.
void advise_usable(const DesignOrder& order, DesignStudy& s) {
  TrialBudget budget{advice_periods};
  std::vector<DesignSpec> changes = single_changes(order, s.design);
  // This change is inserted first, so that the longest period of each warning is tried before other changes.
  if (const auto longer = longer_of_periods(order.spec, s.design)) changes.insert(changes.begin(), *longer);
  for (const DesignSpec& spec : changes) {
    const std::optional<DriveDesign> d = in_closed_form(order, spec);
    if (!d || !promises(s.warnings, *d)) continue;
    const std::optional<DesignStudy> next = tried(order, spec, budget);
    if (!next || !next->usable() || next->warnings.size() >= s.warnings.size()) continue;
    const bool brings_another = std::any_of(next->warnings.begin(), next->warnings.end(),
                                            [&s](const Warning& w) { return !warns_of(s.warnings, w.of); });
    if (brings_another) continue;
    for (Warning& w : s.warnings)
      if (w.cure.empty() && !warns_of(next->warnings, w.of))
        add_cure(w.cure, words_of_change(order.spec, spec));
  }
}

bool holds(const DesignOrder& order, const DesignSpec& spec, TrialBudget& budget) {
  const std::optional<DesignStudy> study = tried(order, spec, budget);
  return study && study->usable();
}

/// True if the bus is above the sheet's nominal voltage. A lower bus changes the drive; it is advised only if
/// no other change succeeds.
bool above_nominal(const DesignSpec& spec, const DriveDesign& d) {
  return spec.voltage_V && d.motor.nominal_voltage_V > 0.0 && *spec.voltage_V > d.bus_V &&
         *spec.voltage_V > d.motor.nominal_voltage_V;
}

/// Changes that may make the design usable, in the order of their likelihood.
std::vector<DesignSpec> rescues(const DesignOrder& order, const DriveDesign& d) {
  std::vector<DesignSpec> all = single_changes(order, d);
  for (const DesignSpec& spec : joint_changes(order, d)) all.push_back(spec);
  if (!order.spec.rotor.hall || !decodes_encoders(order.subject.board)) return all;
  if (order.spec.mode == Mode::position) {
    std::vector<DesignSpec> first;
    // A slow drive needs no short period, and a trial with a longer period takes a fraction of the time.
    if (order.spec.period_s < unhurried_period_s) first.push_back(unhurried(order.spec, d.motor));
    for (const DesignSpec& spec : on_encoders(order, d)) first.push_back(spec);
    first.push_back(unhurried(on_encoder(order, order.spec.period_s), d.motor));
    all.insert(all.begin(), first.begin(), first.end());
  } else {
    for (const DesignSpec& spec : on_encoders(order, d)) all.push_back(spec);
  }
  return all;
}

std::vector<DesignSpec> on_this_bus_or_others(const DesignOrder& order, const DriveDesign& d) {
  std::vector<DesignSpec> all = rescues(order, d);
  if (order.subject.board) {
    // The board's program requires the board's period. Slower loops at this period therefore come first, and
    // other periods last.
    const auto keeps_period = [&](const DesignSpec& s) { return s.period_s == order.spec.period_s; };
    const auto slower_alone = [&](const DesignSpec& s) {
      return keeps_period(s) && s.mode == Mode::current && s.settle_s != order.spec.settle_s;
    };
    const auto others = std::stable_partition(all.begin(), all.end(), slower_alone);
    std::stable_partition(others, all.end(), keeps_period);
  }
  std::stable_partition(all.begin(), all.end(), [&d](const DesignSpec& s) { return !above_nominal(s, d); });
  return all;
}

/// Result of a search for a change. Slower loops may need more simulation time than the budget of an advice.
struct Rescue {
  std::string words;      ///< the first change that makes the design usable; empty if there is none
  bool too_long = false;  ///< true: a change or its run over the tolerances was too long to try
};

/// Tries each change first with the sheet's motor only, because this is quick and most changes fail at this
/// step. A position is then designed with the full search, as in the user's own study.
Rescue rescue(const DesignOrder& order, const DriveDesign& d) {
  const bool position = order.spec.mode == Mode::position;
  TrialBudget budget{rescue_periods}, whole_searches{4 * GainSearch{}.periods};
  DesignOrder alone = order;
  alone.tolerances.clear();
  if (position) alone.gain = {.quick = true, .longest_periods = 6e5, .periods = 1.5e6};
  Rescue out;
  std::string nominal;  // first change that succeeds with the sheet's motor
  const auto rescued = [&](const DesignSpec& spec, const DriveDesign& next) {
    if (!position && !(periods_of(alone, next) <= budget.periods)) out.too_long = true;
    if (!holds(alone, spec, budget)) return false;
    if (!position && order.tolerances.empty()) return true;
    if (!position && !(periods_of(order, next) <= budget.periods)) {
      if (nominal.empty()) nominal = words_of_change(order.spec, spec);
      return false;
    }
    return holds(order, spec, position ? whole_searches : budget);
  };
  std::vector<std::pair<DesignSpec, DriveDesign>> dear;
  for (const DesignSpec& spec : on_this_bus_or_others(order, d)) {
    if (order.keep_going && !order.keep_going()) return out;
    const std::optional<DriveDesign> next = in_closed_form(order, spec);
    if (!next) continue;
    // Changes that would need most of the budget are tried after the short trials.
    if (periods_of(order, *next) > rescue_periods / 4 && !position) {
      dear.emplace_back(spec, *next);
      continue;
    }
    if (rescued(spec, *next)) return {words_of_change(order.spec, spec), false};
  }
  for (const auto& [spec, next] : dear)
    if (rescued(spec, next)) return {words_of_change(order.spec, spec), false};
  if (!nominal.empty())
    return {
        nominal +
            ", tested only with the sheet's nominal motor, because the tolerances take too long to simulate",
        true};
  return out;
}

/// A smaller step, for a setpoint that no loop can reach: 0.9 times the reached step.
std::string smaller_step(const DesignOrder& order, const DesignStudy& s) {
  const double first = s.scenario.reference.values.front(), held = s.outcome.verdicts.front().measured;
  DesignOrder next = order;
  next.subject.step = base::shortened(0.9 * (held - first), 2, base::Towards::down);
  TrialBudget budget{rescue_periods};
  if (!holds(next, order.spec, budget)) return "give a smaller step, a higher voltage or less load";
  return "usable with step = " + base::written(*next.subject.step);
}

/// Text for the case that all tried changes failed.
std::string nothing_tried(const DriveDesign& d, bool too_long) {
  std::string text =
      "none of the tried changes makes the design usable: other chopping, another period_s, another sensor, slower loops, a lower torque limit";
  if (too_long) text += "; changes that take longer to simulate were not tried";
  if (d.spec.settle_s && d.settle_by_torque_s > *d.spec.settle_s)
    text += "; this torque limit and inertia need settle_s = " +
            base::written(base::shortened(d.settle_by_torque_s, 2, base::Towards::up));
  return text;
}

/// Text if the board is the cause: without this board the same loops are usable.
std::string board_is_the_cause(const DesignOrder& order) {
  if (!order.subject.board) return {};
  const study::Scenario &board = *order.subject.board, usual;
  TrialBudget budget{rescue_periods};
  const auto holds_on = [&](const auto& change) {
    DesignOrder next = order;
    next.tolerances.clear();
    next.gain.quick = true;
    change(*next.subject.board);
    return holds(next, order.spec, budget);
  };
  const auto straight = [&usual](study::Scenario& s) {
    s.sensors.hall_lines = usual.sensors.hall_lines;
    s.bridge.phases = usual.bridge.phases;
  };
  const bool crossed =
      board.sensors.hall_lines != usual.sensors.hall_lines || board.bridge.phases != usual.bridge.phases;
  if (crossed && holds_on(straight))
    return "set sensors.hall_lines = \"123\" and bridge.phases = \"abc\": with straight wires the design is usable";
  if (!board.sensors.current_bandwidth_Hz ||
      !holds_on([](study::Scenario& s) { s.sensors.current_bandwidth_Hz.reset(); }))
    return {};
  for (const double times : {2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0})
    if (const double wider_Hz = times * *board.sensors.current_bandwidth_Hz;
        holds_on([wider_Hz](study::Scenario& s) { s.sensors.current_bandwidth_Hz = wider_Hz; }))
      return "the current amplifier is too slow: the design is usable with sensors.current_bandwidth_Hz = " +
             base::written(wider_Hz);
  return "the current amplifier is too slow: remove sensors.current_bandwidth_Hz; without this lag the design is usable";
}

/// Finds changes that make an unusable design usable.
void advise_unusable(const DesignOrder& order, DesignStudy& s) {
  const auto grave =
      std::find_if(s.warnings.begin(), s.warnings.end(), [](const Warning& w) { return w.grave; });
  if (grave->of == Concern::shunt) return;  // no loop can control what its sensor does not measure
  if (grave->of == Concern::reach) {
    grave->cure = smaller_step(order, s);
    return;
  }
  if (of_a_run(grave->of))
    if (grave->cure = board_is_the_cause(order); !grave->cure.empty()) return;
  const Rescue found = rescue(order, s.design);
  grave->cure = found.words.empty() ? nothing_tried(s.design, found.too_long) : "usable with " + found.words;
}

}  // namespace

/// Number of control periods of a study. For a position, the gain is limited to braking_gain().
double periods_of(const DesignOrder& order, DriveDesign d) {
  if (d.spec.mode == Mode::position) {
    double& gain = d.loops.back().gains.d1;
    gain = std::min(gain, braking_gain(d));
  }
  return runs_of_study(order) * design_scenario(d, order.subject).duration_s / d.spec.period_s;
}

std::optional<DesignStudy> tried(const DesignOrder& order, const DesignSpec& spec, TrialBudget& budget) {
  if (order.keep_going && !order.keep_going()) return std::nullopt;
  const std::optional<DriveDesign> d = in_closed_form(order, spec);
  if (!d) return std::nullopt;
  if (!(periods_of(order, *d) <= budget.periods)) return std::nullopt;
  DesignOrder next = order;
  next.spec = spec;
  next.budget = &budget;
  next.advises = false;
  base::Result<DesignStudy> study = study_design(next);
  if (!study) return std::nullopt;
  return std::move(*study);
}

void advise(const DesignOrder& order, base::Problems& problems) {
  if (problems.size() != 1 || problems.front().where != "mode" || order.spec.mode != Mode::position) return;
  const base::Result<design::MotorModel> motor = design::motor_model(order.subject.believed_sheet());
  if (!motor) return;
  const base::Result<DriveDesign> d = design::design_drive(*motor, order.spec);
  if (!d) return;
  const auto grave =
      std::find_if(d->warnings.begin(), d->warnings.end(), [](const Warning& w) { return w.grave; });
  if (const std::string words = rescue(order, *d).words; !words.empty())
    problems.front().cure = "use " + words;
  else if (grave != d->warnings.end())  // a gain would not remove this problem
    problems.front().cure = "correct the design's first problem first: " + grave->what;
}

void advise(const DesignOrder& order, DesignStudy& study) {
  if (order.keep_going && !order.keep_going()) return;
  if (study.usable())
    advise_usable(order, study);
  else
    advise_unusable(order, study);
}

}  // namespace sixstep::analysis
