// SPDX-License-Identifier: Apache-2.0
// Tests the sentences below a comparison. They name the controllers, and state a factor only if it has a
// meaning.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "text/contest/contest_text.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::size_t settle = 4, loss = analysis::loss_figure;

/// The index of a controller in the list of all controllers, its settling time and its loss.
struct Of {
  std::size_t who;
  double settle_s, loss_W;
};
std::vector<std::string> words(const std::vector<Of>& all) {
  analysis::Contest c;
  for (const Of& of : all) {
    c.entries.push_back({&analysis::contestants()[of.who], {}, base::Problem{}});
    analysis::ContestRow row;
    row.values[settle] = of.settle_s;
    row.values[loss] = of.loss_W;
    row.nominal_held = true;
    c.rows.push_back(row);
  }
  return text::contest_words(c);
}

std::string name(std::size_t who) { return std::string(analysis::contestants()[who].name); }

TEST(ContestWords, WhoSharesAFigureIsNamed) {
  const auto told = words({{0, 1.0, 5.0}, {1, 2.0, 3.0}, {2, 3.0, 3.01}});
  EXPECT_THAT(told,
              Contains(name(1) + " and " + name(2) + " share these least values within 5 %: total loss."));
  EXPECT_THAT(told, Contains(HasSubstr(name(0) + " has these least values: ")));
  EXPECT_THAT(told, Not(Contains(HasSubstr("first two"))));
}

/// The sentence names every controller within 5 % of the smallest value, not only the best two. If more than
/// four controllers are within 5 %, the sentence names the other controllers instead, provided that these are
/// fewer.
TEST(ContestWords, AllWhoShareAFigureAreNamed) {
  EXPECT_THAT(words({{0, 1.0, 3.1}, {1, 2.0, 3.0}, {2, 3.0, 3.01}, {3, 4.0, 3.2}}),
              Contains(name(0) + "; " + name(1) + " and " + name(2) +
                       " share these least values within 5 %: total loss."));
  // Percentages refer to the smallest value, as on the whole page: 3.155 is 5.2 % more than 3.
  EXPECT_THAT(words({{0, 1.0, 3.155}, {1, 2.0, 3.0}, {2, 3.0, 3.01}}),
              Contains(name(1) + " and " + name(2) + " share these least values within 5 %: total loss."));
  EXPECT_THAT(
      words({{0, 1.0, 3.1}, {1, 2.0, 3.0}, {2, 3.0, 3.01}, {3, 4.0, 3.1}, {4, 5.0, 3.05}, {5, 6.0, 9.0}}),
      Contains("All controllers that hold the course, but for " + name(5) +
               ", share these least values within 5 %: total loss."));
  EXPECT_THAT(
      words({{0, 1.0, 3.1}, {1, 2.0, 3.0}, {2, 3.0, 3.01}, {3, 4.0, 3.1}, {4, 5.0, 3.05}}),
      Contains("All controllers that hold the course share these least values within 5 %: total loss."));
}

/// If a controller exceeds 1.5 times the limit's current at the start, it has an unfair advantage. It must
/// have no star and no sentence, but a note with the reason.
TEST(ContestWords, WhoeverStartsBeyondTheLimitWinsNothing) {
  analysis::Contest c;
  c.bench.design.current_at_full_torque_A = 4.0;
  for (const double peak_A : {5.9, 6.1}) {
    c.entries.push_back({&analysis::contestants()[c.rows.size()], {}, study::Scenario{}});
    analysis::ContestRow row;
    row.values[analysis::peak_figure] = peak_A;
    row.values[settle] = 1.0 / peak_A;  // the controller beyond the limit is faster
    row.nominal_held = true;
    c.rows.push_back(row);
  }
  EXPECT_TRUE(analysis::may_win(c, 0));
  EXPECT_FALSE(analysis::may_win(c, 1));
  EXPECT_THAT(text::contest_words(c), Not(Contains(HasSubstr(name(1) + " has the least"))));
  EXPECT_THAT(
      text::contest_notes(c),
      ElementsAre(
          name(1) +
          " starts with a peak of 6.1 A, 1.5 times the current of the torque limit. Commutation and ripple explain a peak of at most 6 A. None of the controller's figures counts as the least"));
  for (const text::ContestTable& table : text::contest_tables(c))
    for (const std::string& cell : table.rows.back()) EXPECT_THAT(cell, Not(HasSubstr("*")));
}

TEST(ContestWords, AgainstNothingStandsAValue) {
  const std::string phrase(analysis::contest_figures[settle].phrase);
  EXPECT_THAT(phrase, HasSubstr("settling"));
  EXPECT_THAT(words({{0, 0.0, 1.0}, {1, 0.005, 2.0}}),
              Contains(HasSubstr(phrase + " (0 ms; the next controller: 5 ms)")));
  const double never = std::numeric_limits<double>::infinity();
  EXPECT_THAT(words({{0, never, 1.0}, {1, 0.005, 2.0}}),
              Contains(HasSubstr(name(1) + " has these least values: " + phrase +
                                 " (5 ms; the other controllers never settle)")));
}

}  // namespace SIXSTEP_TEST_FILE
