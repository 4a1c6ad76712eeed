// SPDX-License-Identifier: Apache-2.0
#include "text/recording/known_names.hpp"

#include <algorithm>

#include "sixstep/study/measure/columns.hpp"
#include "text/recording/bench_columns.hpp"
#include "text/recording/heading.hpp"

namespace text {
namespace {

bool is_in(const std::vector<std::string_view>& names, std::string_view bare) {
  return std::find(names.begin(), names.end(), bare) != names.end();
}

bool is_in(const ThreeNames& three, std::string_view bare) {
  return std::any_of(three.begin(), three.end(), [&](const auto& names) { return is_in(names, bare); });
}

}  // namespace

bool names_a_time(std::string_view bare) {
  static const std::vector<std::string_view> names = {"t",       "time",  "times", "ts",   "timestamp",
                                                      "seconds", "xaxis", "x",     "zeit", "temps",
                                                      "tiempo",  "tempo", "xvalue"};
  return is_in(names, bare);
}

std::string bare_column(const study::Column& column) {
  std::string unit = "_" + column.unit;
  std::replace(unit.begin(), unit.end(), '/', '_');
  std::erase(unit, ' ');  // "N m" is written Nm in names
  std::string_view name = column.name;
  if (name.ends_with(unit)) name.remove_suffix(unit.size());
  return bare_name(name);
}

bool is_known_name(std::string_view bare) {
  if (names_a_time(bare) || is_in(names_of_hall_codes(), bare)) return true;
  if (is_in(names_between_terminals(), bare) || is_in(names_of_terminals(), bare) ||
      is_in(names_of_hall_lines(), bare))
    return true;
  const auto& columns = study::all_columns();
  return std::any_of(columns.begin(), columns.end(),
                     [&](const study::Column& column) { return bare_column(column) == bare; });
}

}  // namespace text
