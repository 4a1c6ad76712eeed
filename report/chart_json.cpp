// SPDX-License-Identifier: Apache-2.0
#include "report/chart_json.hpp"

#include <algorithm>
#include <string_view>

namespace report {
namespace {

std::size_t rows_in(const std::vector<double>& time, const Interval& window) {
  return static_cast<std::size_t>(std::ranges::upper_bound(time, window.to) -
                                  std::ranges::lower_bound(time, window.from));
}

}  // namespace

std::size_t Axes::of(const std::vector<double>& time, const std::vector<std::size_t>& rows) {
  const auto [axis, fresh] = places_.try_emplace({&time, rows}, places_.size());
  if (fresh) page_["axes"].push_back(packed<double>(time, rows));
  return axis->second;
}

json chart_json(const Group& group, bool complete, std::size_t recorded) {
  json chart{
      {"id", group.id},       {"title", group.title}, {"unit", group.unit},   {"height", group.height_px},
      {"logic", group.logic}, {"lanes", group.lanes}, {"complete", complete}, {"recorded", recorded}};
  if (!group.quantity.empty()) chart["quantity"] = group.quantity;
  return chart;
}

json curve_json(const Curve& curve, std::size_t axis, const std::vector<std::size_t>& rows) {
  return {{"label", curve.label},
          {"style", curve.style},
          {"meaning", curve.meaning},
          {"axis", axis},
          {"data", packed<float>(*curve.values, rows)}};
}

json rows_json(const PackedRows& rows, const std::vector<CurvePlace>& places) {
  json columns = json::array();
  for (std::size_t n = 0; n < rows.columns.size(); ++n) {
    json column{{"low", rows.columns[n].low}, {"step", rows.columns[n].step}};
    if (n < places.size()) {
      column["chart"] = places[n].chart;
      column["curve"] = places[n].curve;
    }
    columns.push_back(std::move(column));
  }
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(rows.bytes.data());
  return {{"rows", rows.rows},
          {"start", rows.start_s},
          {"tick", rows.tick_s},
          {"columns", std::move(columns)},
          {"data", base64(std::span(bytes, rows.bytes.size()))}};
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

std::vector<Interval> kept(const Windows& windows, const std::vector<double>& time, std::size_t most_rows) {
  std::vector<Interval> out;
  for (const auto& window : {windows.periods, windows.commutation, windows.step})
    if (window && rows_in(time, *window) <= most_rows) out.push_back(*window);
  return out;
}

namespace {

std::string by_library(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// Whether a text needs no escapes in JSON. Base64 and most names need none.
bool is_plain(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c >= ' ' && c < 0x7F && c != '"' && c != '\\'; });
}

void append_string(std::string& out, const std::string& text) {
  if (!is_plain(text))
    out += by_library(text);
  else
    out.append(1, '"').append(text).append(1, '"');
}

void append_value(std::string& out, const json& value) {
  const char* between = "";
  if (value.is_object()) {
    out += '{';
    for (const auto& [key, of] : value.items()) {
      append_string(out += between, key);
      append_value(out += ':', of);
      between = ",";
    }
    out += '}';
  } else if (value.is_array()) {
    out += '[';
    for (const json& of : value) {
      append_value(out += between, of);
      between = ",";
    }
    out += ']';
  } else if (value.is_string()) {
    append_string(out, value.get_ref<const std::string&>());
  } else {
    out += by_library(value);
  }
}

}  // namespace

std::string dumped(const json& page) {
  std::string out;
  append_value(out, page);
  return out;
}

}  // namespace report
