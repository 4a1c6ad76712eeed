// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/hall/smooth_motion.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/identification/hall/motion_filter.hpp"

namespace sixstep::analysis {
namespace {

/// Results of the forward pass at a sighting, for the backward pass.
template <std::size_t order>
struct Passed {
  Step<order> step{0.0};     ///< step since the sighting before
  MotionState<order> state;  ///< predicted state
  MotionSpread<order> spread;
  double innovation = 0.0;
  MotionGain<order> gain;
};

/// Filters one stretch forward from its likeliest begin, then smooths it backward (P. de Jong, "Smoothing and
/// interpolation with the state-space model", J. Amer. Statist. Assoc. 84, 1989).
template <std::size_t order>
class Stretch {
 public:
  Stretch(std::span<const Sighting> sightings, const MotionFit& fit, const MotionNoise& noise)
      : sightings_(sightings), fit_(fit), noise_(noise) {}

  void into(std::vector<MotionPoint>& points) {
    forward(find_begin());
    back(points);
  }

 private:
  double datum(const Sighting& s) const {
    double x = s.says_deg;
    for (const Effect& e : s.effects)
      if (e.factor != 0.0) x -= e.factor * fit_.effects[e.index];
    return x;
  }

  /// Least squares with known effects: a second pass of the filter, with the unknowns of the begin as
  /// columns.
  MotionState<order> find_begin() {
    NormalEquations equations(order);
    std::array<MotionState<order>, order> columns{};
    for (std::size_t i = 0; i < order; ++i) columns[i][i] = -1.0;
    MotionState<order> data{};
    MotionSpread<order> spread;
    double first = 0.0;
    bool any = false;
    for (std::size_t n = 0; n < sightings_.size(); ++n) {
      if (n > 0) {
        const Step<order> step(sightings_[n].t_s - sightings_[n - 1].t_s);
        spread.pass(step, noise_.intensity);
        step.pass(data);
        for (MotionState<order>& c : columns) step.pass(c);
      }
      if (sightings_[n].left_out) continue;
      if (!any) first = datum(sightings_[n]);
      any = true;
      const MotionGain<order> gain = update(spread, variance_of(sightings_[n], noise_));
      const double y = datum(sightings_[n]) - first - data[0];
      std::array<double, order> row{};
      for (std::size_t c = 0; c < order; ++c) row[c] = -columns[c][0];
      equations.add(row, y, 1.0 / gain.F);
      for (std::size_t i = 0; i < order; ++i) {
        data[i] += gain.K[i] * y;
        for (std::size_t c = 0; c < order; ++c) columns[c][i] += gain.K[i] * row[c];
      }
    }
    MotionState<order> begin{};
    const std::optional<Solution> found = solution_of(equations);
    judged_ = found.has_value();
    if (found) std::copy_n(found->unknowns.begin(), order, begin.begin());
    begin[0] += first;
    return begin;
  }

  void forward(MotionState<order> state) {
    MotionSpread<order> spread;
    passed_.resize(sightings_.size());
    for (std::size_t n = 0; n < sightings_.size(); ++n) {
      Passed<order>& p = passed_[n];
      if (n > 0) {
        p.step = Step<order>(sightings_[n].t_s - sightings_[n - 1].t_s);
        spread.pass(p.step, noise_.intensity);
        p.step.pass(state);
      }
      p.state = state;
      p.spread = spread;
      if (sightings_[n].left_out) continue;
      p.gain = update(spread, variance_of(sightings_[n], noise_));
      p.innovation = datum(sightings_[n]) - state[0];
      for (std::size_t i = 0; i < order; ++i) state[i] += p.gain.K[i] * p.innovation;
    }
  }

