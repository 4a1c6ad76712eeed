// SPDX-License-Identifier: Apache-2.0
#include "batch/contest.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

#include "batch/for_each.hpp"
#include "batch/plan_runs.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/spread.hpp"

namespace batch {
namespace {

/// Enough for a curve over a page.
constexpr double rows_of_a_trace = 1500;

/// Runs the nominal drive and keeps what is drawn.
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

/// All drives of all that can run, in the order of their numbers.
void run_drives(analysis::Contest& contest, const analysis::Plan& plan, const analysis::PlanColumns& columns,
                const ContestOrder& order, std::atomic<std::size_t>& done) {
  std::map<std::size_t, analysis::RunRecord> records;
  std::mutex guard;
  const auto entry_of = [&](std::size_t n) -> const analysis::ContestEntry& {
    return contest.entries[n / plan.drives];
  };
  run_plan(
      {.plan = plan,
       .columns = columns,
       .scenario = [&](std::size_t n) -> base::Result<analysis::PlannedRun> {
         const study::Scenario& nominal = *entry_of(n).scenario;
         return analysis::PlannedRun{study::varied(nominal, plan.seed, *analysis::drive_of_run(plan, n)), {}};
       },
       .wanted = [&](std::size_t n) { return static_cast<bool>(entry_of(n).scenario); },
       .take =
           [&](analysis::RunRecord&& record) {
             const std::lock_guard lock(guard);
             const std::size_t number = record.number;
             records.emplace(number, std::move(record));
             if (order.progress) order.progress(++done);
           },
       .stop = order.stop,
       .jobs = order.jobs});
  for (const auto& [number, record] : records)
    analysis::take_drive(contest.rows[number / plan.drives], record, columns);
}

}  // namespace

std::size_t contest_runs(std::size_t controllers, std::size_t drives) { return controllers * (1 + drives); }

analysis::Contest compare_controllers(analysis::ContestBench bench,
                                      std::vector<analysis::ContestEntry> entries,
                                      const ContestOrder& order) {
  analysis::Contest contest{std::move(bench), std::move(entries), {}, order.drives};
  contest.rows.resize(contest.entries.size());
  const analysis::Plan plan = analysis::contest_plan(contest.entries, order.drives, order.seed);
  const analysis::PlanColumns columns = analysis::contest_columns(plan, contest.bench);
  std::atomic<std::size_t> done{0};
  for_each(contest.entries.size(), order.jobs, [&](std::size_t n) {
    const base::Result<study::Scenario>& scenario = contest.entries[n].scenario;
    analysis::ContestRow& row = contest.rows[n];
    const base::Result<study::Outcome> outcome = scenario ? traced(*scenario, order.stop, row.trace)
                                                          : base::Result<study::Outcome>(scenario.problems());
    analysis::take_nominal(row, analysis::record_of(outcome, columns), columns);
    if (order.progress) order.progress(++done);
  });
  if (order.drives > 0) run_drives(contest, plan, columns, order, done);
  return contest;
}

}  // namespace batch
