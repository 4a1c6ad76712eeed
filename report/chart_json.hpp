// SPDX-License-Identifier: Apache-2.0
// Writes the parts of the JSON that the pages' scripts draw.
#pragma once
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "report/groups.hpp"
#include "report/html.hpp"
#include "report/packed_rows.hpp"
#include "report/thinning.hpp"
#include "report/windows.hpp"

namespace report {

using json = nlohmann::ordered_json;

/// The selected rows of a column as base64 of their bytes.
template <class To>
std::string packed(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<To> chosen;
  chosen.reserve(rows.size());
  for (const std::size_t n : rows) chosen.push_back(static_cast<To>(values[n]));
  return base64(std::span<const To>(chosen));
}

/// A page's time axes. Curves with the same rows share one axis, because an axis is the largest part of the
/// file.
class Axes {
 public:
  explicit Axes(json& page) : page_(page) {}
  std::size_t of(const std::vector<double>& time, const std::vector<std::size_t>& rows);

 private:
  json& page_;
  std::map<std::pair<const std::vector<double>*, std::vector<std::size_t>>, std::size_t> places_;
};

/// A chart without its curves. `complete`: all `recorded` rows are in the page, none is replaced by an
/// envelope.
json chart_json(const Group& group, bool complete, std::size_t recorded);
json curve_json(const Curve& curve, std::size_t axis, const std::vector<std::size_t>& rows);

/// Indices of the chart and the curve of a packed column.
struct CurvePlace {
  std::size_t chart = 0, curve = 0;
};
/// Packed columns after the last of `places` are conduction codes, not curves.
json rows_json(const PackedRows& rows, const std::vector<CurvePlace>& places);

json windows_json(const Windows& windows, const sixstep::study::Scenario& scenario);
/// The windows whose rows all fit into the page, most_rows in total.
std::vector<Interval> kept(const Windows& windows, const std::vector<double>& time, std::size_t most_rows);

/// Returns the JSON text that nlohmann's dump() would return, with invalid UTF-8 replaced. dump() itself
/// needs more time for a megabyte of base64.
std::string dumped(const json& page);

}  // namespace report
