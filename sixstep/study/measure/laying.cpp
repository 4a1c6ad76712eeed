// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/laying.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/sheet_constants.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::study {

namespace {

/// Sums over rows with the simulated value s and the recorded value r.
struct Sums {
  double n = 0.0, s = 0.0, r = 0.0, ss = 0.0, sr = 0.0, rr = 0.0;
  void add(const Sums& o, double sign) {
    n += sign * o.n;
    s += sign * o.s;
    r += sign * o.r;
    ss += sign * o.ss;
    sr += sign * o.sr;
    rr += sign * o.rr;
  }
  void add(double x, double y) { add({1.0, x, y, x * x, x * y, y * y}, 1.0); }
};

/// The line r = gain * s + zero. The noise is the recording's, so that the recorded value is the dependent one.
struct Line {
  double gain, zero;
  double scale() const { return 1.0 / gain; }
  double offset() const { return -zero / gain; }
};

Line line(const Recording& c, const Sums& t) {
  const bool scale = c.is_free("scale"), offset = c.is_free("offset");
  const double given = 1.0 / c.scale;
  if (scale && offset) {
    const double gain = (t.n * t.sr - t.s * t.r) / (t.n * t.ss - t.s * t.s);
    return {gain, (t.r - gain * t.s) / t.n};
  }
  if (scale) {  // r = gain * (s - offset)
    const double gain = (t.sr - c.offset * t.r) / (t.ss - 2.0 * c.offset * t.s + c.offset * c.offset * t.n);
    return {gain, -gain * c.offset};
  }
  return {given, offset ? (t.r - given * t.s) / t.n : -given * c.offset};
}

/// Squares of the distance from the line, as a part of the recording's own about its mean.
double left(const Line& l, const Sums& t) {
  const double squares = t.rr - 2.0 * l.gain * t.sr - 2.0 * l.zero * t.r + l.gain * l.gain * t.ss +
                         2.0 * l.gain * l.zero * t.s + l.zero * l.zero * t.n;
  return squares / std::max(t.rr - t.r * t.r / t.n, std::numeric_limits<double>::min());
}

/// The simulated value at a time, on the line between two samples; NaN beyond the ends.
double value_at(const Samples& x, double t_s) {
  const double at = (t_s - x.start_s) / x.interval_s;
  if (!(at >= 0.0)) return NAN;
  const auto n = static_cast<std::size_t>(at);
  if (n + 1 >= x.values.size()) return NAN;
  return x.values[n] + (at - static_cast<double>(n)) * (x.values[n + 1] - x.values[n]);
}

/// A recording that begins at a time, over the simulation.
struct Overlap {
  const Samples &recorded, &simulated;
  double begin_s;
  template <class Use>
  void each(std::size_t every, const Use& use) const {
    for (std::size_t n = 0; n < recorded.values.size(); n += every) {
      const double t = begin_s + recorded.start_s + recorded.interval_s * static_cast<double>(n);
      const double s = value_at(simulated, t);
      if (s == s) use(n, t, s, recorded.values[n]);
    }
  }
};

constexpr std::size_t blocks = 8;

/// Half widths of the 95 % intervals by leaving out one block of rows after the other: Student's t of 7
/// degrees of freedom times the jackknife's deviation. Errors within a block may depend on each other.
void bound(const Recording& c, const std::array<Sums, blocks>& parts, const Sums& all, Placing& out) {
  double scales = 0.0, offsets = 0.0;
  for (const Sums& part : parts) {
    Sums rest = all;
    rest.add(part, -1.0);
    const Line l = line(c, rest);
    scales += (l.scale() - out.scale) * (l.scale() - out.scale);
    offsets += (l.offset() - out.offset) * (l.offset() - out.offset);
  }
  constexpr double student_7 = 2.365, factor = (blocks - 1.0) / blocks;
  out.scale_bound = student_7 * std::sqrt(factor * scales);
  out.offset_bound = student_7 * std::sqrt(factor * offsets);
}

/// The shift with the least distance, on a grid and then on finer ones.
double best_shift(const Recording& c, const Samples& recorded, const Samples& simulated, double from_s,
                  double period_s) {
  constexpr double coarse = 256.0, finer = 8.0;
  double best = c.shift_s, least = std::numeric_limits<double>::infinity(), low = c.shift_s,
         high = c.shift_s + period_s, step = std::max(period_s / coarse, recorded.interval_s);
  std::size_t rows = 4000, most = 0;
  for (;;) {
    const std::size_t every = recorded.values.size() / rows + 1;
    least = std::numeric_limits<double>::infinity();
    for (double shift = low; shift <= high; shift += step) {
      Sums sums;
      Overlap{recorded, simulated, from_s + shift}.each(
          every, [&](std::size_t, double, double s, double r) { sums.add(s, r); });
      const auto count = static_cast<std::size_t>(sums.n) * every;
      most = std::max(most, count);
      if (count < fewest_rows || 2 * count < most) continue;
      const Line found = line(c, sums);
      const double there = left(found, sums);
      if (there >= least || found.gain * c.scale < 0.0) continue;
      least = there;
      best = shift;
    }
    if (step <= 0.02 * recorded.interval_s) return best;
    low = best - step;
    high = best + step;
    step /= finer;
    rows = 40'000;
  }
}

std::string bounded(double value, double half) {
  return base::rounded(value, 5) + " +- " + base::rounded(half, 2);
}

}  // namespace

