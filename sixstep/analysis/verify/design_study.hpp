// SPDX-License-Identifier: Apache-2.0
// The whole road from a sheet and a spec to gains that are known to hold: designed in closed form, run with
// all switching, put through the sheet's tolerances.
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
  study::Scenario scenario;              ///< that the design was run as
  study::Outcome outcome;
  study::Trace trace;  ///< of that run, as its [record] asks
  std::optional<Robustness> robustness;
  std::optional<double> ideal_swing_rad_s;  ///< peak to peak of the speed in steady state, with ideal sensors
  std::optional<double> allowed_swing_rad_s;  ///< above which the speed loop oscillates (board.hpp)
  /// Of a board whose drive is sensorless: start, range and lateness. Its loops are run with Hall edges where crossings would be.
  std::vector<design::DerivationStep> sensorless;
  std::vector<design::Warning> warnings;  ///< the design's, and what only the runs could show

  bool usable() const;  ///< no warning is grave
};

struct DesignOrder {
  DesignSubject subject{};
  design::DesignSpec spec{};
  std::vector<Tolerance> tolerances{};  ///< empty: not looked at
  ForEach for_each = one_after_the_other;
  std::function<bool()> keep_going{};  ///< false ends it early: what comes out then means nothing
  GainSearch gain{};                   ///< position: how its gain is looked for
  TrialBudget* budget = nullptr;       ///< that each run is taken out of; a search ends where it is empty
  bool advises = true;                 ///< tries what helps against each warning (advice.hpp)
};

/// Adds to a scenario of a speed design what no mean shows: that the speed does not swing further than the design may. A position's
/// scenario has it.
void require_swing(const DesignStudy& study, study::Scenario& scenario);

/// What the first grave warning says; empty where the design is usable.
std::string found_against(const DesignStudy& study);

/// Problems are those of sheet, spec and scenario.
base::Result<DesignStudy> study_design(const DesignOrder& order);

}  // namespace sixstep::analysis
