// SPDX-License-Identifier: Apache-2.0
// Chooses the units of speed and torque for a curve's page: rpm and mNm, for a linear motor m/s and N.
#pragma once
#include <string>

#include "report/figures.hpp"
#include "sixstep/analysis/curve/curve.hpp"
#include "sixstep/design/sheet/motion.hpp"

namespace report {

struct CurveUnits {
  sixstep::base::Motion motion;
  double per_rad_s, per_Nm;
  const char *speed, *torque;

  std::string speed_text(double rad_s) const { return plain(rad_s * per_rad_s, 5) + "\u00a0" + speed; }
  std::string torque_text(double Nm) const { return plain(Nm * per_Nm, 4) + "\u00a0" + torque; }
};

inline CurveUnits curve_units(const sixstep::analysis::CurveRequest& r) {
  const sixstep::base::Motion motion = sixstep::design::motion_of(r.sheet);
  if (motion.linear) return {motion, 1.0, 1.0, "m/s", "N"};
  return {motion, 30 / sixstep::base::pi, 1e3, "rpm", "mNm"};
}

}  // namespace report
