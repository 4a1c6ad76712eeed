// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/few_digits.hpp"

#include "sixstep/analysis/verify/linear_study.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/measure/figures.hpp"

namespace sixstep::analysis {
namespace {

using control::Mode;

/// Rounds a number in the unit in which it is shown: for a linear motor, mm instead of degrees.
double shortened(double x, double factor, int digits, base::Towards towards) {
  return base::shortened(x * factor, digits, towards) / factor;
}

/// Rounds all times up: their order is kept, and adjacent windows remain adjacent. Default bounds of a window
/// are omitted.
void shorten_times(study::Measure& m, double duration_s) {
  for (std::optional<double>* time : {&m.from_s, &m.to_s})
    if (*time) *time = base::shortened(**time, 3, base::Towards::up);
  if (m.from_s == 0.0) m.from_s.reset();
  if (m.to_s == duration_s) m.to_s.reset();
}

}  // namespace

void write_in_few_digits(study::Scenario& s) {
  s.duration_s = base::shortened(s.duration_s, 3, base::Towards::up);
  for (double& time : s.reference.times_s) time = base::shortened(time, 3, base::Towards::up);
  for (study::Requirement& r : s.require) {
    shorten_times(r.measure, s.duration_s);
    const double factor = unit_in(s, figure_unit(r.measure)).factor;
    if (r.min) r.min = shortened(*r.min, factor, 4, base::Towards::down);
    if (r.max) r.max = shortened(*r.max, factor, 4, base::Towards::up);
  }
  for (study::Comparison& c : s.compare) {
    shorten_times(c.measure, s.duration_s);
    c.value = shortened(c.value, unit_in(s, figure_unit(c.measure)).factor, 4, base::Towards::down);
  }
  s.load.torque_Nm = base::shortened(s.load.torque_Nm, 2, base::Towards::down);
  s.initial.angle_rad = base::shortened(s.initial.angle_rad, 4, base::Towards::down);
  if (std::optional<double>& limit = s.control.speed.torque_limit_Nm)
    limit = base::shortened(*limit, 3, base::Towards::down);
  if (s.control.mode != Mode::position) return;
  double& gain = s.control.position.gain_rad_s_per_deg;
  const double of_gain = design::motion_of(s.sheet).unit("rad/s/deg").factor;
  gain = shortened(gain, of_gain, 2, base::Towards::down);  // rounded down, because a lower gain overshoots
                                                            // less
}

}  // namespace sixstep::analysis
