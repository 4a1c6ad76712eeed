// SPDX-License-Identifier: Apache-2.0
// Controllers side by side: what each came to on the course, nominal and over the sheet's tolerances.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "sixstep/analysis/contest/lowest_speed.hpp"
#include "sixstep/analysis/plan/plan_table.hpp"

namespace sixstep::analysis {

/// A contestant and its scenario, or why this motor has none.
struct ContestEntry {
  const Contestant* who = nullptr;
  std::vector<ContestKey> keys;
  base::Result<study::Scenario> scenario;
};

/// The course of the nominal drive, for pictures: a value per instant.
struct ContestTrace {
  std::vector<double> t_s, speed_rad_s, torque_Nm, current_A;
};

/// NaN all of them.
ContestValues no_contest_values();

struct ContestRow {
  std::optional<RunRecord> nominal{};
  ContestTrace trace{};
  std::optional<double>
      lowest_rad_s{};  ///< it still holds nominally (lowest_speed.hpp); none: not even the course's low one
  ContestValues values = no_contest_values();  ///< nominal
  std::optional<ContestValues> worst{};  ///< the largest over nominal and all drives; none without drives
  std::size_t drives = 0, held = 0;      ///< of the tolerances; those that hold every requirement
  bool nominal_held = false;
};

/// The drives of all entries are one plan, whose table has the same columns for all: contestants are the values of its one key.
struct Contest {
  ContestBench bench;
  std::vector<ContestEntry> entries;
  std::vector<ContestRow> rows;  ///< one per entry
  Plan plan;
  TableColumns columns;
};

/// Before anything runs: `drives` of each entry.
Contest contest_of(ContestBench bench, std::vector<ContestEntry> entries, std::size_t drives,
                   std::uint64_t seed, const UnitOfKey& unit_of = {});

/// The gauges of a run, found by their labels; NaN where it has none.
GaugeValues gauges_of(const RunRecord& record);

/// Takes the nominal run of an entry, whose drive does not stray.
void take_nominal(Contest& contest, std::size_t entry, const base::Result<study::Outcome>& result);
/// Takes the figures of a drive of the tolerances, found by its number in the plan, which then count where they are worse.
void take_drive(Contest& contest, const RunRecord& record);

}  // namespace sixstep::analysis
