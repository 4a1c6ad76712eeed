// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/shaft.hpp"

#include <limits>
#include <string>

#include "sixstep/base/written.hpp"
#include "sixstep/study/check/reference.hpp"

namespace sixstep::study {

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();  // the table may end after the run

/// Speeds closer together than this count as equal. The rounding of a run's speed is about a hundredth of
/// this value.
constexpr double least_step_rad_s = 1e-6;

void check_table(const Load& l, base::Problems& out) {
  if (l.at_speeds_rad_s.size() != l.at_speeds_Nm.size() || l.at_speeds_Nm.size() == 1 ||
      l.at_speeds_Nm.size() > 100)
    out.push_back({"load.at_speeds_Nm", std::to_string(l.at_speeds_Nm.size()) + " values",
                   "need as many load.at_speeds_rad_s, 2 to 100 of them",
                   "write for example at_speeds_rad_s = [0, 300] and at_speeds_Nm = [0.01, 0.05]"});
  for (std::size_t n = 0; n + 1 < l.at_speeds_rad_s.size(); ++n)
    if (const double step = l.at_speeds_rad_s[n + 1] - l.at_speeds_rad_s[n]; !(step >= least_step_rad_s)) {
      out.push_back({"load.at_speeds_rad_s[" + std::to_string(n + 1) + "]",
                     base::six_digits(l.at_speeds_rad_s[n + 1]),
                     step > 0 ? "is too close to the previous speed: a run cannot distinguish the two"
                              : "must be above the previous speed",
                     step > 0 ? "remove one of the two equal speeds" : "sort the speeds"});
      return;
    }
}

/// Refuses a torque that the table replaces at the run's first instant, and an interpolation without a table.
void check_torques(const Scenario& s, base::Problems& out) {
  const Load& l = s.load;
  check_steps(l.times_s, l.torques_Nm, "load", "torques_Nm",
              l.between == Between::lines ? endless : s.duration_s, out);
  if (l.torque_Nm != 0 && !l.times_s.empty() && l.times_s.front() == 0)
    out.push_back({"load.torque_Nm", base::six_digits(l.torque_Nm),
                   "has no effect, because load.torques_Nm gives the torque from load.times_s[0] = 0 on",
                   "remove this key, or let load.times_s begin after 0"});
  if (l.between == Between::lines && l.times_s.empty() && l.torques_Nm.empty())
    out.push_back({"load.between", "\"lines\"", "needs load.torques_Nm, which is not given",
                   "give load.times_s and load.torques_Nm, or remove this key"});
}

/// Refuses load torques, inertia and the like for a load whose speed a dynamometer imposes.
void check_dynamometer(const Scenario& s, base::Problems& out) {
  const Load& l = s.load;
  if (l.dynamometer_times_s.empty() && l.dynamometer_rad_s.empty()) return;
  check_steps(l.dynamometer_times_s, l.dynamometer_rad_s, "load", "dynamometer_rad_s", endless, out,
              "dynamometer_times_s");
  if (!l.dynamometer_times_s.empty() && l.dynamometer_times_s.front() != 0)
    out.push_back({"load.dynamometer_times_s", base::six_digits(l.dynamometer_times_s.front()),
                   "must begin at 0, because a dynamometer turns the shaft from the start",
                   "write 0 as the first value of load.dynamometer_times_s"});
  const auto refuse = [&out](const std::string& key, double value) {
    if (value != 0)
      out.push_back({key, base::six_digits(value), "has no effect where a dynamometer imposes the speed",
                     "remove this key: the load torque is a result of the run"});
  };
  refuse("load.torque_Nm", l.torque_Nm);
  refuse("load.torques_Nm", static_cast<double>(l.torques_Nm.size()));
  refuse("load.at_speeds_Nm", static_cast<double>(l.at_speeds_Nm.size()));
  refuse(square_law(l).key, square_law(l).Nm_s2);
  refuse("load.gravity_Nm", l.gravity_Nm);
  refuse("initial.speed_rad_s", s.initial.speed_rad_s);
  if (l.locked)
    out.push_back(
        {"load.locked", "true", "contradicts load.dynamometer_rad_s", "remove one of the two keys"});
  if (l.gear_efficiency < 1 && !(l.stiffness_Nm_rad > 0))
    out.push_back({"load.gear_efficiency", base::six_digits(l.gear_efficiency),
                   "has no effect where a dynamometer turns a rigid shaft",
                   "remove this key, or give load.stiffness_Nm_rad and load.inertia_kg_m2"});
}

}  // namespace

void check_shaft(const Scenario& s, base::Problems& out) {
  const Load& l = s.load;
  if (l.stiffness_Nm_rad > 0 && !(l.inertia_kg_m2 > 0))
    out.push_back({"load.stiffness_Nm_rad", base::six_digits(l.stiffness_Nm_rad),
                   "needs load.inertia_kg_m2: without inertia of the load nothing can oscillate",
                   "give load.inertia_kg_m2"});
  if (l.damping_Nm_s_rad > 0 && !(l.stiffness_Nm_rad > 0))
    out.push_back({"load.damping_Nm_s_rad", base::six_digits(l.damping_Nm_s_rad),
                   "applies to an elastic shaft only, and this shaft is rigid",
                   "give load.stiffness_Nm_rad, or remove this key"});
  if (l.gravity_angle_deg != 0 && l.gravity_Nm == 0)
    out.push_back({"load.gravity_angle_deg", base::six_digits(l.gravity_angle_deg),
                   "has no effect without load.gravity_Nm", "give load.gravity_Nm, or remove this key"});
  check_table(l, out);
  check_dynamometer(s, out);
  if (l.gear_efficiency < 1 && l.gear == 1)
    out.push_back({"load.gear_efficiency", base::six_digits(l.gear_efficiency),
                   "needs load.gear, which is not given", "give load.gear, or remove this key"});
  if (l.locked && s.initial.speed_rad_s != 0)
    out.push_back({"initial.speed_rad_s", base::six_digits(s.initial.speed_rad_s),
                   "contradicts load.locked = true", "set this value to 0, or set load.locked = false"});
  check_torques(s, out);
}

}  // namespace sixstep::study
