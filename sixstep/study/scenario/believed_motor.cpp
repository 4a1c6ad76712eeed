// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/scenario/believed_motor.hpp"

#include <string>
#include <string_view>
#include <utility>

#include "sixstep/design/sheet/sheet_override.hpp"

namespace sixstep::study {

namespace {

using Believes = std::optional<base::Quantity> Believed::*;
using OfSheet = std::optional<base::Quantity> design::Sheet::*;

struct Constant {
  std::string_view key;
  Believes from;
  OfSheet to;
};

constexpr Constant constants[] = {
    {"resistance_ohm", &Believed::resistance_ohm, &design::Sheet::resistance_ohm},
    {"inductance_mH", &Believed::inductance_mH, &design::Sheet::inductance_mH},
    {"d_axis_inductance_mH", &Believed::d_axis_inductance_mH, &design::Sheet::d_axis_inductance_mH},
    {"q_axis_inductance_mH", &Believed::q_axis_inductance_mH, &design::Sheet::q_axis_inductance_mH},
    {"torque_constant_mNm_A", &Believed::torque_constant_mNm_A, &design::Sheet::torque_constant_mNm_A},
    {"back_emf_mV_s", &Believed::back_emf_mV_s, &design::Sheet::back_emf_mV_s},
    {"torque_constant_Nm_A", &Believed::torque_constant_Nm_A, &design::Sheet::torque_constant_Nm_A},
    {"flux_linkage_mWb", &Believed::flux_linkage_mWb, &design::Sheet::flux_linkage_mWb},
    {"speed_constant_rpm_V", &Believed::speed_constant_rpm_V, &design::Sheet::speed_constant_rpm_V},
    {"inertia_gcm2", &Believed::inertia_gcm2, &design::Sheet::inertia_gcm2},
};

bool believes(const Believed& b, std::string_view key) {
  if (key == "pole_pairs") return b.pole_pairs.has_value();
  for (const Constant& c : constants)
    if (c.key == key) return (b.*c.from).has_value();
  return false;
}

/// The first believed key.
std::string_view first_believed(const Believed& b) {
  for (const Constant& c : constants)
    if (b.*c.from) return c.key;
  return "pole_pairs";
}

/// Attributes a problem at another line of the sheet to a belief, because the motor itself has no problems.
base::Problem under_a_belief(const Believed& b, base::Problem p) {
  if (believes(b, p.where)) {
    p.where = "believed." + p.where;
    return p;
  }
  p.limit = "does not go with the motor's other values: " + p.where +
            (p.value.empty() ? " " : " = " + p.value + " ") + p.limit;
  p.where = "believed." + std::string(first_believed(b));
  p.value.clear();
  return p;
}

}  // namespace

bool believes_a_motor(const Believed& b) {
  if (b.pole_pairs) return true;
  for (const Constant& c : constants)
    if (b.*c.from) return true;
  return false;
}

design::Sheet believed_sheet(design::Sheet sheet, const Believed& b) {
  if (!believes_a_motor(b)) return sheet;
  if (b.pole_pairs) sheet.pole_pairs = *b.pole_pairs;
  for (const Constant& c : constants) {
    if (!(b.*c.from)) continue;
    base::Quantity value = *(b.*c.from);
    if (value.frame.empty() && sheet.*c.to) value.frame = (sheet.*c.to)->frame;
    sheet.*c.to = std::move(value);
  }
  // The drive believes one inertia. For a rotor with its brake, it replaces both lines of the sheet.
  if (b.inertia_gcm2 && sheet.with_brake) sheet.inertia_with_brake_gcm2 = sheet.inertia_gcm2;
  drop_stale(sheet, [&b, &sheet](std::string_view key) {
    if (key == "inertia_with_brake_gcm2") return b.inertia_gcm2 && sheet.with_brake;
    return believes(b, key);
  });
  return sheet;
}

design::Sheet believed_sheet(const Scenario& s) {
  return believed_sheet(s.designed_for ? s.designed_for->sheet : s.sheet, s.believed);
}

base::Result<design::MotorModel> believed_motor(const Scenario& s) {
  base::Result<design::MotorModel> motor = design::motor_model(believed_sheet(s));
  if (motor || !believes_a_motor(s.believed)) return motor;
  base::Problems problems = motor.problems();
  for (base::Problem& p : problems) p = under_a_belief(s.believed, std::move(p));
  return problems;
}

}  // namespace sixstep::study
