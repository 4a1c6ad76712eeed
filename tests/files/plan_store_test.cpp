// SPDX-License-Identifier: Apache-2.0
// The rows of a store survive the end of the program. Plain SQL can read them.
#include "files/store/plan_store.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>

#include "tests/files/a_store.hpp"

namespace files {
namespace SIXSTEP_TEST_FILE {

using ::testing::HasSubstr;

TEST_F(Store, GivesBackEachRowToTheBitInTheOrderOfItsNumber) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  {
    base::Result<PlanStore> store = PlanStore::create(path(), plan(), false);
    ASSERT_TRUE(store);
    analysis::RunValues odd = values(2);
    odd.figures = {inf, nan};
    odd.end = analysis::RunEnd::fault;
    odd.problem = "t = 1 s: shoot-through";
    odd.remarks = {"one", "two\nlines"};
    store->add(row(7));
    store->add(row(std::move(odd)));
    store->add(row(0));
    EXPECT_EQ(store->finish(), base::Problems{});
    EXPECT_EQ(store->rows(), 3u);
  }
  base::Result<PlanStore> store = PlanStore::read(path());
  ASSERT_TRUE(store);
  const std::vector<analysis::RunRecord> rows = rows_of(*store);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0]->number, 0u);
  EXPECT_EQ(rows[1]->number, 2u);
  EXPECT_EQ(rows[2]->figures, row(7)->figures);
  EXPECT_EQ(rows[2]->strayed, row(7)->strayed);
  EXPECT_EQ(rows[2]->digest, row(7)->digest);
  EXPECT_EQ(rows[1]->figures[0], inf);
  EXPECT_TRUE(std::isnan(rows[1]->figures[1]));
  EXPECT_EQ(rows[1]->problem, "t = 1 s: shoot-through");
  EXPECT_EQ(rows[1]->remarks, (std::vector<std::string>{"one", "two\\u000alines"}));
  EXPECT_TRUE(rows[0]->remarks.empty());
  EXPECT_EQ(rows[1]->end, analysis::RunEnd::fault);
  EXPECT_EQ(*store->plan().columns, *plan().columns);
  EXPECT_EQ(store->plan().scenario_text, "x = 1\n");
}

TEST_F(Store, IsAskedInPlainSqlByNamesWithUnits) {
  {
    base::Result<PlanStore> store = PlanStore::create(path(), plan(), false);
    store->add(row(1));
    store->add(row(3));
    store->finish();
  }
  base::Result<Database> db = Database::open(path());
  base::Result<Statement> select = db->prepare(
      "SELECT passed, \"pwm.period_s [s]\", \"pwm.chopping\", \"drive: motor_override.resistance_ohm [ohm]\", "
      "\"rise \"\"time\"\" [s]\" FROM runs ORDER BY run");
  ASSERT_TRUE(select) << to_string(select.problems().front());
  ASSERT_TRUE(select->step());
  EXPECT_EQ(select->whole(0), 1);
  EXPECT_EQ(select->number(1), 3e-5);
  EXPECT_EQ(select->text(2), "soft");
  EXPECT_EQ(select->number(3), 0.5);
  EXPECT_EQ(select->number(4), 1.0);
  ASSERT_TRUE(select->step());
  EXPECT_EQ(select->whole(0), 0) << "3 s are more than 2";
}

TEST_F(Store, GoesOnWithTheSamePlanAloneAndSaysWhatChanged) {
  { PlanStore::create(path(), plan(), false)->add(row(4)); }
  EXPECT_THAT(to_string(PlanStore::create(path(), plan(), false).problems().front()),
              HasSubstr("already contains runs"));
  {
    base::Result<PlanStore> store = PlanStore::resume(path(), plan());
    ASSERT_TRUE(store);
    EXPECT_TRUE(store->has(4));
    EXPECT_FALSE(store->has(0));
    store->add(row(5));
    store->add(row(5));
    EXPECT_EQ(store->finish(), base::Problems{});
    EXPECT_EQ(store->rows(), 2u);
  }
  StoredPlan other = plan();
  other.plan = "{}";
  EXPECT_THAT(to_string(PlanStore::resume(path(), other).problems().front()), HasSubstr("another plan"));
  other = plan();
  other.inputs = "4567";
  EXPECT_THAT(to_string(PlanStore::resume(path(), other).problems().front()), HasSubstr("changed since"));
  ASSERT_TRUE(PlanStore::create(path(), other, true));
  EXPECT_EQ(PlanStore::read(path())->rows(), 0u);
}

