// SPDX-License-Identifier: Apache-2.0
#include "report/plots.hpp"

#include <algorithm>
#include <numeric>

#include "report/chart_json.hpp"
#include "report/conduction.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace report {
namespace {

/// Whether an event connects phases to other legs. One drawing then cannot show all connections.
bool rewires(const sixstep::study::Scenario& s) {
  return std::any_of(s.at.begin(), s.at.end(), [&](const sixstep::study::At& at) {
    return at.bridge.phases != sixstep::study::AtOrder::same;
  });
}

/// All changes of conduction, if there are at most 400000. `with_rows`: only the run's end, because the
/// packed rows contain the codes.
json conduction_json(const Conduction& c, bool with_rows) {
  constexpr std::size_t most = 400000;
  if (c.code.empty()) return nullptr;
  if (with_rows) return {{"end", c.end_s}};
  if (c.code.size() > most) return nullptr;
  return {{"time", base64(std::span<const double>(c.time_s))},
          {"code", base64(std::span<const std::uint8_t>(c.code))},
          {"end", c.end_s}};
}

/// The conduction code at each row. The compressed column needs almost no space, because its changes coincide
/// with changes of gates and currents.
std::vector<double> by_row(const Conduction& c, const std::vector<double>& time) {
  std::vector<double> codes;
  codes.reserve(time.size());
  std::size_t next = 0;
  for (const double t : time) {
    while (next < c.time_s.size() && c.time_s[next] <= t) ++next;
    codes.push_back(next > 0 ? c.code[next - 1] : 0.0);
  }
  return codes;
}

/// Every row of every curve, followed by the conduction codes; null if they are too large for the page.
json every_row(const std::vector<double>& time, const Groups& groups, const Conduction& conducts,
               std::size_t most_bytes) {
  std::vector<const std::vector<double>*> columns;
  std::vector<CurvePlace> places;
  for (std::size_t chart = 0; chart < groups.charts.size(); ++chart)
    for (std::size_t curve = 0; curve < groups.charts[chart].curves.size(); ++curve) {
      columns.push_back(groups.charts[chart].curves[curve].values);
      places.push_back({chart, curve});
    }
  const std::vector<double> codes = by_row(conducts, time);
  if (!conducts.code.empty()) columns.push_back(&codes);
  const auto packed = packed_rows(time, columns, most_bytes);
  return packed ? rows_json(*packed, places) : json();
}

json spectra_json(const Spectra& spectra, json& page) {
  json charts = json::array();
  for (const DrawnSpectrum& s : spectra.all) {
    const Drawn lines = drawn_lines(s.lines);
    const Group group{.id = s.id, .title = s.title, .unit = s.unit, .height_px = 220, .quantity = s.quantity};
    std::vector<std::size_t> rows(lines.amplitude.size());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    json chart = chart_json(group, true, rows.size());
    chart["log"] = true;
    const Curve curve{s.label, s.style, "amplitude", &lines.amplitude};
    chart["curves"].push_back(curve_json(curve, page["axes"].size(), rows));
    page["axes"].push_back(packed<double>(lines.frequency_Hz, rows));
    charts.push_back(std::move(chart));
  }
  return charts;
}

}  // namespace

std::string plot_data(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario,
                      double pole_pairs, PlotSize size, const std::optional<Spectra>& found) {
  json out{
      {"run", json::array()}, {"windows", json::array()}, {"axes", json::array()}, {"charts", json::array()}};
  const auto* time = find_column(trace, "t_s");
  if (!time || time->size() < 2) return out.dump();
  out["run"] = {time->front(), time->back()};
  const Windows windows = choose_windows(trace, scenario);
  out["windows"] = windows_json(windows, scenario);
  Axes axes(out);
  const Groups groups = chart_groups(trace, scenario);
  const std::array<std::uint8_t, 3> phase_at = sixstep::rig::ends_of(scenario.bridge.phases);
  const Conduction conducts =
      trace.whole.empty() && !rewires(scenario)
          ? conduction(trace, scenario.bridge.device == sixstep::study::Device::igbt, phase_at)
          : Conduction();
  const json every = time->size() > size.full && trace.whole.empty()
                         ? every_row(*time, groups, conducts, size.packed_bytes)
                         : json();
  // If every row is in the page, no close-up is needed beside the envelope.
  const std::vector<Interval> keep =
      every.is_null() ? kept(windows, *time, size.full) : std::vector<Interval>();
  if (!every.is_null()) out["rows"] = json::array({every});
  for (const Group& group : groups.charts) {
    Curves curves;
    for (const Curve& curve : group.curves) curves.emplace_back(*curve.values);
    const Thinned rows = thinned(*time, curves, keep, size.cap, size.full);
    json chart = chart_json(group, rows.complete && trace.whole.empty(), time->size() + trace.left_out);
    for (const Curve& curve : group.curves)
      chart["curves"].push_back(curve_json(curve, axes.of(*time, rows.rows), rows.rows));
    out["charts"].push_back(std::move(chart));
  }
  if (!groups.angle_deg.empty()) {
    // The angle is smooth, so straight lines between 2000 rows are exact enough for the drawing.
    const Thinned rows = thinned(*time, {groups.angle_deg}, {}, 2000, 2000);
    out["angle"] = {{"axis", axes.of(*time, rows.rows)},
                    {"data", packed<float>(groups.angle_deg, rows.rows)}};
  }
  out["conduction"] = conduction_json(conducts, !every.is_null());
  out["legs"] = phase_at;
  if (found) out["spectra"] = spectra_json(*found, out);  // after the axes over time
  out["pole_pairs"] = pole_pairs;
  return dumped(out);
}

}  // namespace report