Placing placed(const Recording& c, const Samples& recorded, const Samples& simulated, double from_s,
               double period_s) {
  Placing out;
  out.shift_s = c.is_free("shift") ? best_shift(c, recorded, simulated, from_s, period_s) : c.shift_s;
  const Overlap laid{recorded, simulated, from_s + out.shift_s};
  std::array<Sums, blocks> parts;
  laid.each(1, [&](std::size_t n, double, double s, double r) {
    parts[n * blocks / recorded.values.size()].add(s, r);
  });
  Sums all;
  for (const Sums& part : parts) all.add(part, 1.0);
  const Line l = line(c, all);
  out.rows = static_cast<std::size_t>(all.n);
  out.scale = l.scale();
  out.offset = l.offset();
  bound(c, parts, all, out);
  double squares = 0.0, low = HUGE_VAL, high = -HUGE_VAL;
  laid.each(1, [&](std::size_t, double t, double s, double r) {
    low = std::min(low, s);
    high = std::max(high, s);
    const double apart = out.scale * r + out.offset - s;
    squares += apart * apart;
    if (std::abs(apart) > std::abs(out.greatest)) {
      out.greatest = apart;
      out.at_s = t;
    }
  });
  out.rms = out.rows < fewest_rows ? NAN : std::sqrt(squares / all.n);
  out.span = high - low;
  return out;
}

namespace {

/// Samples of the simulation per row of the recording. Between two samples the simulation is taken as a line, which cuts the
/// peaks of a wave of few rows.
double finer_grid(const LaidOver& laid, const Scenario& scenario) {
  constexpr double usual = 8.0, most_samples = 1e6;
  const double window_s = laid.measure.to_s.value_or(scenario.duration_s) - laid.measure.from_s.value_or(0.0);
  const double rows = window_s / laid.recording.rows->interval_s;
  return std::clamp(std::floor(most_samples / std::max(rows, 1.0)), 1.0, usual);
}

/// Noise of the rows: 1.4826 times the median size of their second differences, divided by sqrt(6). Edges are rare, so that
/// they do not move the median.
double noise_of(const std::vector<double>& x) {
  std::vector<double> bends;
  for (std::size_t n = 1; n + 1 < x.size(); ++n) bends.push_back(std::fabs(x[n - 1] - 2.0 * x[n] + x[n + 1]));
  if (bends.empty()) return 0.0;
  const auto middle = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() / 2);
  std::nth_element(bends.begin(), middle, bends.end());
  return 1.4826 * *middle / std::sqrt(6.0);
}

}  // namespace

