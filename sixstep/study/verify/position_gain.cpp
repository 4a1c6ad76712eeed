// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/verify/position_gain.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/run/keep_going.hpp"
#include "sixstep/study/run/run.hpp"

namespace sixstep::study {
namespace {

constexpr double precision = 1e-3;

/// Runs the move with a gain; only the overshoot is looked at.
class Trial {
 public:
  Trial(const design::DriveDesign& design, const DesignSubject& subject,
        const std::function<bool()>& keep_going)
      : design_(design), subject_(subject), keep_going_(keep_going) {}

  bool overshoots(double gain) {
    ++runs;
    design::DriveDesign d = design_;
    d.loops.back().gains.d1 = gain;
    Scenario s = design_scenario(d, subject_);
    s.compare.clear();
    const base::Result<Outcome> outcome =
        run(s, {.on_record = {}, .on_event = {}, .keep_going = listening(keep_going_), .keep_books = false});
    if (!outcome) {
      problems = outcome.problems();
      return true;
    }
    return !outcome->passed();
  }

  int runs = 0;
  base::Problems problems;

 private:
  const design::DriveDesign& design_;
  const DesignSubject& subject_;
  const std::function<bool()>& keep_going_;
};

}  // namespace

base::Result<PositionGain> largest_position_gain(const design::DriveDesign& design,
                                                 const DesignSubject& subject,
                                                 const std::function<bool()>& keep_going) {
  PositionGain found;
  found.linear = design.loop("position").gains.d1;
  found.estimate = design.torque_limit_Nm / design.motor.shaft.J_kg_m2 /
                   (design.bus_V / design.motor.K_t_Nm_A) * base::pi / 180;
  Trial trial(design, subject, keep_going);
  double low = std::min(found.estimate, found.linear), high = found.linear;
  for (int n = 0; n < 20 && trial.overshoots(low) && trial.problems.empty(); ++n) {
    high = found.overshoots = low;
    low /= 2;
  }
  if (!trial.problems.empty()) return trial.problems;
  if (found.overshoots == 0.0 && high > low) {
    if (trial.overshoots(high))
      found.overshoots = high;
    else
      low = high;
  }
  while (trial.problems.empty() && high - low > precision * low) {
    const double middle = low + (high - low) / 2;
    if (trial.overshoots(middle))
      high = found.overshoots = middle;
    else
      low = middle;
  }
  if (!trial.problems.empty()) return trial.problems;
  found.gain_rad_s_per_deg = low;
  found.runs = trial.runs;
  return found;
}

}  // namespace sixstep::study
