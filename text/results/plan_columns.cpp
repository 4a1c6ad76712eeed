// SPDX-License-Identifier: Apache-2.0
#include "text/results/plan_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "text/escape/csv_cell.hpp"

namespace text {
namespace {

/// Names are compared in lower case, because SQL does not distinguish A from a.
std::string in_small_letters(std::string name) {
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return name;
}

}  // namespace

std::vector<std::string> column_names(const analysis::PlanColumns& columns) {
  std::set<std::string> taken(std::begin(columns_before), std::end(columns_before));
  taken.insert(std::begin(columns_behind), std::end(columns_behind));
  std::vector<std::string> names;
  const auto add = [&](const std::string& name, const std::string& unit) {
    const std::string wanted = cell_name(unit.empty() ? name : fmt::format("{} [{}]", name, unit));
    std::string free = wanted;
    for (int n = 2; !taken.insert(in_small_letters(free)).second; ++n)
      free = fmt::format("{} ({})", wanted, n);
    names.push_back(std::move(free));
  };
  for (const analysis::InputColumn& key : columns.keys) add(key.key, key.unit);
  for (const analysis::InputColumn& strayed : columns.strayed) add("drive: " + strayed.key, strayed.unit);
  for (const analysis::FigureColumn& figure : columns.figures) add(figure.name, figure.unit);
  return names;
}

}  // namespace text
