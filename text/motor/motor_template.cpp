// SPDX-License-Identifier: Apache-2.0
#include "text/motor/motor_template.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/escape/escape.hpp"
#include "text/keys/key_advice.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/keys/key_tree.hpp"
#include "text/keys/template_line.hpp"

namespace text {
namespace {

struct Style {
  std::string_view name;
  std::string_view what;
  std::string_view shape;                  ///< the back-EMF that such a sheet means, to be looked at
  std::vector<std::string_view> needed;    ///< a model needs them
  std::vector<std::string_view> optional;  ///< worth typing in: they are checked against the others
  bool linear = false;
};

const std::vector<Style>& styles() {
  static const std::vector<Style> all = {
      {"maxon",
       "numbered lines, values between two terminals",
       "trapezoid",
       {"line_29_number_of_pole_pairs", "line_1_nominal_voltage_V", "line_10_terminal_resistance_ohm",
        "line_11_terminal_inductance_mH", "line_12_torque_constant_mNm_A", "line_16_rotor_inertia_gcm2"},
       {"line_2_no_load_speed_rpm", "line_3_no_load_current_mA", "line_4_nominal_speed_rpm",
        "line_5_nominal_torque_mNm", "line_6_nominal_current_A", "line_7_stall_torque_mNm",
        "line_8_stall_current_A", "line_9_max_efficiency_percent", "line_13_speed_constant_rpm_V",
        "line_14_speed_torque_gradient_rpm_mNm", "line_15_mechanical_time_constant_ms",
        "line_17_thermal_resistance_housing_ambient_K_W", "line_18_thermal_resistance_winding_housing_K_W",
        "line_19_thermal_time_constant_winding_s", "line_20_thermal_time_constant_motor_s",
        "line_22_max_winding_temperature_degC", "line_23_max_speed_rpm"}},
      {"drone",
       "KV, internal resistance, teeth and poles, idle current at a voltage",
       "sine",
       {"winding", "nominal_voltage_V", "speed_constant_rpm_V", "resistance_mohm", "inductance_uH",
        "inertia_gcm2"},
       {"idle_current_A", "idle_voltage_V", "no_load_speed_rpm", "max_speed_rpm"}},
      {"servo",
       "torque per ampere rms, back-EMF per 1000 rpm, inertia with and without brake",
       "sine",
       {"poles", "nominal_voltage_V", "torque_constant_Nm_A", "resistance_ohm", "inductance_mH",
        "inertia_kgcm2"},
       {"back_emf_constant_V_krpm", "inertia_with_brake_kgcm2", "with_brake", "nominal_torque_Nm",
        "nominal_current_A", "nominal_speed_rpm", "max_speed_rpm"}},
      {"linear",
       "force per ampere, pole pitch, moving mass",
       "sine",
       {"pole_pitch_mm", "nominal_voltage_V", "resistance_ohm", "inductance_mH", "force_constant_N_A",
        "mass_kg"},
       {"back_emf_V_s_m", "nominal_force_N", "nominal_current_A", "nominal_speed_m_s", "stall_force_N",
        "stall_current_A", "no_load_speed_m_s", "no_load_current_mA", "viscous_friction_N_s_m",
        "coulomb_friction_N", "max_speed_m_s", "thermal_resistance_winding_housing_K_W",
        "thermal_resistance_housing_ambient_K_W", "thermal_time_constant_winding_s",
        "thermal_time_constant_motor_s", "max_winding_temperature_degC"},
       true},
      {"firmware",
       "what a drive identifies: R, L and flux linkage of one phase",
       "sine",
       {"pole_pairs", "resistance_ohm", "inductance_uH", "flux_linkage_mWb", "inertia_kgm2"},
       {"nominal_voltage_V", "speed_constant_rpm_V", "viscous_friction_Nm_s", "coulomb_friction_mNm"}},
  };
  return all;
}

/// Another spelling is told in its own unit; a linear motor's has become the key's own.
KeyEntry as_spelled(const KeyEntry& entry, std::string_view key) {
  for (const base::Spelling& spelling : entry.about.also)
    if (spelling.key == key) return spelled(entry, spelling);
  return entry;
}

/// "frame = "terminal|phase"" stands until the reader strikes out one of the two: no frame has that name.
std::string empty_value(const KeyEntry& entry) {
  if (entry.type == KeyType::text) return "\"\"";
  if (entry.type == KeyType::flag) return "true";
  if (entry.type != KeyType::quantity) return "0";
  if (frames_of(entry.about.frame).size() < 2) return "{ value = nan, source = \"data sheet\" }";
  return fmt::format("{{ value = nan, frame = \"{}\", source = \"data sheet\" }}", entry.about.frame);
}

std::string line(const KeyEntry& given, std::string_view key, bool needed) {
  const KeyEntry entry = as_spelled(given, key);
  const bool choice = frames_of(entry.about.frame).size() > 1;
  return template_line(entry, {.key = key,
                               .value = empty_value(entry),
                               .open = needed,
                               .more = choice ? "frame: keep the one that the sheet means" : ""});
}

}  // namespace

std::vector<std::string> template_styles() {
  std::vector<std::string> names;
  for (const Style& style : styles()) names.emplace_back(style.name);
  return names;
}

base::Result<std::string> motor_template(std::string_view style_name, const std::string& name) {
  const auto style =
      std::find_if(styles().begin(), styles().end(), [&](const Style& s) { return s.name == style_name; });
  if (style == styles().end())
    return base::Problem{.where = "--style",
                         .value = std::string(style_name),
                         .limit = fmt::format("is none of {}", fmt::join(template_styles(), ", ")),
                         .cure = "choose the one whose sheet looks like yours"};
  const std::vector<KeyEntry> keys = style->linear ? in_linear_words(sheet_keys()) : sheet_keys();
  std::string text = fmt::format(
      "# A motor, to be filled in from its sheet: {}.\n"
      "# Each nan wants a number; take the # away from other lines that the sheet has. sixstep help KEY says "
      "more\n"
      "# of each, and sixstep motor check FILE holds the sheet against itself.\n"
      "name = {}\nmaker = \"\"\n{}\n"
      "# shape of the back-EMF over the electrical angle, trapezoid or sine: sheets rarely say it\n"
      "back_emf = \"{}\"\n\n",
      style->what, toml_text(name), style->linear ? "kind = \"linear\"  # it moves along a line\n" : "",
      style->shape);
  for (const std::string_view key : style->needed)
    if (const KeyEntry* entry = find_key(keys, key)) text += line(*entry, key, true);
  text += "\n";
  for (const std::string_view key : style->optional)
    if (const KeyEntry* entry = find_key(keys, key)) text += line(*entry, key, false);
  return text;
}

}  // namespace text
