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

struct ContestRow {
  RunRecord nominal{};  ///< its figures are the gauges, requirements first
  ContestTrace trace{};
  std::optional<double>
      lowest_rad_s{};  ///< it still holds nominally (lowest_speed.hpp); none: not even the course's low one
  std::vector<double> values{};      ///< of contest_figures, nominal
  std::vector<double> worst{};       ///< the largest over nominal and all drives; empty without drives
  std::size_t drives = 0, held = 0;  ///< of the tolerances; those that hold every requirement
  bool nominal_held = false;
};

struct Contest {
  ContestBench bench;
  std::vector<ContestEntry> entries;
  std::vector<ContestRow> rows;  ///< one per entry
  std::size_t drives = 0;        ///< of each
};

/// The plan of all drives: contestants are the values of its one key.
Plan contest_plan(const std::vector<ContestEntry>& entries, std::size_t drives, std::uint64_t seed);
/// The same columns in all.
PlanColumns contest_columns(const Plan& plan, const ContestBench& bench);

/// Takes the figures of the nominal run, or of a drive of the tolerances, found by its number in the plan, which then count where they
/// are worse.
void take_nominal(ContestRow& row, RunRecord record, const PlanColumns& columns);
void take_drive(Contest& contest, const RunRecord& record, const PlanColumns& columns);

}  // namespace sixstep::analysis
