// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/sheet/sheet_relations.hpp"

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/linear.hpp"
#include "sixstep/design/sheet/sheet_check.hpp"
#include "sixstep/design/sheet/sheet_factors.hpp"
#include "sixstep/design/sheet/sheet_no_load.hpp"
#include "sixstep/design/sheet/sheet_term.hpp"

namespace sixstep::design {
namespace {

using base::Quantity;

/// Limit of a printed tolerance: a wider tolerance would not be useful.
constexpr double most_above = 9.99;

class Relations {
 public:
  Relations(const Sheet& sheet, const SheetConstants& constants) : s_(sheet), c_(constants) {
    if (c_.R_ohm && s_.resistance_ohm) R_ = Term{2.0 * c_.R_ohm->value, relative_doubt(*s_.resistance_ohm)};
    if (c_.K_t_Nm_A) K_t_ = Term{c_.K_t_Nm_A->value, c_.K_e_relative_doubt};
    if (c_.nominal_voltage_V) U_ = exact(*c_.nominal_voltage_V);
    const std::optional<Quantity>& inertia = s_.with_brake ? s_.inertia_with_brake_gcm2 : s_.inertia_gcm2;
    if (c_.J_kg_m2) J_ = Term{c_.J_kg_m2->value, inertia ? relative_doubt(*inertia) : body_doubt()};
    stall_ = term(s_.stall_current_A);
    if (!stall_ && U_ && R_) stall_ = *U_ / *R_;
    idle_ = term(s_.no_load_current_mA, 1e-3);
  }

  std::vector<Relation> all() {
    stall();
    constants();
    no_load();
    nominal();
    nominal_speed();
    dynamics();
    winding();
    body();
    mechanics();
    if (s_.kind == MotorKind::linear)
      for (Relation& r : found_) in_metres(r);
    return std::move(found_);
  }

 private:
  /// Converts a relation to the words and units of a linear motor. The deviation does not change.
  static void in_metres(Relation& r) {
    const base::LinearUnit unit = base::in_linear(r.unit);
    r.name = base::linear_words(r.name);
    r.left_words = base::linear_words(r.left_words);
    r.right_words = base::linear_words(r.right_words);
    r.unit = unit.linear;
    r.left *= unit.factor;
    r.right *= unit.factor;
  }

  /// Adds a relation. `below` and `above` widen the tolerance beyond rounding. `frames`: true if the value
  /// has a frame, which may be wrong.
  Relation& add(std::string name, std::string left_words, std::string right_words, Term left, Term right,
                std::string unit, double below = 0.0, double above = 0.0, bool frames = true) {
    Relation r;
    r.name = std::move(name);
    r.left_words = std::move(left_words);
    r.right_words = std::move(right_words);
    r.left = left.value;
    r.right = right.value;
    r.unit = std::move(unit);
    r.deviation = left.value / right.value - 1.0;
    const double rounding = left.doubt + right.doubt;
    r.lowest = -(rounding + below);
    r.highest = rounding + above;
    // A small tolerance for the arithmetic: two equal exact numbers must fulfil the relation.
    constexpr double arithmetic = 1e-12;
    const bool holds = r.deviation >= r.lowest - arithmetic && r.deviation <= r.highest + arithmetic;
    r.verdict = holds ? RelationVerdict::holds : RelationVerdict::broken;
    if (!holds) r.remark = well_known_factor(left.value / right.value, rounding, frames);
    return found_.emplace_back(std::move(r));
  }

  static bool near(const Term& left, const Term& right) {
    return std::abs(left.value / right.value - 1.0) <= left.doubt + right.doubt;
  }

  /// Names one bad value of U/R, I_stall and the stall torque if the other two agree.
  void stall() {
    const std::optional<Term> torque = term(s_.stall_torque_mNm);
    const bool computed = U_ && R_, printed = s_.stall_current_A.has_value();
    std::string suspect;
    bool by_U = !printed;
    if (computed && printed && !near(*U_ / *R_, *stall_) && torque && K_t_) {
      by_U = near(*K_t_ * (*U_ / *R_) * 1e3, *torque);
      if (by_U)
        suspect = "the stall torque agrees with k_M U / R: check the stall current";
      else if (near(*K_t_ * *stall_ * 1e3, *torque))
        suspect = "the stall torque agrees with the stall current: check the resistance and the voltage";
    }
    if (computed && printed) {
      Relation& r = add("stall current", "U / R", "stall current", *U_ / *R_, *stall_, "A");
      if (!suspect.empty()) r.remark += (r.remark.empty() ? "" : " ") + suspect;
    }
    if (computed && by_U) stall_ = *U_ / *R_;  // the efficiency uses this value too
    if (torque && K_t_ && stall_)
      add("stall torque", by_U ? "k_M U / R" : "k_M I_stall", "stall torque", *K_t_ * *stall_ * 1e3, *torque,
          "mNm");
  }

