// SPDX-License-Identifier: Apache-2.0
// A plan on a cluster gives the same rows as one process, for any distribution of the runs. In this test,
// threads with mailboxes replace the processes.
#include "batch/cluster.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "batch/letters.hpp"
#include "tests/support/scenarios.hpp"

namespace batch {
namespace SIXSTEP_TEST_FILE {

using namespace sixstep::testing;

/// Mailboxes in memory, one for each process.
struct Post {
  std::mutex guard;
  std::map<unsigned, std::deque<Mail>> boxes;

  Cluster of(unsigned rank, unsigned size) {
    return {.rank = rank,
            .size = size,
            .send =
                [this, rank](unsigned to, std::string bytes) {
                  const std::lock_guard lock(guard);
                  boxes[to].push_back({rank, std::move(bytes)});
                },
            .receive = [this, rank]() -> std::optional<Mail> {
              const std::lock_guard lock(guard);
              std::deque<Mail>& box = boxes[rank];
              if (box.empty()) return {};
              Mail mail = std::move(box.front());
              box.pop_front();
              return mail;
            }};
  }
};

study::Scenario half_ms() {
  study::Scenario s = current_square();
  s.duration_s = 0.5e-3;
  study::Spread spread;
  spread.key = "motor_override.inductance_mH";
  spread.relative = 0.2;
  s.spread = {spread};
  ask(s, measure(study::MetricKind::maximum, study::Signal::current));
  return s;
}

base::Result<analysis::PlannedRun> drive(const study::Scenario& s, std::uint64_t seed, std::size_t n) {
  return analysis::planned_drive(s, seed, n);
}

/// A leader and its followers (`others`). Each follower has already requested its first work from the leader.
struct Together {
  study::Scenario scenario = half_ms();
  analysis::Plan plan{.axes = {}, .drives = 60, .seed = 5};
  analysis::TableColumns columns = analysis::columns_of(plan, scenario);
  std::mutex guard{};
  std::map<std::size_t, analysis::RunRecord> rows{};
  std::size_t twice = 0;
  std::map<unsigned, std::size_t> made{};
  std::size_t begins_with = 1;  ///< number of ranks that wait for each other in their first run
  std::condition_variable begun{};
  std::map<unsigned, int> exits{};
  std::stop_source stop{};
  Post post{};
  std::function<bool(unsigned rank)> told_to_end = [](unsigned) { return false; };

