// SPDX-License-Identifier: Apache-2.0
// Kalman's filter for an angle whose second or third derivative is white noise. One update applies to all
// columns that are filtered together.
#pragma once
#include <array>
#include <cstddef>

namespace sixstep::analysis {

/// Angle, speed and further derivatives below the derivative that is noise.
template <std::size_t order>
using MotionState = std::array<double, order>;

/// Powers of a time divided by their factorials.
template <std::size_t order>
class Step {
 public:
  explicit Step(double T) {
    terms_[0] = 1.0;
    for (std::size_t n = 1; n < terms_.size(); ++n) terms_[n] = terms_[n - 1] * T / static_cast<double>(n);
    T_ = T;
  }
  /// T^n/n! for the step's time T.
  double term(std::size_t n) const { return terms_[n]; }
  double seconds() const { return T_; }

  /// Advances a state by Taylor's series.
  void pass(MotionState<order>& x) const {
    for (std::size_t i = 0; i < order; ++i)
      for (std::size_t k = i + 1; k < order; ++k) x[i] += terms_[k - i] * x[k];
  }
  /// The transposed step, for the backward pass of the smoother.
  void pass_back(MotionState<order>& r) const {
    for (std::size_t i = order; i-- > 0;)
      for (std::size_t k = 0; k < i; ++k) r[i] += terms_[i - k] * r[k];
  }

 private:
  std::array<double, order> terms_{};
  double T_ = 0.0;
};

template <std::size_t order>
struct MotionSpread {
  std::array<std::array<double, order>, order> P{};

  /// Advances the covariance P = F P F' + Q; F: matrix of the step, Q: integral of the noise's response over
  /// the step.
  void pass(const Step<order>& step, double intensity) {
    for (std::size_t c = 0; c < order; ++c)
      for (std::size_t i = 0; i < order; ++i)
        for (std::size_t k = i + 1; k < order; ++k) P[i][c] += step.term(k - i) * P[k][c];
    for (std::size_t r = 0; r < order; ++r)
      for (std::size_t i = 0; i < order; ++i)
        for (std::size_t k = i + 1; k < order; ++k) P[r][i] += step.term(k - i) * P[r][k];
    for (std::size_t i = 0; i < order; ++i)
      for (std::size_t k = 0; k < order; ++k)
        P[i][k] += intensity * step.term(order - 1 - i) * step.term(order - 1 - k) * step.seconds() /
                   static_cast<double>(2 * order - 1 - i - k);
  }
};

template <std::size_t order>
struct MotionGain {
  double F = 0.0;  ///< variance of the innovation; 0: no update
  std::array<double, order> K{};
};

template <std::size_t order>
MotionGain<order> update(MotionSpread<order>& spread, double variance) {
  MotionGain<order> gain;
  gain.F = spread.P[0][0] + variance;
  const std::array<double, order> row = spread.P[0];
  for (std::size_t i = 0; i < order; ++i) gain.K[i] = row[i] / gain.F;
  for (std::size_t i = 0; i < order; ++i)
    for (std::size_t k = 0; k < order; ++k) spread.P[i][k] -= gain.K[i] * row[k];
  return gain;
}

}  // namespace sixstep::analysis
