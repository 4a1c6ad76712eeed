// SPDX-License-Identifier: Apache-2.0
// The pieces of the JSON that the pages' scripts draw from.
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

/// The chosen rows of a column as base64 of its bytes.
template <class To>
std::string packed(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<To> chosen;
  chosen.reserve(rows.size());
  for (const std::size_t n : rows) chosen.push_back(static_cast<To>(values[n]));
  return base64(std::span<const To>(chosen));
}

/// A page's time axes: curves that keep the same rows share one, for it is the largest part of the file.
class Axes {
 public:
  explicit Axes(json& page) : page_(page) {}
  std::size_t of(const std::vector<double>& time, const std::vector<std::size_t>& rows);

 private:
  json& page_;
  std::map<std::pair<const std::vector<double>*, std::vector<std::size_t>>, std::size_t> places_;
};

/// A chart without its curves. `complete`: no envelope stands for any of the `recorded` rows.
json chart_json(const Group& group, bool complete, std::size_t recorded);
json curve_json(const Curve& curve, std::size_t axis, const std::vector<std::size_t>& rows);

/// Which curve of which chart a packed column belongs to.
struct CurvePlace {
  std::size_t chart = 0, curve = 0;
};
/// A column beyond the places is no curve: what conducts.
json rows_json(const PackedRows& rows, const std::vector<CurvePlace>& places);

json windows_json(const Windows& windows, const sixstep::study::Scenario& scenario);
/// Those whose every row the page can carry.
std::vector<Interval> kept(const Windows& windows, const std::vector<double>& time, std::size_t most_rows);

/// As text, as the library writes it; what is no UTF-8 is replaced. Its way through a megabyte of base64 is longer.
std::string dumped(const json& page);

}  // namespace report
