// SPDX-License-Identifier: Apache-2.0
// The filter is compared with the same model solved as one dense system. The parts of the filter are compared
// with known numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sixstep/analysis/identification/distributions.hpp"
#include "sixstep/analysis/identification/hall/motion_posterior.hpp"
#include "sixstep/analysis/identification/hall/smooth_motion.hpp"
#include "tests/analysis/identification/normal.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::analysis;
using sixstep::testing::Draw;

using Dense = std::vector<std::vector<double>>;

/// Gauss-Jordan inversion, independent of the library's code.
Dense inverse(Dense m, double* log_determinant = nullptr) {
  const std::size_t n = m.size();
  Dense out(n, std::vector<double>(n));
  double logs = 0.0;
  for (std::size_t i = 0; i < n; ++i) out[i][i] = 1.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double pivot = m[i][i];
    logs += std::log(pivot);
    for (std::size_t k = 0; k < n; ++k) m[i][k] /= pivot, out[i][k] /= pivot;
    for (std::size_t r = 0; r < n; ++r) {
      if (r == i) continue;
      const double factor = m[r][i];
      for (std::size_t k = 0; k < n; ++k) m[r][k] -= factor * m[i][k], out[r][k] -= factor * out[i][k];
    }
  }
  if (log_determinant) *log_determinant = logs;
  return out;
}

/// Covariance of two values at times s and t, of white noise integrated `order` times from 0 on.
double integrated(double s, double t, int order, double intensity) {
  const double m = std::min(s, t), M = std::max(s, t);
  if (order == 2) return intensity * (m * m * M / 2 - m * m * m / 6);
  // The integral of (s-x)^2 (t-x)^2/4 over [0, m].
  const double a = M - m;
  return intensity / 4 * (std::pow(m, 5) / 5 + a * std::pow(m, 4) / 2 + a * a * std::pow(m, 3) / 3);
}

struct DenseFit {
  std::vector<double> unknowns;
  Dense covariance;
  double log_likelihood = 0.0;
  std::vector<double> angles;
};

/// Generalised least squares. The unknowns are the effects and the initial state of each stretch. Everything
/// else is part of the covariance.
DenseFit dense_fit(const std::vector<Sighting>& all, std::size_t effects, const MotionNoise& noise) {
  const int order = noise.smoothness == Smoothness::second ? 2 : 3;
  std::vector<std::size_t> stretch(all.size());
  std::vector<double> from(all.size());
  std::size_t stretches = 1;
  double begin_s = all[0].t_s;
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (n > 0 && all[n].begins) ++stretches, begin_s = all[n].t_s;
    stretch[n] = stretches - 1;
    from[n] = all[n].t_s - begin_s;
  }
  std::vector<std::size_t> seen;
  for (std::size_t n = 0; n < all.size(); ++n)
    if (!all[n].left_out) seen.push_back(n);
  const std::size_t columns = effects + stretches * static_cast<std::size_t>(order), rows = seen.size();
  Dense V(rows, std::vector<double>(rows)), X(rows, std::vector<double>(columns));
  for (std::size_t i = 0; i < rows; ++i) {
    const std::size_t a = seen[i];
    for (std::size_t k = 0; k < rows; ++k)
      if (stretch[seen[k]] == stretch[a])
        V[i][k] = integrated(from[a], from[seen[k]], order, noise.intensity);
    V[i][i] += variance_of(all[a], noise);
    for (const Effect& e : all[a].effects)
      if (e.factor != 0.0) X[i][e.index] += e.factor;
    double term = 1.0;
    for (int d = 0; d < order; ++d) {
      X[i][effects + stretch[a] * static_cast<std::size_t>(order) + static_cast<std::size_t>(d)] = term;
      term *= from[a] / (d + 1);
    }
  }
  double log_V = 0.0, log_X = 0.0;
  const Dense W = inverse(V, &log_V);
  Dense A(columns, std::vector<double>(columns));
  std::vector<double> right(columns);
  double square = 0.0;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t k = 0; k < rows; ++k) {
      const double y_k = all[seen[k]].says_deg;
      square += all[seen[i]].says_deg * W[i][k] * y_k;
      for (std::size_t c = 0; c < columns; ++c) {
        right[c] += X[i][c] * W[i][k] * y_k;
        for (std::size_t d = 0; d < columns; ++d) A[c][d] += X[i][c] * W[i][k] * X[k][d];
      }
    }
  DenseFit out;
  out.covariance = inverse(A, &log_X);
  for (std::size_t c = 0; c < columns; ++c) {
    out.unknowns.push_back(0.0);
    for (std::size_t d = 0; d < columns; ++d) out.unknowns[c] += out.covariance[c][d] * right[d];
  }
  for (std::size_t c = 0; c < columns; ++c) square -= out.unknowns[c] * right[c];
  out.log_likelihood = -0.5 * (log_V + log_X + square);
  // The angle at every sighting: the fitted value plus the residuals weighted by the covariance.
  std::vector<double> residual(rows), weighted(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    residual[i] = all[seen[i]].says_deg;
    for (std::size_t c = 0; c < columns; ++c) residual[i] -= X[i][c] * out.unknowns[c];
  }
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t k = 0; k < rows; ++k) weighted[i] += W[i][k] * residual[k];
  for (std::size_t n = 0; n < all.size(); ++n) {
    double angle = 0.0, term = 1.0;
    for (int d = 0; d < order; ++d) {
      angle +=
          term *
          out.unknowns[effects + stretch[n] * static_cast<std::size_t>(order) + static_cast<std::size_t>(d)];
      term *= from[n] / (d + 1);
    }
    for (std::size_t k = 0; k < rows; ++k)
      if (stretch[seen[k]] == stretch[n])
        angle += integrated(from[n], from[seen[k]], order, noise.intensity) * weighted[k];
    out.angles.push_back(angle);
  }
  return out;
}

