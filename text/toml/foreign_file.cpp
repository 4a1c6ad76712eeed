// SPDX-License-Identifier: Apache-2.0
#include "text/toml/foreign_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "text/keys/decimal_number.hpp"
#include "text/keys/key_advice.hpp"

namespace text {
namespace {

/// A number of the other program, and the key with the same meaning here.
struct ForeignNumber {
  std::string_view word;
  std::string_view key;
  double factor = 1.0;
  std::string_view frame{};
};

struct ForeignKind {
  std::string_view name;
  std::string_view mark;  ///< text that occurs in no other program's files
  std::array<ForeignNumber, 6> numbers;
};

// Resistance, inductance and flux linkage are phase values in all of these programs, because each computes in
// the rotor's frame.
constexpr ForeignKind foreign_kinds[] = {
    {"a VESC motor configuration",
     "<MCConfiguration",
     {{{"<si_motor_poles>", "pole_pairs", 0.5},
       {"<foc_motor_r>", "resistance_ohm", 1, "phase"},
       {"<foc_motor_l>", "inductance_uH", 1e6, "phase"},
       {"<foc_motor_flux_linkage>", "flux_linkage_mWb", 1e3}}}},
    {"an ODrive configuration",
     "phase_resistance\"",
     {{{"pole_pairs\"", "pole_pairs"},
       {"phase_resistance\"", "resistance_ohm", 1, "phase"},
       {"phase_inductance\"", "inductance_uH", 1e6, "phase"},
       {"torque_constant\"", "torque_constant_mNm_A", 1e3}}}},
    {"a moteus configuration",
     "motor.poles ",
     {{{"motor.poles ", "pole_pairs", 0.5},
       {"motor.resistance_ohm ", "resistance_ohm", 1, "phase"},
       {"motor.Kv ", "speed_constant_rpm_V", 1, "line-peak"}}}},
    {"a MATLAB struct of a motor",
     ".FluxPM",
     {{{".p ", "pole_pairs"},
       {".Rs ", "resistance_ohm", 1, "phase"},
       {".Ld ", "inductance_uH", 1e6, "phase"},
       {".FluxPM", "flux_linkage_mWb", 1e3},
       {".J ", "inertia_kgm2"}}}},
};

/// The number after a word, as in "<foc_motor_r>0.0187", "phase_resistance": 0.05", "motor.poles 14" or ".Rs
/// = 0.36".
std::optional<double> number_behind(std::string_view text, std::string_view word) {
  const std::size_t at = text.find(word);
  if (word.empty() || at == std::string_view::npos) return {};
  std::string_view rest = text.substr(at + word.size());
  const std::size_t first = rest.find_first_not_of(" \t:=\"");
  if (first == std::string_view::npos) return {};
  const DecimalNumber x = decimal_number(rest.substr(first));
  return x.kind == DecimalNumber::Kind::number ? std::optional(x.value) : std::nullopt;
}

std::string toml_line(const ForeignNumber& number, double value) {
  // Ten digits, so that 2.23e-05 H becomes 22.3 uH and not 22.299999999999997.
  const std::string written = fmt::format("{:.10g}", value * number.factor);
  return number.frame.empty()
             ? fmt::format("{} = {}", number.key, written)
             : fmt::format("{} = {{ value = {}, frame = \"{}\" }}", number.key, written, number.frame);
}

base::Problem foreign_problem(const std::string& name, std::string_view kind, const std::string& lines) {
  return {.where = name + ":1:1:",
          .value = "",
          .limit = fmt::format("is {}, not a TOML file", kind),
          .cure = lines.empty() ? "type its values into a motor's file of the style firmware"
                                : "type into a motor's file: " + lines +
                                      "; add the inertia and the other values that the style firmware lists"};
}

/// Reads BLDCMotor(pole pairs, phase resistance, KV, phase inductance), of which the last three may be
/// missing.
std::optional<base::Problem> simple_foc(const std::string& name, std::string_view text) {
  constexpr ForeignNumber order[] = {{"", "pole_pairs"},
                                     {"", "resistance_ohm", 1, "phase"},
                                     {"", "speed_constant_rpm_V", 1, "line-peak"},
                                     {"", "inductance_uH", 1e6, "phase"}};
  std::size_t at = text.find("BLDCMotor(");
  if (at == std::string_view::npos) return {};
  std::string_view rest = text.substr(at + 10);
  std::string lines;
  for (const ForeignNumber& number : order) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    const DecimalNumber x = decimal_number(rest);
    if (x.kind != DecimalNumber::Kind::number) break;
    lines += (lines.empty() ? "" : ", ") + toml_line(number, x.value);
    rest.remove_prefix(x.size);
    const std::size_t comma = rest.find_first_not_of(" \tfF");
    if (comma == std::string_view::npos || rest[comma] != ',') break;
    rest.remove_prefix(comma + 1);
  }
  return foreign_problem(name, "a SimpleFOC sketch", lines);
}

}  // namespace

std::optional<base::Problem> foreign_file(const std::string& name, std::string_view text) {
  for (const ForeignKind& kind : foreign_kinds) {
    if (text.find(kind.mark) == std::string_view::npos) continue;
    std::string lines;
    for (const ForeignNumber& number : kind.numbers)
      if (const std::optional<double> value = number_behind(text, number.word))
        lines += (lines.empty() ? "" : ", ") + toml_line(number, *value);
    return foreign_problem(name, kind.name, lines);
  }
  return simple_foc(name, text);
}

}  // namespace text
