// SPDX-License-Identifier: Apache-2.0
#include "batch/contest.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "batch/for_each.hpp"
#include "batch/plan_runs.hpp"
#include "sixstep/study/run/run.hpp"

namespace batch {
namespace {

/// Number of rows of a trace: enough for a curve over the width of a page.
constexpr double rows_of_a_trace = 1500;

/// Runs the nominal drive, and stores the rows for the drawing in `trace`.
base::Result<study::Outcome> traced(study::Scenario scenario, const std::stop_token& stop,
                                    analysis::ContestTrace& trace) {
  const double periods =
      std::max(1.0, std::ceil(scenario.duration_s / rows_of_a_trace / scenario.pwm.period_s));
  scenario.record = {.grid_s = periods * scenario.pwm.period_s,
                     .events = false,
                     .columns = {"t_s", "speed_rad_s", "torque_Nm", "i_a_A"}};
  study::Listeners listeners;
  listeners.keep_books = false;
  listeners.keep_going = [&stop](double) { return !stop.stop_requested(); };
  listeners.on_record = [&trace](study::Row row) {
    trace.t_s.push_back(row[0]);
    trace.speed_rad_s.push_back(row[1]);
    trace.torque_Nm.push_back(row[2]);
    trace.current_A.push_back(row[3]);
  };
  return study::run(scenario, listeners);
}

/// Runs a drive at the low speeds, from the highest low speed down. Returns the lowest speed that the drive
/// holds.
std::optional<double> lowest_of(const study::Scenario& scenario, const analysis::ContestBench& bench,
                                const std::stop_token& stop) {
  const study::Listeners listeners{.keep_going = [&stop](double) { return !stop.stop_requested(); },
                                   .keep_books = false};
  const base::Result<study::Outcome> outcome =
      study::run(analysis::slow_scenario(scenario, bench), listeners);
  if (!outcome) return {};
  return analysis::lowest_speed_rad_s(bench.course, outcome->verdicts);
}

}  // namespace

std::size_t nominal_runs(std::size_t controllers) { return 2 * controllers; }

analysis::Contest compare_nominally(analysis::ContestBench bench, std::vector<analysis::ContestEntry> entries,
                                    const ContestOrder& order) {
  analysis::Contest contest =
      analysis::contest_of(std::move(bench), std::move(entries), order.drives, order.seed, order.unit_of);
  std::atomic<std::size_t> done{0};
  for_each(nominal_runs(contest.entries.size()), order.jobs, [&](std::size_t n) {
    const base::Result<study::Scenario>& scenario = contest.entries[n / 2].scenario;
    analysis::ContestRow& row = contest.rows[n / 2];
    if (n % 2 == 1) {
      if (scenario) row.lowest_rad_s = lowest_of(*scenario, contest.bench, order.stop);
    } else {
      const base::Result<study::Outcome> outcome = scenario
                                                       ? traced(*scenario, order.stop, row.trace)
                                                       : base::Result<study::Outcome>(scenario.problems());
      analysis::take_nominal(contest, n / 2, outcome);
    }
    if (order.progress) order.progress(++done);
  });
  return contest;
}

void run_drives(const analysis::Contest& contest, const ContestOrder& order,
                const std::function<bool(std::size_t number)>& has,
                const std::function<void(analysis::RunRecord&&)>& take) {
  const analysis::Plan& plan = contest.plan;
  if (plan.drives == 0) return;
  const auto entry_of = [&](std::size_t n) -> const analysis::ContestEntry& {
    return contest.entries[n / plan.drives];
  };
  run_plan(
      {.plan = plan,
       .columns = contest.columns,
       .scenario = [&](std::size_t n) -> base::Result<analysis::PlannedRun> {
         return analysis::planned_drive(*entry_of(n).scenario, plan.seed, *analysis::drive_of_run(plan, n));
       },
       .wanted = [&](std::size_t n) { return static_cast<bool>(entry_of(n).scenario) && !(has && has(n)); },
       .take = take,
       .stop = order.stop,
       .jobs = order.jobs});
}

}  // namespace batch