std::vector<Sighting> drawn_sightings(Draw& draw, std::size_t effects) {
  std::vector<Sighting> out;
  double t = draw.between(0.0, 50.0);
  for (int n = 0; n < 40; ++n) {
    t += draw.between(0.05, 0.3);
    Sighting s;
    s.t_s = t;
    s.says_deg = 60.0 * n + 3.0 * normal(draw);
    s.known_deg2 = draw.between(0.01, 2.0);
    s.is_edge = !draw.chance(0.3);
    s.begins = n > 0 && n % 17 == 0;
    s.left_out = draw.chance(0.05);
    if (s.is_edge) s.effects[0] = {static_cast<std::size_t>(n) % effects, -1.0};
    if (s.is_edge) s.effects[1] = {effects - 1, draw.between(-1.0, 1.0)};
    out.push_back(s);
  }
  return out;
}

TEST(Motion, TheFilterIsGeneralisedLeastSquares) {
  constexpr std::size_t effects = 4;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Draw draw(seed);
    const std::vector<Sighting> seen = drawn_sightings(draw, effects);
    const MotionNoise noise{seed % 2 == 0 ? Smoothness::second : Smoothness::third, draw.decades(0.1, 1e3),
                            draw.between(0.1, 2.0), draw.between(0.5, 2.0)};
    const MotionNoise other{noise.smoothness, 2.0 * noise.intensity, 1.5 * noise.jitter_deg,
                            noise.voltage_scale};
    const auto fit = fit_motion(seen, effects, noise), other_fit = fit_motion(seen, effects, other);
    ASSERT_TRUE(fit && other_fit);
    const DenseFit dense = dense_fit(seen, effects, noise), other_dense = dense_fit(seen, effects, other);
    for (std::size_t n = 0; n < effects; ++n) {
      const double size = std::sqrt(dense.covariance[n][n]);
      EXPECT_NEAR(fit->effects[n], dense.unknowns[n], 1e-6 * size) << "seed " << seed;
      for (std::size_t k = 0; k < effects; ++k)
        EXPECT_NEAR(fit->covariance.at(n, k), dense.covariance[n][k],
                    1e-6 * size * std::sqrt(dense.covariance[k][k]));
    }
    // The two likelihoods differ by a constant, so their differences are compared.
    EXPECT_NEAR(fit->log_likelihood - other_fit->log_likelihood,
                dense.log_likelihood - other_dense.log_likelihood, 1e-6)
        << "seed " << seed;
    const std::vector<MotionPoint> points = smooth_motion(seen, *fit, noise);
    ASSERT_EQ(points.size(), seen.size());
    for (std::size_t n = 0; n < points.size(); ++n)
      EXPECT_NEAR(points[n].angle_deg, dense.angles[n], 1e-5) << "seed " << seed;
  }
}

TEST(Motion, APathIsTheSplineThroughItsPoints) {
  // A cubic polynomial is equal to its Hermite spline.
  const auto angle = [](double t) { return 3.0 + 40.0 * t - 7.0 * t * t + 2.0 * t * t * t; };
  const auto speed = [](double t) { return 40.0 - 14.0 * t + 6.0 * t * t; };
  std::vector<MotionPoint> points;
  for (const double t : {0.0, 0.3, 1.0, 1.2, 5.0, 6.0})
    points.push_back({t, angle(t), speed(t), 0.0, t == 5.0});
  const MotionPath path(points);
  for (const double t : {0.1, 0.7, 1.19, 0.0, 5.5, 0.2}) {
    ASSERT_TRUE(path.at(t)) << t;
    EXPECT_NEAR(path.at(t)->angle_deg, angle(t), 1e-12);
    EXPECT_NEAR(path.at(t)->speed_deg_s, speed(t), 1e-11);
  }
  for (const double t : {-0.1, 2.0, 6.1}) EXPECT_FALSE(path.at(t)) << t;
}

