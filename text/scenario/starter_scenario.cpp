// SPDX-License-Identifier: Apache-2.0
#include "text/scenario/starter_scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string_view>

#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/operating_limits.hpp"
#include "text/escape/escape.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/keys/key_tree.hpp"
#include "text/keys/template_line.hpp"
#include "text/scenario/json_schema.hpp"
#include "text/scenario/scenario_text.hpp"

namespace text {
namespace {

using sixstep::control::Mode;

struct Wanted {
  std::string path;
  bool open = false;  ///< true: the line is active even if it only repeats the default
};

/// Keys that a first scenario shows in addition to the keys that it sets.
std::vector<Wanted> wanted_keys(Mode mode) {
  std::vector<Wanted> keys = {{"title", true},
                              {"supply.voltage_V", true},
                              {"supply.resistance_ohm"},
                              {"supply.capacitance_F"},
                              {"bridge.on_resistance_ohm"},
                              {"bridge.diode_drop_V"},
                              {"bridge.dead_time_s"},
                              {"pwm.period_s", true},
                              {"pwm.chopping", true},
                              {"pwm.delay_periods"},
                              {"pwm.pattern"},
                              {"reference.shape", true},
                              {"reference.unit", true},
                              {"load.torque_Nm", true},
                              {"load.inertia_kg_m2"},
                              {"load.coulomb_Nm"},
                              {"initial.speed_rad_s"},
                              {"record.grid_s"},
                              {"record.events"}};
  if (mode == Mode::current) keys.push_back({"load.locked", true});
  if (mode != Mode::duty) {
    keys.push_back({"control.current.commutation"});
    keys.push_back({"control.limits.current_A"});
  }
  if (mode == Mode::position) keys.push_back({"control.position.speed_limit_rad_s"});
  return keys;
}

/// The value of a line for which the scenario has no value. Reading refuses it until the user gives a number.
std::string placeholder(const KeyEntry& entry) {
  if (!entry.default_value.empty()) return entry.default_value;
  switch (entry.type) {
    case KeyType::flag:
      return "false";
    case KeyType::text:
      return "\"\"";
    case KeyType::numbers:
    case KeyType::texts:
      return "[]";
    case KeyType::word:
      return fmt::format("\"{}\"", entry.choices.front().first);
    default:
      return "nan";
  }
}

/// Writes "3e-05" in engineering form, "30e-6", which is the same number. Other texts are unchanged.
std::string with_plain_exponent(const std::string& text) {
  const std::size_t cut = text.find('e');
  if (cut == std::string::npos || text.find_first_not_of("-.0123456789") != cut) return text;
  std::string digits = text.substr(0, cut);
  int power = std::atoi(text.c_str() + cut + 1);
  if (digits.find('.') == std::string::npos) digits += '.';
  for (; power % 3 != 0; --power) {  // moves the point one digit to the right
    const std::size_t point = digits.find('.');
    if (point + 1 == digits.size()) digits += '0';
    std::swap(digits[point], digits[point + 1]);
  }
  if (digits.back() == '.') digits.pop_back();
  return fmt::format("{}e{}", digits, power);
}

/// The scenario without `extends`, because a written-out scenario already contains everything that it
/// extends.
study::Scenario alone(study::Scenario scenario) {
  scenario.extends.clear();
  return scenario;
}

/// The keys in the words of the scenario's motor.
std::vector<KeyEntry> keys_for(const study::Scenario& scenario) {
  return scenario.sheet.kind == design::MotorKind::rotary ? scenario_keys()
                                                          : in_linear_words(scenario_keys());
}

std::vector<Wanted> wanted_for(const study::Scenario& scenario) {
  std::vector<Wanted> wanted = wanted_keys(scenario.control.mode);
  const std::vector<KeyEntry>& turning = scenario_keys();
  const std::vector<KeyEntry> own = keys_for(scenario);
  for (Wanted& key : wanted)
    for (std::size_t n = 0; n < turning.size(); ++n)
      if (turning[n].path == key.path) {
        key.path = own[n].path;
        break;
      }
  return wanted;
}

/// The source of a torque limit if the sheet has no nominal current: the key's meaning would wrongly refer to
/// this current.
std::string torque_limit_origin(const study::Scenario& s) {
  const base::Result<design::MotorModel> motor = design::motor_model(s.sheet);
  const std::optional<double>& limit = s.control.speed.torque_limit_Nm;
  if (!motor || !limit || motor->nominal_current_A > 0.0) return "";
  const double usual = design::usual_torque_limit_Nm(*motor, s.supply.voltage_V);
  if (!(std::fabs(*limit - usual) < 0.01 * usual)) return "";
  return fmt::format(
      "The sheet names no nominal current: control.speed.torque_limit_Nm is the torque of a quarter of the stall current, {} A. Check that bridge and winding withstand this current, or give nominal_current_A in the motor file, or the allowed torque.",
      base::rounded(usual / motor->K_t_Nm_A, 4));
}

class Starter {
 public:
  Starter(const study::Scenario& scenario, bool full)
      : origin_(torque_limit_origin(scenario)),
        keys_(keys_for(scenario)),
        values_(scenario_values(alone(scenario))),
        wanted_(wanted_for(scenario)),
        full_(full) {}

