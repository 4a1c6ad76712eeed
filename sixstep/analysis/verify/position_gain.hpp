// SPDX-License-Identifier: Apache-2.0
// The largest gain of a position controller with which the drive, its torque, bus and speed limits acting,
// does not overshoot.
#pragma once
#include <functional>

#include "sixstep/analysis/verify/design_scenario.hpp"
#include "sixstep/analysis/verify/robust.hpp"
#include "sixstep/base/result.hpp"

namespace sixstep::analysis {

struct PositionGain {
  double gain_rad_s_per_deg = 0.0;
  double estimate = 0.0;    ///< a closed form below it: what braking from full speed allows
  double linear = 0.0;      ///< above it: the linear loop's own
  double overshoots = 0.0;  ///< the smallest gain tried that overshoots; 0 where none did
  double nominal =
      0.0;  ///< what the motor of the sheet stands; the gain is lower where tolerances ask for it
  int runs = 0;
};

/// Control periods that may still be simulated: what a search costs is known only behind it.
struct TrialBudget {
  double periods = 0.0;
  /// Takes the periods of so many runs out of it; false where they are more than it has.
  bool takes(const study::Scenario& s, std::size_t runs);
};

/// How long a search may be: a lower gain makes a longer move.
struct GainSearch {
  bool quick = false;  ///< the first of the closed form and its halves that holds, and no larger one
  double longest_periods = 2e6;  ///< of a run
  double periods = 1.5e7;        ///< of all runs together: half a minute of one core
};

/// The P controller asks for w = k x on the last of the way, a slowing-down of k^2 x = k w: no more than
/// T_max/J at the highest speed, k = T_max/(J U/K_t); here in rad/s per degree.
double braking_gain(const design::DriveDesign& design);

/// Between that and the linear loop's gain the overshoot grows with the gain, and halving with full simulations finds where it begins,
/// to a part in 1000. Problems are those of a run, or that none was found within the search. The runs are taken out of `budget`, where
/// there is one.
base::Result<PositionGain> largest_position_gain(const design::DriveDesign& design,
                                                 const DesignSubject& subject,
                                                 const std::function<bool()>& keep_going = {},
                                                 const GainSearch& search = {},
                                                 TrialBudget* budget = nullptr);

/// The gain lowered until no motor of the tolerances overshoots by more than allowed_overshoot_deg
/// (board.hpp), to a part in 50; the nominal one where a sixteenth of it does not do either.
base::Result<PositionGain> lowered_for_tolerances(const design::DriveDesign& design,
                                                  const DesignSubject& subject, const PositionGain& nominal,
                                                  const std::vector<Tolerance>& tolerances,
                                                  const ForEach& for_each,
                                                  const std::function<bool()>& keep_going = {},
                                                  const GainSearch& search = {},
                                                  TrialBudget* budget = nullptr);

}  // namespace sixstep::analysis
