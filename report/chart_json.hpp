// SPDX-License-Identifier: Apache-2.0
// Writes the parts of the JSON from which the pages' scripts draw.
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

/// The chosen rows of a column as base64 of their bytes.
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

/// A chart without its curves. `complete`: no envelope replaces any of the `recorded` rows.
json chart_json(const Group& group, bool complete, std::size_t recorded);
json curve_json(const Curve& curve, std::size_t axis, const std::vector<std::size_t>& rows);

/// The chart and curve to which a packed column belongs.
struct CurvePlace {
  std::size_t chart = 0, curve = 0;
};
/// Columns beyond `places` are not curves: they hold the conduction codes.
json rows_json(const PackedRows& rows, const std::vector<CurvePlace>& places);

json windows_json(const Windows& windows, const sixstep::study::Scenario& scenario);
/// The windows, as many as the page can hold with all their rows.
std::vector<Interval> kept(const Windows& windows, const std::vector<double>& time, std::size_t most_rows);

/// Returns the JSON text that the library would print; invalid UTF-8 is replaced. The library itself needs
/// more time for a megabyte of base64.
std::string dumped(const json& page);

}  // namespace report
