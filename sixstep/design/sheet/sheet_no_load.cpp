// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/sheet/sheet_no_load.hpp"

#include <algorithm>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/sheet_check.hpp"

namespace sixstep::design {
namespace {

using base::Quantity;

/// A term whose error is the range of the value in the file, if the range is larger than rounding. The file
/// contains a range if sources differ, or if the maker prints a tolerance.
std::optional<Term> ranged(const std::optional<Quantity>& q, double unit = 1.0) {
  std::optional<Term> t = term(q, unit);
  if (t && q->range)
    t->doubt = std::max(t->doubt, std::max(q->range->high - q->value, q->value - q->range->low) / q->value);
  return t;
}

/// True if a value was measured on another motor than the sheet's motor, and no range covers the difference.
bool of_another_motor(const std::optional<Quantity>& q) {
  return q && !q->range && (q->kind == base::Trust::measured || q->kind == base::Trust::derived);
}

struct SheetLine {
  std::string name;  ///< "" or "second "
  std::optional<Term> U_V, speed_rpm, current_A;
  bool current_is_nothing = false;  ///< true: the sheet prints 0
};

class NoLoad {
 public:
  NoLoad(const Sheet& sheet, const SheetConstants& constants)
      : s_(sheet), c_(constants), f_(constants.friction) {
    if (constants.R_ohm && s_.resistance_ohm)
      R_ = Term{2.0 * constants.R_ohm->value, relative_doubt(*s_.resistance_ohm)};
    if (constants.K_t_Nm_A) K_t_ = Term{constants.K_t_Nm_A->value, constants.K_e_relative_doubt};
    first_ = point("", s_.no_load_voltage_V ? s_.no_load_voltage_V : s_.nominal_voltage_V,
                   s_.no_load_speed_rpm, s_.no_load_current_mA);
    second_ = point("second ", s_.second_no_load_voltage_V, s_.second_no_load_speed_rpm,
                    s_.second_no_load_current_mA);
  }

  std::vector<NoLoadSides> all() {
    if (!K_t_) return {};
    for (const SheetLine* at : {&first_, &second_}) {
      speed(*at);
      current(*at);
    }
    return std::move(found_);
  }

 private:
  static SheetLine point(std::string name, const std::optional<Quantity>& voltage,
                         const std::optional<Quantity>& speed, const std::optional<Quantity>& current) {
    SheetLine p{std::move(name), std::nullopt, ranged(speed), ranged(current, 1e-3),
                current && current->value == 0.0};
    if (voltage && voltage->value > 0.0) p.U_V = exact(voltage->value);
    return p;
  }

  /// Torque of the dry friction, N m, including the iron's part.
  Term dry_Nm() const {
    return ranged(s_.coulomb_friction_mNm, 1e-3).value_or(Term{}) +
           ranged(s_.iron_coulomb_mNm, 1e-3).value_or(Term{});
  }

  /// Viscous coefficient B, N m s, from its own lines. Default: from the first point minus the dry friction.
  Term viscous_Nm_s() const {
    const Term iron = ranged(s_.iron_viscous_Nm_s).value_or(Term{});
    if (s_.viscous_friction_Nm_s) return ranged(s_.viscous_friction_Nm_s).value_or(Term{}) + iron;
    const std::optional<Term> w = rad_s(first_);
    if (!first_.current_A || !w) return iron;
    const Term loss = *K_t_ * *first_.current_A, dry = dry_Nm();
    return loss.value > dry.value ? (loss - dry) / *w : Term{};
  }

  /// Speed of a line, rad/s: the printed speed. Default: the speed of the ideal line.
  std::optional<Term> rad_s(const SheetLine& at) const {
    if (at.speed_rpm) return *at.speed_rpm * (1.0 / base::rpm_per_rad_s);
    if (!at.U_V || !R_ || !at.current_A) return {};
    const Term drop = *R_ * *at.current_A;
    if (!(drop.value < at.U_V->value)) return {};
    Term w = (*at.U_V - drop) / *K_t_;
    w.doubt += commutation_margin(*at.current_A);
    return w;
  }

  /// Allowed relative difference between friction lines and a no-load current, if one of them belongs to
  /// another motor.
  double friction_doubt(const std::optional<Quantity>& current) const {
    for (const std::optional<Quantity>* q : {&s_.viscous_friction_Nm_s, &s_.coulomb_friction_mNm,
                                             &s_.iron_viscous_Nm_s, &s_.iron_coulomb_mNm, &current})
      if (of_another_motor(*q)) return friction_margin;
    return 0.0;
  }