  /// Compares further printed constants with the constant of the model.
  void constants() {
    for (const OtherWay& other : c_.other_ways) {
      const std::optional<Quantity>& k_n = s_.speed_constant_rpm_V;
      if (other.key == "speed_constant_rpm_V" && k_n->frame == "six-step" && K_t_)
        add("speed constant", "k_M k_n", "30000 / pi", *K_t_ * 1e3 * Term{k_n->value, other.relative_doubt},
            exact(1000.0 * base::rpm_per_rad_s), "rpm/V mNm/A");
      else
        with_pole_pairs(add("K_e by " + other.key, "K_e used", "K_e by " + other.key,
                            Term{c_.K_e_V_s->value * 1e3, c_.K_e_relative_doubt},
                            Term{other.K_e_V_s * 1e3, other.relative_doubt}, "mV s"));
    }
  }

  /// A constant per electrical angle is converted by the pole pairs.
  static void with_pole_pairs(Relation& r) {
    if (r.remark == well_known_factors[0].words)
      r.remark = "a factor 2: terminal against phase, or poles against pole pairs?";
  }

  void no_load() {
    for (const NoLoadSides& n : no_load_sides(s_, c_)) {
      // The two sides are torques, which have no frame, although the relation is named after a current.
      Relation& r =
          add(n.name, n.left_words, n.right_words, n.left, n.right, n.unit, n.below, n.above, !n.of_friction);
      const bool lacks_dry = n.of_friction && r.verdict == RelationVerdict::broken && r.deviation < 0.0 &&
                             !s_.coulomb_friction_mNm;
      if (lacks_dry)
        r.remark = s_.kind == MotorKind::linear
                       ? "Coulomb friction F_c is not given; F_c would increase the left side"
                       : "Coulomb friction T_c is not given; T_c would increase the left side";
      if (r.remark.empty()) r.remark = n.remark;
    }
  }

  /// Torque per ampere of the printed current: of the terminal current, or of the rms value.
  Term per_ampere() const {
    const bool rms = s_.nominal_current_A && s_.nominal_current_A->frame == "rms";
    return rms ? Term{torque_per_rms_A(c_.K_e_V_s->value, c_.shape), K_t_->doubt} : *K_t_;
  }

  /// Lowest nominal speed that a warm motor can explain: by the usual drop, or by warm winding and
  /// commutation.
  double slowest_nominal(const Term& top, const Term& drop, double torque_Nm) const {
    const double current_A = torque_Nm / K_t_->value + (idle_ ? idle_->value : 0.0);
    return std::fmin(top.value - most_nominal_drop * drop.value,
                     (top.value - warm_winding * drop.value) / (1.0 + commutation_part(c_, current_A)));
  }

  /// Compares the nominal speed with the no-load speed minus gradient times torque. It may be lower by the
  /// additional drop of a warm motor.
  void nominal_speed() {
    const std::optional<Term> printed = term(s_.nominal_speed_rpm), current = term(s_.nominal_current_A);
    if (!printed) return;
    std::optional<Term> idle = term(s_.no_load_speed_rpm), torque = term(s_.nominal_torque_mNm, 1e-3);
    if (s_.no_load_voltage_V && (!U_ || s_.no_load_voltage_V->value != U_->value)) idle.reset();
    if (!torque && current && K_t_) torque = per_ampere() * *current;
    if (!K_t_ || !R_ || !torque || !(idle || U_)) {
      if (idle && printed->value >= idle->value) as_fast_as_idle(*idle, *printed);
      return;
    }
    const Term top = idle ? *idle : *U_ / *K_t_ * base::rpm_per_rad_s;
    const Term drop = *R_ / (*K_t_ * *K_t_) * *torque * base::rpm_per_rad_s;
    if (idle && printed->value >= idle->value) return as_fast_as_idle(*idle, *printed);
    const Term line = drop.value < top.value ? top - drop : Term{};
    const double warm = slowest_nominal(top, drop, torque->value);
    const double above = warm > 0.0 ? line.value / warm - 1.0 : HUGE_VAL;
    Relation& r = add("nominal speed", idle ? "n_0 - R/k_M^2 M_N" : "U/k_M - R/k_M^2 M_N", "nominal speed",
                      line, *printed, "rpm", no_load_margin, std::fmin(above, most_above), false);
    if (r.verdict == RelationVerdict::holds) r.remark = beside_the_line(torque->value);
    if (r.verdict != RelationVerdict::broken) return;
    if (r.deviation > 0.0) {
      r.verdict = RelationVerdict::doubted;
      r.remark =
          "neither a warm winding nor commutation explains the deviation: the motor's drive limits the speed, or a value of the nominal point is wrong";
    } else if (r.remark.empty()) {
      r.remark = "the nominal point lies above the ideal line, U/k_M - R/k_M^2 M";
    }
  }

