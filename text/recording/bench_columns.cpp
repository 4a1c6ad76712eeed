// SPDX-License-Identifier: Apache-2.0
#include "text/recording/bench_columns.hpp"

#include <algorithm>

#include "text/keys/units.hpp"

namespace text {
namespace {

bool is_any_of(const RecordedColumn& column, const ThreeNames& names) {
  return std::any_of(names.begin(), names.end(), [&](const auto& of) { return is_called(column, of); });
}

/// The reason why a voltage with a known heading was not used.
std::string why_not_voltage(Meaning meaning, const BenchUse& use) {
  const bool line = meaning == Meaning::between_terminals;
  if (use.voltages_are_asked) return "the options request other voltages";
  if (use.voltages == Meaning::unknown)
    return line ? "a line-to-line voltage; u_ab and u_bc are both needed"
                : "a voltage of a terminal; u_a, u_b and u_c are all needed";
  if (use.voltages == meaning) return "three voltages are already used";
  return line ? "a line-to-line voltage; the voltages of terminals are used"
              : "a voltage of a terminal; the line-to-line voltages are used";
}

}  // namespace

const ThreeNames& names_between_terminals() {
  static const ThreeNames names = {
      {{"uab", "vab", "eab", "ab"}, {"ubc", "vbc", "ebc", "bc"}, {"uca", "vca", "eca", "ca"}}};
  return names;
}
const ThreeNames& names_of_terminals() {
  static const ThreeNames names = {{{"ua", "va", "ea", "phasea", "vphasea"},
                                    {"ub", "vb", "eb", "phaseb", "vphaseb"},
                                    {"uc", "vc", "ec", "phasec", "vphasec"}}};
  return names;
}
const ThreeNames& names_of_hall_lines() {
  static const ThreeNames names = {{{"hall1", "h1", "halla", "ha", "hallu", "hu"},
                                    {"hall2", "h2", "hallb", "hb", "hallv", "hv"},
                                    {"hall3", "h3", "hallc", "hc", "hallw", "hw"}}};
  return names;
}
const std::vector<std::string_view>& names_of_hall_codes() {
  static const std::vector<std::string_view> names = {"hall", "code", "hallcode", "hallstate"};
  return names;
}

Meaning meaning_of(const RecordedColumn& column) {
  if (is_any_of(column, names_between_terminals())) return Meaning::between_terminals;
  if (is_any_of(column, names_of_terminals())) return Meaning::of_terminal;
  if (is_any_of(column, names_of_hall_lines())) return Meaning::hall_line;
  return is_called(column, names_of_hall_codes()) ? Meaning::hall_code : Meaning::unknown;
}

base::Result<Three> three_of(const Recording& recording, const ThreeNames& names) {
  Three out;
  for (std::size_t n = 0; n < out.size(); ++n) {
    const base::Result<Picked> found = find_column(recording, names[n]);
    if (!found) return found.problems();
    if (found->column) out[n] = *found;
  }
  return out;
}

Columns from_the_first(const Three& found) {
  Columns out;
  for (const std::optional<Picked>& column : found) {
    if (!column) break;
    out.push_back(*column);
  }
  return out;
}

Columns in_turn(const Three& found) {
  // The sequence begins after the missing column, or at the first column: a b, b c or c a. Each voltage lags
  // the previous voltage by 120 degrees.
  const auto gap =
      static_cast<std::size_t>(std::find(found.begin(), found.end(), std::nullopt) - found.begin());
  const std::size_t before = std::min(gap, found.size() - 1);
  Columns out;
  for (std::size_t n = 1; n <= found.size(); ++n)
    if (const std::optional<Picked>& column = found[(before + n) % found.size()]) out.push_back(*column);
  return out;
}

Voltages chosen(Columns lines, Columns terminals, std::optional<analysis::EmfBetween> wanted) {
  using analysis::EmfBetween;
  if (wanted == EmfBetween::star && !terminals.empty()) return {std::move(terminals), wanted};
  if (wanted == EmfBetween::lines && !lines.empty()) return {std::move(lines), wanted};
  if (lines.size() > 1) return {std::move(lines), wanted.value_or(EmfBetween::lines)};
  if (terminals.size() == 3) return {std::move(terminals), wanted.value_or(EmfBetween::star)};
  if (!lines.empty()) return {std::move(lines), wanted.value_or(EmfBetween::lines)};
  return {std::move(terminals), wanted};
}

bool is_of_other_unit(const RecordedColumn& column) {
  return !column.unit.empty() && !column.letter && !same_kind(*unit_of(column.unit), *unit_of("V"));
}

std::string why_not_used(const RecordedColumn& column, const BenchUse& use) {
  if (is_of_other_unit(column)) return "in " + column.unit;
  const Meaning meaning = meaning_of(column);
  switch (meaning) {
    case Meaning::between_terminals:
    case Meaning::of_terminal:
      return why_not_voltage(meaning, use);
    case Meaning::hall_line:
      if (!use.hall_log) return "a Hall line, not a voltage";
      return use.by_codes ? "a Hall line; the column of Hall codes is used instead"
                          : "a Hall line; three Hall lines are already used";
    case Meaning::hall_code:
      return use.hall_log ? "Hall codes; the three Hall lines are used instead" : "Hall codes, not a voltage";
    case Meaning::unknown:
      break;
  }
  return "its heading has no known meaning";
}

}  // namespace text