  PlanRuns runs(unsigned jobs) {
    return {.plan = plan,
            .columns = columns,
            .scenario =
                [this](std::size_t n) {
                  note(0);
                  return drive(scenario, plan.seed, n);
                },
            .wanted = {},
            .take =
                [this](analysis::RunRecord&& record) {
                  const std::lock_guard lock(guard);
                  const std::size_t n = record->number;
                  twice += rows.emplace(n, std::move(record)).second ? 0 : 1;
                },
            .stop = stop.get_token(),
            .jobs = jobs};
  }
  void note(unsigned rank) {
    std::unique_lock lock(guard);
    ++made[rank];
    begun.notify_all();
    begun.wait_for(lock, std::chrono::seconds(60), [this] { return made.size() >= begins_with; });
  }
  void follow_as(unsigned rank, unsigned size) {
    Cluster cluster = post.of(rank, size);
    const Prepare prepare = [&](const std::string& made_of, const analysis::Plan& told, Ask ask) {
      EXPECT_EQ(made_of, "half a millisecond");
      return [this, rank, ask, seed = told.seed](std::size_t n) {
        note(rank);
        return drive(scenario, seed + std::stoull(ask("what to add")), n);
      };
    };
    const int exit = follow(cluster, prepare, [&] { return told_to_end(rank); });
    const std::lock_guard lock(guard);
    exits[rank] = exit;
  }
  bool lead(unsigned size, const PlanRuns& work) {
    std::vector<std::jthread> others;
    for (unsigned rank = 1; rank < size; ++rank) others.emplace_back([=, this] { follow_as(rank, size); });
    Cluster cluster = post.of(0, size);
    const auto end = [&](int exit) { dismiss(cluster, exit); };
    try {
      const bool all = lead_plan(cluster, work, {"half a millisecond", [](const std::string& question) {
                                                   EXPECT_EQ(question, "what to add");
                                                   return std::string("0");
                                                 }});
      end(7);
      return all;
    } catch (...) {
      end(4);
      throw;
    }
  }
};

TEST(Cluster, HasTheRowsOfOneProcess) {
  Together alone;
  run_plan(alone.runs(1));
  for (const auto& [size, jobs] : {std::pair{2u, 1u}, {3u, 2u}, {7u, 1u}}) {
    Together cluster;
    EXPECT_TRUE(cluster.lead(size, cluster.runs(jobs)));
    ASSERT_EQ(cluster.rows.size(), alone.rows.size());
    EXPECT_EQ(cluster.twice, 0u);
    for (const auto& [n, row] : alone.rows) {
      EXPECT_EQ(cluster.rows.at(n)->digest, row->digest);
      EXPECT_EQ(cluster.rows.at(n)->figures, row->figures);
      EXPECT_EQ(cluster.rows.at(n)->strayed, row->strayed);
    }
    EXPECT_EQ(cluster.exits.size(), size - 1);
    for (const auto& [rank, exit] : cluster.exits) EXPECT_EQ(exit, 7) << rank;
  }
}

/// No run ends before each process has begun a run. Therefore no process can do all runs.
TEST(Cluster, LetsEverybodyWork) {
  Together cluster;
  cluster.begins_with = 3;
  EXPECT_TRUE(cluster.lead(3, cluster.runs(1)));
  EXPECT_EQ(cluster.rows.size(), 60u);
  EXPECT_EQ(cluster.made.size(), 3u);
}

TEST(Cluster, MakesWhatIsWantedAlone) {
  Together cluster;
  PlanRuns runs = cluster.runs(1);
  runs.wanted = [](std::size_t n) { return n % 7 == 3; };
  EXPECT_TRUE(cluster.lead(3, runs));
  std::set<std::size_t> numbers;
  for (const auto& [n, row] : cluster.rows) numbers.insert(n);
  EXPECT_THAT(numbers, ::testing::ElementsAre(3, 10, 17, 24, 31, 38, 45, 52, 59));
}

TEST(Cluster, FillsInThePointsOfOthersRows) {
  Together cluster;
  cluster.plan.axes = {{.key = "supply.voltage_V", .values = {"12", "24", "48"}}};
  cluster.plan.drives = 20;
  cluster.columns = analysis::columns_of(cluster.plan, cluster.scenario);
  EXPECT_TRUE(cluster.lead(2, cluster.runs(1)));
  ASSERT_EQ(cluster.rows.size(), 60u);
  for (const auto& [n, row] : cluster.rows) EXPECT_EQ(row->point, analysis::point_of_run(cluster.plan, n));
}

TEST(Cluster, AStopEndsItEverywhereAndFinishedRowsStay) {
  Together cluster;
  cluster.plan.drives = 1'000'000'000;
  PlanRuns runs = cluster.runs(1);
  runs.take = [&, take = runs.take](analysis::RunRecord&& record) {
    take(std::move(record));
    const std::lock_guard lock(cluster.guard);
    if (cluster.rows.size() > 200) cluster.stop.request_stop();
  };
  EXPECT_TRUE(cluster.lead(3, runs));
  EXPECT_EQ(cluster.twice, 0u);
  EXPECT_GT(cluster.rows.size(), 200u);
  EXPECT_EQ(cluster.exits.size(), 2u);
}

TEST(Cluster, WhoIsToldToEndGivesItsRunsBack) {
  Together cluster;
  cluster.plan.drives = 1000;
  cluster.told_to_end = [&](unsigned rank) {
    const std::lock_guard lock(cluster.guard);
    return rank == 1 && cluster.made[1] >= 5;
  };
  EXPECT_TRUE(cluster.lead(3, cluster.runs(1)));
  EXPECT_EQ(cluster.rows.size(), 1000u);
  EXPECT_EQ(cluster.twice, 0u);
}

TEST(Cluster, DoesNotWaitForTheDeadOnceStopped) {
  Together cluster;
  cluster.plan.drives = 1'000'000'000;
  PlanRuns runs = cluster.runs(1);
  runs.take = [&](analysis::RunRecord&& record) {
    if (record->number > 20) cluster.stop.request_stop();
  };
  Cluster leader = cluster.post.of(0, 2);  // the second process does not exist
  EXPECT_FALSE(lead_plan(leader, runs, {"", [](const std::string&) { return std::string(); }}));
}

TEST(Cluster, AnExceptionOfWhoTakesTheRowsComesOut) {
  for (const std::size_t at : {0u, 40u}) {
    Together cluster;
    cluster.plan.drives = 1'000'000'000;
    PlanRuns runs = cluster.runs(1);
    std::atomic<std::size_t> taken{0};
    runs.take = [&](analysis::RunRecord&&) {
      if (taken++ == at) throw std::runtime_error("full disk");
    };
    EXPECT_THROW(cluster.lead(2, runs), std::runtime_error);
  }
}

/// The leader's disk is full while a run waits for the leader's answer. The answer never arrives, but the
/// follower must still end.
TEST(Cluster, ADismissalEndsARunThatWaitsForAnAnswer) {
  Together cluster;
  Cluster leader = cluster.post.of(0, 2);
  const letters::Begin begin{cluster.plan, *cluster.columns, 1, "half a millisecond"};
  leader.send(1, letters::bytes_of(begin));
  leader.send(1, letters::bytes_of(letters::Runs{{0}}));
  std::jthread follower([&] { cluster.follow_as(1, 2); });
  for (bool asked = false; !asked;) {
    const std::optional<Mail> mail = leader.receive();
    const auto letter = mail ? letters::read(mail->bytes) : std::nullopt;
    asked = letter && std::holds_alternative<letters::Question>(*letter);
  }
  leader.send(1, letters::bytes_of(letters::Dismissed{4}));
  follower.join();
  EXPECT_EQ(cluster.exits.at(1), 4);
}

/// A follower from another build sends a row with other columns. The leader discards this row.
TEST(Cluster, RowsOfOtherColumnsAreNoRows) {
  Together cluster;
  cluster.plan.drives = 1'000'000'000;
  Cluster leader = cluster.post.of(0, 2);
  analysis::RunValues row;
  row.number = 999'999'999;
  row.strayed = {0.5, 0.5, 0.5};
  row.figures.assign(cluster.columns->figures.size(), 1.0);
  cluster.post.of(1, 2).send(0, letters::bytes_of(letters::Rows{{row}}));
  EXPECT_THROW(lead_plan(leader, cluster.runs(1), {"", [](const std::string&) { return std::string(); }}),
               std::runtime_error);
  EXPECT_FALSE(cluster.rows.contains(row.number));
}

TEST(Cluster, AnotherBuildsLettersAreNoRows) {
  Together cluster;
  cluster.plan.drives = 1'000'000'000;
  Cluster leader = cluster.post.of(0, 2);
  cluster.post.of(1, 2).send(0, "gibberish");
  EXPECT_THROW(lead_plan(leader, cluster.runs(1), {"", [](const std::string&) { return std::string(); }}),
               std::runtime_error);
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace batch
