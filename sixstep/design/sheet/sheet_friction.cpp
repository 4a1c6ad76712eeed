// SPDX-License-Identifier: Apache-2.0
// Computes the friction from the no-load points: K_t I_0 = B w_0 + T_c contains the whole friction.
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

/// A no-load point with its printed speed, or by default with the speed of the ideal line, w = (U - R_tt
/// I)/K_t.
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
    return reader.problem("second_no_load_speed_rpm", "", "is equal to the speed of the first no-load point",
                          "give a point at another voltage, or remove the keys of the second point");
  const double B = (second->loss_Nm - first.loss_Nm) / (second->speed_rad_s - first.speed_rad_s);
  const double T_c = first.loss_Nm - B * first.speed_rad_s;
  if (B < 0.0 || T_c < 0.0)
    return reader.wrong(
        "second_no_load_current_mA", *s.second_no_load_current_mA,
        "gives, with the first point, a negative friction: B = " + rounded(B) +
            " Nm s, T_c = " + rounded(T_c * 1e3) + " mNm",
        "measure both points again, each after the same running time, or leave the second point out");
  f.split_viscous_Nm_s = B;
  f.split_coulomb_Nm = T_c;
}

/// Adds the lines of the iron and the bearings' dry friction, which are always part of the friction.
void add_given(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  Friction& f = reader.out.friction;
  const auto take = [&reader](const std::optional<Quantity>& q, std::string_view key, int ten) {
    if (q) reader.use(key);
    return q ? SheetReader::not_negative(*q, ten).value_or(0.0) : 0.0;
  };
  f.iron.coulomb_Nm = take(s.iron_coulomb_mNm, "iron_coulomb_mNm", -3);
  f.iron.B_Nm_s = take(s.iron_viscous_Nm_s, "iron_viscous_Nm_s", 0);
  f.coulomb_Nm = take(s.coulomb_friction_mNm, "coulomb_friction_mNm", -3) + f.iron.coulomb_Nm;
}

/// Checks that no part is negative: the iron's part of a measured sum is at most the sum.
void check_iron(SheetReader& reader) {
  const Friction& f = reader.out.friction;
  const auto beyond = [&](const char* key, double part, double sum, const char* unit) {
    if (part <= sum * (1 + 1e-12)) return;
    reader.problem(
        key, base::written(part),
        "exceeds the friction that the no-load points leave for the iron, " + rounded(sum) + " " + unit,
        "lower this value, or give viscous_friction_Nm_s of the bearings");
  };
  beyond("iron_coulomb_mNm", f.iron.coulomb_Nm * 1e3, f.coulomb_Nm * 1e3, "mNm");
  beyond("iron_viscous_Nm_s", f.iron.B_Nm_s, f.B_Nm_s, "Nm s");
}

/// Computes B = (K_t I_0 - T_c)/w_0 from one point, or B and T_c from two points.
void take_from_points(SheetReader& reader, const Point& point) {
  const Sheet& s = reader.sheet;
  Friction& f = reader.out.friction;
  reader.use("no_load_current_mA");
  if (s.no_load_speed_rpm) reader.use("no_load_speed_rpm");
  if (f.split_viscous_Nm_s && !s.coulomb_friction_mNm) {
    f.B_Nm_s = *f.split_viscous_Nm_s;
    f.coulomb_Nm = *f.split_coulomb_Nm;
    f.from = "the two no-load points";
    reader.use("second_no_load_current_mA");
    return reader.use(s.second_no_load_speed_rpm ? "second_no_load_speed_rpm" : "second_no_load_voltage_V");
  }
  if (f.coulomb_Nm > point.loss_Nm && point.loss_Nm > 0.0)
    return reader.problem(
        s.coulomb_friction_mNm ? "coulomb_friction_mNm" : "iron_coulomb_mNm",
        base::six_digits(f.coulomb_Nm * 1e3),
        "exceeds the loss at no load, K_t I_0 = " + base::six_digits(point.loss_Nm * 1e3) + " mNm",
        "lower this value, or give viscous_friction_Nm_s");
  if (point.loss_Nm > 0.0) f.B_Nm_s = (point.loss_Nm - f.coulomb_Nm) / point.speed_rad_s;
  f.from = point.printed_speed ? "the no-load point, B = (K_t I_0 - T_c)/w_0"
                               : "the no-load current, B = (K_t I_0 - T_c)/w_0 with w_0 = (U - R I_0)/K_t";
}

/// Uses the values of the sheet; the other values follow from the no-load loss.
void choose(SheetReader& reader, const std::optional<Point>& point) {
  const Sheet& s = reader.sheet;
  Friction& f = reader.out.friction;
  const bool iron = f.iron.B_Nm_s > 0.0 || f.iron.coulomb_Nm > 0.0;
  if (s.viscous_friction_Nm_s) {
    f.B_Nm_s = SheetReader::not_negative(*s.viscous_friction_Nm_s).value_or(0.0) + f.iron.B_Nm_s;
    f.from = SheetReader::key_of("viscous_friction_Nm_s", *s.viscous_friction_Nm_s) + " as written" +
             (iron ? ", and the iron's" : "");
    return reader.use("viscous_friction_Nm_s");
  }
  if (point) {
    take_from_points(reader, *point);
    return check_iron(reader);
  }
  f.B_Nm_s = f.iron.B_Nm_s;
  f.from = iron ? "the iron's alone" : "no friction: the sheet gives none";
  if (s.coulomb_friction_mNm)
    f.from = SheetReader::key_of("coulomb_friction_mNm", *s.coulomb_friction_mNm) +
             (iron ? " and the iron's" : " alone");
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
  add_given(reader);
  choose(reader, point);
}

}  // namespace sixstep::design
