// SPDX-License-Identifier: Apache-2.0
// A batch is its runs, whatever the number of threads; and it can be watched, stopped and broken into.
#include "batch/run.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "sixstep/study/scenario/spread.hpp"
#include "tests/support/scenarios.hpp"

namespace batch {
namespace {

using namespace sixstep::testing;
using ::testing::ElementsAreArray;

/// Figures on, settling-time gains, each run another motor.
study::Scenario series() {
  study::Scenario s = current_square();
  s.control.current.d1 = s.control.current.d0 = std::nullopt;
  s.duration_s = 2e-3;
  study::Requirement r;
  r.measure = measure(study::MetricKind::maximum, study::Signal::current);
  r.max = 5.2;
  s.require.push_back(r);
  for (const char* key : {"motor_override.resistance_ohm", "motor_override.inductance_mH"}) {
    study::Spread spread;
    spread.key = key;
    spread.relative = 0.1;
    s.spread.push_back(spread);
  }
  return s;
}

study::Scenario drive(std::size_t n) { return study::varied(series(), 1, n); }

struct Seen {
  std::vector<std::size_t> numbers;
  std::vector<std::uint64_t> digests;
  std::vector<double> figures;
};

Seen batch_of(std::size_t count, unsigned jobs) {
  Seen seen;
  const std::size_t taken = run({.count = count,
                                 .scenario = drive,
                                 .take =
                                     [&](std::size_t n, RunResult&& result) {
                                       seen.numbers.push_back(n);
                                       seen.digests.push_back(result ? result->digest : 0);
                                       seen.figures.push_back(result ? result->verdicts.at(0).measured : 0.0);
                                     },
                                 .jobs = jobs});
  EXPECT_EQ(taken, count);
  return seen;
}

TEST(Run, IsEachRunAloneToTheBitOnAnyNumberOfThreads) {
  constexpr std::size_t count = 24;
  Seen alone;
  for (std::size_t n = 0; n < count; ++n) {
    const RunResult result = study::run(drive(n));
    ASSERT_TRUE(result);
    alone.numbers.push_back(n);
    alone.digests.push_back(result->digest);
    alone.figures.push_back(result->verdicts.at(0).measured);
  }
  for (std::size_t n = 1; n < count; ++n) EXPECT_NE(alone.digests[n], alone.digests[n - 1]);
  for (const unsigned jobs : {1u, 2u, 3u, 8u}) {
    const Seen seen = batch_of(count, jobs);
    EXPECT_EQ(seen.numbers, alone.numbers) << jobs;
    EXPECT_EQ(seen.digests, alone.digests) << jobs;
    EXPECT_EQ(seen.figures, alone.figures) << jobs;
  }
}

TEST(Run, AProblemIsAResultToo) {
  const auto scenario = [](std::size_t n) {
    study::Scenario s = drive(n);
    if (n == 1) s.sheet.resistance_ohm->value = -1.0;
    return s;
  };
  std::vector<bool> ran;
  run({.count = 3, .scenario = scenario, .take = [&](std::size_t, RunResult&& r) {
         ran.push_back(bool(r));
       }});
  EXPECT_THAT(ran, ElementsAreArray({true, false, true}));
}

/// Run 0 is by far the longest: the other thread must wait for it instead of piling up results.
TEST(Run, KeepsNoMoreResultsThanItMay) {
  constexpr std::size_t count = 2 * results_ahead;
  std::atomic<std::size_t> begun{0};
  std::size_t begun_at_first = 0;
  const auto scenario = [&](std::size_t n) {
    ++begun;
    study::Scenario s = drive(n);
    s.duration_s = n == 0 ? 1.0 : 60e-6;
    s.reference.period_s = n == 0 ? 0.1 : 10e-3;
    return s;
  };
  run({.count = count,
       .scenario = scenario,
       .take =
           [&](std::size_t n, RunResult&&) {
             if (n == 0) begun_at_first = begun;
           },
       .jobs = 2});
  EXPECT_EQ(begun, count);
  EXPECT_LE(begun_at_first, results_ahead);
}

TEST(Run, TellsItsProgress) {
  std::vector<std::size_t> told;
  run({.count = 5,
       .scenario = drive,
       .progress = [&](std::size_t done) { told.push_back(done); },
       .jobs = 3});
  EXPECT_THAT(told, ElementsAreArray({1u, 2u, 3u, 4u, 5u}));
}

TEST(Run, MakesATraceOnlyWhereAskedFor) {
  std::vector<std::size_t> rows(3, 0);
  run({.count = 3,
       .scenario = drive,
       .listeners =
           [&](std::size_t n) {
             study::Listeners listeners;
             if (n == 1) listeners.on_record = [&rows, n](study::Row) { ++rows[n]; };
             return listeners;
           },
       .jobs = 2});
  EXPECT_EQ(rows[0], 0u);
  EXPECT_GT(rows[1], 60u);
  EXPECT_EQ(rows[2], 0u);
}

TEST(Run, StopsAtOnceAndKeepsWhatIsWhole) {
  for (const unsigned jobs : {1u, 2u, 8u}) {
    std::stop_source stop;
    std::vector<std::size_t> taken;
    const auto scenario = [](std::size_t n) {
      study::Scenario s = drive(n);
      if (n >= 10) s.duration_s = s.reference.period_s = 1e5;  // hours, unless it is stopped
      return s;
    };
    const std::size_t count = run({.count = std::size_t{1} << 60,
                                   .scenario = scenario,
                                   .take =
                                       [&](std::size_t n, RunResult&& result) {
                                         taken.push_back(n);
                                         EXPECT_TRUE(result && result->simulated_s == 2e-3);
                                         if (n == 5) stop.request_stop();
                                       },
                                   .stop = stop.get_token(),
                                   .jobs = jobs});
    EXPECT_EQ(count, taken.size());
    EXPECT_GE(count, 6u);
    EXPECT_LE(count, 10u);
    for (std::size_t n = 0; n < taken.size(); ++n) EXPECT_EQ(taken[n], n);
  }
}

TEST(Run, AnExceptionOfATakerEndsTheBatchAndComesOut) {
  for (const unsigned jobs : {1u, 3u}) {
    std::atomic<std::size_t> begun{0};
    EXPECT_THROW(run({.count = std::size_t{1} << 60,
                      .scenario =
                          [&](std::size_t n) {
                            ++begun;
                            return drive(n);
                          },
                      .take =
                          [](std::size_t n, RunResult&&) {
                            if (n == 4) throw std::runtime_error("full disk");
                          },
                      .jobs = jobs}),
                 std::runtime_error);
    EXPECT_LE(begun, 5 + results_ahead);
  }
}

TEST(Run, OfNothingIsNothing) { EXPECT_EQ(run({.count = 0, .scenario = drive}), 0u); }

}  // namespace
}  // namespace batch
