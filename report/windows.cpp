// SPDX-License-Identifier: Apache-2.0
#include "report/windows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "report/highlights.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace report {
namespace {

using sixstep::study::Trace;

constexpr std::string_view gate_names[] = {"gate_T1", "gate_T2", "gate_T3", "gate_T4", "gate_T5", "gate_T6"};

/// Rows at which a column changes.
std::vector<std::size_t> changes(const std::vector<double>& values) {
  std::vector<std::size_t> rows;
  for (std::size_t n = 1; n < values.size(); ++n)
    if (values[n] != values[n - 1]) rows.push_back(n);
  return rows;
}

/// Turn-on instants of all six gates, in rising order.
std::vector<double> turn_ons(const Trace& trace, const std::vector<double>& time) {
  std::vector<double> instants;
  for (const auto& name : gate_names) {
    const auto* gate = find_column(trace, name);
    if (!gate) continue;
    for (const std::size_t n : changes(*gate))
      if ((*gate)[n] > 0.5) instants.push_back(time[n]);
  }
  std::ranges::sort(instants);
  return instants;
}

std::optional<Interval> switching_periods(const Trace& trace, const sixstep::study::Scenario& scenario,
                                          const std::vector<double>& time) {
  const double period = scenario.pwm.period_s;
  const double start = time.front(), end = time.back();
  if (!(period > 0.0) || end - start < 3.0 * period) return std::nullopt;
  const std::vector<double> instants = turn_ons(trace, time);
  // Hysteresis control has no fixed period, so its close-up shows some cycles of the comparators.
  const bool free_running = scenario.control.current.type == sixstep::study::CurrentLoopType::hysteresis &&
                            scenario.control.mode >= sixstep::control::Mode::current;
  if (free_running && instants.size() >= 5) {
    const double from = instants[instants.size() - 5], to = instants.back();
    return Interval{from - 0.1 * (to - from), std::min(end, to + 0.1 * (to - from))};
  }
  const auto last = static_cast<std::int64_t>(std::floor((end - start) / period * (1.0 + 1e-12)));
  const auto at = [&](std::int64_t n) { return start + static_cast<double>(n) * period; };
  for (std::int64_t n = last - 3; n >= 0; n -= 3) {
    const Interval window{at(n), at(n + 3)};
    const auto begin = std::lower_bound(instants.begin(), instants.end(), window.from);
    if (!is_whole(trace, window)) break;  // no earlier window is complete either
    if (std::upper_bound(instants.begin(), instants.end(), window.to) - begin >= 3) return window;
  }
  return Interval{at(last - 3), at(last)};
}

double largest_current(const Trace& trace, std::size_t row) {
  double largest = 0.0;
  for (const auto* name : {"i_a_A", "i_b_A", "i_c_A"}) {
    const auto* i = find_column(trace, name);
    if (i && std::abs((*i)[row]) > largest) largest = std::abs((*i)[row]);
  }
  return largest;
}

std::optional<Interval> one_commutation(const Trace& trace, double period, const std::vector<double>& time) {
  const auto* hall = find_column(trace, "hall");
  if (!hall) return std::nullopt;
  const std::vector<std::size_t> edges = changes(*hall);
  std::vector<double> currents;
  double strongest = 0.0;
  for (const std::size_t n : edges) {
    currents.push_back(largest_current(trace, n));
    strongest = std::max(strongest, currents.back());
  }
  for (std::size_t k = edges.size(); k-- > 0;) {
    if (currents[k] < 0.5 * strongest) continue;
    const double edge = time[edges[k]];
    // A sector may last microseconds, or arbitrarily long near standstill. Bounds limit the length of the
    // close-up.
    const double sector = k > 0 ? edge - time[edges[k - 1]] : 10.0 * period;
    const Interval window{edge - std::clamp(0.5 * sector, 3.0 * period, 8.0 * period),
                          edge + std::clamp(1.1 * sector, 6.0 * period, 14.0 * period)};
    if (window.from >= time.front() && window.to <= time.back() && is_whole(trace, window)) return window;
  }
  return std::nullopt;
}

}  // namespace

const std::vector<double>* find_column(const Trace& trace, std::string_view name) {
  for (std::size_t c = 0; c < trace.columns.size() && c < trace.values.size(); ++c) {
    if (trace.columns[c].name != name) continue;
    const auto& values = trace.values[c];
    const bool any = std::ranges::any_of(values, [](double v) { return std::isfinite(v); });
    return any ? &values : nullptr;
  }
  return nullptr;
}

bool is_whole(const Trace& trace, const Interval& interval) {
  return trace.whole.empty() || std::ranges::any_of(trace.whole, [&](const sixstep::study::TimeSpan& s) {
           return s.from_s <= interval.from && interval.to <= s.to_s;
         });
}

double whole_from_s(const Trace& trace) {
  if (!trace.whole.empty()) return trace.whole.back().from_s;
  const auto* time = find_column(trace, "t_s");
  return time && !time->empty() ? time->front() : 0.0;
}

Windows choose_windows(const Trace& trace, const sixstep::study::Scenario& scenario) {
  const auto* time = find_column(trace, "t_s");
  if (!time || time->size() < 2) return {};
  Windows out{switching_periods(trace, scenario, *time),
              one_commutation(trace, scenario.pwm.period_s, *time)};
  // A step as long as the run needs no close-up.
  const auto step = largest_step(trace, scenario);
  if (step && step->window.to - step->window.from < 0.8 * (time->back() - time->front()) &&
      is_whole(trace, step->window))
    out.step = step->window;
  return out;
}

}  // namespace report
