// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/recorded_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "sixstep/base/elementary.hpp"

namespace sixstep::study {

namespace {

using Values = std::vector<double>;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Student's t for 95 %, by Abramowitz and Stegun 26.7.5 with another last term: within 1 % from 1 degree of freedom on.
double student(double freedom) {
  const double n = 1.0 / freedom;
  return 1.96 + n * (2.372 + n * (2.822 + n * (2.556 + n * 2.996)));
}

double deviation(const Values& x, double mean) {
  double squares = 0.0;
  for (const double v : x) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / static_cast<double>(x.size() - 1));
}

double mean_of(std::span<const double> x) {
  double sum = 0.0;
  for (const double v : x) sum += v;
  return sum / static_cast<double>(x.size());
}

/// The mean of values of which `independent` do not depend on each other.
Estimate mean_estimate(const Values& x, double independent, double resolution) {
  Estimate out;
  out.count = static_cast<std::size_t>(independent);
  if (x.empty()) return out;
  out.value = mean_of(x);
  if (x.size() < 2) {
    out.uncertainty = infinite;
    return out;
  }
  const double spread = deviation(x, out.value) * student(std::max(1.0, independent - 1.0));
  out.uncertainty = root_of_squares(spread / std::sqrt(independent), resolution);
  return out;
}

struct Pulse {
  double from_s, to_s;
};

/// The pulses above the level. An edge counts if the signal goes on by a twentieth of its span, so that noise at the
/// level makes no pulse; its instant is where the line between two samples crosses the level. `sign` -1: below.
std::vector<Pulse> pulses(const Samples& x, double level, double sign) {
  const auto [low, high] = std::minmax_element(x.values.begin(), x.values.end());
  const double margin = 0.05 * (*high - *low);
  std::vector<Pulse> out;
  bool risen = false, known = false;
  double up_s = 0.0, down_s = 0.0, rise_s = 0.0, before = 0.0;
  for (std::size_t n = 0; n < x.values.size(); ++n) {
    const double v = sign * (x.values[n] - level);
    if (n > 0 && (before < 0.0) != (v < 0.0))
      (v < 0.0 ? down_s : up_s) = x.start_s + x.interval_s * (static_cast<double>(n) - v / (v - before));
    before = v;
    if (v > margin && !risen) {
      risen = true;
      rise_s = up_s;
      known = known && n > 0;
    } else if (v < -margin) {
      if (risen && known) out.push_back({rise_s, down_s});
      risen = false;
      known = true;  // the recording has shown the level's other side, so that the next edge is one
    }
  }
  return out;
}

Estimate of_pulses(const FigureAsked& asked, const Samples& x) {
  const RecordedFigure figure = asked.figure.fact->figure;
  Values widths, rises;
  for (const Pulse& p : pulses(x, asked.level, figure == RecordedFigure::low ? -1.0 : 1.0)) {
    const double width = p.to_s - p.from_s;
    if (width < asked.shortest_s || width > asked.longest_s) continue;
    widths.push_back(width);
    rises.push_back(p.from_s);
  }
  // Two edges, each uniform within a sample: 2 * interval / sqrt(6). It stays with any number of pulses, because
  // pulses may be locked to the samples.
  const double resolution = 0.82 * x.interval_s;
  if (figure != RecordedFigure::period)
    return mean_estimate(widths, static_cast<double>(widths.size()), resolution);
  Values steps;
  for (std::size_t n = 1; n < rises.size(); ++n) steps.push_back(rises[n] - rises[n - 1]);
  if (steps.empty()) return {};
  // Pulses may pause; steps far from the median contain a pause.
  Values sorted = steps;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  const double median = sorted[sorted.size() / 2];
  std::erase_if(steps, [median](double s) { return std::abs(s - median) > 0.25 * median; });
  const auto count = static_cast<double>(steps.size());
  return mean_estimate(steps, count, resolution / std::max(1.0, count));
}

/// One order of a signal: a cos(p) + b sin(p) with the phase p since the first value.
struct Wave {
  double a = 0.0, b = 0.0;
  double size() const { return root_of_squares(a, b); }
};

/// One order over a whole period of `samples` samples: of the last value only a part counts, because a rounded
/// period would make harmonics of its own.
Wave amplitude(std::span<const double> x, double samples, int order) {
  const double step = 2.0 * std::numbers::pi * order / samples, mean = mean_of(x),
               over = static_cast<double>(x.size()) - samples, cos_step = base::cos(step),
               sin_step = base::sin(step);
  Wave sum;
  double cos = 1.0, sin = 0.0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double v = (x[n] - mean) * (n + 1 == x.size() ? 1.0 - over : 1.0) * (2.0 / samples), was = cos;
    sum.a += v * cos;
    sum.b += v * sin;
    cos = was * cos_step - sin * sin_step;
    sin = sin * cos_step + was * sin_step;
  }
  return sum;
}