/// Only an edge that is 10 standard deviations off has a large surprise.
TEST(Motion, WhatContradictsAllOthersSurprises) {
  std::vector<Sighting> seen;
  Draw draw(7);
  for (int n = 0; n < 60; ++n) {
    Sighting s;
    s.t_s = 0.1 * n;
    s.says_deg = 60.0 * n + 0.5 * normal(draw) + (n == 31 ? 5.0 : 0.0);
    seen.push_back(s);
  }
  const MotionNoise noise{Smoothness::third, 1.0, 0.5, 1.0};
  const auto fit = fit_motion(seen, 0, noise);
  ASSERT_TRUE(fit);
  const std::vector<MotionPoint> points = smooth_motion(seen, *fit, noise);
  for (std::size_t n = 0; n < points.size(); ++n)
    EXPECT_EQ(std::fabs(points[n].surprise) > 5.0, n == 31) << n << ": " << points[n].surprise;
}

TEST(Distributions, AreThoseOfTheTables) {
  EXPECT_DOUBLE_EQ(normal_cdf(0.0), 0.5);
  for (const double x : {-8.0, -3.3, -1.0, -0.1, 0.4, 1.959963984540054, 3.99, 4.01, 7.0})
    EXPECT_NEAR(normal_cdf(x), 0.5 * std::erfc(-x / std::sqrt(2.0)), 2e-15) << x;
  // Reference values: Abramowitz and Stegun, table 26.10.
  EXPECT_NEAR(student_95(3), 3.182, 0.032);
  EXPECT_NEAR(student_95(6), 2.447, 5e-4);
  EXPECT_NEAR(student_95(10), 2.228, 5e-4);
  EXPECT_NEAR(student_95(30), 2.042, 5e-4);
  EXPECT_NEAR(student_95(1e9), 1.9600, 1e-4);
  EXPECT_EQ(student_95(1), student_95(3));
}

TEST(Distributions, AMixtureHas25InAThousandOnEachSide) {
  const Component mixture[] = {{0.25, -3.0, 1.0}, {0.75, 2.0, 0.5}};
  const Interval x = mixture_95(mixture);
  EXPECT_NEAR(x.value, 0.75, 1e-12);
  const auto below = [&](double at) {
    return 0.25 * normal_cdf(at + 3.0) + 0.75 * normal_cdf((at - 2.0) / 0.5);
  };
  EXPECT_NEAR(below(x.low), 0.025, 1e-9);
  EXPECT_NEAR(below(x.high), 0.975, 1e-9);
  const Component certain[] = {{1.0, 4.0, 0.0}};
  EXPECT_NEAR(mixture_95(certain).low, 4.0, 1e-9);
}

/// length_95() returns an interval for the length of a vector with noise in both coordinates. The counted
/// coverage is equal to the stated coverage.
TEST(Distributions, ALengthIsHeldAsOftenAsItSays) {
  for (const double length : {0.0, 0.5, 2.0, 10.0}) {
    Draw draw(static_cast<std::uint64_t>(10.0 * length) + 1);
    int held = 0;
    constexpr int count = 2000;
    for (int n = 0; n < count; ++n) {
      const double x = length + normal(draw), y = normal(draw);
      held += length_95(std::sqrt(x * x + y * y), 1.0).holds(length);
    }
    const double part = static_cast<double>(held) / count, width = 4.0 * std::sqrt(0.95 * 0.05 / count);
    EXPECT_GT(part, 0.95 - width) << length;
    EXPECT_LT(part, length > 1.0 ? 0.95 + width : 1.0) << length;
  }
  EXPECT_EQ(length_95(3.0, 0.0).low, 3.0);
  // Each end of the interval excludes 2.5 % of the cases. The expected value is Rice's distribution, a sum of
  // noncentral chi-square distributions with 2 degrees of freedom.
  const auto below = [](double r, double length) {
    const double half = 0.5 * length * length, x = 0.5 * r * r;
    double sum = 0.0, weight = std::exp(-half), tail = std::exp(-x), gamma = 1.0 - tail;
    for (int k = 0; k < 200; ++k) {
      sum += weight * gamma;
      weight *= half / (k + 1);
      tail *= x / (k + 1);
      gamma -= tail;
    }
    return sum;
  };
  const Interval x = length_95(4.0, 1.0);
  EXPECT_NEAR(below(4.0, x.low), 0.975, 1e-7);
  EXPECT_NEAR(below(4.0, x.high), 0.025, 1e-7);
}

}  // namespace SIXSTEP_TEST_FILE
