// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sixstep/analysis/identification/hall/motion_filter.hpp"
#include "sixstep/analysis/identification/hall/smooth_motion.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::analysis {
namespace {

/// Columns that are filtered together: the data, each effect, and each unknown of a stretch's begin.
template <std::size_t order>
class Columns {
 public:
  explicit Columns(std::size_t effects)
      : effects_(effects),
        states_(effects + 1 + order),
        innovations_(effects + 1 + order),
        sums_(effects + 1 + order) {
    begin_stretch();
  }

  /// Adds the stretch's sums of data and effects, with the unknowns of its begin eliminated. A stretch that
  /// is too short for the elimination adds nothing.
  void end_stretch() {
    if (seen_ >= order) {
      Symmetric begin(order);
      for (std::size_t i = 0; i < order; ++i)
        for (std::size_t k = 0; k <= i; ++k) begin.at(i, k) = sums_.at(effects_ + 1 + i, effects_ + 1 + k);
      begin.mirror();
      if (const std::optional<Cholesky> factors = Cholesky::of(begin)) eliminate(*factors);
    }
    begin_stretch();
  }

  void pass(const Step<order>& step) {
    for (MotionState<order>& s : states_) step.pass(s);
  }

  void take(const Sighting& sighting, const MotionGain<order>& gain) {
    for (std::size_t c = 0; c < states_.size(); ++c) innovations_[c] = -states_[c][0];
    innovations_[0] += sighting.says_deg;
    for (const Effect& e : sighting.effects)
      if (e.factor != 0.0) innovations_[e.index + 1] += e.factor;
    for (std::size_t c = 0; c < states_.size(); ++c) {
      const double innovation = innovations_[c], weighted = innovation / gain.F;
      for (std::size_t d = 0; d <= c; ++d) sums_.at(c, d) += weighted * innovations_[d];
      for (std::size_t i = 0; i < order; ++i) states_[c][i] += gain.K[i] * innovation;
    }
    stretch_log_ += base::log(gain.F);
    ++seen_;
  }

  std::optional<MotionFit> result() const {
    Symmetric left(effects_);
    std::vector<double> right(effects_);
    for (std::size_t i = 0; i < effects_; ++i) {
      for (std::size_t k = 0; k <= i; ++k) left.at(i, k) = total_.at(i + 1, k + 1);
      right[i] = total_.at(i + 1, 0);
    }
    left.mirror();
    const std::optional<Cholesky> factors = Cholesky::of(left);
    if (!factors) return {};
    MotionFit out{factors->solve(right), factors->inverse(), 0.0};
    double square = total_.at(0, 0);
    for (std::size_t i = 0; i < effects_; ++i) square -= out.effects[i] * right[i];
    out.log_likelihood = -0.5 * (log_sum_ + factors->log_determinant() + square);
    return out;
  }

 private:
  void begin_stretch() {
    sums_ = Symmetric(states_.size());
    std::fill(states_.begin(), states_.end(), MotionState<order>{});
    for (std::size_t i = 0; i < order; ++i) states_[effects_ + 1 + i][i] = -1.0;
    seen_ = 0;
    stretch_log_ = 0.0;
  }

  void eliminate(const Cholesky& begin) {
    log_sum_ += stretch_log_ + begin.log_determinant();
    std::vector<double> column(order);
    for (std::size_t k = 0; k <= effects_; ++k) {
      for (std::size_t i = 0; i < order; ++i) column[i] = sums_.at(effects_ + 1 + i, k);
      const std::vector<double> solved = begin.solve(column);
      for (std::size_t r = k; r <= effects_; ++r) {
        double taken = 0.0;
        for (std::size_t i = 0; i < order; ++i) taken += sums_.at(effects_ + 1 + i, r) * solved[i];
        total_.at(r, k) += sums_.at(r, k) - taken;
      }
    }
  }

  std::size_t effects_;
  std::vector<MotionState<order>> states_;
  std::vector<double> innovations_;
  Symmetric sums_;                 // sums of this stretch, the lower half
  Symmetric total_{effects_ + 1};  // sums of the earlier stretches, in the same order
  double stretch_log_ = 0.0, log_sum_ = 0.0;
  std::size_t seen_ = 0;
};

template <std::size_t order>
std::optional<MotionFit> fit(std::span<const Sighting> sightings, std::size_t effects,
                             const MotionNoise& noise) {
  Columns<order> columns(effects);
  MotionSpread<order> spread;
  for (std::size_t n = 0; n < sightings.size(); ++n) {
    const Sighting& s = sightings[n];
    if (n > 0 && s.begins) {
      columns.end_stretch();
      spread = {};
    } else if (n > 0) {
      const Step<order> step(s.t_s - sightings[n - 1].t_s);
      spread.pass(step, noise.intensity);
      columns.pass(step);
    }
    if (!s.left_out) columns.take(s, update(spread, variance_of(s, noise)));
  }
  columns.end_stretch();
  return columns.result();
}

}  // namespace

std::optional<MotionFit> fit_motion(std::span<const Sighting> sightings, std::size_t effects,
                                    const MotionNoise& noise) {
  return noise.smoothness == Smoothness::second ? fit<2>(sightings, effects, noise)
                                                : fit<3>(sightings, effects, noise);
}

}  // namespace sixstep::analysis
