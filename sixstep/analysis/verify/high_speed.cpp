// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/high_speed.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/verify/board.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/run/keep_going.hpp"
#include "sixstep/study/run/run.hpp"

namespace sixstep::analysis {
namespace {

/// The mean of the speed at the end of a run, rad/s; empty if the run ended early.
std::optional<double> held_speed(const study::Scenario& s, const std::function<bool()>& keep_going) {
  const base::Result<study::Outcome> outcome = study::run(
      s, {.on_record = {}, .on_event = {}, .keep_going = study::listening(keep_going), .keep_books = false});
  if (!outcome || outcome->verdicts.empty()) return std::nullopt;
  return outcome->verdicts.front().measured;
}

}  // namespace

void look_at_high_speed(const DesignOrder& order, DesignStudy& s) {
  const auto grain = std::find_if(s.warnings.begin(), s.warnings.end(),
                                  [](const design::Warning& w) { return w.of == design::Concern::grain; });
  const std::vector<double>& levels = s.scenario.reference.values;
  if (grain == s.warnings.end() || levels.empty()) return;
  DesignSubject subject = order.subject;
  const double asked = s.design.high_speed_rad_s;
  subject.step = asked - levels.front();
  if (!(*subject.step > 0.0)) return;
  const study::Scenario up = design_scenario(s.design, subject);
  const std::optional<double> ideal = held_speed(with_ideal_sensors(up), order.keep_going);
  const std::optional<double> held = held_speed(up, order.keep_going);
  if (order.budget != nullptr) order.budget->takes(up, 2);
  if (!ideal || !held) return;
  if (!(std::fabs(*held - *ideal) > design::settling_band(s.design) * asked)) return;
  grain->grave = true;
  grain->what += ". In a run with a reference of " + base::three_digits(asked) + " rad/s the mean speed is " +
                 base::three_digits(*held) + " rad/s; with ideal sensors the mean speed is " +
                 base::three_digits(*ideal) + " rad/s";
}

}  // namespace sixstep::analysis
