// SPDX-License-Identifier: Apache-2.0
#include "report/spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/highlights.hpp"
#include "report/windows.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace report {
namespace {

using Values = std::vector<double>;
using std::numbers::pi;

constexpr double fewest_periods = 64.0;
constexpr double most_periods =
    4096.0;  // with 64 cells per period, a transform of this many cells takes about 50 ms
constexpr std::size_t fewest_cells = 1024, most_cells = 1u << 18;

/// The value at t on the straight line between two rows.
double value_at(const Values& time, const Values& y, double t) {
  const auto after = std::ranges::upper_bound(time, t) - time.begin();
  if (after == 0) return y.front();
  const auto n = static_cast<std::size_t>(after);
  if (n == time.size()) return y.back();
  return y[n - 1] + (y[n] - y[n - 1]) * (t - time[n - 1]) / (time[n] - time[n - 1]);
}

/// The last time, not before `not_before`, at which the polyline through the rows crossed `level`.
std::optional<double> last_crossing(const Values& time, const Values& y, double level, double not_before) {
  for (std::size_t n = time.size(); n-- > 1 && time[n] >= not_before;) {
    const double a = y[n - 1] - level, b = y[n] - level;
    if (a == 0.0) return time[n - 1];
    if ((a < 0.0) != (b < 0.0)) return time[n - 1] + (time[n] - time[n - 1]) * a / (a - b);
  }
  return std::nullopt;
}

/// Means of the polyline through the rows, over `count` equal cells of the stretch.
Values cell_means(const Values& time, const Values& y, const Interval& stretch, std::size_t count) {
  const double width = (stretch.to - stretch.from) / static_cast<double>(count);
  Values means(count, 0.0);
  std::size_t cell = 0;
  for (std::size_t n = 1; n < time.size(); ++n) {
    const double t0 = time[n - 1], t1 = time[n];
    double from = std::max(t0, stretch.from);
    const double end = std::min(t1, stretch.to);
    if (!(from < end)) continue;
    const double slope = (y[n] - y[n - 1]) / (t1 - t0);
    while (from < end) {
      const bool last = cell + 1 == count;  // rounding may place the last cell's edge before the stretch's
                                            // end
      const double to = last ? end : std::min(end, stretch.from + width * static_cast<double>(cell + 1));
      if (to > from) means[cell] += (to - from) * (y[n - 1] + slope * ((from + to) / 2 - t0)) / width;
      if (to < end) ++cell;
      from = std::max(from, to);
    }
  }
  return means;
}

/// The tone of line k, which is higher than its neighbours. Frequency and amplitude are computed from line k
/// and its higher neighbour, by the Hann window's response to a tone `off` lines away.
Tone tone_at(const Values& a, std::size_t k) {
  const bool up = a[k + 1] >= a[k - 1];
  const double ratio = (up ? a[k + 1] : a[k - 1]) / a[k];
  const double off = std::clamp((2 * ratio - 1) / (ratio + 1), 0.0, 0.5);
  const double window = off > 0.0 ? std::sin(pi * off) / (pi * off * (1 - off * off)) : 1.0;
  return {static_cast<double>(k) + (up ? off : -off), a[k] / window};
}

/// Upper bound of the Hann window's leakage from a tone at this distance, in lines.
double leakage(double lines) { return lines > 1.2 ? 1 / (pi * lines * (lines * lines - 1)) : 1.0; }

std::vector<Tone> tones_of(const Values& a) {
  const double floor = a.empty() ? 0.0 : std::max(1e-3 * std::ranges::max(a), least_tone);
  std::vector<Tone> peaks, tones;
  // The search excludes the first line, because a drift over the stretch also causes a peak in this line.
  for (std::size_t k = 2; k + 1 < a.size(); ++k)
    if (a[k] > floor && a[k] > a[k - 1] && a[k] >= a[k + 1]) peaks.push_back(tone_at(a, k));
  std::ranges::stable_sort(peaks, [](const Tone& p, const Tone& q) { return p.amplitude > q.amplitude; });
  for (const Tone& p : peaks) {
    double leaked = 0.0;
    for (const Tone& t : tones) leaked += t.amplitude * leakage(std::abs(t.line - p.line));
    if (p.amplitude > 2 * leaked) tones.push_back(p);
  }
  return tones;
}

}  // namespace

std::optional<Stretch> steady_stretch(const sixstep::study::Trace& trace,
                                      const sixstep::study::Scenario& scenario, double pole_pairs) {
  const auto* time = find_column(trace, "t_s");
  if (!time || time->size() < 2) return std::nullopt;
  const double end = time->back(), begin = last_setpoint_s(trace, scenario).value_or(time->front());
  const double longest = most_periods * scenario.pwm.period_s;
  Stretch out{{std::max({(begin + end) / 2, end - longest, whole_from_s(trace)}), end}, 0};
  const auto* angle = find_column(trace, "angle_rad");
  if (angle && pole_pairs > 0) {
    const double turned = (angle->back() - value_at(*time, *angle, out.time.from)) * pole_pairs / (2 * pi);
    const double whole = std::trunc(turned);
    const auto from =
        last_crossing(*time, *angle, angle->back() - whole * 2 * pi / pole_pairs, out.time.from);
    const bool enough = std::abs(whole) >= fewest_turns;
    if (!enough) out.part = std::abs(turned);
    if (enough && from) out = {{*from, end}, std::llabs(static_cast<long long>(whole))};
  }
  if (out.time.to - out.time.from < fewest_periods * scenario.pwm.period_s) return std::nullopt;
  return out;
}

