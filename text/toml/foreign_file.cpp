// SPDX-License-Identifier: Apache-2.0
#include "text/toml/foreign_file.hpp"

#include <fmt/format.h>

namespace text {
namespace {

struct ForeignMark {
  ForeignKind kind;
  std::string_view name;
  std::string_view mark;    ///< text that occurs in no other program's files
  std::string_view with{};  ///< a second text that must occur too
};

constexpr ForeignMark foreign_marks[] = {
    {ForeignKind::vesc, "a VESC motor configuration", "<MCConfiguration"},
    {ForeignKind::odrive, "an ODrive configuration", "phase_resistance\""},
    {ForeignKind::moteus, "a moteus configuration", "motor.poles "},
    {ForeignKind::moteus, "a moteus configuration", "motor.resistance_ohm "},
    {ForeignKind::simple_foc, "a SimpleFOC sketch", "BLDCMotor"},
    {ForeignKind::matlab, "a MATLAB struct of a motor", ".FluxPM"},
    {ForeignKind::matlab, "a MATLAB struct of a motor", ".Rs", ".Ld"},
};

}  // namespace

ForeignKind foreign_kind(std::string_view text) {
  for (const ForeignMark& row : foreign_marks)
    if (text.find(row.mark) != std::string_view::npos && text.find(row.with) != std::string_view::npos)
      return row.kind;
  return ForeignKind::none;
}

std::string_view foreign_name(ForeignKind kind) {
  for (const ForeignMark& row : foreign_marks)
    if (row.kind == kind) return row.name;
  return {};
}

std::optional<base::Problem> foreign_file(const std::string& name, std::string_view text) {
  const ForeignKind kind = foreign_kind(text);
  if (kind == ForeignKind::none) return {};
  return base::Problem{
      .where = name + ":1:1:",
      .value = "",
      .limit = fmt::format("is {}, but a TOML file is required", foreign_name(kind)),
      .cure = fmt::format("make a motor file from this file: sixstep motor new NAME --from {}", name)};
}

}  // namespace text