Laying::Laying(const Scenario& scenario) : scenario_(scenario), watched_(scenario.recordings().size()) {}

void Laying::watch(std::vector<GridRecorder>& grids) {
  for (std::size_t n = 0; n < watched_.size(); ++n) {
    const LaidOver& laid = scenario_.recordings()[n];
    const std::optional<std::size_t> column = column_of(laid.measure.signal);
    if (!column || !laid.recording.rows) continue;
    Watched& to = watched_[n];
    const sim::Instant grid = sim::to_instant(laid.recording.rows->interval_s / finer_grid(laid, scenario_));
    const double from_s = laid.measure.from_s.value_or(0.0),
                 to_s = laid.measure.to_s.value_or(scenario_.duration_s),
                 factor = all_columns(scenario_.sheet.kind)[*column].per_turning;
    to.signal.interval_s = grid.seconds();
    grids.push_back(
        GridRecorder(grid.ticks, sim::to_instant(scenario_.duration_s),
                     std::vector{std::size_t{0}, *column, static_cast<std::size_t>(ColumnId::angle)},
                     [&to, from_s, to_s, factor](std::span<const double> row) {
                       if (row[0] < from_s || row[0] > to_s) return;
                       if (to.signal.values.empty()) {
                         to.signal.start_s = row[0];
                         to.first_angle = row[2];
                       }
                       to.last_angle = row[2];
                       to.signal.values.push_back(row[1] * factor);
                     }));
  }
}

void Laying::judge(Outcome& outcome) const {
  std::vector<LaidRecording> pictures;
  for (std::size_t n = 0; n < watched_.size(); ++n) judge_one(n, outcome, pictures);
  if (!pictures.empty())
    outcome.laid = std::make_shared<const std::vector<LaidRecording>>(std::move(pictures));
}

