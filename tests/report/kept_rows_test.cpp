// SPDX-License-Identifier: Apache-2.0
// A report stores its rows in bounded memory. The stored rows contain every peak, the latest events and the
// largest step. If only an envelope of an interval is stored, the report draws no conclusion from this
// interval.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "report/cost_card.hpp"
#include "report/highlights.hpp"
#include "report/kept_rows.hpp"
#include "report/windows.hpp"
#include "sixstep/study/measure/columns.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace report;
using sixstep::control::Mode;
using sixstep::study::all_columns;
using sixstep::study::column_count;
using sixstep::study::ColumnId;
using sixstep::study::Scenario;
using sixstep::study::Trace;
using ::testing::HasSubstr;

constexpr std::size_t most_rows = 4096, most_bytes = most_rows * column_count * sizeof(double);
constexpr double gap_s = 1e-5;

std::size_t place(ColumnId column) { return static_cast<std::size_t>(column); }

/// One row with five signals: a current that oscillates, a gate that switches in each row, one narrow peak,
/// one narrow dip, and a step of the reference.
std::vector<double> row(std::size_t n, std::size_t step_at) {
  std::vector<double> out(column_count, 0.0);
  out[place(ColumnId::t)] = static_cast<double>(n) * gap_s;
  out[place(ColumnId::i_a)] = std::sin(static_cast<double>(n)) + (n == 777 ? 40.0 : n == 7777 ? -30.0 : 0.0);
  out[place(ColumnId::gate_T1)] = static_cast<double>(n % 2);
  out[place(ColumnId::i_ref)] = n < step_at ? 0.0 : 5.0;
  const double since = n < step_at ? 0.0 : static_cast<double>(n - step_at);
  out[place(ColumnId::i_m)] = n < step_at ? 0.0 : 5.0 * (1 - std::exp(-since / 40));
  out[place(ColumnId::duty)] = 1.0;
  return out;
}

Scenario current_drive() {
  Scenario s;
  s.control.mode = Mode::current;
  s.pwm.period_s = 2 * gap_s;
  return s;
}

KeptRows filled(const Scenario& s, std::size_t count, std::size_t step_at) {
  KeptRows kept(s, most_bytes);
  for (std::size_t n = 0; n < count; ++n) {
    kept.add(row(n, step_at));
    EXPECT_LE(kept.trace().values[0].size(), most_rows);
  }
  return kept;
}

/// Each stored row is equal to an added row. In the intervals that are marked as whole, no row is missing.
void expect_whole_where_it_says(const Trace& t, std::size_t count, std::size_t step_at) {
  std::size_t last = 0;
  for (std::size_t n = 0; n < t.values[0].size(); ++n) {
    const auto number = static_cast<std::size_t>(std::lround(t.values[0][n] / gap_s));
    const std::vector<double> added = row(number, step_at);
    for (std::size_t c = 0; c < column_count; ++c) ASSERT_EQ(t.values[c][n], added[c]) << number;
    if (n > 0) {
      ASSERT_GT(number, last);
      const double before_s = static_cast<double>(last) * gap_s, now_s = t.values[0][n];
      const std::size_t missing = number - last - 1;
      ASSERT_TRUE(missing == 0 || !is_whole(t, {before_s, now_s})) << missing << " before " << now_s;
    }
    last = number;
  }
  EXPECT_EQ(last, count - 1);
  EXPECT_EQ(t.values[0].size() + t.left_out, count);
}

TEST(KeptRows, AreAllRowsWhileTheyAreFew) {
  const Scenario s = current_drive();
  const KeptRows kept = filled(s, most_rows, 100);
  EXPECT_TRUE(kept.trace().whole.empty());
  EXPECT_EQ(rows_told(kept.trace()), "");
  expect_whole_where_it_says(kept.trace(), most_rows, 100);
}

TEST(KeptRows, OfALongRunStayInTheirMemoryAndLoseNoPeak) {
  const Scenario s = current_drive();
  constexpr std::size_t count = 100 * most_rows;
  const KeptRows kept = filled(s, count, 1000);
  const Trace& t = kept.trace();
  expect_whole_where_it_says(t, count, 1000);
  const std::vector<double>& i_a = t.values[place(ColumnId::i_a)];
  EXPECT_EQ(*std::ranges::max_element(i_a), row(777, 1000)[place(ColumnId::i_a)]);
  EXPECT_EQ(*std::ranges::min_element(i_a), row(7777, 1000)[place(ColumnId::i_a)]);
  // The latest whole rows fill more than a quarter of the memory.
  const double last_s = t.values[0].back();
  EXPECT_GT((last_s - whole_from_s(t)) / gap_s, most_rows / 4.0);
  EXPECT_FALSE(is_whole(t, {0.0, last_s}));
}

TEST(KeptRows, OfTheLargestStepAllStay) {
  const Scenario s = current_drive();
  const KeptRows kept = filled(s, 100 * most_rows, 1000);
  const auto step = largest_step(kept.trace(), s);
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->at_s, 1000 * gap_s, 1e-12);
  EXPECT_TRUE(is_whole(kept.trace(), step->window));
  EXPECT_GT(step->window.to - step->window.from, 100 * gap_s);
  const auto windows = choose_windows(kept.trace(), s);
  ASSERT_TRUE(windows.step);
  ASSERT_TRUE(windows.periods);
  EXPECT_TRUE(is_whole(kept.trace(), *windows.periods));
  const auto current = step_current(kept.trace(), *step);
  ASSERT_TRUE(current);
  EXPECT_STREQ(step->held.column, "i_m_A") << "its rows have the columns of all drives";
  EXPECT_GT(current->peak_A, 4.0);
  EXPECT_FALSE(current->then_mean_A) << "an envelope has no mean";
  EXPECT_THAT(rows_told(kept.trace()), HasSubstr("the report has every event from 0.01 s to "));
}

TEST(KeptRows, NothingIsCountedWhereAnEnvelopeStands) {
  const Scenario s = current_drive();
  const KeptRows kept = filled(s, 10 * most_rows, 1000);
  const Trace& t = kept.trace();
  const double seen_s = t.values[0].back() - whole_from_s(t);
  const auto counts = turn_on_counts(t);
  ASSERT_TRUE(counts);
  EXPECT_NEAR(static_cast<double>((*counts)[0]), seen_s / gap_s / 2, 1.0);
  const auto held = held_back(t, s);
  ASSERT_TRUE(held);
  EXPECT_DOUBLE_EQ(held->seen_s, seen_s);
  EXPECT_NEAR(held->bus_s, seen_s, 1e-12);
}

TEST(KeptRows, AreForetoldWhereTheirNumberCanBe) {
  Scenario s = current_drive();
  s.pwm.period_s = 30e-6;
  s.duration_s = 0.1;
  EXPECT_EQ(rows_foretold(s), "");
  s.duration_s = 1000;
  EXPECT_THAT(rows_foretold(s), HasSubstr("a report keeps only 160 MB"));
  // The time from which every event is stored depends on the run, so only the page states it.
  const std::string longer = rows_foretold(s);
  s.pwm.period_s = 60e-6;
  s.duration_s = 2000;
  EXPECT_EQ(rows_foretold(s), longer);
}

}  // namespace SIXSTEP_TEST_FILE