  /// No-load current I_0 by the friction lines, A, if it is not printed. The speed w follows from U = R I + K
  /// w and K I = T_c + B w, with the voltage U and the torque constant K.
  Term current_of_friction(const Term& U) const {
    const double K = K_t_->value, R = R_->value;
    const Term dry = dry_Nm(), viscous = viscous_Nm_s();
    const double w = (U.value - R * dry.value / K) / (K + R * viscous.value / K);
    if (!(w > 0.0)) return Term{U.value / R, 0.0};
    Term current = (dry + viscous * w) / *K_t_;
    current.doubt += friction_doubt({});
    return current;
  }

  void speed(const SheetLine& at) {
    if (!at.speed_rpm || !at.U_V || !R_) return;
    const bool printed = at.current_A || at.current_is_nothing;
    const Term I = printed ? at.current_A.value_or(Term{}) : current_of_friction(*at.U_V), drop = *R_ * I;
    const bool turns = drop.value < at.U_V->value;
    const std::optional<Quantity>& k_n = s_.speed_constant_rpm_V;
    const bool by_k_n = k_n && k_n->frame == "six-step" && k_n->value > 0.0;
    const Term rpm_V = by_k_n ? Term{k_n->value, relative_doubt(*k_n)} : exact(base::rpm_per_rad_s) / *K_t_;
    NoLoadSides sides{at.name + "no-load speed",
                      by_k_n ? "k_n (U - R I_0)" : "(U - R I_0) / k_M",
                      at.name + "no-load speed",
                      turns ? rpm_V * (*at.U_V - drop) : Term{},
                      *at.speed_rpm,
                      "rpm",
                      no_load_margin,
                      commutation_margin(I),
                      "",
                      false};
    if (!printed) without_current(I, sides);
    if (!turns) sides.remark = "R I_0 uses up the whole voltage: with this current the motor does not turn";
    found_.push_back(std::move(sides));
  }

  /// Widens the tolerance if no I_0 is printed. If the viscous friction is not printed either, the friction
  /// is at least the printed part.
  void without_current(const Term& I, NoLoadSides& sides) const {
    if (I.value > 0.0)
      sides.remark = "I_0 = " + base::rounded(I.value * 1e3, 4) + " mA, computed from the friction lines";
    if (s_.viscous_friction_Nm_s) return;
    sides.above += most_unknown_drop / (1.0 - most_unknown_drop);
    sides.remark =
        I.value > 0.0
            ? sides.remark + "; viscous friction is not printed, and lowers the speed further"
            : "I_0 is taken as 0, because neither I_0 nor friction is printed; both lower the speed";
  }

  /// Compares a no-load current with the friction lines, unless the friction was computed from this current.
  void current(const SheetLine& at) {
    const bool of_points = f_.split_viscous_Nm_s && !s_.coulomb_friction_mNm;
    const bool given =
        s_.viscous_friction_Nm_s || (&at == &second_ && !of_points && f_.no_load_speed_rad_s > 0.0);
    const std::optional<Term> w = rad_s(at);
    if (!at.current_A || !w || !given) return;
    const double margin =
        friction_doubt(&at == &second_ ? s_.second_no_load_current_mA : s_.no_load_current_mA);
    const Term loss = dry_Nm() + viscous_Nm_s() * *w;
    const bool linear = s_.kind == MotorKind::linear;
    found_.push_back(
        {at.name + "no-load current", linear ? "(F_c + B v_0) / k_M" : "(T_c + B w_0) / k_M",
         at.name + "no-load current", loss * 1e3 / *K_t_, *at.current_A * 1e3, "mA", margin, margin,
         margin > 0.0 ? "part of the friction is not from the sheet, and friction differs from motor to motor"
                      : "",
         true});
  }

  /// Margin of the speed below the ideal line for the loss by commutation; at least no_load_margin.
  double commutation_margin(const Term& I) const {
    return std::max(no_load_margin, commutation_part(c_, I.value));
  }

  const Sheet& s_;
  const SheetConstants& c_;
  const Friction& f_;
  std::optional<Term> R_, K_t_;
  SheetLine first_, second_;
  std::vector<NoLoadSides> found_;
};

}  // namespace

std::vector<NoLoadSides> no_load_sides(const Sheet& sheet, const SheetConstants& constants) {
  return NoLoad(sheet, constants).all();
}

}  // namespace sixstep::design