namespace {

/// A recording on the run's clock and in the signal's unit, with the signal.
struct Pair {
  Samples recorded, simulated;
  Placing placing;
  double period_s = 0.0;
};

/// What is known of the probe and of the agreement, in one sentence.
std::string note_of(const LaidOver& laid, const Placing& p) {
  const Recording& c = laid.recording;
  const std::string unit = std::string(1, ' ').append(unit_of(laid.measure.signal));
  std::string note = c.file + " over " + std::string(fact_of(laid.measure.signal).word) + ": ";
  if (p.rows < fewest_rows)
    return note + "only " + std::to_string(p.rows) + " rows are in the window, so that nothing is compared";
  if (c.is_free("scale")) note += "scale " + bounded(p.scale, p.scale_bound) + unit + " per unit, ";
  if (c.is_free("offset")) note += "offset " + bounded(p.offset, p.offset_bound) + unit + ", ";
  if (c.is_free("shift")) note += "first row at " + base::rounded(p.shift_s, 6) + " s, ";
  return note + "at most " + base::rounded(p.greatest, 3) + unit + " apart, at " + base::rounded(p.at_s, 6) +
         " s";
}

/// The rows that the window holds, on the run's clock; the picture gets at most 4000 of them.
LaidRecording picture_of(const LaidOver& laid, Pair& pair) {
  const auto& p = pair.placing;
  LaidRecording out{std::string(fact_of(laid.measure.signal).word),
                    std::string(unit_of(laid.measure.signal)),
                    laid.recording.file,
                    {},
                    {},
                    {}};
  const std::size_t every = p.rows / 4000 + 1;
  Samples kept{0.0, pair.recorded.interval_s, {}};
  Overlap{pair.recorded, pair.simulated, laid.measure.from_s.value_or(0.0) + p.shift_s}.each(
      1, [&](std::size_t n, double t, double s, double r) {
        kept.values.push_back(p.scale * r + p.offset);
        if (n % every != 0) return;
        out.t_s.push_back(t);
        out.recorded.push_back(kept.values.back());
        out.simulated.push_back(s);
      });
  pair.recorded = std::move(kept);
  return out;
}

ComparisonResult compared(const LaidOver& laid, const NamedFigure& figure, const Pair& pair) {
  const Recording& c = laid.recording;
  const Placing& p = pair.placing;
  const bool distance = figure.fact->figure == RecordedFigure::difference,
             of_pulses = is_of_pulses(figure.fact->figure);
  const double step = std::abs(p.scale) * c.rows->step;
  Estimate there{0.0, step / std::sqrt(12.0), p.rows}, here{p.rms, 0.0, p.rows};
  // The rows of a perfect model differ from the recording by the recording's noise.
  if (distance) there.uncertainty = root_of_squares(there.uncertainty, 1.2 * noise_of(pair.recorded.values));
  if (!distance) {
    const FigureAsked asked{figure, pair.period_s, laid.measure.level.value_or(0.0), c.shortest_s,
                            c.longest_s.value_or(std::numeric_limits<double>::infinity())};
    there = estimate(asked, pair.recorded);
    here = estimate(asked, pair.simulated);
    here.uncertainty = root_of_squares(here.uncertainty, 0.01 * c.conditions_percent * here.value);
  }
  // The converter rounds a value by at most half a step; a fitted probe adds its own bounds.
  if (!distance && !of_pulses && figure.order < 2)
    there.uncertainty =
        root_of_squares(root_of_squares(there.uncertainty, 0.5 * step),
                        root_of_squares(p.scale_bound / p.scale * there.value, p.offset_bound));
  ComparisonResult out{figure.name(laid.measure),
                       std::string(figure.unit(laid.measure)),
                       here.value,
                       there.value,
                       c.file,
                       0.0};
  out.uncertainty = root_of_squares(there.uncertainty, here.uncertainty);
  if (!distance) out.source += ", " + std::to_string(there.count) + (of_pulses ? " pulses" : " periods");
  out.fails = c.tolerance_percent &&
              !(out.beyond() <= 0.01 * *c.tolerance_percent * std::abs(distance ? p.span : there.value));
  return out;
}

}  // namespace

void Laying::judge_one(std::size_t index, Outcome& outcome, std::vector<LaidRecording>& pictures) const {
  const LaidOver& laid = scenario_.recordings()[index];
  const Recording& c = laid.recording;
  const Watched& watched = watched_[index];
  if (!c.rows) return;
  Pair pair{{0.0, c.rows->interval_s, c.rows->values}, watched.signal, {}, watched.signal.length_s()};
  const double turns = std::abs(watched.last_angle - watched.first_angle) / (2.0 * std::numbers::pi) *
                       design::sheet_constants(scenario_.sheet).pole_pairs.value_or(1);
  if (turns > 0.0) pair.period_s /= turns;
  if (laid.measure.frequency_Hz) pair.period_s = 1.0 / *laid.measure.frequency_Hz;
  take_moving_mean(pair.simulated, c.mean_s);
  take_moving_mean(pair.recorded, c.mean_s);
  pair.placing = placed(c, pair.recorded, pair.simulated, laid.measure.from_s.value_or(0.0), pair.period_s);
  LaidRecording picture = picture_of(laid, pair);
  // Where only pulses are measured, the two need not lie over each other.
  const std::vector<std::string> figures = c.asked();
  const bool placed_rows = !c.free.empty() ||
                           std::find(figures.begin(), figures.end(), "difference_rms") != figures.end(),
             enough = pair.placing.rows >= fewest_rows;
  if (placed_rows || !enough) outcome.notes.push_back(note_of(laid, pair.placing));
  if (placed_rows && enough) pictures.push_back(std::move(picture));
  if (!enough) pair.recorded.values.clear();
  for (const std::string& word : figures)
    if (const std::optional<NamedFigure> figure = recorded_figure(word))
      outcome.comparisons.push_back(compared(laid, *figure, pair));
}

}  // namespace sixstep::study
