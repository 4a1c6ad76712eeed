// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/statistics/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sixstep::analysis {
namespace SIXSTEP_TEST_FILE {

Statistics of(std::initializer_list<double> values) {
  Statistics s;
  for (const double x : values) s.add(x);
  return s;
}

TEST(Statistics, KnowsMeanAndDeviation) {
  const Statistics s = of({2, 4, 4, 4, 5, 5, 7, 9});  // mean 5, sum of squares 32
  EXPECT_EQ(s.mean(), 5.0);
  EXPECT_DOUBLE_EQ(*s.standard_deviation(), std::sqrt(32.0 / 7.0));
  EXPECT_EQ(s.min(), 2.0);
  EXPECT_EQ(s.max(), 9.0);
}

TEST(Statistics, QuantilesAreValuesThatOccurred) {
  const Statistics s = of({30, 10, 40, 20});
  EXPECT_EQ(s.quantile(0.0), 10.0);
  EXPECT_EQ(s.quantile(0.25), 10.0);  // one value of four, exactly 25 %, is at or below 10
  EXPECT_EQ(s.quantile(0.2500001), 20.0);
  EXPECT_EQ(s.quantile(0.5), 20.0);
  EXPECT_EQ(s.quantile(0.75), 30.0);
  EXPECT_EQ(s.quantile(0.99), 40.0);
  EXPECT_EQ(s.quantile(1.0), 40.0);
}

/// The median has as many values above it as below it.
TEST(Statistics, TheMedianIsTheMiddleOrTheMeanOfTheTwoThere) {
  EXPECT_EQ(of({30, 10, 40}).median(), 30.0);
  EXPECT_EQ(of({30, 10, 40, 20}).median(), 25.0);
  EXPECT_EQ(of({1, 2}).median(), 1.5);
  EXPECT_EQ(of({7, 7}).median(), 7.0);
  EXPECT_EQ(of({3}).median(), 3.0);
  EXPECT_FALSE(of({}).median());
  const double never = std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::max();
  EXPECT_EQ(of({1, never}).median(), never) << "of two drives one never settles";
  EXPECT_EQ(of({1, 2, never}).median(), 2.0);
  EXPECT_EQ(of({never, never}).median(), never);
  EXPECT_EQ(of({most, most}).median(), most);
  // Mirrored values have the mirrored median. If the median were one of the two middle values, this symmetry
  // would not hold.
  EXPECT_EQ(*of({-30, -10, -40, -20}).median(), -*of({30, 10, 40, 20}).median());
}

TEST(Statistics, OfOneValueThereIsNoDeviation) {
  EXPECT_EQ(of({3}).mean(), 3.0);
  EXPECT_EQ(of({3}).quantile(0.5), 3.0);
  EXPECT_FALSE(of({3}).standard_deviation());
  EXPECT_FALSE(of({}).mean());
  EXPECT_FALSE(of({}).quantile(0.5));
}

TEST(Statistics, WhatNeverCameIsAValueButHasNoMean) {
  const double never = std::numeric_limits<double>::infinity();
  const Statistics s = of({1, never, 2});
  EXPECT_FALSE(s.mean());
  EXPECT_FALSE(s.standard_deviation());
  EXPECT_EQ(s.quantile(0.5), 2.0);
  EXPECT_EQ(s.max(), never);
}

TEST(Statistics, WhatHasNoValueIsCountedApart) {
  const Statistics s = of({1, std::nan(""), 3});
  EXPECT_EQ(s.count(), 2u);
  EXPECT_EQ(s.missing(), 1u);
  EXPECT_EQ(s.mean(), 2.0);
}

/// The values differ only in their last digits. Plain sums of the large values would lose these digits.
TEST(Statistics, KeepsTheDigitsOfFiguresThatHardlyDiffer) {
  const double base = 1e9, step = 0x1p-20;
  Statistics s;
  for (int n = 0; n < 1001; ++n) s.add(base + n * step);
  EXPECT_EQ(s.mean(), base + 500 * step);
  // The sum of (n - 500)^2 over 1001 values is 2 * 500 * 501 * 1001/6.
  EXPECT_DOUBLE_EQ(*s.standard_deviation(), step * std::sqrt(2.0 * 500 * 501 * 1001 / 6 / 1000));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace sixstep::analysis
