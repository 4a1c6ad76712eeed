// SPDX-License-Identifier: Apache-2.0
// Studies a design from sheet and spec: computes its gains in closed form, simulates the drive with all
// switching, and tests it over the sheet's tolerances.
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
  std::optional<PositionGain> position;  ///< position mode: search for the gain
  study::Scenario scenario;              ///< scenario with which the design was run
  study::Outcome outcome;
  study::Trace trace;  ///< trace of the run, with the columns of its [record]
  std::optional<Robustness> robustness;
  std::optional<double> ideal_swing_rad_s;    ///< peak to peak swing of the speed in steady state, with ideal
                                              ///< sensors
  std::optional<double> allowed_swing_rad_s;  ///< a larger swing is an oscillation of the speed loop
                                              ///< (board.hpp)
  /// Derivation of start, range and delay of a board with a sensorless drive. In the study's run, Hall edges
  /// replace the crossings.
  std::vector<design::DerivationStep> sensorless;
  std::vector<std::string> beliefs;       ///< cost of each wrong belief (study/run/belief_costs.hpp)
  std::vector<design::Warning> warnings;  ///< warnings of the design and of its runs

  bool usable() const;  ///< true: no warning is grave
};

struct DesignOrder {
  DesignSubject subject{};
  design::DesignSpec spec{};
  std::vector<Tolerance> tolerances{};  ///< tolerances within which motors are run; empty: none
  ForEach for_each = one_after_the_other;
  std::function<bool()> keep_going{};  ///< false ends the study early; the result is then meaningless
  GainSearch gain{};                   ///< position: search for its gain
  TrialBudget* budget = nullptr;       ///< the periods of each run are subtracted from it; at 0 a search ends
  bool advises = true;                 ///< true: changes are tried against each warning (advice.hpp)
};

/// Adds to a speed design's scenario the requirement that the speed's swing stays within its limit. The other
/// required means do not show a swing. A position's scenario already has the requirement.
void require_swing(const DesignStudy& study, study::Scenario& scenario);

/// The first grave warning; empty if the design is usable.
std::string found_against(const DesignStudy& study);

/// Returns the Problems of sheet, spec and scenario.
base::Result<DesignStudy> study_design(const DesignOrder& order);

}  // namespace sixstep::analysis
