// SPDX-License-Identifier: Apache-2.0
// Finds the largest gain of a position controller with which the drive does not overshoot, including the
// effect of its torque, bus and speed limits.
#pragma once
#include <functional>

#include "sixstep/analysis/verify/design_scenario.hpp"
#include "sixstep/analysis/verify/robust.hpp"
#include "sixstep/base/result.hpp"

namespace sixstep::analysis {

struct PositionGain {
  double gain_rad_s_per_deg = 0.0;
  double estimate = 0.0;    ///< gain by the closed form for braking from full speed; first tried gain
  double linear = 0.0;      ///< gain of the linear loop, the upper end of the search
  double overshoots = 0.0;  ///< the smallest tried gain that overshoots; 0 if no tried gain overshoots
  /// Largest gain for the sheet's motor. The tolerances may require a smaller gain.
  double nominal = 0.0;
  int runs = 0;
};

/// Control periods that may still be simulated. Each run reduces the number, because a search's cost is known
/// only afterwards.
struct TrialBudget {
  double periods = 0.0;
  /// Subtracts the periods of this number of runs. Returns false if fewer periods remain.
  bool takes(const study::Scenario& s, std::size_t runs);
};

/// Limits of a search, because a move with a lower gain takes longer.
struct GainSearch {
  bool quick = false;            ///< true: halves the closed form's gain until the drive does not overshoot
  double longest_periods = 2e6;  ///< limit of one run, in control periods
  double periods = 1.5e7;  ///< limit of all runs together, in control periods: half a minute of one core
};

/// Near the end of the move the P controller requests the speed w = k x, with the gain k and the remaining
/// distance x. The speed decreases by k^2 x = k w per second. At the highest speed U/K_t (bus voltage, torque
/// constant) this is at most T_max/J (full torque, inertia) if k = T_max/(J U/K_t). Returned in rad/s per
/// degree.
double braking_gain(const design::DriveDesign& design);

/// The overshoot grows with the gain between braking_gain() and the linear loop's gain. Bisection with full
/// simulations finds the gain at which overshoot begins, to a part in 1000. Problems: errors of a run; no
/// gain was found within the search's limits. The periods of the runs are subtracted from `budget`, if it is
/// given.
base::Result<PositionGain> largest_position_gain(const design::DriveDesign& design,
                                                 const DesignSubject& subject,
                                                 const std::function<bool()>& keep_going = {},
                                                 const GainSearch& search = {},
                                                 TrialBudget* budget = nullptr);

/// Lowers the gain until no motor within the tolerances overshoots by more than allowed_overshoot_deg()
/// (board.hpp), to a part in 50. If even a sixteenth of the nominal gain overshoots, the nominal gain is
/// returned.
base::Result<PositionGain> lowered_for_tolerances(const design::DriveDesign& design,
                                                  const DesignSubject& subject, const PositionGain& nominal,
                                                  const std::vector<Tolerance>& tolerances,
                                                  const ForEach& for_each,
                                                  const std::function<bool()>& keep_going = {},
                                                  const GainSearch& search = {},
                                                  TrialBudget* budget = nullptr);

}  // namespace sixstep::analysis
