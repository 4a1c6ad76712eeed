// SPDX-License-Identifier: Apache-2.0
// Table of a plan's runs. It has a row per run, and columns for each varied key, each value of [[spread]] and
// each figure of merit. The columns are known before the first run.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sixstep/analysis/plan/plan.hpp"
#include "sixstep/base/describe.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

/// A column of a figure of merit.
struct FigureColumn {
  std::string name, unit;
  bool required = false;  ///< true: a requirement; false: only compared
  std::optional<double> min, max;
  double zero = 0.0;  ///< study::figure_zero() of the scenario as written

  /// Distance of a bound from `zero`. A relative margin is divided by this distance.
  double size(double bound) const { return bound < zero ? zero - bound : bound - zero; }
  /// True if the value meets the requirement, as in the verdict of a single run: it is within its bounds. A
  /// compared figure always holds.
  bool holds(double x) const { return !required || (x == x && (!min || x >= *min) && (!max || x <= *max)); }
  bool operator==(const FigureColumn&) const = default;
};

/// A column of an input: a key of the plan, or a key that deviates by [[spread]].
struct InputColumn {
  std::string key, unit;
  bool operator==(const InputColumn&) const = default;
};

struct PlanColumns {
  std::vector<InputColumn> keys;      ///< keys of the plan's axes
  std::vector<InputColumn> strayed;   ///< keys of [[spread]]; none if the plan has no drives
  std::vector<FigureColumn> figures;  ///< requirements first, then comparisons, in the scenario's order
  bool operator==(const PlanColumns&) const = default;
};

/// Shared by a table and all of its rows.
using TableColumns = std::shared_ptr<const PlanColumns>;

/// The unit of a scenario's key; empty if the key has no unit.
using UnitOfKey = std::function<std::string(const std::string& key)>;

/// The columns of a plan's table. `scenario` has its [[spread]], before any value deviates.
TableColumns columns_of(const Plan& plan, const study::Scenario& scenario, const UnitOfKey& unit_of = {});

/// A value drawn by [[spread]], with its key.
struct Strayed {
  std::string key;
  double value = 0.0;  ///< in the key's unit; NaN if no value could be drawn
};

/// The scenario of a planned run, and the values that [[spread]] has drawn for it.
struct PlannedRun {
  study::Scenario scenario;
  std::vector<Strayed> strayed;
};

/// Drive number `drive` of the series that the nominal scenario's [[spread]] defines.
PlannedRun planned_drive(const study::Scenario& nominal, std::uint64_t seed, std::size_t drive);

enum class RunEnd : std::uint8_t { whole, fault, refused };

inline constexpr base::Choice<RunEnd> run_ends[] = {
    {"whole", RunEnd::whole, "ran to its end, with any verdicts"},
    {"fault", RunEnd::fault, "stopped by a fault; figures have their values at that time"},
    {"refused", RunEnd::refused, "could not start: no figures"},
};

/// The values of a row. RunRecord combines them with the columns, which define the meaning of each value.
struct RunValues {
  std::size_t number = 0;
  std::vector<std::string> point;  ///< value of each key, as a file writes it
  std::vector<double> strayed;     ///< in the keys' units; NaN if no value could be drawn
  RunEnd end = RunEnd::whole;
  std::string problem;                 ///< text of a fault or a refusal, in one line
  std::vector<std::string> remarks{};  ///< remarks of the outcome
  std::vector<double> figures;         ///< NaN for a figure without a value
  std::uint64_t digest = 0;            ///< digest of the trajectory
};

/// A row with its columns. of() checks that each column has exactly one value; a row does not change afterwards.
class RunRecord {
 public:
  /// A Problem if the number of values of a kind differs from its number of columns.
  static base::Result<RunRecord> of(TableColumns columns, RunValues values);
  /// The row of a run without figures, which could not start or ended with the program.
  static RunRecord without_figures(TableColumns columns, std::size_t number, std::vector<std::string> point,
                                   RunEnd end, std::string problem);

  const PlanColumns& columns() const { return *columns_; }
  /// True if this is a row of the table with these columns.
  bool fits(const TableColumns& columns) const { return columns_ == columns || *columns_ == *columns; }
  const RunValues& operator*() const { return values_; }
  const RunValues* operator->() const { return &values_; }

 private:
  RunRecord(TableColumns columns, RunValues values)
      : columns_(std::move(columns)), values_(std::move(values)) {}
  TableColumns columns_;
  RunValues values_;
};

/// The row of a run. Its values are found by the names of deviating keys and figures. If these names differ
/// from the columns, the row is a run that could not start, with the reason.
RunRecord record_of(const TableColumns& columns, std::size_t number, std::vector<std::string> point,
                    const base::Result<PlannedRun>& planned, const base::Result<study::Outcome>& result);

/// True if the run reached its end and meets every requirement.
bool passed(const RunRecord& record);

}  // namespace sixstep::analysis
