// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/scenario/reference_waveform.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/reference_description.hpp"

namespace sixstep::study {

namespace {

/// Adds the intervals of one reference to `out`. The reference's times count from from_s. `before` is the
/// value of the preceding reference at from_s.
class StretchWriter {
 public:
  StretchWriter(const Reference& r, double from_s, double until_s, double before, std::vector<Stretch>& out)
      : r_(r), from_s_(from_s), until_s_(until_s), before_(before), out_(out) {}

  void add() {
    switch (r_.shape) {
      case Shape::constant:
        return put(0.0, r_.value);
      case Shape::steps:
        return steps();
      case Shape::square:
        return square();
      case Shape::ramp:
        return ramp();
      case Shape::sine:
        return put(0.0, r_.offset,
                   {.amplitude = r_.amplitude,
                    .frequency_Hz = r_.frequency_Hz,
                    .phase_turns = r_.phase_deg / 360.0});
      case Shape::trapezoid:
        return trapezoid();
      case Shape::csv:
        return rows();
    }
  }

 private:
  void put(double at_s, double value, const rig::Waveform& waveform = {}) {
    if (at_s == 0.0 || from_s_ + at_s < until_s_) out_.push_back({from_s_ + at_s, value, waveform});
  }
  void stand_until(double at_s, double value) {
    if (at_s > 0.0) put(0.0, value);
  }

  void steps() {
    if (r_.times_s.empty() || r_.times_s.front() > 0) put(0.0, before_);
    for (std::size_t n = 0; n < r_.times_s.size(); ++n) put(r_.times_s[n], r_.values[n]);
  }

  /// Half period n begins at n T/2, rounded once. A sum of half periods would be rounded at every edge.
  void square() {
    const double half_s = r_.period_s / 2;
    for (int n = 0; n == 0 || from_s_ + n * half_s < until_s_; ++n)
      put(n * half_s, n % 2 == 0 ? r_.high : r_.low);
  }

  void ramp() {
    const double start = r_.start.value_or(before_), way = r_.end - start;
    const double length_s = r_.end_s ? *r_.end_s - r_.begin_s : std::fabs(way) / r_.slope.value_or(1.0);
    stand_until(r_.begin_s, start);
    if (length_s > 0.0) put(r_.begin_s, start, {.rate = way / length_s});
    put(r_.begin_s + length_s, r_.end);
  }

  /// Movement over the distance s from rest to rest, with the largest rate v and its rate of change a. The
  /// rate rises for t_a = v/a, stays for s/v - t_a and falls for t_a. A movement shorter than v^2/a never
  /// reaches v: t_a = sqrt(s/a).
  void trapezoid() {
    const double start = r_.start.value_or(before_), way = r_.end - start, size = std::fabs(way);
    const double v = r_.slope.value_or(1.0), a = r_.acceleration.value_or(1.0), sign = way < 0 ? -1.0 : 1.0;
    const bool cruises = size * a > v * v;
    const double rise_s = cruises ? v / a : std::sqrt(size / a);
    const double cruise_s = cruises ? size / v - rise_s : 0.0;
    const double rate = sign * a * rise_s, first = rate * rise_s / 2, begin_s = r_.begin_s;
    stand_until(begin_s, start);
    if (rise_s > 0.0) put(begin_s, start, {.curvature = sign * a});
    if (cruises) put(begin_s + rise_s, start + first, {.rate = rate});
    if (rise_s > 0.0)
      put(begin_s + rise_s + cruise_s, r_.end - first, {.rate = rate, .curvature = -sign * a});
    put(begin_s + 2 * rise_s + cruise_s, r_.end);
  }

  /// The first value also applies before the table, and the last value after it.
  void rows() {
    const std::vector<double>&t = r_.times_s, &y = r_.values;
    if (t.empty()) return put(0.0, before_);
    stand_until(t.front(), y.front());
    for (std::size_t n = 0; n < t.size(); ++n) {
      const bool goes_on = r_.interpolation == Interpolation::linear && n + 1 < t.size();
      put(t[n], y[n], {.rate = goes_on ? (y[n + 1] - y[n]) / (t[n + 1] - t[n]) : 0.0});
    }
  }

  const Reference& r_;
  double from_s_, until_s_, before_;
  std::vector<Stretch>& out_;
};

/// The time at which interval n ends, s.
double end_of(const std::vector<Stretch>& stretches, std::size_t n, double duration_s) {
  return n + 1 < stretches.size() ? stretches[n + 1].at_s : duration_s;
}

}  // namespace

std::vector<Stretch> reference_waveform(const Scenario& s) {
  std::vector<const At*> changes = in_order(s);
  std::erase_if(changes, [](const At* at) { return !at->reference; });
  const auto until = [&](std::size_t n) {
    return n < changes.size() ? happens_at_s(s, *changes[n]) : s.duration_s;
  };
  std::vector<Stretch> stretches;
  StretchWriter(s.reference, 0.0, until(0), 0.0, stretches).add();
  for (std::size_t n = 0; n < changes.size(); ++n) {
    const double from_s = until(n);
    StretchWriter(*changes[n]->reference, from_s, until(n + 1), stretches.back().at(from_s), stretches).add();
  }
  return stretches;
}

std::vector<Level> reference_levels(const Scenario& s) {
  const std::vector<Stretch> stretches = reference_waveform(s);
  std::vector<Level> levels;
  for (std::size_t n = 0; n < stretches.size(); ++n) {
    const Stretch& stretch = stretches[n];
    levels.push_back({stretch.at_s, stretch.waveform.moves() ? stretch.at(end_of(stretches, n, s.duration_s))
                                                             : stretch.value});
  }
  return levels;
}

double largest_reference(const Scenario& s) {
  const std::vector<Stretch> stretches = reference_waveform(s);
  double largest = 0.0;
  // Only a sine reverses within its interval. All other intervals have their extremes at their ends.
  for (std::size_t n = 0; n < stretches.size(); ++n) {
    const Stretch& stretch = stretches[n];
    const double swing = std::fabs(stretch.waveform.amplitude);
    largest = std::max(largest, std::fabs(stretch.value) + swing);
    if (stretch.waveform.moves() && swing == 0.0)
      largest = std::max(largest, std::fabs(stretch.at(end_of(stretches, n, s.duration_s))));
  }
  return largest;
}

bool reference_moves(const Scenario& s, double from_s, double to_s) {
  const std::vector<Stretch> stretches = reference_waveform(s);
  for (std::size_t n = 0; n < stretches.size(); ++n)
    if (stretches[n].waveform.moves() && stretches[n].at_s < to_s &&
        end_of(stretches, n, s.duration_s) > from_s)
      return true;
  return false;
}

std::optional<double> reference_rests_from_s(const Scenario& s) {
  Scenario longer = s;
  const Reference* last = &s.reference;
  for (const At* at : in_order(s))
    if (at->reference) last = &*at->reference;
  // For a square wave the run's duration stays: the wave only repeats its two levels, and over longest_s it
  // would have too many intervals.
  if (last->shape != Shape::square) longer.duration_s = longest_s;
  const std::vector<Stretch> stretches = reference_waveform(longer);
  if (stretches.back().waveform.moves()) return std::nullopt;
  double rests_s = 0.0;
  for (std::size_t n = 0; n + 1 < stretches.size(); ++n)
    if (stretches[n].waveform.moves()) rests_s = stretches[n + 1].at_s;
  return rests_s;
}

}  // namespace sixstep::study
