// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/speed.hpp"

#include <string>

#include "sixstep/base/written.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::study {

namespace {

/// Refuses keys that only the PI's positional form has.
void check_positional(const Scenario& s, base::Problems& out) {
  const SpeedLoop& loop = s.control.speed;
  const auto refuse = [&](const char* key, const std::optional<double>& value) {
    if (value && loop.form != SpeedForm::positional)
      out.push_back({std::string("control.speed.") + key, base::six_digits(*value),
                     "applies only to control.speed.form = \"positional\"",
                     "set control.speed.form = \"positional\", or remove this key"});
  };
  refuse("anti_windup", loop.anti_windup);
  refuse("derivative_s", loop.derivative_s);
  refuse("derivative_filter_s", loop.derivative_filter_s);
  refuse("setpoint_weight", loop.setpoint_weight);
  if (loop.derivative_filter_s && !loop.derivative_s && loop.form == SpeedForm::positional)
    out.push_back({"control.speed.derivative_filter_s", base::six_digits(*loop.derivative_filter_s),
                   "has no effect without control.speed.derivative_s",
                   "add control.speed.derivative_s, or remove this key"});
  if (loop.observer_ratio)
    out.push_back({"control.speed.observer_ratio", base::six_digits(*loop.observer_ratio),
                   "applies only to an observer, which law = \"pi\" does not have",
                   "set control.speed.law to a law with an observer, or remove this key"});
}

/// Refuses gains for a law that is designed from a settling time.
void check_designed(const Scenario& s, base::Problems& out) {
  const SpeedLoop& loop = s.control.speed;
  const std::string law(base::word(speed_law_choices, loop.law));
  const auto refuse = [&](const char* key, const std::optional<double>& value, const std::string& cure) {
    if (value)
      out.push_back({std::string("control.speed.") + key, base::six_digits(*value),
                     "applies only to a PI, which control.speed.law = \"" + law + "\" does not have", cure});
  };
  const std::string gains = "remove this key and give settle_s and observer_ratio, or set law = \"pi\"";
  refuse("d1", loop.d1, gains);
  refuse("d0", loop.d0, gains);
  refuse("kp", loop.kp, gains);
  refuse("ki", loop.ki, gains);
  refuse("ki_per_s", loop.ki_per_s, gains);
  refuse("damping", loop.damping, "remove this key, because this law places real poles; or set law = \"pi\"");
  const std::string form = "remove this key, or set law = \"pi\"";
  refuse("anti_windup", loop.anti_windup, form);
  refuse("derivative_s", loop.derivative_s, form);
  refuse("derivative_filter_s", loop.derivative_filter_s, form);
  refuse("setpoint_weight", loop.setpoint_weight, form);
  if (loop.form == SpeedForm::positional)
    out.push_back({"control.speed.form", "\"positional\"",
                   "applies only to a PI, which control.speed.law = \"" + law + "\" does not have", form});
  if (s.control.arithmetic != Arithmetic::float64 && s.control.arithmetic != Arithmetic::float32)
    out.push_back({"control.arithmetic", std::string(base::word(arithmetic_choices, s.control.arithmetic)),
                   "is fixed point, which has no proven scaling for control.speed.law = \"" + law + "\"",
                   "set arithmetic = \"float\" or \"double\", or law = \"pi\""});
}

}  // namespace

void check_speed_law(const Scenario& s, base::Problems& out) {
  if (s.control.speed.law == SpeedLaw::pi)
    check_positional(s, out);
  else
    check_designed(s, out);
}

}  // namespace sixstep::study
