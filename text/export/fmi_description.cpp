// SPDX-License-Identifier: Apache-2.0
#include "text/export/fmi_description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "sixstep/base/written.hpp"
#include "text/escape/escape.hpp"
#include "text/scenario/scenario_text.hpp"

namespace text {
namespace {

/// FNV-1a hash with 64 bits. Another seed gives an independent hash.
std::uint64_t fmi_hash(std::string_view text, std::uint64_t seed) {
  std::uint64_t hash = 0xcbf29ce484222325U ^ seed;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

/// A GUID computed from everything that determines the unit's behaviour.
std::string fmi_token(const UnitTexts& unit, FmiVersion version, FmiChip chip) {
  const std::string all = fmt::format("{}\n{}\n{}\n{}\n{}\n{}", SIXSTEP_VERSION, static_cast<int>(version),
                                      static_cast<int>(chip), unit.scenario, unit.motor, unit.identifier);
  const std::string a = base::written_hex(fmi_hash(all, 0)),
                    b = base::written_hex(fmi_hash(all, 0x9e3779b97f4a7c15U));
  return fmt::format("{{{}-{}-{}-{}-{}}}", a.substr(0, 8), a.substr(8, 4), a.substr(12), b.substr(0, 4),
                     b.substr(4));
}

std::string fmi_bits(double x) { return base::written_hex(std::bit_cast<std::uint64_t>(x)); }

const char* fmi_word(FmiKind kind) {
  switch (kind) {
    case FmiKind::real:
      return "real";
    case FmiKind::integer:
      return "integer";
    case FmiKind::boolean:
      return "boolean";
    default:
      return "";
  }
}

std::string variable_lines(const UnitModel& model, FmiChip chip) {
  std::string out = fmt::format("token {}\nchip {}\n", model.token, static_cast<int>(chip));
  for (const FmiVariable& v : model.variables) {
    const std::string_view word = fmi_word(v.kind);
    if (!v.key.empty())
      out += fmt::format("input {} {} {}\n", v.reference, fmi_bits(v.start), v.key);
    else if (v.role != FmiRole::time && !word.empty())
      out += fmt::format("{} {} {} {}\n", word, v.reference, fmi_bits(v.factor), v.count);
  }
  return out;
}

}  // namespace

std::string c_identifier(std::string_view name) {
  std::string out;
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  for (const char c : name) out += is_letter(c) || (c >= '0' && c <= '9') ? c : '_';
  return out.empty() || !is_letter(out.front()) ? "drive_" + out : out;
}

std::vector<std::string> UnitModel::units() const {
  std::vector<std::string> all;
  for (const FmiVariable& v : variables)
    if (!v.unit.empty() && std::ranges::find(all, v.unit) == all.end()) all.push_back(v.unit);
  return all;
}

std::string fmi_unit_lines(const std::vector<std::string>& units) {
  std::string out = "  <UnitDefinitions>\n";
  for (const std::string& name : units) {
    const FmiUnit* const unit = fmi_unit(name);
    if (unit == nullptr) {
      out += fmt::format("    <Unit name=\"{}\"/>\n", markup_text(name));
      continue;
    }
    out += fmt::format("    <Unit name=\"{}\">\n      <BaseUnit", name);
    const std::pair<const char*, int> exponents[] = {{"kg", unit->kg}, {"m", unit->m}, {"s", unit->s},
                                                     {"A", unit->A},   {"K", unit->K}, {"rad", unit->rad}};
    for (const auto& [symbol, exponent] : exponents)
      if (exponent != 0) out += fmt::format(" {}=\"{}\"", symbol, exponent);
    if (unit->factor != 1.0) out += fmt::format(" factor=\"{}\"", base::written(unit->factor));
    if (unit->offset != 0.0) out += fmt::format(" offset=\"{}\"", base::written(unit->offset));
    out += "/>\n";
    if (!unit->display.empty())
      out += fmt::format("      <DisplayUnit name=\"{}\" factor=\"{}\"/>\n", unit->display,
                         base::written(unit->display_factor));
    out += "    </Unit>\n";
  }
  return out + "  </UnitDefinitions>\n";
}

base::Result<UnitTexts> unit_texts(const study::Scenario& scenario, std::string_view name, FmiVersion version,
                                   FmiChip chip, const std::vector<std::string>& sources) {
  study::Scenario own = scenario;
  own.require.clear();
  own.compare.clear();
  own.spread.clear();
  base::Result<std::vector<FmiVariable>> variables = fmi_variables(own, chip, version);
  if (!variables) return variables.problems();
  own.motor = "motor.toml";
  own.motor_sheet = own.sheet;
  UnitTexts unit{
      .identifier = c_identifier(name),
      .description = {},
      .variables = {},
      .scenario = scenario_text(own, {"Made by sixstep " SIXSTEP_VERSION " for a functional mock-up unit."}),
      .motor = sheet_text(own.sheet),
      .build = {}};
  const UnitModel model{.scenario = own,
                        .name = std::string(name),
                        .identifier = unit.identifier,
                        .token = fmi_token(unit, version, chip),
                        .variables = std::move(*variables),
                        .sources = sources};
  unit.description = version == FmiVersion::fmi2 ? fmi2_description(model) : fmi3_description(model);
  if (version == FmiVersion::fmi3) unit.build = fmi3_build(model);
  unit.variables = variable_lines(model, chip);
  return unit;
}

}  // namespace text
