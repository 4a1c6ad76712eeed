// SPDX-License-Identifier: Apache-2.0
// What a plan's runs leave behind, as a table: a row per run, a column per varied key, strayed value and figure of
// merit. The columns are known before anything runs.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/plan/plan.hpp"
#include "sixstep/base/describe.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

/// What is written of a run beside its point.
struct FigureColumn {
  std::string name, unit;
  bool required = false;  ///< else only compared
  std::optional<double> min, max;

  /// As a verdict on one run says it: a value there is, within its bounds. Compared figures ask nothing.
  bool holds(double x) const { return !required || (x == x && (!min || x >= *min) && (!max || x <= *max)); }
  bool operator==(const FigureColumn&) const = default;
};

struct PlanColumns {
  std::vector<std::string> keys;      ///< of the plan's axes
  std::vector<std::string> strayed;   ///< keys of [[spread]]; none where the plan has no drives
  std::vector<FigureColumn> figures;  ///< requirements first, then comparisons, in the scenario's order
  bool operator==(const PlanColumns&) const = default;
};

PlanColumns columns_of(const Plan& plan, const study::Scenario& scenario);

/// What a run of a plan is: the drive at its point.
struct PlannedRun {
  study::Scenario scenario;
  std::vector<double> strayed;  ///< as RunRecord's
};

enum class RunEnd : std::uint8_t { whole, fault, refused };

inline constexpr base::Choice<RunEnd> run_ends[] = {
    {"whole", RunEnd::whole, "came to its end, whatever its verdicts"},
    {"fault", RunEnd::fault, "stopped by one; figures are as they were then"},
    {"refused", RunEnd::refused, "could not start: no figures"},
};

struct RunRecord {
  std::size_t number = 0;
  std::vector<std::string> point;  ///< what each key was set to, as a file writes it
  std::vector<double> strayed;     ///< in the keys' units; NaN where it could not be drawn
  RunEnd end = RunEnd::whole;
  std::string problem;          ///< of a fault or a refusal, in one line
  std::vector<double> figures;  ///< NaN where there is none
  std::uint64_t digest = 0;     ///< of the trajectory
};

/// The row of a run: `number`, `point` and `strayed` are the caller's to fill.
RunRecord record_of(const base::Result<study::Outcome>& result, const PlanColumns& columns);

/// Came to its end and holds every requirement.
bool passed(const RunRecord& record, const PlanColumns& columns);

}  // namespace sixstep::analysis