/// The figure's value over one period.
double over_period(const NamedFigure& figure, std::span<const double> x, double samples) {
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  switch (figure.fact->figure) {
    case RecordedFigure::minimum:
      return *low;
    case RecordedFigure::maximum:
      return *high;
    case RecordedFigure::peak_to_peak:
      return *high - *low;
    case RecordedFigure::harmonic: {
      const double fundamental = amplitude(x, samples, 1).size();
      return figure.order == 1 ? fundamental : amplitude(x, samples, figure.order).size() / fundamental;
    }
    case RecordedFigure::rms: {
      double squares = 0.0;
      for (const double v : x) squares += v * v;
      return std::sqrt(squares / static_cast<double>(x.size()));
    }
    default:
      return mean_of(x);
  }
}

/// The fundamental's period in samples, near the given one, by its phase at both ends of the samples.
double own_period(const Values& x, double samples) {
  for (int n = 0; n < 2; ++n) {
    const auto length = static_cast<std::size_t>(std::ceil(samples));
    if (length < 8 || x.size() < length + length / 10) return samples;
    const std::size_t apart = x.size() - length;
    const Wave first = amplitude({x.data(), length}, samples, 1),
               last = amplitude({x.data() + apart, length}, samples, 1);
    const double turned = 2.0 * std::numbers::pi * static_cast<double>(apart) / samples,
                 seen = base::atan2(first.b, first.a) - base::atan2(last.b, last.a);
    samples *= turned / (turned + std::remainder(seen - turned, 2.0 * std::numbers::pi));
  }
  return samples;
}

/// Values over windows of one period that begin all over the samples. They overlap, so that as many are independent as
/// there are periods.
Estimate of_periods(const FigureAsked& asked, const Samples& x) {
  constexpr std::size_t most_windows = 24;
  double samples = asked.period_s / x.interval_s;
  if (asked.figure.order > 0) samples = own_period(x.values, samples);
  const auto length = static_cast<std::size_t>(std::ceil(std::max(0.0, samples)));
  if (length < 2 || length > x.values.size()) return {};
  const std::size_t room = x.values.size() - length, windows = std::min(most_windows, room + 1);
  Values found;
  for (std::size_t n = 0; n < windows; ++n) {
    const std::size_t at = windows > 1 ? n * room / (windows - 1) : 0;
    found.push_back(over_period(asked.figure, {x.values.data() + at, length}, samples));
  }
  return mean_estimate(found, static_cast<double>(x.values.size()) / static_cast<double>(length), 0.0);
}

}  // namespace

void take_moving_mean(Samples& x, double mean_s) {
  const auto length = static_cast<std::size_t>(std::max(1L, std::lround(mean_s / x.interval_s)));
  if (length == 1 || x.values.size() < length) return;
  double sum = 0.0;
  for (std::size_t n = 0; n < length; ++n) sum += x.values[n];
  Values means;
  for (std::size_t n = length;; ++n) {
    means.push_back(sum / static_cast<double>(length));
    if (n == x.values.size()) break;
    sum += x.values[n] - x.values[n - length];
  }
  x.values = std::move(means);
  x.start_s += 0.5 * x.interval_s * static_cast<double>(length - 1);
}

Estimate estimate(const FigureAsked& asked, const Samples& x) {
  if (x.values.size() < 2) return {};
  return is_of_pulses(asked.figure.fact->figure) ? of_pulses(asked, x) : of_periods(asked, x);
}

}  // namespace sixstep::study
