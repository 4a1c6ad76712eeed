// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/contest_store.hpp"

#include <fmt/format.h>

#include <utility>

#include "faces/cli/plan_storing.hpp"
#include "files/text_file.hpp"
#include "sixstep/base/written.hpp"
#include "text/plan/plan_file.hpp"
#include "text/scenario/scenario_text.hpp"

namespace cli {

base::Result<files::PlanStore> store_of(const analysis::Contest& contest, const ContestStoring& storing) {
  const study::Scenario& common = contest.bench.scenario;
  // A digest of the inputs. It changes if a controller's rule computes other numbers, or if a user's
  // controller was recompiled.
  std::uint64_t inputs = files::text_digest(SIXSTEP_VERSION);
  for (const analysis::ContestRow& row : contest.rows)
    inputs = files::text_digest(base::written_hex((*row.nominal)->digest), inputs);
  for (const analysis::ContestEntry& entry : contest.entries)
    if (entry.scenario) inputs = files::text_digest(text::scenario_text(*entry.scenario), inputs);
  files::StoredPlan stored{.plan = text::plan_identity(contest.plan),
                           .inputs = base::written_hex(inputs),
                           .title = "Controllers side by side",
                           .motor = common.sheet.name,
                           .scenario = common.title,
                           .command = storing.command,
                           .scenario_text = text::scenario_text(common),
                           .columns = contest.columns};
  return store_at(storing.path, storing.resume, storing.force, std::move(stored));
}

base::Problems take_drives(analysis::Contest& contest, batch::ContestOrder order, files::PlanStore& store) {
  const auto progress = std::move(order.progress);
  batch::run_drives(
      contest, order, [&store](std::size_t number) { return store.has(number); },
      [&](analysis::RunRecord&& record) {
        store.add(std::move(record));
        if (progress) progress(store.rows());
      });
  if (base::Problems unwritten = store.finish(); !unwritten.empty()) return unwritten;
  return store.each([&](const analysis::RunRecord& record) { analysis::take_drive(contest, record); });
}

}  // namespace cli
