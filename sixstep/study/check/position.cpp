// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/position.hpp"

#include <string>

#include "sixstep/base/written.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::study {

void check_position(const Scenario& s, base::Problems& out) {
  const Control& c = s.control;
  const PositionProfile& p = c.position.profile;
  if (!p.on) {
    if (p != PositionProfile{})
      out.push_back({"control.position.profile", "", "has no effect, because the profile is off",
                     "set control.position.profile.on = true, or remove this key"});
    return;
  }
  if (p.jerk_rad_s3 && p.smoothing_s)
    out.push_back({"control.position.profile.smoothing_s", base::six_digits(*p.smoothing_s),
                   "contradicts jerk_rad_s3: both keys determine the time in which the acceleration rises",
                   "remove jerk_rad_s3 or smoothing_s"});
  const std::optional<double>& limit = c.position.speed_limit_rad_s;
  if (p.speed_rad_s && limit && *p.speed_rad_s > *limit)
    out.push_back({"control.position.profile.speed_rad_s", base::six_digits(*p.speed_rad_s),
                   "is above control.position.speed_limit_rad_s = " + base::six_digits(*limit) +
                       ", the bound of the loop's speed reference",
                   "lower this value, best to nine tenths of the limit, or raise the limit"});
  if (c.slew && c.mode == control::Mode::position)
    out.push_back({"control.slew", base::six_digits(*c.slew),
                   "limits the rate of the setpoint, which control.position.profile already limits",
                   "remove this key: control.position.profile.speed_rad_s is the limit"});
  if (c.arithmetic != Arithmetic::float64 && c.arithmetic != Arithmetic::float32)
    out.push_back({"control.arithmetic", std::string(base::word(arithmetic_choices, c.arithmetic)),
                   "has a resolution that is too coarse for the increments of control.position.profile",
                   "set arithmetic = \"float\" or \"double\", or remove the profile"});
  if (p.feed_forward && c.speed.law != SpeedLaw::pi)
    out.push_back({"control.position.profile.feed_forward", "true",
                   "adds a torque that the observer of control.speed.law = \"" +
                       std::string(base::word(speed_law_choices, c.speed.law)) +
                       "\" would estimate as a load and compensate",
                   "set feed_forward = false, or law = \"pi\""});
}

}  // namespace sixstep::study
