// SPDX-License-Identifier: Apache-2.0
// The exact lag is compared with closed forms: step, ramp, sine, and a chopped input in its steady state. The
// weights of the lag are compared with a quadrature in long double.
#include "sixstep/series/first_order_lag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::series;
using Poly = Coefficients<double>;

/// A first-order lag that is advanced segment by segment, as the board's front end does.
struct Lag {
  double tau = 1;
  CompensatedSum<double> x{};

  void follow(const Poly& u, int degree, double h, double s = 1) {
    x.add(lag_increment(u, degree, s, lag_weights(s * h / tau, degree), x.value));
  }
};

constexpr double eps = 0x1p-52;

/// The weight by Gauss-Legendre quadrature with 5 points in each piece. The number of pieces is so large that
/// the error, 4e-13 (30/pieces)^10, is below rounding.
long double weight(long double z, int j) {
  constexpr long double at[] = {0.0L, 0.538469310105683091036314420700L, 0.906179845938663992797626878299L};
  constexpr long double of[] = {0.568888888888888888888888888889L, 0.478628670499366468041291514836L,
                                0.236926885056189087514264040720L};
  const int pieces = 200;
  long double sum = 0;
  for (int n = 0; n < pieces; ++n)
    for (int k = -2; k <= 2; ++k) {
      const int size = k < 0 ? -k : k;
      const long double r = (n + 0.5L + (k < 0 ? -at[size] : at[size]) / 2) / pieces;
      sum += of[size] / 2 / pieces * std::exp(-z * (1 - r)) * std::pow(r, static_cast<long double>(j));
    }
  return z * sum;
}

TEST(FirstOrderLag, WeightsAreTheirIntegral) {
  // Each order follows from a recurrence in which errors decay. The error is a few roundings of numbers below
  // 1, relative to the weight.
  for (const double z : {1e-9, 1e-3, 0.2, 0.999, 1.0, 1.5, 2.0, 3.7, 7.0, 8.3, 11.9, 15.99, 16.0, 30.0})
    for (const int degree : {16, 9, 6, 1}) {
      const LagWeights w = lag_weights(z, degree);
      for (int j = 0; j <= degree; ++j) {
        const auto exact = static_cast<double>(weight(z, j));
        EXPECT_NEAR(w[j], exact, 8 * eps * exact) << z << " " << j << " of " << degree;
      }
    }
}

TEST(FirstOrderLag, WithoutLagTheInputComesThrough) {
  const Poly u{1.0, -2.0, 3.0};
  const LagWeights w = lag_weights(HUGE_VAL, 2);
  EXPECT_EQ(lag_increment(u, 2, 0.5, w, 7.0), 0.75 - 7.0);
}

TEST(FirstOrderLag, Step) {
  for (const double h : {1e-9, 1e-3, 0.3, 5.0, 900.0}) {
    Lag lag{.tau = 2.0};
    const int segments = 700;
    for (int n = 1; n <= segments; ++n) {
      lag.follow({3.0}, 6, h);
      EXPECT_NEAR(lag.x.value, -3.0 * std::expm1(-n * h / 2.0), 3 * 1e-15 * n) << h << " " << n;
    }
  }
}

TEST(FirstOrderLag, OnARampItLagsBySlopeTimesTau) {
  const double slope = -4.0, tau = 0.7, h = 0.05;
  Lag lag{.tau = tau};
  for (int n = 0; n < 2000; ++n) {
    lag.follow({slope * n * h, slope * h}, 1, h);
    const double t = (n + 1) * h;
    EXPECT_NEAR(lag.x.value, slope * (t - tau * (1 - std::exp(-t / tau))), 1e-12) << n;
  }
  EXPECT_NEAR(slope * 2000 * h - lag.x.value, slope * tau, 1e-12);
}

/// Taylor coefficients of sin(a + b s), up to the last significant term.
Poly sine(double a, double b) {
  Poly c{};
  double factor = 1;
  for (int j = 0; j <= max_degree; ++j) {
    c[j] = factor * std::sin(a + j * std::numbers::pi / 2);
    factor *= b / (j + 1);
  }
  return c;
}

TEST(FirstOrderLag, SineComesThroughSmallerAndLater) {
  const double w = 2.0, h = 0.21;
  for (const double tau : {1e-4, 0.03, 0.5, 40.0}) {
    // The lag starts on its steady response 1/(1 + i w tau) and must remain on it.
    const double size = 1 / std::hypot(1, w * tau), later = std::atan(w * tau);
    Lag lag{.tau = tau, .x = {-size * std::sin(later), 0}};
    for (int n = 0; n < 3000; ++n) lag.follow(sine(w * h * n, w * h), max_degree, h);
    EXPECT_NEAR(lag.x.value, size * std::sin(w * h * 3000 - later), 1e-12) << tau;
  }
}

TEST(FirstOrderLag, AnySplitOfASegmentEndsAtTheSame) {
  const Poly u = sine(0.3, 0.9);
  for (const double tau : {0.01, 0.3, 2.0, 1e5}) {
    Lag whole{.tau = tau}, split{.tau = tau};
    whole.follow(u, max_degree, 1.0);
    split.follow(restricted(u, max_degree, 0.0, 0.375), max_degree, 0.375);
    split.follow(u, max_degree, 1.0, 0.0);  // a step of length 0 changes nothing
    split.follow(restricted(u, max_degree, 0.375, 1.0), max_degree, 0.625);
    EXPECT_NEAR(whole.x.value, split.x.value, 1e-15) << tau;
  }
}

TEST(FirstOrderLag, ChoppedInputInItsSteadyState) {
  const double U = 24, period = 30e-6, duty = 0.3, tau = 47e-6;
  const double on = std::exp(-duty * period / tau), off = std::exp(-(1 - duty) * period / tau);
  Lag lag{.tau = tau};
  double low = 0, high = 0;
  for (int n = 0; n < 100; ++n) {  // 64 time constants: the remainder of the start is below 1e-27
    lag.follow({U}, 6, duty * period);
    high = lag.x.value;
    lag.follow({0.0}, 6, (1 - duty) * period);
    low = lag.x.value;
  }
  EXPECT_NEAR(high, U * (1 - on) / (1 - on * off), 1e-12);
  EXPECT_NEAR(low, U * (1 - on) / (1 - on * off) * off, 1e-12);
}

TEST(FirstOrderLag, AMillionShortSegmentsLoseNothing) {
  Lag lag{.tau = 1.0};
  const int segments = 1'000'000;
  for (int n = 0; n < segments; ++n) lag.follow({1.0}, 6, 1e-6);
  EXPECT_NEAR(lag.x.value, -std::expm1(-1.0), 1e-14);
}

}  // namespace SIXSTEP_TEST_FILE
