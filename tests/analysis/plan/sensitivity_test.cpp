// SPDX-License-Identifier: Apache-2.0
// Sobol indices of two functions are compared with the closed-form indices.
#include "sixstep/analysis/plan/sensitivity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "sixstep/analysis/plan/plan.hpp"
#include "sixstep/base/angle.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using analysis::SensitivityIndex;
using Function = std::function<double(const std::vector<double>&)>;

std::vector<double> asked(const Function& f, std::size_t keys, std::size_t rows, std::uint64_t seed) {
  analysis::Plan plan{.sampling = analysis::Sampling::saltelli, .points = rows, .seed = seed};
  for (std::size_t k = 0; k < keys; ++k) plan.axes.push_back({.key = std::to_string(k), .to = 1.0});
  EXPECT_TRUE(analysis::check(plan).empty());
  std::vector<double> figures;
  for (std::size_t n = 0; n < analysis::points_of(plan); ++n)
    figures.push_back(f(analysis::coordinates(plan, n)));
  return figures;
}

/// Ishigami's function sin x1 + 7 sin^2 x2 + 0.1 x3^4 sin x1, each variable from -pi to pi (T. Ishigami and
/// T. Homma, 1990).
double ishigami(const std::vector<double>& u) {
  const auto x = [&](std::size_t k) { return base::pi * (2 * u[k] - 1); };
  const double s = std::sin(x(0)), t = std::sin(x(1));
  return s + 7 * t * t + 0.1 * std::pow(x(2), 4) * s;
}

/// Sobol's function g is the product of the factors (|4 u - 2| + a)/(1 + a). The partial variance of each
/// factor is 1/(3 (1 + a)^2).
constexpr double g_of[] = {0.0, 1.0, 4.5, 9.0};
double sobol_g(const std::vector<double>& u) {
  double f = 1.0;
  for (std::size_t k = 0; k < u.size(); ++k) f *= (std::fabs(4 * u[k] - 2) + g_of[k]) / (1 + g_of[k]);
  return f;
}

struct Truth {
  std::vector<double> first, total;
};

Truth of_ishigami() {
  const double a = 7, b = 0.1, p4 = std::pow(base::pi, 4), p8 = p4 * p4;
  const double v1 = 0.5 * (1 + b * p4 / 5) * (1 + b * p4 / 5), v2 = a * a / 8;
  const double v13 = b * b * p8 * (1.0 / 18 - 1.0 / 50), v = v1 + v2 + v13;
  return {{v1 / v, v2 / v, 0}, {(v1 + v13) / v, v2 / v, v13 / v}};
}

Truth of_g() {
  std::vector<double> part;
  double all = 1.0;
  for (const double a : g_of) {
    part.push_back(1 / (3 * (1 + a) * (1 + a)));
    all *= 1 + part.back();
  }
  Truth truth;
  for (const double p : part) {
    truth.first.push_back(p / (all - 1));
    truth.total.push_back(p * all / (1 + p) / (all - 1));
  }
  return truth;
}

// The first-order indices S_i and the total indices T_i obey 0 <= S_i <= T_i and sum S_i <= 1. Estimates from
// enough rows obey these laws too.
TEST(Sensitivity, IndicesThatCannotBeAreOfTooFewRows) {
  const auto judged = [](const std::vector<double>& first, const std::vector<double>& total) {
    std::vector<SensitivityIndex> indices(first.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
      indices[k].first.value = first[k];
      indices[k].total.value = total[k];
    }
    return analysis::too_few_rows(indices);
  };
  for (const Truth& truth : {of_ishigami(), of_g()}) EXPECT_FALSE(judged(truth.first, truth.total));
  EXPECT_TRUE(judged({0.5, 0.109}, {0.6, 0.097})) << "above its total";
  EXPECT_TRUE(judged({0.5, -0.045}, {0.6, 0.1})) << "negative";
  EXPECT_TRUE(judged({0.6, 0.54}, {0.6, 0.54})) << "more than the whole";
  EXPECT_TRUE(analysis::too_few_rows(*analysis::sensitivity(asked(ishigami, 3, 8, 3), 3, 1)));
  EXPECT_FALSE(analysis::too_few_rows(*analysis::sensitivity(asked(ishigami, 3, 8192, 3), 3, 1)));
}

