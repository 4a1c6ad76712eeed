// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/sheet/sheet_check.hpp"

#include <algorithm>
#include <string_view>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/linear.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"
#include "sixstep/design/sheet/sheet_reader.hpp"
#include "sixstep/design/sheet/sheet_relations.hpp"

namespace sixstep::design {
namespace {

using base::Quantity;

/// Reason why the model does not use a line. A key without an entry here prints a value that another key has
/// given already.
struct Reason {
  std::string_view key;
  std::string_view why;
};
constexpr Reason reasons[] = {
    {"nominal_voltage_V",
     "the scenario's supply sets the bus voltage; the sheet's other values hold at this voltage"},
    {"no_load_voltage_V", "the voltage of the no-load point"},
    {"second_no_load_voltage_V", "the voltage of the second no-load point"},
    {"nominal_speed_rpm", "a rating, for the winding temperature that the maker chose"},
    {"nominal_torque_mNm",
     "a rating; makers disagree whether friction is subtracted, so K_t is not computed from the nominal torque"},
    {"nominal_current_A", "a rating"},
    {"stall_torque_mNm",
     "not a parameter of the motor: the relations compare this value with the other values"},
    {"stall_current_A", "follows from U / R"},
    {"max_efficiency_percent", "follows from the other lines"},
    {"speed_torque_gradient_rpm_mNm", "follows from R and K_t"},
    {"mechanical_time_constant_ms", "follows from R, J and K_t"},
    {"electrical_time_constant_ms", "follows from L and R"},
    {"max_speed_rpm", "a limit of the mechanics"},
    {"rotor_radius_mm", "not used, because the inertia is printed"},
    {"rotor_inner_radius_mm", "not used, because the inertia is printed"},
    {"rotor_length_mm", "not used, because the inertia is printed"},
    {"rotor_density_kg_m3", "not used, because the inertia is printed"},
    {"inertia_gcm2", "the motor carries its brake: inertia_with_brake_gcm2 is used"},
    {"inertia_with_brake_gcm2", "the motor carries no brake: inertia_gcm2 is used"},
    {"thermal_resistance_winding_housing_K_W",
     "used only by [heat] and the thermal curve; without them the motor stays at the sheet's temperature"},
    {"thermal_resistance_housing_ambient_K_W",
     "used only by [heat] and the thermal curve; without them the motor stays at the sheet's temperature"},
    {"thermal_time_constant_winding_s",
     "used only by [heat] and the thermal curve; without them the motor stays at the sheet's temperature"},
    {"thermal_time_constant_motor_s",
     "used only by [heat] and the thermal curve; without them the motor stays at the sheet's temperature"},
    {"max_winding_temperature_degC", "a limit"},
};

/// Visitor that records, for each quantity of the sheet, whether the model uses it.
class Lines final : public base::Visitor {
 public:
  explicit Lines(const SheetConstants& constants) : constants_(constants) {}

  std::vector<LineUse> lines;

