// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/loop_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::design {
namespace {

/// Point between low and high at which f changes its sign, exact to rounding.
template <class F>
double root(double low, double high, F f) {
  const bool rising = f(low) < 0.0;
  for (int n = 0; n < 200; ++n) {
    const double middle = low + (high - low) / 2.0;
    if (middle <= low || middle >= high) break;
    ((f(middle) < 0.0) == rising ? low : high) = middle;
  }
  return low + (high - low) / 2.0;
}

/// Angles w T_s per sample, rad, from low to pi, evenly spaced in their logarithm.
std::vector<double> grid(double low, int points) {
  std::vector<double> turns(static_cast<std::size_t>(points));
  const double ratio = base::exp(base::log(base::pi / low) / (points - 1));
  double turn = low;
  for (double& t : turns) {
    t = turn;
    turn *= ratio;
  }
  turns.back() = base::pi;
  return turns;
}

/// Start of the scan, rad per sample: a hundredth of the slowest pole's frequency, below which |L| only
/// rises.
double lowest_turn(const Transfer& loop) {
  const double decay = slowest_decay(closed(loop).den);
  return std::clamp(decay > 0.0 ? 0.01 * decay : 1e-5, 1e-12, 0.1);
}

/// The phase margin as in margins.hpp: pi + arg L with arg L in (-2 pi, 0]; negative if the phase is below
/// -180 degrees.
double phase_left(Complex L) {
  const double angle = L.angle_rad();
  return base::pi + (angle > 0.0 ? angle - 2.0 * base::pi : angle);
}

void look_at_crossing(LoopFigures& f, double w, double left, bool falls) {
  if (falls) f.crossover_rad_s = w;
  if (!f.phase_rad || left < *f.phase_rad) f.phase_rad = left;
  const double delay_s = left > 0.0 ? left / w : 0.0;
  if (!f.delay_s || delay_s < *f.delay_s) f.delay_s = delay_s;
}

/// Gain margin: where Im L = 0 and L < 0, the gain may grow until |L| = 1.
void look_at_axis(LoopFigures& f, Complex L) {
  const double size = L.size();
  if (L.re >= 0.0 || size >= 1.0 || size <= 0.0) return;
  if (!f.gain || 1.0 / size < *f.gain) f.gain = 1.0 / size;
}

}  // namespace

namespace {

/// Scans a loop L over frequency. loop(turn) returns the value of L, left(turn) its phase distance to -180
/// degrees.
template <class Loop, class Left>
LoopFigures scanned(const Loop& loop, const Left& left, double lowest, double period_s, int points) {
  LoopFigures f;
  const auto whole = [&](double turn) {
    const Complex L = loop(turn);
    return (L / (L + Complex{1.0, 0.0})).size();
  };
  const std::vector<double> turns = grid(lowest, points);
  Complex last = loop(turns[0]);
  double last_closed = whole(turns[0]);
  constexpr double half_power = 0.70710678118654752440;
  for (std::size_t n = 0; n < turns.size(); ++n) {
    const double turn = turns[n];
    const Complex L = loop(turn), one_more = L + Complex{1.0, 0.0};
    const double sensitivity = 1.0 / one_more.size(), through = (L / one_more).size();
    if (sensitivity > f.sensitivity_peak) {
      f.sensitivity_peak = sensitivity;
      f.sensitivity_peak_rad_s = turn / period_s;
    }
    if (n > 0) {
      const double before = turns[n - 1];
      if ((L.size() < 1.0) != (last.size() < 1.0)) {
        const double at = root(before, turn, [&](double x) { return loop(x).size() - 1.0; });
        look_at_crossing(f, at / period_s, left(at), L.size() < 1.0);
      }
      const bool end = n + 1 == turns.size();  // true at half the sampling rate, where L is real
      if (!end && (L.im < 0.0) != (last.im < 0.0) && L.re < 0.0)
        look_at_axis(f, loop(root(before, turn, [&](double x) { return loop(x).im; })));
      if (end) look_at_axis(f, {L.re, 0.0});
      if (!f.bandwidth_rad_s && last_closed >= half_power && through < half_power)
        f.bandwidth_rad_s = root(before, turn, [&](double x) { return whole(x) - half_power; }) / period_s;
    }
    last = L;
    last_closed = through;
  }
  return f;
}

}  // namespace

LoopFigures loop_figures(const Transfer& loop, double period_s, int points) {
  const auto at = [&](double turn) { return loop.at(turn); };
  LoopFigures f = scanned(
      at, [&](double turn) { return phase_left(loop.at(turn)); }, lowest_turn(loop), period_s, points);
  f.stable = is_stable(closed(loop).den);
  return f;
}