  /// Remark that the line neglects commutation, which the model contains. Empty if commutation reduces the
  /// speed by less than a twentieth.
  std::string beside_the_line(double torque_Nm) const {
    constexpr double worth_it = 0.05;
    const double part =
        commutation_part(c_, (torque_Nm / K_t_->value + (idle_ ? idle_->value : 0.0)) / edge_current);
    if (!(part > worth_it)) return "";
    return "the computed speed is on the ideal line: in the model commutation lowers the speed by about " +
           rounded(100.0 * part / (1.0 + part), 2) +
           " %; the torque-speed curve has the speed that the model reaches";
  }

  void as_fast_as_idle(const Term& idle, const Term& printed) {
    Relation& r =
        add("nominal speed", "no-load speed", "nominal speed", idle, printed, "rpm", 0.0, 0.0, false);
    r.verdict = RelationVerdict::broken;
    r.highest = most_above;
    r.lowest = 0.0;
    r.remark = "a loaded motor turns more slowly than a motor without load";
  }

  void nominal() {
    const std::optional<Term> torque = term(s_.nominal_torque_mNm), current = term(s_.nominal_current_A);
    if (torque && current && K_t_) {
      // Some sheets subtract the friction, K_t (I_N - I_0), others do not. The torque is at most K_t I_N.
      const bool rms = s_.nominal_current_A->frame == "rms", known = idle_ && idle_->value < current->value;
      const Term computed = per_ampere() * *current * 1e3;
      double friction = 0.0;
      if (known && !rms) {
        // I/(I - I_0) - 1, with I and I_0 at the limits of their rounding. Without friction, I K_t already
        // contains the rounding of I.
        const double idle = idle_->value * (1.0 + idle_->doubt),
                     least = current->value * (1.0 - current->doubt);
        // This factor multiplies the factor of the rounding, which add() adds.
        const double share = (1.0 + computed.doubt + torque->doubt) * idle / (least - idle);
        friction = idle < least ? std::fmin(share, most_above) : most_above;
      }
      Relation& r = add("nominal torque", rms ? "K_rms I_N" : "k_M I_N", "nominal torque", computed, *torque,
                        "mNm", 0.0, friction);
      if (r.verdict == RelationVerdict::broken && r.deviation < 0.0 && r.remark.empty())
        r.remark =
            "the nominal torque is above the torque of the nominal current; the model does not use the nominal torque";
    }
    if (const std::optional<Term> printed = term(s_.max_efficiency_percent);
        printed && idle_ && stall_ && idle_->value < stall_->value) {
      // With x = sqrt(I_0/I_stall) the best efficiency is (1 - x)^2 if friction is the same at every speed,
      // and (1 - x)/(1 + x) if it grows with speed, both at the current sqrt(I_0 I_stall). A relative error d
      // of the ratio changes the result by x d/(1 - x).
      const double x = std::sqrt(idle_->value / stall_->value);
      const Term computed = {100.0 * (1.0 - x) * (1.0 - x), (idle_->doubt + stall_->doubt) * x / (1.0 - x)};
      const double viscous = 100.0 * (1.0 - x) / (1.0 + x);
      add("max. efficiency", "(1 - sqrt(I_0 / I_stall))^2", "max. efficiency", computed, *printed, "percent",
          1.0 - computed.value / viscous);
    }
  }