TEST_F(Store, LeavesWhatIsNotItsOwnAlone) {
  std::ofstream(path()) << "a letter\n";
  for (const bool force : {false, true})
    EXPECT_THAT(to_string(PlanStore::create(path(), plan(), force).problems().front()),
                HasSubstr("not a store of runs"));
  EXPECT_FALSE(PlanStore::resume(path(), plan()));
  EXPECT_FALSE(PlanStore::read(path()));
  EXPECT_EQ(std::filesystem::file_size(path()), 9u);
  EXPECT_FALSE(PlanStore::create((folder_ / "no/such/folder.sqlite").string(), plan(), false));
}

TEST_F(Store, IsOneWritersAlone) {
  base::Result<PlanStore> first = PlanStore::create(path(), plan(), false);
  ASSERT_TRUE(first);
  first->add(row(0));
  first->finish();
  EXPECT_THAT(to_string(PlanStore::resume(path(), plan()).problems().front()),
              HasSubstr("is in use by another program"));
}

TEST_F(Store, TakesNoRowOfOtherColumns) {
  analysis::PlanColumns other = *columns();
  other.strayed.push_back({"supply.voltage_V", "V"});
  analysis::RunValues wide = values(1);
  wide.strayed.push_back(24.0);
  EXPECT_FALSE(analysis::RunRecord::of(columns(), wide)) << "a value more than there are columns";
  base::Result<PlanStore> store = PlanStore::create(path(), plan(), false);
  store->add(row(0));
  store->add(row(std::make_shared<const analysis::PlanColumns>(other), wide));
  const base::Problems told = store->finish();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(to_string(told[0]), HasSubstr("cannot store run 1"));
  EXPECT_TRUE(store->failed());
}

/// A label must have no effect in a terminal that prints the store, or in a spreadsheet that opens an export
/// from SQLite.
TEST_F(Store, ShowsWhatActsInNames) {
  const std::string evil = "=1+1 \x1b[31m\n\xe2\x80\xae";
  StoredPlan odd = plan();
  analysis::PlanColumns names = *columns();
  names.figures[1].name = evil;
  names.keys[1].key = evil;
  odd.columns = std::make_shared<const analysis::PlanColumns>(names);
  odd.title = odd.motor = odd.scenario = odd.plan = evil;
  analysis::RunValues values = Store::values(1);
  values.problem = values.point[1] = evil;
  {
    base::Result<PlanStore> store = PlanStore::create(path(), odd, false);
    ASSERT_TRUE(store);
    store->add(row(odd.columns, values));
    EXPECT_EQ(store->finish(), base::Problems{});
  }
  {
    base::Result<PlanStore> store = PlanStore::resume(path(), odd);
    ASSERT_TRUE(store) << to_string(store.problems().front());
    EXPECT_EQ(store->rows(), 1u);
  }
  const std::string bytes = text_of_file();
  for (const char* raw : {"\x1b[31m", "\xe2\x80\xae", "31m\n", "\"=1+1"})
    EXPECT_EQ(bytes.find(raw), std::string::npos) << raw;
  EXPECT_NE(bytes.find("\"'=1+1 \\u001b[31m\\u000a\\u202e [A]\""), std::string::npos);
}

/// Rows that rows() has counted survive kill -9. A run can then continue the store.
TEST_F(Store, KeepsWhatItHasCountedThroughKills) {
  std::size_t told = 0;
  for (int kill = 0; kill < 10; ++kill) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      base::Result<PlanStore> store = PlanStore::resume(path(), plan());
      if (!store) ::_exit(1);
      for (std::size_t n = store->rows();; ++n) {
        store->add(row(n));
        const std::size_t counted = store->rows();
        if (::write(ends[1], &counted, sizeof counted) != sizeof counted) ::_exit(2);
      }
    }
    ::close(ends[1]);
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(20 + 13 * kill);
    std::size_t last = 0;
    while (std::chrono::steady_clock::now() < until && ::read(ends[0], &last, sizeof last) == sizeof last)
      told = std::max(told, last);
    ::kill(child, SIGKILL);
    while (::read(ends[0], &last, sizeof last) == sizeof last) told = std::max(told, last);
    ::close(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    base::Result<PlanStore> store = PlanStore::read(path());
    ASSERT_TRUE(store);
    EXPECT_GE(store->rows(), told);
    const std::vector<analysis::RunRecord> rows = rows_of(*store);
    for (std::size_t n = 0; n < rows.size(); ++n) {
      ASSERT_EQ(rows[n]->number, n) << "no gap: they were added in order";
      ASSERT_EQ(rows[n]->figures, row(n)->figures);
    }
  }
  EXPECT_GT(told, 100u);
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace files
