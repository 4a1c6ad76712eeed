// SPDX-License-Identifier: Apache-2.0
#include "io/verdict_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace io {
namespace {

enum class Kind { heading, ok, failed, comparison, note };
struct Line {
  Kind kind;
  std::array<std::string, 5> cells;
};

std::string with_unit(double x, const std::string& unit) {
  return unit.empty() || unit == "1" ? fmt::format("{:.9g}", x) : fmt::format("{:.9g} {}", x, unit);
}

/// Characters, not bytes: a title may be in any language.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

const char* colour_of(Kind kind) {
  switch (kind) {
    case Kind::heading:
      return "\x1b[1m";
    case Kind::ok:
      return "\x1b[32m";
    case Kind::failed:
      return "\x1b[31m";
    case Kind::comparison:
      return "\x1b[2m";
    case Kind::note:
      return "";
  }
  return "";
}

void add_entry(std::vector<Line>& lines, const TableEntry& entry) {
  std::string name = entry.experiment;  // once, on the experiment's first line
  const auto add = [&](Kind kind, std::string figure, std::string required, std::string measured,
                       std::string end) {
    lines.push_back(
        {kind, {name, std::move(figure), std::move(required), std::move(measured), std::move(end)}});
    name.clear();
  };
  for (const study::Verdict& v : entry.outcome->verdicts)
    add(v.ok ? Kind::ok : Kind::failed, v.figure, required_text(v), with_unit(v.measured, v.unit),
        v.ok ? "ok" : "FAILED");
  for (const study::ComparisonResult& c : entry.outcome->comparisons)
    add(Kind::comparison, c.figure, fmt::format("{} ({})", with_unit(c.value, c.unit), c.source),
        with_unit(c.measured, c.unit), deviation_text(c));
  if (entry.outcome->fault)
    add(Kind::failed, "fault: " + base::to_string(*entry.outcome->fault), "", "", "STOPPED");
  if (!name.empty()) add(Kind::note, "requires nothing", "", "", "");
}

}  // namespace

std::string required_text(const study::Verdict& v) {
  if (v.min && v.max) return fmt::format("{:.9g} .. {}", *v.min, with_unit(*v.max, v.unit));
  if (v.max) return "<= " + with_unit(*v.max, v.unit);
  if (v.min) return ">= " + with_unit(*v.min, v.unit);
  return "";
}

std::string deviation_text(const study::ComparisonResult& c) {
  if (c.value == 0.0) return fmt::format("{:+.3g}", c.measured);
  return fmt::format("{:+.3g} %", 100.0 * (c.measured - c.value) / std::abs(c.value));
}

std::string verdict_table(std::span<const TableEntry> entries, bool colour) {
  std::vector<Line> lines{{Kind::heading, {"experiment", "figure", "required", "measured", ""}}};
  for (const TableEntry& entry : entries) add_entry(lines, entry);
  std::array<std::size_t, 5> widths{};
  for (const Line& line : lines)
    for (std::size_t n = 0; n < widths.size(); ++n) widths[n] = std::max(widths[n], width(line.cells[n]));
  std::string text;
  for (const Line& line : lines) {
    std::string row;
    for (std::size_t n = 0; n < widths.size(); ++n)
      row += line.cells[n] + std::string(widths[n] - width(line.cells[n]) + 2, ' ');
    row.erase(row.find_last_not_of(' ') + 1);
    text += colour ? fmt::format("{}{}\x1b[0m\n", colour_of(line.kind), row) : row + "\n";
  }
  return text;
}

}  // namespace io
