// SPDX-License-Identifier: Apache-2.0
// A board's log over a simulation: numbers that are known beforehand.
#include "sixstep/analysis/bench/log/laid_over.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sixstep::analysis {
namespace {

study::Trace trace(std::vector<std::pair<std::string, std::vector<double>>> columns) {
  study::Trace out;
  for (auto& [name, values] : columns) {
    out.columns.push_back({.name = name, .unit = "", .frame = "", .meaning = ""});
    out.values.push_back(std::move(values));
  }
  return out;
}

TEST(LaidOver, StraightBetweenRowsAndOnTheLaterSideOfAJump) {
  const study::Trace simulated =
      trace({{"t_s", {0, 1, 1, 2}}, {"i_m_A", {0, 2, 5, 5}}, {"duty", {1, 1, 1, 1}}});
  const study::Trace log =
      trace({{"t_s", {-1, 0.5, 1, 2, 3}}, {"i_m_A", {9, 1.5, 5, 4, 9}}, {"bus_V", {1, 1, 1, 1, 1}}});
  const std::vector<LaidOver> found = laid_over(simulated, log, 0.0);
  ASSERT_EQ(found.size(), 1u) << "a column that only one has is compared with nothing";
  EXPECT_EQ(found[0].column.name, "i_m_A");
  EXPECT_EQ(found[0].rows, 3u) << "rows outside are left out";
  EXPECT_DOUBLE_EQ(found[0].span, 4.0);
  EXPECT_DOUBLE_EQ(found[0].rms, std::sqrt((0.25 + 0 + 1) / 3));
  EXPECT_DOUBLE_EQ(found[0].greatest, -1.0);
  EXPECT_DOUBLE_EQ(found[0].at_s, 2.0);
}

TEST(LaidOver, NothingMeetsNothing) {
  const study::Trace simulated = trace({{"t_s", {0, 1}}, {"duty", {0, 1}}});
  EXPECT_TRUE(laid_over(simulated, trace({{"t_s", {5, 6}}, {"duty", {0, 1}}}), 0.0).empty());
  EXPECT_FALSE(laid_over(simulated, trace({{"t_s", {5, 6}}, {"duty", {0, 1}}}), -5.0).empty());
  EXPECT_TRUE(laid_over(simulated, trace({{"t_s", {}}, {"duty", {}}}), 0.0).empty());
  EXPECT_TRUE(laid_over(simulated, trace({{"t_s", {0.5}}, {"duty", {NAN}}}), 0.0).empty());
  EXPECT_EQ(best_shift_s(simulated, trace({{"t_s", {5, 6}}, {"duty", {0, 1}}}), "duty", 1.0, 0.1), 0.0);
}

/// A ripple with a slope beneath it, looked at by a clock that is off.
TEST(LaidOver, FindsTheShiftOfARipple) {
  constexpr double period = 1e-4, off = 2.327e-4;
  const auto wave = [](double t) { return 40 * t + std::abs(std::fmod(t, period) / period - 0.5); };
  study::Trace simulated = trace({{"t_s", {}}, {"i_m_A", {}}}), log = simulated;
  for (int n = 0; n <= 4000; ++n) {
    const double t = n * 5e-6;
    simulated.values[0].push_back(t);
    simulated.values[1].push_back(wave(t));
  }
  for (int n = 5; n < 190; ++n) {
    const double t = n * 1.03e-4;
    log.values[0].push_back(t - off);
    log.values[1].push_back(wave(t));
  }
  const double shift = best_shift_s(simulated, log, "i_m_A", 5 * period, period / 20);
  EXPECT_NEAR(shift, off, 1e-7);
  EXPECT_LT(laid_over(simulated, log, shift)[0].rms, 5e-3);
  EXPECT_GT(laid_over(simulated, log, 0.0)[0].rms, 5e-2);
}

TEST(LaidOver, AtInstantsIsTheLogThere) {
  const study::Trace log = trace({{"t_s", {0, 1, 2}}, {"duty", {0, 1, 0}}});
  const study::Trace there = at_instants(log, 0.5, {0, 0.5, 1, 1.5, 2.5, 3});
  EXPECT_THAT(there.values[0], testing::ElementsAre(0, 0.5, 1, 1.5, 2.5, 3));
  EXPECT_TRUE(std::isnan(there.values[1][0]));
  EXPECT_TRUE(std::isnan(there.values[1][5]));
  EXPECT_THAT(std::vector<double>(there.values[1].begin() + 1, there.values[1].end() - 1),
              testing::ElementsAre(0, 0.5, 1, 0));
}

}  // namespace
}  // namespace sixstep::analysis
