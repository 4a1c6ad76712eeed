// SPDX-License-Identifier: Apache-2.0
#include "text/results/verdict_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "text/escape/escape.hpp"
#include "text/results/core_text.hpp"
#include "text/results/quantity_text.hpp"

namespace text {
namespace {

enum class Kind { heading, name, ok, failed, comparison, note };
struct Line {
  Kind kind;
  std::array<std::string, 5> cells;
};

/// The width in characters, not in bytes, because a title may be in any language.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

const char* colour_of(Kind kind) {
  switch (kind) {
    case Kind::heading:
    case Kind::name:
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

/// Whether a line has no columns, so that it does not affect their width.
bool is_free(Kind kind) { return kind == Kind::name || kind == Kind::note; }

std::string coloured(Kind kind, std::string text, bool colour) {
  text.erase(text.find_last_not_of(' ') + 1);
  return colour ? fmt::format("{}{}\x1b[0m\n", colour_of(kind), text) : text + "\n";
}

Line requirement_line(const study::Verdict& v) {
  std::vector<double> limits;
  if (v.min) limits.push_back(*v.min);
  if (v.max) limits.push_back(*v.max);
  const ComparedTexts texts = compared_texts(v.measured, limits, v.unit);
  std::string required;
  if (v.min && v.max)
    required = texts.yardsticks[0] + " .. " + texts.yardsticks[1];
  else if (v.min || v.max)
    required = (v.max ? "<= " : ">= ") + texts.yardsticks[0];
  if (!texts.unit.empty() && !required.empty()) required += " " + texts.unit;
  return {v.ok ? Kind::ok : Kind::failed,
          {"  " + v.figure, std::move(required), texts.x, v.ok ? "ok" : "FAILED", ""}};
}

Line comparison_line(const study::ComparisonResult& c) {
  return {c.fails ? Kind::failed : Kind::comparison,
          {"  " + c.figure, quantity_text(c.value, c.unit), quantity_text(c.measured, c.unit),
           deviation_text(c), c.source}};
}

void add_entry(std::vector<Line>& lines, const TableEntry& entry) {
  lines.push_back({Kind::name, {entry.experiment}});
  const std::size_t before = lines.size();
  for (const study::Verdict& v : entry.outcome->verdicts) lines.push_back(requirement_line(v));
  for (const study::ComparisonResult& c : entry.outcome->comparisons) lines.push_back(comparison_line(c));
  if (entry.outcome->fault)
    lines.push_back({Kind::note, {"  STOPPED by a fault: " + base::to_string(*entry.outcome->fault)}});
  for (const std::string& note : entry.outcome->notes) lines.push_back({Kind::note, {"  note: " + note}});
  for (const std::string& remark : entry.outcome->remarks)
    lines.push_back({Kind::note, {"  remark: " + remark}});
  for (const std::string& told : core_texts(*entry.outcome)) lines.push_back({Kind::note, {"  " + told}});
  if (lines.size() == before) lines.push_back({Kind::note, {"  requires nothing"}});
}

}  // namespace

std::string recorded_verdict(const study::ComparisonResult& c) {
  if (!std::isfinite(c.value)) return "not in the recording";
  if (!std::isfinite(*c.uncertainty)) return "no verdict: seen once";
  const double beyond = c.beyond();
  const std::string percent =
      c.value == 0.0 ? "" : fmt::format("{:+.3g} %, ", 100.0 * (c.measured - c.value) / std::abs(c.value));
  return percent + (beyond > 0.0 ? "beyond by " + quantity_text(beyond, c.unit, 2) + " (+- " : "within +- ") +
         quantity_text(*c.uncertainty, c.unit, 2) + (beyond > 0.0 ? ")" : "") + (c.fails ? ", FAILED" : "");
}

std::string deviation_text(const study::ComparisonResult& c) {
  if (!std::isfinite(c.measured)) return "not comparable";
  if (c.uncertainty) return recorded_verdict(c);
  if (c.value == 0.0) return "";
  // The percentage is relative to the magnitude of the expected value. It has no meaning for opposite signs,
  // for a temperature in degC, or for an expected value near zero; the difference is then printed.
  constexpr double most_times = 1000.0, most_percent = 1000.0;
  if ((c.measured < 0.0) != (c.value < 0.0) || c.unit == "degC" ||
      std::abs(c.measured) > most_times * std::abs(c.value))
    return (c.measured > c.value ? "+" : "") +
           quantity_text(c.measured - c.value, c.unit == "degC" ? "K" : c.unit);
  const double percent = 100.0 * (c.measured - c.value) / c.value;
  // From ten times on, a factor is clearer than a percentage.
  if (percent >= most_percent) return fmt::format("x {:.3g}", c.measured / c.value);
  return std::abs(percent) < 1e-9 ? "0 %" : fmt::format("{:+.3g} %", percent);
}

std::string verdict_table(std::span<const TableEntry> entries, bool colour) {
  const bool only_compares = std::none_of(entries.begin(), entries.end(),
                                          [](const TableEntry& e) { return !e.outcome->verdicts.empty(); });
  const bool only_recorded =
      only_compares && std::any_of(entries.begin(), entries.end(), [](const TableEntry& e) {
        return !e.outcome->comparisons.empty() && e.outcome->comparisons.front().uncertainty;
      });
  const char* beside = only_recorded ? "recorded" : only_compares ? "expected" : "required";
  std::vector<Line> lines{
      {Kind::heading, {"experiment", beside, only_recorded ? "simulated" : "measured", "", "source"}}};
  for (const TableEntry& entry : entries) add_entry(lines, entry);
  const bool has_source = std::any_of(entries.begin(), entries.end(),
                                      [](const TableEntry& e) { return !e.outcome->comparisons.empty(); });
  if (!has_source) lines[0].cells[4].clear();
  for (Line& line : lines)
    for (std::string& cell : line.cells) cell = visible(cell);
  std::array<std::size_t, 5> widths{};
  for (const Line& line : lines)
    for (std::size_t n = 0; n < widths.size() && !is_free(line.kind); ++n)
      widths[n] = std::max(widths[n], width(line.cells[n]));
  std::string text;
  for (const Line& line : lines) {
    std::string row;
    for (std::size_t n = 0; n < widths.size(); ++n) {
      row += line.cells[n];
      if (!is_free(line.kind)) row += std::string(widths[n] - width(line.cells[n]) + 2, ' ');
    }
    text += coloured(line.kind, row, colour);
  }
  return text;
}

std::string faults_text(std::span<const TableEntry> entries) {
  std::string text;
  for (const TableEntry& entry : entries)
    if (entry.outcome->fault)
      text += visible(entry.experiment + ": stopped by a fault: " + base::to_string(*entry.outcome->fault)) +
              "\n";
  return text;
}

std::string verdict_summary(std::span<const TableEntry> entries, bool colour) {
  std::size_t requirements = 0, misses = 0, stopped = 0, recorded = 0, within = 0, off = 0;
  std::string which;
  const auto tell = [&which](const std::string& line) { which += "\n  " + visible(line); };
  for (const TableEntry& entry : entries) {
    requirements += entry.outcome->verdicts.size();
    for (const study::Verdict& v : entry.outcome->verdicts) {
      if (v.ok) continue;
      ++misses;
      tell(entry.experiment + ": " + v.figure);
    }
    for (const study::ComparisonResult& c : entry.outcome->comparisons) {
      recorded += c.uncertainty ? 1 : 0;
      within += c.uncertainty && std::isfinite(*c.uncertainty) && c.beyond() == 0.0 &&
                        std::isfinite(c.measured - c.value)
                    ? 1
                    : 0;
      if (!c.fails) continue;
      ++off;
      tell(entry.experiment + ": " + c.figure);
    }
    if (!entry.outcome->fault) continue;
    ++stopped;
    tell(entry.experiment + ": stopped by a fault");
  }
  std::string text = counted(entries.size(), "experiment") + ": ";
  if (misses > 0)
    text += fmt::format("{} of {} requirements FAILED", misses, requirements);
  else if (requirements == 0)
    text += "nothing required";
  else
    text +=
        requirements == 1 ? "the requirement holds" : fmt::format("all {} requirements hold", requirements);
  if (recorded > 0)
    text += fmt::format(", {} of {} recorded figures within their uncertainty", within, recorded);
  if (off > 0) text += fmt::format(", {} beyond their tolerance: FAILED", off);
  if (stopped > 0) text += fmt::format(", {} stopped by a fault", stopped);
  return coloured(misses + stopped + off > 0 ? Kind::failed : Kind::ok, text + which, colour);
}

}  // namespace text
