// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/believed.hpp"

#include <string>

#include "sixstep/study/scenario/believed_motor.hpp"

namespace sixstep::study {

namespace {

/// Refuses a torque constant in more than one form: the drive has one.
void check_one_torque_constant(const Believed& b, base::Problems& out) {
  const std::pair<const char*, bool> forms[] = {
      {"torque_constant_mNm_A", b.torque_constant_mNm_A.has_value()},
      {"back_emf_mV_s", b.back_emf_mV_s.has_value()},
      {"torque_constant_Nm_A", b.torque_constant_Nm_A.has_value()},
      {"flux_linkage_mWb", b.flux_linkage_mWb.has_value()},
      {"speed_constant_rpm_V", b.speed_constant_rpm_V.has_value()}};
  std::string first;
  for (const auto& [key, given] : forms) {
    if (!given) continue;
    if (!first.empty())
      out.push_back({std::string("believed.") + key, "",
                     "gives the torque constant a second time, after believed." + first,
                     "keep one of the two keys"});
    first = key;
  }
}

void check_inductances(const Believed& b, base::Problems& out) {
  if (b.inductance_mH && (b.d_axis_inductance_mH || b.q_axis_inductance_mH))
    out.push_back({"believed.inductance_mH", "",
                   "contradicts d_axis_inductance_mH and q_axis_inductance_mH: the inductance is given twice",
                   "remove believed.inductance_mH, or both axis inductances"});
  else if (b.d_axis_inductance_mH.has_value() != b.q_axis_inductance_mH.has_value())
    out.push_back({b.d_axis_inductance_mH ? "believed.q_axis_inductance_mH" : "believed.d_axis_inductance_mH",
                   "", "is missing, and the other axis's inductance is given",
                   "give both axis inductances, or only believed.inductance_mH"});
}

}  // namespace

void check_believed(const Scenario& s, base::Problems& out) {
  const Believed& b = s.believed;
  if (!believes_a_motor(b)) return;
  const std::size_t before = out.size();
  if (b.pole_pairs && s.sheet.kind == design::MotorKind::linear)
    out.push_back({"believed.pole_pairs", std::to_string(*b.pole_pairs),
                   "are values of a rotary motor, and this motor is linear", "remove this key"});
  check_one_torque_constant(b, out);
  check_inductances(b, out);
  if (out.size() > before) return;
  if (const auto motor = believed_motor(s); !motor) append(out, motor.problems());
}

}  // namespace sixstep::study
