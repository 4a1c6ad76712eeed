// SPDX-License-Identifier: Apache-2.0
// Studies a design from sheet and spec: computes its gains in closed form, runs them with all switching, and tests
// them over the sheet's tolerances.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/verify/design_scenario.hpp"
#include "sixstep/analysis/verify/position_gain.hpp"
#include "sixstep/analysis/verify/robust.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace sixstep::analysis {

struct DesignStudy {
  design::DriveDesign design;
  std::optional<PositionGain> position;  ///< position mode: how its gain was found
  study::Scenario scenario;              ///< with which the design was run
  study::Outcome outcome;
  study::Trace trace;  ///< trace of that run, with the columns of its [record]
  std::optional<Robustness> robustness;
  std::optional<double> ideal_swing_rad_s;  ///< peak to peak of the speed in steady state, with ideal sensors
  std::optional<double> allowed_swing_rad_s;  ///< above it the speed loop oscillates (board.hpp)
  /// Start, range and delay of a board with a sensorless drive. Its loops are run with Hall edges in place of
  /// crossings.
  std::vector<design::DerivationStep> sensorless;
  std::vector<design::Warning> warnings;  ///< warnings of the design and of its runs

  bool usable() const;  ///< no warning is grave
};

struct DesignOrder {
  DesignSubject subject{};
  design::DesignSpec spec{};
  std::vector<Tolerance> tolerances{};  ///< empty: not tested
  ForEach for_each = one_after_the_other;
  std::function<bool()> keep_going{};  ///< false ends it early; the result is then meaningless
  GainSearch gain{};                   ///< position: search for its gain
  TrialBudget* budget = nullptr;       ///< each run is subtracted from it; a search ends when it is empty
  bool advises = true;                 ///< tries changes against each warning (advice.hpp)
};

/// Adds to a speed design's scenario the requirement that the speed's swing stays within its limit, because
/// no mean shows this. A position's scenario has it.
void require_swing(const DesignStudy& study, study::Scenario& scenario);

/// The first grave warning; empty where the design is usable.
std::string found_against(const DesignStudy& study);

/// Problems are those of sheet, spec and scenario.
base::Result<DesignStudy> study_design(const DesignOrder& order);

}  // namespace sixstep::analysis
