// SPDX-License-Identifier: Apache-2.0
// Compares controllers: the figures of each controller on the course, for the nominal drive and over the
// sheet's tolerances.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "sixstep/analysis/contest/lowest_speed.hpp"
#include "sixstep/analysis/plan/plan_table.hpp"

namespace sixstep::analysis {

/// A contestant and its scenario, or the Problem with the reason why this motor has no scenario for it.
struct ContestEntry {
  const Contestant* who = nullptr;
  std::vector<ContestKey> keys;
  base::Result<study::Scenario> scenario;
};

/// The nominal drive's traces on the course, for pictures: one value per instant.
struct ContestTrace {
  std::vector<double> t_s, speed_rad_s, torque_Nm, current_A;
};

/// Values that are all NaN.
ContestValues no_contest_values();

struct ContestRow {
  std::optional<RunRecord> nominal{};
  ContestTrace trace{};
  /// Lowest speed in rad/s that counts as held for the nominal drive (lowest_speed.hpp). Empty if the
  /// course's low speed does not count as held.
  std::optional<double> lowest_rad_s{};
  ContestValues values = no_contest_values();  ///< figures of the nominal drive
  std::optional<ContestValues> worst{};        ///< worst over nominal and all drives; empty without drives
  std::size_t drives = 0, held = 0;  ///< number of drives within the tolerances; number of them that meet
                                     ///< every requirement
  bool nominal_held = false;
};

/// The drives of all entries are one plan with one table. The only key of the plan is the contestant.
struct Contest {
  ContestBench bench;
  std::vector<ContestEntry> entries;
  std::vector<ContestRow> rows;  ///< one per entry
  Plan plan;
  TableColumns columns;
};

/// Creates the contest with `drives` drives of each entry. No run has started.
Contest contest_of(ContestBench bench, std::vector<ContestEntry> entries, std::size_t drives,
                   std::uint64_t seed, const UnitOfKey& unit_of = {});

/// The largest peak current in A of a start within the torque limit. Commutations add up to half of the
/// limit's current to it, and the PWM adds its ripple.
double most_peak_A(const ContestBench& bench);
/// True if a row's figures may count as the best: its nominal drive follows the course, with a start current
/// within most_peak_A(). A larger current would be an unfair advantage.
bool may_win(const Contest& contest, std::size_t row);

/// The gauges of a run, found by their labels. NaN: the run does not contain the gauge.
GaugeValues gauges_of(const RunRecord& record);

/// Stores the run of an entry's nominal drive.
void take_nominal(Contest& contest, std::size_t entry, const base::Result<study::Outcome>& result);
/// Stores the figures of a drive within the tolerances. Its number in the plan selects the entry. Only
/// figures that are worse than the stored figures are kept.
void take_drive(Contest& contest, const RunRecord& record);

}  // namespace sixstep::analysis
