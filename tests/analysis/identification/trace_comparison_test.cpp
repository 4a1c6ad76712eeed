// SPDX-License-Identifier: Apache-2.0
// A board's log is compared with a simulation. The differences between them are known.
#include "sixstep/analysis/identification/log/trace_comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sixstep::analysis {
namespace SIXSTEP_TEST_FILE {

study::Trace trace(std::vector<std::pair<std::string, std::vector<double>>> columns) {
  study::Trace out;
  for (auto& [name, values] : columns) {
    out.columns.push_back({.name = name, .unit = "", .frame = "", .meaning = ""});
    out.values.push_back(std::move(values));
  }
  return out;
}

TEST(TraceComparison, StraightBetweenRowsAndOnTheLaterSideOfAJump) {
  const study::Trace simulated =
      trace({{"t_s", {0, 1, 1, 2}}, {"i_m_A", {0, 2, 5, 5}}, {"duty", {1, 1, 1, 1}}});
  const study::Trace log =
      trace({{"t_s", {-1, 0.5, 1, 2, 3}}, {"i_m_A", {9, 1.5, 5, 4, 9}}, {"bus_V", {1, 1, 1, 1, 1}}});
  const std::vector<TraceComparison> found = trace_comparison(simulated, log, 0.0);
  ASSERT_EQ(found.size(), 1u) << "a column that only one has is compared with nothing";
  EXPECT_EQ(found[0].column.name, "i_m_A");
  EXPECT_EQ(found[0].rows, 3u) << "rows outside are left out";
  EXPECT_DOUBLE_EQ(found[0].span, 4.0);
  EXPECT_DOUBLE_EQ(found[0].rms, std::sqrt((0.25 + 0 + 1) / 3));
  EXPECT_DOUBLE_EQ(found[0].greatest, -1.0);
  EXPECT_DOUBLE_EQ(found[0].at_s, 2.0);
}

/// Codes are labels: renaming the codes changes no result, and two labels are either equal or different.
TEST(TraceComparison, LabelsDifferOrDoNot) {
  const std::vector<double> t_s{0, 1, 2, 2, 3, 4, 5}, logged_s{0.5, 1, 2, 2.5, 3, 4.5, 5};
  const int simulated[] = {1, 1, 1, 2, 2, 3, 3}, logged[] = {1, 2, 2, 2, 1, 2, 3};
  std::optional<TraceComparison> first;
  for (const std::vector<double>& codes : {std::vector<double>{0, 1, 2, 3}, {0, 5, 4, 6}, {0, 6, 1, 5}}) {
    study::Trace here = trace({{"t_s", t_s}, {"hall", {}}}), log = trace({{"t_s", logged_s}, {"hall", {}}});
    for (const int n : simulated) here.values[1].push_back(codes[static_cast<std::size_t>(n)]);
    for (const int n : logged) log.values[1].push_back(codes[static_cast<std::size_t>(n)]);
    const std::vector<TraceComparison> found = trace_comparison(here, log, 0.0);
    ASSERT_EQ(found.size(), 1u);
    if (!first) first = found[0];
    EXPECT_EQ(found[0].rows, 7u);
    // The labels differ at 1 s, 3 s and 4.5 s. At 2 s, the log has the simulated label after the edge, so
    // this row agrees.
    EXPECT_EQ(found[0].differing, 3u);
    EXPECT_DOUBLE_EQ(found[0].at_s, 1.0);
    EXPECT_DOUBLE_EQ(found[0].rms, first->rms);
  }
  EXPECT_FALSE(trace_comparison(trace({{"t_s", {0, 1}}, {"duty", {0, 1}}}),
                                trace({{"t_s", {0, 1}}, {"duty", {0, 1}}}), 0)[0]
                   .differing);
}

/// The Hall codes alone determine the clock's shift: with this shift, no row differs.
TEST(TraceComparison, FindsTheShiftByTheEdgesOfLabels) {
  constexpr double off = 1.3e-3;
  const auto code = [](double t) {
    constexpr double codes[] = {4, 6, 2, 3, 1, 5};
    return codes[static_cast<std::size_t>((t + 0.3 * t * t) / 2e-3) % 6];
  };
  study::Trace simulated = trace({{"t_s", {}}, {"hall", {}}}), log = simulated;
  for (int n = 0; n <= 4000; ++n) {
    simulated.values[0].push_back(n * 25e-6);
    simulated.values[1].push_back(code(n * 25e-6));
  }
  for (int n = 50; n < 900; ++n) {
    const double t = n * 1e-4;
    log.values[0].push_back(t - off);
    log.values[1].push_back(code(t));
  }
  const double shift = best_shift_s(simulated, log, 2e-3, 1e-4);
  EXPECT_NEAR(shift, off, 1e-4);
  EXPECT_EQ(trace_comparison(simulated, log, shift)[0].differing, 0u);
  EXPECT_GT(trace_comparison(simulated, log, 0.0)[0].differing, 100u);
}

TEST(TraceComparison, NothingMeetsNothing) {
  const study::Trace simulated = trace({{"t_s", {0, 1}}, {"duty", {0, 1}}});
  EXPECT_TRUE(trace_comparison(simulated, trace({{"t_s", {5, 6}}, {"duty", {0, 1}}}), 0.0).empty());
  EXPECT_FALSE(trace_comparison(simulated, trace({{"t_s", {5, 6}}, {"duty", {0, 1}}}), -5.0).empty());
  EXPECT_TRUE(trace_comparison(simulated, trace({{"t_s", {}}, {"duty", {}}}), 0.0).empty());
  EXPECT_TRUE(trace_comparison(simulated, trace({{"t_s", {0.5}}, {"duty", {NAN}}}), 0.0).empty());
  EXPECT_EQ(best_shift_s(simulated, trace({{"t_s", {5, 6}}, {"duty", {0, 1}}}), 1.0, 0.1), 0.0);
}

/// The signal is a ripple on a slope, sampled by a clock with an offset.
TEST(TraceComparison, FindsTheShiftOfARipple) {
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
  const double shift = best_shift_s(simulated, log, 5 * period, period / 20);
  EXPECT_NEAR(shift, off, 1e-7);
  EXPECT_LT(trace_comparison(simulated, log, shift)[0].rms, 5e-3);
  EXPECT_GT(trace_comparison(simulated, log, 0.0)[0].rms, 5e-2);
}

/// The speed changes slowly and does not show the clock's offset. The current changes fast and shows it. If
/// the log is the rounded run itself, the shift is 0.
TEST(TraceComparison, AllColumnsDecideTheShiftAndNothingIsGainedByNone) {
  study::Trace simulated = trace({{"t_s", {}}, {"speed_rad_s", {}}, {"i_m_A", {}}}), log = simulated,
               late = simulated;
  const auto current = [](double t) { return 15 * std::exp(-t / 0.01) + 0.3 * std::sin(4e4 * t); };
  for (int n = 0; n <= 100'000; ++n) {
    const double t = n * 1e-6;
    simulated.values[0].push_back(t);
    simulated.values[1].push_back(40 * (1 - std::exp(-t / 0.02)));
    simulated.values[2].push_back(current(t));
  }
  for (int n = 0; n < 100; ++n) {
    const double t = n * 1e-3;
    for (study::Trace* one : {&log, &late}) {
      one->values[0].push_back(one == &log ? t : t - 3e-5);
      one->values[1].push_back(std::round(1e2 * 40 * (1 - std::exp(-t / 0.02))) / 1e2);
      one->values[2].push_back(std::round(1e3 * current(t)) / 1e3);
    }
  }
  EXPECT_EQ(best_shift_s(simulated, log, 1e-3, 2.5e-6), 0.0);
  EXPECT_NEAR(best_shift_s(simulated, late, 1e-3, 2.5e-6), 3e-5, 1e-8);
}

TEST(TraceComparison, AClockThatStartedLongBeforeCountsFromItsFirstRow) {
  const study::Trace simulated = trace({{"t_s", {0, 1}}, {"duty", {0, 1}}});
  EXPECT_EQ(start_shift_s(simulated, trace({{"t_s", {36000, 36001}}, {"duty", {0, 1}}})), -36000.0);
  EXPECT_EQ(start_shift_s(simulated, trace({{"t_s", {-3, -2}}, {"duty", {0, 1}}})), 3.0);
  EXPECT_EQ(start_shift_s(simulated, trace({{"t_s", {-1, 0.5}}, {"duty", {0, 1}}})), 0.0);
}

/// A comparison over a single row may give 0 and proves nothing, so several rows are required.
TEST(TraceComparison, AHandfulOfRowsAtTheLeast) {
  const study::Trace simulated = trace({{"t_s", {0, 1}}, {"duty", {0, 1}}, {"i_q_A", {NAN, NAN}}});
  const auto of = [&](std::vector<double> t_s) {
    return overlay("log.csv", simulated, trace({{"t_s", t_s}, {"duty", t_s}, {"i_q_A", t_s}, {"bus_V", t_s}}),
                   0.0);
  };
  const auto few = of({0, 1000, 2000, 3000, 4000});
  ASSERT_FALSE(few);
  EXPECT_EQ(
      to_string(few.problems()[0]),
      "log.csv: has 1 of 5 rows in the simulated time, 0 to 1 s; the log covers 0 to 4000 s, and 5 are needed; correct the unit of the log's time, or give the offset of the log's clock");
  const auto enough = of({0, 0.2, 0.4, 0.6, 0.8, 1.5});
  ASSERT_TRUE(enough);
  ASSERT_EQ(enough->columns.size(), 1u);
  EXPECT_EQ(enough->columns[0].rows, 5u);
  EXPECT_EQ(enough->inside, 5u);
  ASSERT_EQ(enough->left_out.size(), 2u);
  EXPECT_EQ(enough->left_out[0].column, "i_q_A");
  EXPECT_EQ(enough->left_out[0].reason, "the run has no values of this column at these times");
}

TEST(TraceComparison, AtInstantsIsTheLogThere) {
  const study::Trace log = trace({{"t_s", {0, 1, 2}}, {"duty", {0, 1, 0}}});
  const study::Trace there = at_instants(log, 0.5, {0, 0.5, 1, 1.5, 2.5, 3});
  EXPECT_THAT(there.values[0], ::testing::ElementsAre(0, 0.5, 1, 1.5, 2.5, 3));
  EXPECT_TRUE(std::isnan(there.values[1][0]));
  EXPECT_TRUE(std::isnan(there.values[1][5]));
  EXPECT_THAT(std::vector<double>(there.values[1].begin() + 1, there.values[1].end() - 1),
              ::testing::ElementsAre(0, 0.5, 1, 0));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace sixstep::analysis