  void dynamics() {
    if (const std::optional<Term> printed = term(s_.electrical_time_constant_ms); printed && c_.L_H && R_) {
      const double doubt = s_.inductance_mH ? relative_doubt(*s_.inductance_mH) : 0.0;
      add("electrical time constant", "L / R", "electrical time constant",
          Term{2e3 * c_.L_H->value, doubt} / *R_, *printed, "ms");
    }
    if (!R_ || !K_t_) return;
    const Term steepness = *R_ / (*K_t_ * *K_t_);  // rad/s per N m
    if (const std::optional<Term> printed = term(s_.mechanical_time_constant_ms); printed && J_)
      add("mechanical time constant", "R J / k_M^2", "mechanical time constant", steepness * *J_ * 1e3,
          *printed, "ms");
    if (const std::optional<Term> printed = term(s_.speed_torque_gradient_rpm_mNm))
      add("speed/torque gradient", "R / k_M^2", "speed/torque gradient",
          steepness * (base::rpm_per_rad_s * 1e-3), *printed, "rpm/mNm");
  }

  /// Relative rounding error of r^4 - r_i^4 from the rotor's dimensions.
  double body_doubt() const {
    const auto doubt = [](const std::optional<Quantity>& q) { return q ? relative_doubt(*q) : 0.0; };
    const double r = s_.rotor_radius_mm ? s_.rotor_radius_mm->value : 0.0;
    const double r_i = s_.rotor_inner_radius_mm ? s_.rotor_inner_radius_mm->value : 0.0;
    const double part = r > 0.0 ? r_i * r_i * r_i * r_i / (r * r * r * r) : 0.0;
    const double radii =
        part < 1.0 ? 4 * (doubt(s_.rotor_radius_mm) + part * doubt(s_.rotor_inner_radius_mm)) / (1 - part)
                   : 0.0;
    return radii + doubt(s_.rotor_length_mm) + doubt(s_.rotor_density_kg_m3);
  }

  /// Compares the printed inertia with the inertia of the rotor's dimensions.
  void body() {
    if (!c_.J_of_body_kg_m2 || !s_.inertia_gcm2 || !J_) return;
    const Term printed{s_.inertia_gcm2->value, relative_doubt(*s_.inertia_gcm2)};
    Relation& r = add("inertia", s_.rotor_inner_radius_mm ? "pi/2 rho l (r^4 - r_i^4)" : "pi/2 rho l r^4",
                      "inertia", Term{c_.J_of_body_kg_m2->value * 1e7, body_doubt()}, printed, "g cm2",
                      body_margin, body_margin, false);
    if (r.verdict == RelationVerdict::broken && std::abs(r.left / r.right / 16.0 - 1.0) < 0.3)
      r.remark =
          "the dimensions give about 16 times the printed inertia: check whether rotor_radius_mm holds the diameter";
  }

  /// Checks the no-load speed against the mechanical limit. They need not agree, because a bus may be lower
  /// than the nominal voltage. But a speed far above the limit shows that a line was read wrongly.
  void mechanics() {
    const std::optional<Term> allowed = term(s_.max_speed_rpm), printed = term(s_.no_load_speed_rpm);
    if (!allowed || !(printed || (U_ && K_t_))) return;
    const Term ideal = printed ? *printed : *U_ / *K_t_ * base::rpm_per_rad_s;
    if (!(ideal.value > allowed->value)) return;
    Relation& r = add("maximum speed", printed ? "no-load speed" : "U / k_M", "maximum speed", ideal,
                      *allowed, "rpm", 1.0, max_speed_margin, false);
    if (r.verdict == RelationVerdict::holds)
      r.remark =
          "the no-load speed at the nominal voltage is above the maximum speed: limit speed or voltage; up to twice the maximum "
          "speed is tolerated, because makers wind one rotor for several voltages";
    else if (r.remark.empty())
      r.remark = "at the nominal voltage the motor would turn far faster than its mechanics allow";
  }

  /// Adds the relation that two lines of the pole pairs agree. A contradiction between them is already a
  /// Problem.
  void winding() {
    if (!s_.pole_pairs || (s_.winding.empty() && !s_.poles) || !c_.pole_pairs) return;
    const double pairs = *c_.pole_pairs;
    add("pole pairs", s_.winding.empty() ? "poles / 2" : "poles of " + s_.winding + " / 2", "pole pairs",
        exact(pairs), exact(pairs), "");
  }

  const Sheet& s_;
  const SheetConstants& c_;
  std::optional<Term> U_, R_, K_t_, J_, stall_, idle_;
  std::vector<Relation> found_;
};

}  // namespace

std::vector<Relation> relations_of(const Sheet& sheet, const SheetConstants& constants) {
  return Relations(sheet, constants).all();
}

}  // namespace sixstep::design
