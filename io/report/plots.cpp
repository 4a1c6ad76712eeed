// SPDX-License-Identifier: Apache-2.0
#include "io/report/plots.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "io/report/conduction.hpp"
#include "io/report/groups.hpp"
#include "io/report/html.hpp"
#include "io/report/thinning.hpp"
#include "io/report/windows.hpp"

namespace io::report {
namespace {

using json = nlohmann::ordered_json;

template <class To>
std::string packed(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<To> chosen;
  chosen.reserve(rows.size());
  for (const std::size_t n : rows) chosen.push_back(static_cast<To>(values[n]));
  return base64(std::span<const To>(chosen));
}

std::size_t rows_in(const std::vector<double>& time, const Interval& window) {
  return static_cast<std::size_t>(std::ranges::upper_bound(time, window.to) -
                                  std::ranges::lower_bound(time, window.from));
}

json windows_json(const Windows& windows, const sixstep::study::Scenario& scenario) {
  json out = json::array();
  const auto add = [&](const char* id, const char* label, const std::optional<Interval>& window) {
    if (window) out.push_back({{"id", id}, {"label", label}, {"from", window->from}, {"to", window->to}});
  };
  const bool hysteresis = scenario.control.current.type == sixstep::study::CurrentLoopType::hysteresis &&
                          scenario.control.mode >= sixstep::control::Mode::current;
  add("step", "Largest step", windows.step);
  add("periods", hysteresis ? "Switching" : "Three PWM periods", windows.periods);
  add("commutation", "One commutation", windows.commutation);
  return out;
}

json chart_json(const Group& group, std::size_t axis, const Thinned& rows, std::size_t recorded) {
  json chart{{"id", group.id},
             {"title", group.title},
             {"unit", group.unit},
             {"height", group.height_px},
             {"logic", group.logic},
             {"lanes", group.lanes},
             {"complete", rows.complete},
             {"recorded", recorded}};
  if (!group.quantity.empty()) chart["quantity"] = group.quantity;
  for (const Curve& curve : group.curves)
    chart["curves"].push_back({{"label", curve.label},
                               {"style", curve.style},
                               {"meaning", curve.meaning},
                               {"axis", axis},
                               {"data", packed<float>(*curve.values, rows.rows)}});
  return chart;
}

/// All changes where they are few enough to carry; a page must stay small enough to send.
json conduction_json(const Conduction& c) {
  constexpr std::size_t most = 400000;
  if (c.code.empty() || c.code.size() > most) return nullptr;
  return {{"time", base64(std::span<const double>(c.time_s))},
          {"code", base64(std::span<const std::uint8_t>(c.code))},
          {"end", c.end_s}};
}

/// Time axes of the page: charts that keep the same rows share one, for it is the largest part of the file.
class Axes {
 public:
  Axes(json& page, const std::vector<double>& time) : page_(page), time_(time) {}
  std::size_t of(const std::vector<std::size_t>& rows) {
    const auto [axis, fresh] = places_.try_emplace(rows, places_.size());
    if (fresh) page_["axes"].push_back(packed<double>(time_, rows));
    return axis->second;
  }

 private:
  json& page_;
  const std::vector<double>& time_;
  std::map<std::vector<std::size_t>, std::size_t> places_;
};

}  // namespace

std::string plot_data(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario,
                      int pole_pairs, PlotSize size) {
  json out{
      {"run", json::array()}, {"windows", json::array()}, {"axes", json::array()}, {"charts", json::array()}};
  const auto* time = find_column(trace, "t_s");
  if (!time || time->size() < 2) return out.dump();
  out["run"] = {time->front(), time->back()};
  const Windows windows = choose_windows(trace, scenario);
  out["windows"] = windows_json(windows, scenario);
  std::vector<Interval> keep;
  for (const auto& window : {windows.periods, windows.commutation, windows.step})
    if (window && rows_in(*time, *window) <= size.full) keep.push_back(*window);
  Axes axes(out, *time);
  const Groups groups = chart_groups(trace, scenario);
  for (const Group& group : groups.charts) {
    Curves curves;
    for (const Curve& curve : group.curves) curves.emplace_back(*curve.values);
    const Thinned rows = thinned(*time, curves, keep, size.cap, size.full);
    out["charts"].push_back(chart_json(group, axes.of(rows.rows), rows, time->size()));
  }
  if (!groups.angle_deg.empty()) {
    // It turns smoothly: between 2000 rows a straight line is as good as the drawing.
    const Thinned rows = thinned(*time, {groups.angle_deg}, {}, 2000, 2000);
    out["angle"] = {{"axis", axes.of(rows.rows)}, {"data", packed<float>(groups.angle_deg, rows.rows)}};
  }
  out["conduction"] = conduction_json(conduction(trace));
  out["pole_pairs"] = pole_pairs;
  return out.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace io::report
