// SPDX-License-Identifier: Apache-2.0
// Stands in for study/run.cpp until that is there: runs nothing, finds fault with contradictory gains only.
#include "sixstep/study/run.hpp"

namespace sixstep::study {

const std::vector<Column>& all_columns() {
  static const std::vector<Column> columns{{"t_s", "s", "", "time"},
                                           {"speed_rad_s", "rad/s", "mechanical", "speed"}};
  return columns;
}

base::Result<std::vector<Column>> record_columns(const Scenario&) { return all_columns(); }

base::Problems check(const Scenario& scenario) {
  const CurrentLoop& loop = scenario.control.current;
  if (loop.settle_s && loop.d1)
    return {{.where = "control.current.d1",
             .limit = "contradicts settle_s",
             .cure = "give either settle_s with damping or d1 with d0"}};
  return {};
}

base::Result<Outcome> run(const Scenario& scenario, const Listeners& listeners) {
  Outcome outcome;
  outcome.simulated_s = scenario.duration_s;
  for (double t : {0.0, 0.1}) {
    const double row[] = {t, 1.0 / 3.0};
    if (listeners.on_record) listeners.on_record(row);
  }
  for (const Requirement& r : scenario.require)
    outcome.verdicts.push_back(
        {.figure = r.measure.label, .min = r.min, .max = r.max, .ok = !(r.max && *r.max < 0)});
  return outcome;
}

}  // namespace sixstep::study
