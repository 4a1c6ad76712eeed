// SPDX-License-Identifier: Apache-2.0
// The scenario of each run of a plan, read as if a file had been written for it.
#pragma once
#include <cstddef>
#include <memory>
#include <string>

#include "sixstep/analysis/plan/plan_table.hpp"
#include "text/scenario/scenario_file.hpp"

namespace text {

/// What all runs of a plan are made of.
struct PlannedText {
  std::string name, text;  ///< of the scenario, for read_scenario_text()
  ReadOptions options;     ///< what a point sets comes behind its overrides
  bool sheet_tolerances = false;
};

/// Asked by several threads at once. What texts name is found once; drives of one point share its reading.
class PlannedScenarios {
 public:
  PlannedScenarios(PlannedText of, analysis::Plan plan);
  ~PlannedScenarios();

  /// As written: with its spread, and nothing varied.
  base::Result<study::Scenario> nominal() const;
  /// Of a point, before it strays from drive to drive. A Problem's `where` is "--set key" for a value of the plan.
  base::Result<study::Scenario> at(const std::vector<std::string>& point) const;
  base::Result<analysis::PlannedRun> run(std::size_t n) const;
  /// A drive of a point that need not be one of the plan's.
  base::Result<analysis::PlannedRun> run(const std::vector<std::string>& point, std::size_t drive) const;

  /// Keys that can be varied at all, with values that can be read: each axis's ends, the others at their beginnings. Told
  /// once for each axis of which no end can be run; a corner that cannot is a row of its own.
  base::Problems check() const;

  const analysis::Plan& plan() const { return plan_; }
  const PlannedText& made_of() const { return of_; }

 private:
  struct Recent;
  base::Result<study::Scenario> read(const ReadOptions& options) const;

  PlannedText of_;
  analysis::Plan plan_;
  std::unique_ptr<Recent> recent_;
};

}  // namespace text
