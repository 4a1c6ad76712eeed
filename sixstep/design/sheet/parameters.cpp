// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/sheet/parameters.hpp"

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/plausible.hpp"
#include "sixstep/base/range_text.hpp"
#include "sixstep/design/sheet/sheet_reader.hpp"

namespace sixstep::design {
namespace {

void read_printed_points(SheetReader& reader, MotorModel& m) {
  const Sheet& sheet = reader.sheet;
  if (sheet.no_load_speed_rpm)
    m.no_load_speed_rad_s = SheetReader::positive(*sheet.no_load_speed_rpm).value_or(0.0) * base::pi / 30.0;
  if (sheet.no_load_current_mA)
    m.no_load_current_A = SheetReader::not_negative(*sheet.no_load_current_mA, -3).value_or(0.0);
  if (const std::optional<base::Quantity>& printed = sheet.nominal_current_A) {
    const bool rms = printed->frame == "rms";
    const double per_A = rms ? torque_per_rms_A(m.K_e_V_s, reader.out.shape) / m.K_t_Nm_A : 1.0;
    m.nominal_current_A = per_A * printed->value;
  }
  m.stall_torque_Nm = m.K_t_Nm_A * m.nominal_voltage_V / (2.0 * m.machine.R_ohm);
  if (sheet.stall_torque_mNm)
    m.stall_torque_Nm = SheetReader::positive(*sheet.stall_torque_mNm, -3).value_or(0.0);
}

/// Checks the model's constants. Constants from several lines, such as K_t = 2 B l r N, have the same limits
/// as constants from one line.
void check_constants(SheetReader& reader, const MotorModel& m) {
  const auto hold = [&reader](const std::string& where, double value, const base::Range& own,
                              std::string_view unit, const char* what) {
    const base::Range allowed = base::allowed(own, unit);
    if (!allowed.holds(value))
      reader.problem(where, "",
                     std::string("makes ") + what + " " + rounded(value) + " " + std::string(unit) +
                         ", which " + limit_of(own, allowed, value),
                     "correct the units of the lines from which this value is computed");
  };
  hold(m.from.K_t.substr(0, m.from.K_t.find(',')), m.K_t_Nm_A, base::above(0), "Nm/A", "the torque constant");
  hold(reader.sheet.viscous_friction_Nm_s ? "viscous_friction_Nm_s" : "no_load_current_mA", m.shaft.B_Nm_s,
       base::from(0), "N m s", "the viscous friction");
}

/// Bounds of the rates. No motor in data/motors exceeds 1e4 rad/s. A rate that is ten times larger or more is
/// caused by a wrong unit, and its simulation would need steps of nanoseconds.
constexpr double fastest_winding_rad_s = 1e6, fastest_swing_rad_s = 1e5;

/// Lower bound of R/L, rad/s: no winding's current decays for minutes, and a simulation of this decay would
/// not end.
constexpr double slowest_winding_rad_s = 0.01;

/// Checks two rates, rad/s, both with terminal values: R/L of the winding, and K_t/sqrt(L J), the oscillation
/// of winding and shaft.
void check_pace(SheetReader& reader, const MotorModel& m) {
  const Sheet& sheet = reader.sheet;
  const double L = 2.0 * m.machine.L_H, winding = 2.0 * m.machine.R_ohm / L;
  const double swing = m.K_t_Nm_A / std::sqrt(L * m.shaft.J_kg_m2);
  if (winding > fastest_winding_rad_s || winding < slowest_winding_rad_s) {
    const std::optional<base::Quantity>& q =
        sheet.inductance_mH ? sheet.inductance_mH : sheet.d_axis_inductance_mH;
    const char* key = sheet.inductance_mH ? "inductance_mH" : "d_axis_inductance_mH";
    const std::string bound = winding > fastest_winding_rad_s
                                  ? rounded(1e9 / winding, 3) + " ns, and no motor has less than 1000 ns"
                                  : rounded(1 / winding, 3) + " s, and no motor has more than 100 s";
    reader.problem(q ? SheetReader::key_of(key, *q) : key, q ? reader.value_of(key, *q) : "",
                   "gives the winding a time constant L/R of " + bound,
                   "correct the unit of inductance or resistance");
  } else if (swing > fastest_swing_rad_s) {
    const std::optional<base::Quantity>& q =
        sheet.with_brake ? sheet.inertia_with_brake_gcm2 : sheet.inertia_gcm2;
    reader.problem(
        m.from.J.substr(0, m.from.J.find(',')),
        q ? reader.value_of(sheet.with_brake ? "inertia_with_brake_gcm2" : "inertia_gcm2", *q) : "",
        "lets rotor and winding oscillate at K_t/sqrt(L J) = " + rounded(swing, 3) +
            " rad/s, and no motor has more than 1e5 rad/s",
        "correct the unit of the inertia, of the inductance or of the torque constant");
  }
}

base::Problem not_simulatable(const Sheet& sheet) {
  return {
      "simulatable", "false", "because " + sheet.not_simulatable_because,
      "choose another motor, or give the missing values in [motor_override] together with simulatable = true and not_simulatable_because = \"\""};
}

}  // namespace

base::Result<MotorModel> motor_model(const Sheet& sheet) {
  SheetConstants c = sheet_constants(sheet);
  if (!sheet.simulatable && c.problems.empty()) return not_simulatable(sheet);
  base::Problems problems = c.problems;
  append(problems, c.missing);
  if (!problems.empty()) return problems;

  MotorModel m;
  m.kind = sheet.kind;
  m.machine.pole_pairs = *c.electrical_per_mechanical();
  m.shape_is_table = sheet.back_emf == BackEmfShape::table;
  m.machine.back_emf =
      sheet.back_emf == BackEmfShape::trapezoid ? plant::BackEmf::trapezoid : plant::BackEmf::sine;
  m.machine.flat_deg = sheet.flat_deg;
  m.machine.R_ohm = c.R_ohm->value;
  m.machine.L_H = c.L_H->value;
  m.K_e_V_s = c.K_e_V_s->value;
  m.K_t_Nm_A = c.K_t_Nm_A->value;
  m.machine.K_e_V_s = m.shape_is_table
                          ? m.K_t_Nm_A / shape_factors(BackEmfShape::sine, sheet.flat_deg).sector_mean
                          : m.K_e_V_s;
  m.nominal_voltage_V = c.nominal_voltage_V.value_or(0.0);
  m.shaft.J_kg_m2 = c.J_kg_m2->value;
  m.shaft.B_Nm_s = c.friction.B_Nm_s;
  m.shaft.coulomb_Nm = c.friction.coulomb_Nm;
  m.iron = c.friction.iron;
  m.from = {c.R_ohm->from, c.L_H->from, c.K_e_V_s->from, c.K_t_Nm_A->from, c.J_kg_m2->from, c.friction.from};
  m.left_to_a_run = left_to_a_run(sheet);
  SheetReader reader{sheet, c};
  read_printed_points(reader, m);
  check_constants(reader, m);
  check_pace(reader, m);
  if (!c.problems.empty()) return c.problems;
  return m;
}

}  // namespace sixstep::design
