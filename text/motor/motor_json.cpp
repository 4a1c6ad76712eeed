// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "sixstep/base/linear.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"
#include "text/escape/escape.hpp"
#include "text/escape/json_number.hpp"
#include "text/motor/motor_text.hpp"

namespace text {
namespace {

using Json = nlohmann::ordered_json;

/// Visits a sheet; values that the sheet does not give are omitted.
class SheetJson final : public base::Visitor {
 public:
  Json object = Json::object();

 private:
  void visit_value(std::string_view key, const base::ValueMember& member, const base::About&) override {
    std::visit([&](const auto* of) { put(std::string(key), *of); }, member);
  }
  template <class T>
  void put(const std::string& key, const T& member) {
    object[key] = member;
  }
  template <class T>
  void put(const std::string& key, const std::optional<T>& member) {
    if (member) put(key, *member);
  }
  void visit_word(std::string_view key, base::WordMember& member, const base::About&) override {
    object[std::string(key)] = member.word();
  }
  void visit_quantity(std::string_view given, const base::QuantityMember& member,
                      const base::About& about) override {
    const base::Quantity* const q = quantity_in(member);
    if (!q) return;
    const base::Spelling* linear = base::linear_spelling(about);
    if (!linear || linear->key != q->key)
      linear = nullptr;  // not null if a linear motor's value has a different name
    const std::string_view key = linear ? linear->key : given;
    const auto told = [linear](double x) { return linear ? base::as_spelled(x, *linear) : x; };
    Json entry = {{"value", told(q->value)}, {"unit", linear ? linear->unit : about.unit}};
    if (!q->frame.empty()) entry["frame"] = q->frame;
    if (!q->source.empty()) entry["source"] = q->source;
    if (q->kind != base::Trust::unstated) entry["kind"] = base::word(base::trust_choices, q->kind);
    if (q->range) entry["range"] = {told(q->range->low), told(q->range->high)};
    if (!q->key.empty() && !linear) entry["printed_as"] = q->key;
    object[std::string(key)] = std::move(entry);
  }
};

Json constant(const std::optional<design::Constant>& c) {
  return c ? Json({{"value", c->value}, {"from", c->from}}) : Json(nullptr);
}

/// Friction as JSON; for a linear motor with the names of its SI units.
Json friction(const design::Friction& f, bool linear) {
  const auto name = [linear](const char* turning, const char* moving) { return linear ? moving : turning; };
  return {{name("viscous_Nm_s", "viscous_N_s_m"), f.B_Nm_s},
          {name("coulomb_Nm", "coulomb_N"), f.coulomb_Nm},
          {name("iron_viscous_Nm_s", "iron_viscous_N_s_m"), f.iron.B_Nm_s},
          {name("iron_coulomb_Nm", "iron_coulomb_N"), f.iron.coulomb_Nm},
          {"from", f.from},
          {name("all_viscous_Nm_s", "all_viscous_N_s_m"), or_null(f.all_viscous_Nm_s)},
          {name("all_coulomb_Nm", "all_coulomb_N"), or_null(f.all_coulomb_Nm)},
          {name("split_viscous_Nm_s", "split_viscous_N_s_m"), or_null(f.split_viscous_Nm_s)},
          {name("split_coulomb_Nm", "split_coulomb_N"), or_null(f.split_coulomb_Nm)}};
}

Json model(const design::Sheet& sheet, const design::SheetCheck& check) {
  const design::SheetConstants& c = check.constants;
  const bool linear = sheet.kind == design::MotorKind::linear;
  Json missing = Json::array();
  for (const base::Problem& problem : c.missing) missing.push_back(base::to_string(problem));
  Json out = {{"simulatable", sheet.simulatable && c.missing.empty()}, {"missing", missing}};
  out["pole_pairs"] = c.pole_pairs ? Json(*c.pole_pairs) : Json(nullptr);
  if (linear) out["pole_pitch_m"] = or_null(c.pole_pitch_m);
  out["R_ohm"] = constant(c.R_ohm);
  out["L_H"] = constant(c.L_H);
  out[linear ? "K_e_V_s_m" : "K_e_V_s"] = constant(c.K_e_V_s);
  out[linear ? "K_f_N_A" : "K_t_Nm_A"] = constant(c.K_t_Nm_A);
  out[linear ? "m_kg" : "J_kg_m2"] = constant(c.J_kg_m2);
  out["electrical_time_constant_s"] = or_null(check.electrical_time_constant_s);
  out["mechanical_time_constant_s"] = or_null(check.mechanical_time_constant_s);
  out["stall_current_A"] = or_null(check.stall_current_A);
  out["friction"] = friction(c.friction, linear);
  return out;
}

Json relations(const design::SheetCheck& check) {
  Json list = Json::array();
  for (const design::Relation& r : check.relations) {
    const bool holds = r.verdict == design::RelationVerdict::holds;
    list.push_back({{"name", r.name},
                    {"left", r.left_words},
                    {"right", r.right_words},
                    {"left_value", r.left},
                    {"right_value", r.right},
                    {"unit", r.unit},
                    {"deviation", r.deviation},
                    {"tolerated", {r.lowest, r.highest}},
                    {"verdict", holds                                           ? "ok"
                                : r.verdict == design::RelationVerdict::known   ? "known"
                                : r.verdict == design::RelationVerdict::doubted ? "doubted"
                                                                                : "broken"},
                    {"remark", r.remark}});
  }
  return list;
}

Json lines(const design::SheetCheck& check) {
  Json list = Json::array();
  for (const design::LineUse& line : check.lines)
    list.push_back({{"key", line.key}, {"used", line.used}, {"why", line.why}});
  return list;
}

Json doubts(const design::SheetCheck& check) {
  Json list = Json::array();
  for (const base::Problem& doubt : check.doubts) list.push_back(base::to_string(doubt));
  return list;
}

}  // namespace

std::string motor_json(const design::Sheet& sheet, const design::SheetCheck& check) {
  SheetJson printed;
  design::Sheet copy = sheet;
  describe(printed, copy);
  const Json all = {{"sixstep", SIXSTEP_VERSION},     {"name", sheet.name},
                    {"consistent", check.consistent}, {"relations", relations(check)},
                    {"doubts", doubts(check)},        {"model", model(sheet, check)},
                    {"lines", lines(check)},          {"sheet", std::move(printed.object)}};
  return visible(all.dump(2, ' ', false, Json::error_handler_t::replace), Lines::kept) + "\n";
}

std::string motor_list_json(const std::vector<NamedSheet>& motors) {
  Json list = Json::array();
  for (const NamedSheet& motor : motors) {
    const design::SheetConstants c = design::sheet_constants(motor.sheet);
    const auto value = [](const auto& constant, double times) {
      return constant ? Json(constant->value * times) : Json();
    };
    const bool linear = motor.sheet.kind == design::MotorKind::linear;
    list.push_back({{"name", motor.name},
                    {"title", motor.sheet.name},
                    {"maker", motor.sheet.maker},
                    {"pole_pairs", c.pole_pairs ? Json(*c.pole_pairs) : Json()},
                    {"nominal_voltage_V", c.nominal_voltage_V ? Json(*c.nominal_voltage_V) : Json()},
                    {"terminal_resistance_ohm", value(c.R_ohm, 2.0)},
                    {linear ? "force_constant_N_A" : "torque_constant_Nm_A", value(c.K_t_Nm_A, 1.0)},
                    {linear ? "mass_kg" : "inertia_kg_m2", value(c.J_kg_m2, 1.0)},
                    {"simulatable", motor.sheet.simulatable},
                    {"not_simulatable_because", motor.sheet.not_simulatable_because}});
  }
  return visible(list.dump(2, ' ', false, Json::error_handler_t::replace), Lines::kept) + "\n";
}

}  // namespace text
