// SPDX-License-Identifier: Apache-2.0
// Friction out of the no-load points: K_t I_0 = B w_0 + T_c pays for all of it.
#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/sheet_reader.hpp"

namespace sixstep::design {
namespace {

using base::Quantity;

struct Point {
  double speed_rad_s = 0.0;
  double loss_Nm = 0.0;
  bool printed_speed = true;
};

/// Speed as printed; without it that of the ideal line, w = (U - R_tt I)/K_t.
std::optional<Point> no_load_point(const SheetConstants& c, const std::optional<Quantity>& voltage,
                                   const std::optional<Quantity>& speed,
                                   const std::optional<Quantity>& current) {
  std::optional<double> rpm, amperes;
  if (speed) rpm = SheetReader::positive(*speed);
  if (current) amperes = SheetReader::not_negative(*current, -3);
  if (!amperes || !c.K_t_Nm_A || (speed && !rpm)) return {};
  Point point;
  point.loss_Nm = c.K_t_Nm_A->value * *amperes;
  if (rpm) {
    point.speed_rad_s = *rpm * base::pi / 30.0;
    return point;
  }
  if (!voltage || !c.R_ohm) return {};
  point.printed_speed = false;
  point.speed_rad_s = (voltage->value - 2.0 * c.R_ohm->value * *amperes) / c.K_t_Nm_A->value;
  if (!(point.speed_rad_s > 0.0)) return {};
  return point;
}

void read_split(SheetReader& reader, const Point& first) {
  const Sheet& s = reader.sheet;
  const std::optional<Point> second = no_load_point(reader.out, s.second_no_load_voltage_V,
                                                    s.second_no_load_speed_rpm, s.second_no_load_current_mA);
  if (!second) return;
  Friction& f = reader.out.friction;
  if (second->speed_rad_s == first.speed_rad_s)
    return reader.problem("second_no_load_speed_rpm", "", "is the first point's speed",
                          "give a point at another voltage, or leave it out");
  const double B = (second->loss_Nm - first.loss_Nm) / (second->speed_rad_s - first.speed_rad_s);
  const double T_c = first.loss_Nm - B * first.speed_rad_s;
  if (B < 0.0 || T_c < 0.0)
    return reader.problem(
        "second_no_load_current_mA", base::written(s.second_no_load_current_mA->value),
        "would make friction negative with the first point: B = " + rounded(B) +
            " Nm s, T_c = " + rounded(T_c * 1e3) + " mNm",
        "measure both points again, each after the same time of running, or leave the second out");
  f.split_viscous_Nm_s = B;
  f.split_coulomb_Nm = T_c;
}

/// What is given stands; the rest is left to the no-load loss.
void choose(SheetReader& reader, const std::optional<Point>& point) {
  const Sheet& s = reader.sheet;
  Friction& f = reader.out.friction;
  if (s.coulomb_friction_mNm)
    f.coulomb_Nm = SheetReader::not_negative(*s.coulomb_friction_mNm, -3).value_or(0.0);
  if (s.coulomb_friction_mNm) reader.use("coulomb_friction_mNm");
  if (s.viscous_friction_Nm_s) {
    f.B_Nm_s = SheetReader::not_negative(*s.viscous_friction_Nm_s).value_or(0.0);
    f.from = "viscous_friction_Nm_s as written";
    return reader.use("viscous_friction_Nm_s");
  }
  if (!point) {
    f.from = s.coulomb_friction_mNm ? "coulomb_friction_mNm alone" : "no friction: the sheet is silent";
    return;
  }
  reader.use("no_load_current_mA");
  if (s.no_load_speed_rpm) reader.use("no_load_speed_rpm");
  if (f.split_viscous_Nm_s && !s.coulomb_friction_mNm) {
    f.B_Nm_s = *f.split_viscous_Nm_s;
    f.coulomb_Nm = *f.split_coulomb_Nm;
    f.from = "the two no-load points";
    reader.use("second_no_load_current_mA");
    return reader.use(s.second_no_load_speed_rpm ? "second_no_load_speed_rpm" : "second_no_load_voltage_V");
  }
  if (f.coulomb_Nm > point->loss_Nm && point->loss_Nm > 0.0)
    return reader.problem(
        "coulomb_friction_mNm", base::written(f.coulomb_Nm * 1e3),
        "exceeds the loss at no load, K_t I_0 = " + base::written(point->loss_Nm * 1e3) + " mNm",
        "lower it, or give viscous_friction_Nm_s");
  if (point->loss_Nm > 0.0) f.B_Nm_s = (point->loss_Nm - f.coulomb_Nm) / point->speed_rad_s;
  f.from = point->printed_speed ? "the no-load point, B = (K_t I_0 - T_c)/w_0"
                                : "the no-load current, B = (K_t I_0 - T_c)/w_0 with w_0 = (U - R I_0)/K_t";
}

}  // namespace

void read_friction(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  const std::optional<Point> point =
      no_load_point(reader.out, s.no_load_voltage_V ? s.no_load_voltage_V : s.nominal_voltage_V,
                    s.no_load_speed_rpm, s.no_load_current_mA);
  if (point) {
    Friction& f = reader.out.friction;
    f.no_load_speed_rad_s = point->speed_rad_s;
    f.all_viscous_Nm_s = point->loss_Nm / point->speed_rad_s;
    f.all_coulomb_Nm = point->loss_Nm;
    read_split(reader, *point);
  }
  choose(reader, point);
}

}  // namespace sixstep::design