LoopFigures sensed_figures(const SensedLoop& s, double period_s, int points) {
  const Complex one{1.0, 0.0};
  const auto H = [&](double turn) { return s.lag.at(turn / period_s); };
  // The lag's own phase is linear in the frequency. It is added separately, so that it does not wrap for any
  // lag.
  const auto left = [&](double turn) {
    return phase_left(s.loop.at(turn)) - turn / period_s * s.lag.delay_s();
  };
  LoopFigures f;
  if (!s.around) {
    f = scanned([&](double turn) { return s.loop.at(turn) * H(turn); }, left, lowest_turn(s.loop), period_s,
                points);
  } else {
    const auto at = [&](double turn) {
      const Complex inner = s.around->at(turn);
      return s.loop.at(turn) * (one + inner) / (one + inner * H(turn));
    };
    f = scanned(
        at, [&](double turn) { return phase_left(at(turn)); }, lowest_turn(s.loop), period_s, points);
  }
  f.stable = is_stable(closed(s.loop).den) && !(f.phase_rad && *f.phase_rad <= 0.0);
  return f;
}

std::vector<BodePoint> bode(const Transfer& loop, double period_s, double from_rad_s, int points) {
  std::vector<BodePoint> out;
  double phase = 0.0;
  bool first = true;
  for (const double turn : grid(from_rad_s * period_s, points)) {
    const Complex L = loop.at(turn);
    double angle = L.angle_rad();
    if (first && angle > 0.0) angle -= 2.0 * base::pi;
    while (!first && angle - phase > base::pi) angle -= 2.0 * base::pi;
    while (!first && angle - phase < -base::pi) angle += 2.0 * base::pi;
    first = false;
    phase = angle;
    out.push_back({turn / period_s, L.size(), phase, (L / (L + Complex{1.0, 0.0})).size()});
  }
  return out;
}

namespace {

/// num/den in its first canonical form: x_1' = x_2, .., x_n' = u - sum den_k x_(k+1), where ' is the
/// difference to the next sample. With this form slow systems lose no digits.
class Recursion {
 public:
  explicit Recursion(const Transfer& t) : num_(t.num), den_(t.den), x_(t.den.size() - 1) {
    const double lead = den_.back();
    for (double& d : den_) d /= lead;
    for (double& n : num_) n /= lead;
    num_.resize(den_.size());
  }
  /// Returns the output for the input u and advances to the next sample.
  double next(double u) {
    double top = u, y = 0.0;
    for (std::size_t k = 0; k < x_.size(); ++k) {
      top -= den_[k] * x_[k];
      y += num_[k] * x_[k];
    }
    y += num_.back() * top;
    for (std::size_t k = 0; k < x_.size(); ++k) x_[k] += k + 1 < x_.size() ? x_[k + 1] : top;
    return y;
  }
  /// Output at the present sample, for a system whose output does not depend on the input of the same sample.
  double output() const {
    double y = 0.0;
    for (std::size_t k = 0; k < x_.size(); ++k) y += num_[k] * x_[k];
    return y;
  }

 private:
  Polynomial num_, den_;
  std::vector<double> x_;
};

/// Mean over the last `samples` samples; samples before the first count as 0.
class Mean {
 public:
  explicit Mean(double samples)
      : held_(static_cast<std::size_t>(std::fmax(1.0, std::floor(samples + 0.5)))) {}
  double next(double x) {
    sum_ += x - held_[at_];
    held_[at_] = x;
    at_ = (at_ + 1) % held_.size();
    return sum_ / static_cast<double>(held_.size());
  }

 private:
  std::vector<double> held_;
  std::size_t at_ = 0;
  double sum_ = 0.0;
};

/// Delays by `samples`, rounded to whole samples.
class Late {
 public:
  explicit Late(double samples) : held_(static_cast<std::size_t>(std::floor(samples + 0.5))) {}
  double next(double x) {
    if (held_.empty()) return x;
    std::swap(x, held_[at_]);
    at_ = (at_ + 1) % held_.size();
    return x;
  }

 private:
  std::vector<double> held_;
  std::size_t at_ = 0;
};

/// Figures of a step response; `next` returns its samples.
template <class Next>
StepResponse response(const Next& next, double period_s, double seconds, double band) {
  StepResponse r;
  const std::size_t count = static_cast<std::size_t>(seconds / period_s) + 2;
  double highest = 0.0;
  std::size_t inside_from = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double y = next();
    r.samples.push_back(y);
    highest = std::max(highest, y);
    if (!r.reach_s && y >= 0.98) r.reach_s = static_cast<double>(k) * period_s;
    if (!(std::fabs(y - 1.0) <= band)) inside_from = k + 1;
  }
  r.overshoot = highest > 1.0 ? highest - 1.0 : 0.0;
  r.settling_s = inside_from < count ? static_cast<double>(inside_from) * period_s
                                     : std::numeric_limits<double>::infinity();
  return r;
}

}  // namespace

StepResponse step_response(const Transfer& closed_loop, double period_s, double seconds, double band) {
  Recursion recursion(closed_loop);
  return response([&] { return recursion.next(1.0); }, period_s, seconds, band);
}

StepResponse sensed_step(const SensedLoop& s, double period_s, double seconds, double band) {
  Recursion recursion(s.loop);
  Mean mean(s.lag.mean_s / period_s), hold(s.lag.hold_s / period_s);
  Late late(s.lag.late_s / period_s);
  const auto next = [&] {
    const double y = recursion.output();
    recursion.next(1.0 - late.next(hold.next(mean.next(y))));
    return y;
  };
  return response(next, period_s, seconds, band);
}

}  // namespace sixstep::design
