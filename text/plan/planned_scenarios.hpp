// SPDX-License-Identifier: Apache-2.0
// Makes the scenario of each run of a plan, as if a file had been written for it.
#pragma once
#include <cstddef>
#include <memory>
#include <string>

#include "sixstep/analysis/plan/plan_table.hpp"
#include "text/scenario/scenario_file.hpp"

namespace text {

/// The input that all runs of a plan share.
struct PlannedText {
  std::string name, text;  ///< name and text of the scenario, for read_scenario_text()
  ReadOptions options;     ///< the values of a point are applied after the overrides
  bool sheet_tolerances = false;
};

/// Reads the scenarios of a plan's runs. Several threads may call it at the same time. Each file is searched
/// only once, and the scenario of a point is read once for all its drives.
class PlannedScenarios {
 public:
  PlannedScenarios(PlannedText of, analysis::Plan plan);
  ~PlannedScenarios();

  /// The scenario as written, with its spread and without varied values.
  base::Result<study::Scenario> nominal() const;
  /// The scenario of a point, before the spread of a drive is applied. For a value of the plan, a Problem's
  /// `where` is "--set key".
  base::Result<study::Scenario> at(const std::vector<std::string>& point) const;
  base::Result<analysis::PlannedRun> run(std::size_t n) const;
  /// The run of one drive at any point, even at a point outside the plan.
  base::Result<analysis::PlannedRun> run(const std::vector<std::string>& point, std::size_t drive) const;

  /// Checks that the keys can be varied and that the axes' ends can be read. It reads the point with the
  /// first ends of all axes. If that fails, it reads for each axis the point with this axis at its other end.
  /// An axis gives Problems only if both readings fail. A corner that cannot run becomes a row of the table.
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