void transform(std::vector<std::complex<double>>& values) {
  const std::size_t count = values.size();
  for (std::size_t n = 1, reversed = 0; n < count; ++n) {
    std::size_t bit = count >> 1;
    for (; reversed & bit; bit >>= 1) reversed ^= bit;
    reversed ^= bit;
    if (n < reversed) std::swap(values[n], values[reversed]);
  }
  // The factors for half the size are every second factor of the full size. Division by a power of two does
  // not change the bits of the angle.
  std::vector<std::complex<double>> turns(count / 2), turn(count / 2);
  for (std::size_t k = 0; k < turns.size(); ++k)
    turns[k] = std::polar(1.0, -2 * pi * static_cast<double>(k) / static_cast<double>(count));
  for (std::size_t size = 2; size <= count; size *= 2) {
    for (std::size_t k = 0; k < size / 2; ++k) turn[k] = turns[k * (count / size)];
    for (std::size_t start = 0; start < count; start += size)
      for (std::size_t k = 0; k < size / 2; ++k) {
        const std::complex<double> even = values[start + k], other = values[start + k + size / 2];
        // The product is written out: the operator of std::complex also checks for infinities, which takes
        // three times as long.
        const std::complex<double> odd(turn[k].real() * other.real() - turn[k].imag() * other.imag(),
                                       turn[k].real() * other.imag() + turn[k].imag() * other.real());
        values[start + k] = even + odd;
        values[start + k + size / 2] = even - odd;
      }
  }
}

Lines lines_of(const Values& time, const Values& values, const Interval& stretch, double cell_s) {
  const double duration = stretch.to - stretch.from;
  std::size_t count = fewest_cells;
  while (count < most_cells && duration / static_cast<double>(count) > cell_s) count *= 2;
  const Values means = cell_means(time, values, stretch, count);
  const auto window = [count](std::size_t n) {
    return 0.5 - 0.5 * std::cos(2 * pi * static_cast<double>(n) / static_cast<double>(count));
  };
  // The mean is weighted by the window. Without the weights, an incomplete period would appear as a tone in
  // the first line.
  double mean = 0.0;
  for (std::size_t n = 0; n < count; ++n) mean += means[n] * window(n) / (0.5 * static_cast<double>(count));
  std::vector<std::complex<double>> bins(count);
  for (std::size_t n = 0; n < count; ++n) bins[n] = (means[n] - mean) * window(n);
  transform(bins);
  Lines out{.spacing_Hz = 1 / duration, .cell_s = duration / static_cast<double>(count)};
  out.amplitude.assign(count / 8 + 1, 0.0);
  for (std::size_t k = 1; k < out.amplitude.size(); ++k) {
    const double x = pi * static_cast<double>(k) / static_cast<double>(count);
    // The factor has three parts: 2/N for an amplitude, 1/2 for the window's mean, and the damping by the
    // cells' means.
    out.amplitude[k] = 4.0 / static_cast<double>(count) * std::abs(bins[k]) * x / std::sin(x);
  }
  out.tones = tones_of(out.amplitude);
  for (const Tone& t : out.tones) out.amplitude[static_cast<std::size_t>(std::lround(t.line))] = t.amplitude;
  return out;
}

Origin origin_of(double at, const Causes& causes) {
  constexpr long long highest_side = 12;
  const double electrical = static_cast<double>(causes.turns), periods = causes.periods;
  const bool turns = causes.turns > 0;
  constexpr double near = 0.3;  // in lines; the error of a tone's frequency is smaller, unless
                                // another tone is close
  const auto times = [](double n, const char* what) {
    return n == 1.0 ? std::string(what) : fmt::format("{} × {}", n, what);
  };
  const double order = turns ? std::round(at / electrical) : 0.0;
  const double beat = periods > 0.0 ? std::round(at / periods) : 0.0;
  if (beat >= 1.0 && std::abs(at - beat * periods) <= near) return {times(beat, "PWM"), beat * periods};
  if (beat >= 1.0 && turns) {
    const double side = std::round((at - beat * periods) / electrical);
    if (std::abs(side) <= static_cast<double>(highest_side) &&
        std::abs(at - beat * periods - side * electrical) <= near)
      return {fmt::format("{} {} {}", times(beat, "PWM"), side < 0 ? "−" : "+",
                          times(std::abs(side), "electrical")),
              beat * periods + side * electrical};
  }
  if (beat >= 1.0 && turns && std::abs(at - beat * periods) < electrical / 2)
    return {"beside " + times(beat, "PWM"), at};
  // The frequency of comparators is constant at constant speed and reference. Otherwise it changes by some
  // per cent.
  constexpr double moves = 0.05;
  const double switched = causes.switchings > 0.0 ? std::round(at / causes.switchings) : 0.0;
  const double off = std::abs(at - switched * causes.switchings);
  if (switched >= 1.0 && off <= near) return {times(switched, "switching"), switched * causes.switchings};
  // At high orders, every line is near a multiple by chance.
  if (order >= 1.0 && order <= 60.0 && std::abs(at - order * electrical) <= near)
    return {order == 1.0 ? "electrical, the fundamental" : times(order, "electrical"), order * electrical};
  if (switched >= 1.0 && off <= moves * causes.switchings)
    return {"beside " + times(switched, "switching"), at};
  // Full-wave rectified mains pulsate at multiples of twice the mains' frequency.
  const double mains = causes.mains > 0.0 ? 2 * std::round(at / (2 * causes.mains)) : 0.0;
  if (mains >= 1.0 && mains <= 60.0 && std::abs(at - mains * causes.mains) <= near)
    return {times(mains, "mains"), mains * causes.mains};
  const double step = causes.heat_steps > 0.0 ? std::round(at / causes.heat_steps) : 0.0;
  if (step >= 1.0 && std::abs(at - step * causes.heat_steps) <= near)
    return {times(step, "step of the thermal model"), step * causes.heat_steps};
  return {"", at};
}

}  // namespace report