void expect_truth(const Function& f, const Truth& truth, std::size_t rows, double within) {
  const std::size_t keys = truth.first.size();
  const auto found = analysis::sensitivity(asked(f, keys, rows, 3), keys, 1);
  ASSERT_TRUE(found);
  for (std::size_t k = 0; k < keys; ++k) {
    EXPECT_NEAR((*found)[k].first.value, truth.first[k], within) << k;
    EXPECT_NEAR((*found)[k].total.value, truth.total[k], within) << k;
  }
}

TEST(Sensitivity, IshigamisFunctionHasItsIndices) { expect_truth(ishigami, of_ishigami(), 16384, 0.005); }
TEST(Sensitivity, SobolsFunctionHasItsIndices) { expect_truth(sobol_g, of_g(), 16384, 0.005); }

/// With random rows, the bootstrap is valid: 95 % of the intervals contain the true value. The tolerance is
/// three standard deviations of a binomial distribution for 200 draws (4.6 %).
TEST(Sensitivity, IntervalsHoldTheTruthAsOftenAsTheySay) {
  const Truth truth = of_g();
  const std::size_t keys = truth.first.size();
  int held = 0, asked_for = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    analysis::Plan plan{.sampling = analysis::Sampling::monte_carlo, .points = 256, .seed = seed};
    for (std::size_t k = 0; k < 2 * keys; ++k) plan.axes.push_back({.key = std::to_string(k), .to = 1.0});
    std::vector<double> figures;
    for (std::size_t n = 0; n < plan.points; ++n) {
      const std::vector<double> u = analysis::coordinates(plan, n);
      const std::vector<double> a(u.begin(), u.begin() + static_cast<std::ptrdiff_t>(keys));
      const std::vector<double> b(u.begin() + static_cast<std::ptrdiff_t>(keys), u.end());
      figures.push_back(sobol_g(a));
      figures.push_back(sobol_g(b));
      for (std::size_t k = 0; k < keys; ++k) {
        std::vector<double> mixed = a;
        mixed[k] = b[k];
        figures.push_back(sobol_g(mixed));
      }
    }
    const auto found = analysis::sensitivity(figures, keys, seed);
    ASSERT_TRUE(found);
    const auto& total = (*found)[0].total;
    held += total.low <= truth.total[0] && truth.total[0] <= total.high;
    ++asked_for;
  }
  EXPECT_NEAR(static_cast<double>(held) / asked_for, 0.95, 0.046);
}

TEST(Sensitivity, RowsWithoutAFigureAreLeftOut) {
  std::vector<double> figures = asked(ishigami, 3, 64, 1), more = figures;
  for (int n = 0; n < 5; ++n) more.push_back(n == 3 ? std::numeric_limits<double>::quiet_NaN() : 1.0);
  const auto found = analysis::sensitivity(figures, 3, 1), same = analysis::sensitivity(more, 3, 1);
  ASSERT_TRUE(found && same);
  EXPECT_EQ((*found)[0].first.value, (*same)[0].first.value);
}

TEST(Sensitivity, WhatDoesNotVaryHangsOnNothing) {
  EXPECT_FALSE(analysis::sensitivity(std::vector<double>(50, 2.0), 3, 1));
  EXPECT_FALSE(analysis::sensitivity(std::vector<double>{1, 2, 3, 4, 5}, 3, 1)) << "one row";
  EXPECT_FALSE(analysis::sensitivity({}, 3, 1));
}

}  // namespace SIXSTEP_TEST_FILE