  std::string text() { return table("", ""); }

 private:
  /// The keys of one table and of its inner tables. `at` is the table's path: "control", or "require[0]".
  std::string table(const std::string& path, const std::string& at) {
    std::string own, inner;
    for (const KeyEntry* entry : keys_in(keys_, path)) {
      if (entry->type == KeyType::list)
        inner += list(*entry);
      else if (entry->type == KeyType::table)
        inner += entry->about.partial ? override_table(*entry) : inner_table(*entry, at);
      else
        own += line(*entry, at);
    }
    return own + inner;
  }

  /// Whether the scenario has any value in the table `at`.
  bool says(const std::string& at) const {
    return std::any_of(values_.begin(), values_.end(),
                       [&](const WrittenValue& value) { return value.path.starts_with(at + "."); });
  }

  bool says_just(const std::string& path) const {
    return std::any_of(values_.begin(), values_.end(),
                       [&](const WrittenValue& value) { return value.path == path; });
  }

  std::string inner_table(const KeyEntry& entry, const std::string& outer) {
    const std::string at =
        outer.empty() ? std::string(name_of(entry)) : fmt::format("{}.{}", outer, name_of(entry));
    const bool in_list =
        outer.find('[') != std::string::npos;  // a table in a list may be left out, including its header
    return headed(entry, table(entry.path, at), !in_list || says(at), entry.optional && says(at));
  }

  /// The table with its header. The header of an existing table is active, so that the user only has to
  /// remove one # to use a key. A table that has an effect by its presence has a header even if all its keys
  /// have defaults.
  static std::string headed(const KeyEntry& table, const std::string& lines, bool open,
                            bool says_by_itself = false) {
    // A table that only has inner tables needs no header: TOML creates it.
    if (!says_by_itself && (lines.empty() || lines.front() == '\n')) return lines;
    return fmt::format("\n{}{}[{}]\n{}", wrapped_comment(meaning_of(table)), open ? "" : "# ", table.path,
                       lines);
  }

  std::string list(const KeyEntry& entry) {
    std::string text;
    for (std::size_t n = 0; true; ++n) {
      const std::string at = fmt::format("{}[{}]", entry.path, n);
      const bool there = says(at);
      if (!there && (n > 0 || !full_)) return text;
      text += fmt::format("\n{}{}[[{}]]\n{}", n == 0 ? wrapped_comment(meaning_of(entry)) : "",
                          there ? "" : "# ", entry.path, table(entry.path, at));
    }
  }

  /// The keys of [motor_override], without explanations, because the motor's file has them.
  std::string override_table(const KeyEntry& entry) {
    std::string text;
    for (const KeyEntry* key : keys_in(keys_, entry.path))
      if (says_just(key->path))
        text += line(*key, entry.path);
      else if (full_ && key->type == KeyType::quantity)
        text += template_line(*key, {.key = name_of(*key), .value = "nan", .open = false});
    return headed(entry, text, true);
  }

  std::string line(const KeyEntry& entry, const std::string& at) {
    const std::string path =
        at.empty() ? std::string(name_of(entry)) : fmt::format("{}.{}", at, name_of(entry));
    const auto value =
        std::find_if(values_.begin(), values_.end(), [&](const WrittenValue& v) { return v.path == path; });
    const auto wanted =
        std::find_if(wanted_.begin(), wanted_.end(), [&](const Wanted& w) { return w.path == entry.path; });
    const bool given = value != values_.end();
    const bool open = given && (!value->usual || (wanted != wanted_.end() && wanted->open));
    if (!open && !full_ && wanted == wanted_.end()) return "";
    // The same keys occur in every item of a list, and the same gains in every loop. Each key is explained
    // only once.
    const bool limit = path == "control.speed.torque_limit_Nm" || path == "control.speed.force_limit_N";
    const std::string why = limit && open && !origin_.empty() ? wrapped_comment(origin_) : "";
    return why + template_line(entry, {.key = name_of(entry),
                                       .value = given ? with_plain_exponent(value->text) : placeholder(entry),
                                       .open = open,
                                       .explained = explained_.insert(entry.about.meaning).second});
  }

  std::string origin_;  ///< origin of the torque limit
  std::vector<KeyEntry> keys_;
  std::vector<WrittenValue> values_;
  std::vector<Wanted> wanted_;
  bool full_;
  std::set<std::string_view> explained_;
};

}  // namespace

std::string starter_note(const study::Scenario& scenario) { return torque_limit_origin(scenario); }

std::string starter_text(const study::Scenario& scenario, const StarterOptions& options) {
  return fmt::format("#:schema {}\n", scenario_schema_file) +
         wrapped_comment(fmt::format(
             "sixstep run {} simulates this scenario and checks its requirements; --html also writes the report. Lines after a # show the defaults: to change a value, remove the #. Where the value is nan there is no default: write a number. Details: sixstep help TABLE and sixstep help KEY.",
             shell_word(options.file))) +
         Starter(scenario, options.full).text();
}

}  // namespace text