 private:
  void visit_quantity(std::string_view key, const base::QuantityMember& member,
                      const base::About& about) override {
    const Quantity* const q = quantity_in(member);
    if (!q) return;
    const bool geometry = key == "active_length_mm" || key == "air_gap_radius_mm";
    const bool body = key.starts_with("rotor_");
    const std::string_view judged = geometry ? std::string_view("flux_density_T")
                                    : body   ? std::string_view("rotor_radius_mm")
                                             : key;
    const auto& used = constants_.used;
    LineUse line{.key = SheetReader::key_of(key, *q),
                 .value = q->value,
                 .unit = std::string(about.unit),
                 .in_file = q->value,
                 .doubt = relative_doubt(*q),
                 .used = false,
                 .why = ""};
    for (const base::Spelling& spelling : about.also)
      if (spelling.key == q->key) line.in_file = base::as_spelled(q->value, spelling);
    line.used = std::find(used.begin(), used.end(), judged) != used.end();
    if (!line.used) line.why = why_not(key);
    lines.push_back(std::move(line));
  }
  std::string why_not(std::string_view key) const {
    if (key.ends_with("no_load_speed_rpm") || key.ends_with("no_load_current_mA")) return why_no_point(key);
    for (const Reason& reason : reasons)
      if (reason.key == key) return std::string(reason.why);
    if (constants_.K_e_V_s)
      return "a second value of the torque constant, which the model reads from " + constants_.K_e_V_s->from;
    return "not used, because other values that this line needs are missing";
  }
  /// A no-load point determines the friction only if the point is complete and no other line contains the
  /// friction.
  std::string why_no_point(std::string_view key) const {
    const Friction& f = constants_.friction;
    const auto& used = constants_.used;
    const bool whole =
        key.starts_with("second_") ? f.split_viscous_Nm_s.has_value() : f.no_load_speed_rad_s > 0.0;
    if (whole || std::find(used.begin(), used.end(), "viscous_friction_Nm_s") != used.end())
      return "friction is given by other lines";
    return "friction follows from a no-load current with its speed, or with its voltage, R and K_t";
  }
  const SheetConstants& constants_;
};

void judge_known(const Sheet& sheet, SheetCheck& check, base::Problems& problems) {
  for (const std::string& name : sheet.known_deviation) {
    const auto relation = std::find_if(check.relations.begin(), check.relations.end(),
                                       [&](const Relation& r) { return r.name == name; });
    if (relation == check.relations.end()) {
      std::string known;
      for (const Relation& r : check.relations) known += (known.empty() ? "" : ", ") + r.name;
      problems.push_back({"known_deviation", "\"" + name + "\"",
                          "is not the name of a relation of this sheet",
                          known.empty() ? "remove this name: no two values of this sheet can be compared"
                                        : "name one of these: " + known});
    } else if (relation->verdict == RelationVerdict::holds) {
      problems.push_back(
          {"known_deviation", "\"" + name + "\"", "names a relation that holds", "remove this name"});
    } else {
      relation->verdict = RelationVerdict::known;
    }
  }
}

/// The limit as text: "gives the rotor a time constant R J/K_t^2 of 440 s, and almost no motor has more than 100 s".
std::string slow_words(const char* what, double seconds, double usual_s) {
  return std::string("gives ") + what + " of " + rounded(seconds, 3) +
         " s, and almost no motor has more than " + rounded(usual_s, 3) + " s";
}

/// Reports values with which a motor is too slow, probably because of a wrong unit. They can be simulated,
/// and possibly no relation of the sheet shows the error.
void doubt_pace(const Sheet& sheet, SheetCheck& check) {
  SheetConstants& c = check.constants;
  const SheetReader reader{sheet, c};
  const auto doubt = [&](std::string_view key, const std::optional<Quantity>& q, std::string limit,
                         const char* cure) {
    check.doubts.push_back({q ? SheetReader::key_of(key, *q) : std::string(key),
                            q ? reader.value_of(key, *q) : "", std::move(limit), cure});
  };
  const std::optional<double>&winding = check.electrical_time_constant_s,
        &rotor = check.mechanical_time_constant_s;
  if (winding && *winding > slowest_usual_winding_s) {
    const bool axes = !sheet.inductance_mH && sheet.d_axis_inductance_mH;
    doubt(axes ? "d_axis_inductance_mH" : "inductance_mH",
          axes ? sheet.d_axis_inductance_mH : sheet.inductance_mH,
          slow_words("the winding a time constant L/R", *winding, slowest_usual_winding_s),
          "correct the unit of inductance or resistance");
  }
  if (rotor && *rotor > slowest_usual_rotor_s) {
    const bool braked = sheet.with_brake && sheet.inertia_with_brake_gcm2;
    const std::string from = c.J_kg_m2->from.substr(0, c.J_kg_m2->from.find(','));
    const std::optional<Quantity>& q = braked ? sheet.inertia_with_brake_gcm2 : sheet.inertia_gcm2;
    const bool linear = sheet.kind == MotorKind::linear;
    if (q)
      doubt(braked ? "inertia_with_brake_gcm2" : "inertia_gcm2", q,
            slow_words(linear ? "the slide a time constant R m/K_f^2" : "the rotor a time constant R J/K_t^2",
                       *rotor, slowest_usual_rotor_s),
            linear ? "correct the unit of the mass, of the force constant or of the resistance"
                   : "correct the unit of the inertia, of the torque constant or of the resistance");
    else
      doubt(from, {}, slow_words("the rotor a time constant R J/K_t^2", *rotor, slowest_usual_rotor_s),
            "correct the units of the rotor's dimensions, of the torque constant or of the resistance");
  }
}

/// Prefixes of numbered lines whose number fixes the frame of the value, as on maxon's sheets.
constexpr std::string_view framed_lines[] = {"line_6_", "line_10_", "line_11_", "line_12_", "line_13_"};

void doubt_maker(const Sheet& sheet, SheetCheck& check) {
  std::string maker = sheet.maker;
  std::transform(maker.begin(), maker.end(), maker.begin(),
                 [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (maker.find("maxon") != std::string::npos) return;
  const auto numbered = std::find_if(check.lines.begin(), check.lines.end(), [](const LineUse& line) {
    return std::any_of(std::begin(framed_lines), std::end(framed_lines),
                       [&](std::string_view start) { return line.key.starts_with(start); });
  });
  if (numbered != check.lines.end())
    check.doubts.push_back({numbered->key, "",
                            "is a numbered line of maxon's sheets, which determines the value's frame",
                            "give maker = \"maxon\", or write keys without numbers, with their frames"});
}

}  // namespace

double commutation_part(const SheetConstants& c, double current_A) {
  const std::optional<double> pairs = c.electrical_per_mechanical();
  if (!pairs || !c.L_H || !c.K_t_Nm_A) return 0.0;
  return edge_current * 3.0 * *pairs * c.L_H->value * current_A / (base::pi * c.K_t_Nm_A->value);
}

base::Result<SheetCheck> check_sheet(const Sheet& sheet) {
  SheetCheck check;
  check.constants = sheet_constants(sheet);
  const SheetConstants& c = check.constants;
  if (!c.problems.empty()) return c.problems;
  check.relations = relations_of(sheet, c);
  base::Problems problems;
  judge_known(sheet, check, problems);
  if (!problems.empty()) return problems;
  for (const Relation& r : check.relations)
    check.consistent = check.consistent && r.verdict != RelationVerdict::broken;
  Lines lines(c);
  Sheet copy = sheet;
  describe(lines, copy);
  check.lines = std::move(lines.lines);
  if (sheet.kind == MotorKind::linear)
    for (LineUse& line : check.lines) line.why = base::linear_words(line.why);
  if (c.R_ohm && c.L_H) check.electrical_time_constant_s = c.L_H->value / c.R_ohm->value;
  if (c.R_ohm && c.J_kg_m2 && c.K_t_Nm_A)
    check.mechanical_time_constant_s =
        2.0 * c.R_ohm->value * c.J_kg_m2->value / (c.K_t_Nm_A->value * c.K_t_Nm_A->value);
  doubt_pace(sheet, check);
  doubt_maker(sheet, check);
  if (c.R_ohm && c.nominal_voltage_V) check.stall_current_A = *c.nominal_voltage_V / (2.0 * c.R_ohm->value);
  return check;
}

std::string contradiction_words(const SheetCheck& check) {
  std::vector<std::string> broken;
  for (const Relation& r : check.relations)
    if (r.verdict == RelationVerdict::broken) broken.push_back(r.name);
  if (broken.empty()) return "";
  std::string names;
  for (std::size_t n = 0; n < broken.size(); ++n)
    names += (n == 0 ? "" : n + 1 == broken.size() ? " and " : ", ") + broken[n];
  return "the motor's sheet contradicts itself: " + names +
         (broken.size() == 1 ? " disagrees" : " disagree") +
         " with the other values; correct the motor file, or name " +
         (broken.size() == 1 ? "this relation" : "these relations") +
         " in known_deviation if the maker's sheet has these values";
}

}  // namespace sixstep::design