  /// r is the information about the state from this sighting and all later sightings; N is its precision.
  void back(std::vector<MotionPoint>& points) const {
    MotionState<order> r{};
    std::array<std::array<double, order>, order> N{};
    std::vector<MotionPoint> out(sightings_.size());
    for (std::size_t n = sightings_.size(); n-- > 0;) {
      const Passed<order>& p = passed_[n];
      const double surprise = p.gain.F > 0.0 ? take(p, r, N) : 0.0;
      MotionPoint& point = out[n];
      point = {sightings_[n].t_s, p.state[0], p.state[1], judged_ ? surprise : 0.0, n == 0};
      for (std::size_t i = 0; i < order; ++i) {
        point.angle_deg += p.spread.P[0][i] * r[i];
        point.speed_deg_s += p.spread.P[1][i] * r[i];
      }
      p.step.pass_back(r);
      for (auto& row : N) p.step.pass_back(row);  // N F, then F' N F by columns
      for (std::size_t c = 0; c < order; ++c) {
        MotionState<order> column;
        for (std::size_t i = 0; i < order; ++i) column[i] = N[i][c];
        p.step.pass_back(column);
        for (std::size_t i = 0; i < order; ++i) N[i][c] = column[i];
      }
    }
    points.insert(points.end(), out.begin(), out.end());
  }

  /// r = H'u + r with u = v/F - K'r; N = H'H/F + (I - K H)' N (I - K H), with de Jong's symbols. Returns u
  /// divided by its deviation.
  static double take(const Passed<order>& p, MotionState<order>& r,
                     std::array<std::array<double, order>, order>& N) {
    double u = p.innovation / p.gain.F, D = 1.0 / p.gain.F;
    std::array<double, order> NK{};
    for (std::size_t i = 0; i < order; ++i) {
      u -= p.gain.K[i] * r[i];
      for (std::size_t k = 0; k < order; ++k) NK[i] += N[i][k] * p.gain.K[k];
    }
    for (std::size_t i = 0; i < order; ++i) D += p.gain.K[i] * NK[i];
    r[0] += u;
    for (std::size_t i = 0; i < order; ++i) {
      N[i][0] -= NK[i];
      N[0][i] -= NK[i];
    }
    N[0][0] += D;
    return u / std::sqrt(D);
  }

  std::span<const Sighting> sightings_;
  const MotionFit& fit_;
  const MotionNoise& noise_;
  std::vector<Passed<order>> passed_;
  bool judged_ = false;
};

}  // namespace

std::vector<MotionPoint> smooth_motion(std::span<const Sighting> sightings, const MotionFit& fit,
                                       const MotionNoise& noise) {
  std::vector<MotionPoint> points;
  for (std::size_t from = 0; from < sightings.size();) {
    std::size_t to = from + 1;
    while (to < sightings.size() && !sightings[to].begins) ++to;
    const std::span<const Sighting> part = sightings.subspan(from, to - from);
    if (noise.smoothness == Smoothness::second)
      Stretch<2>(part, fit, noise).into(points);
    else
      Stretch<3>(part, fit, noise).into(points);
    from = to;
  }
  return points;
}

std::optional<MotionPath::At> MotionPath::at(double t_s) const {
  if (points_.size() < 2) return {};
  while (last_ > 0 && t_s < points_[last_].t_s) --last_;
  while (last_ + 2 < points_.size() && points_[last_ + 1].t_s < t_s) ++last_;
  const MotionPoint &a = points_[last_], &b = points_[last_ + 1];
  if (b.begins || t_s < a.t_s || t_s > b.t_s) return {};
  const double T = b.t_s - a.t_s;
  if (!(T > 0.0)) return At{a.angle_deg, a.speed_deg_s};
  const double x = (t_s - a.t_s) / T, y = 1.0 - x, rise = b.angle_deg - a.angle_deg;
  // Hermite's polynomial: a straight line, bent by the speeds at its two ends.
  const double bend_a = a.speed_deg_s * T - rise, bend_b = rise - b.speed_deg_s * T;
  const double bend = bend_a * y + bend_b * x;
  return At{a.angle_deg + rise * x + x * y * bend, (rise + (y - x) * bend + x * y * (bend_b - bend_a)) / T};
}

}  // namespace sixstep::analysis
