// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "batch/cluster.hpp"
#include "batch/letters.hpp"

namespace batch {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// Pause between two checks for messages, so that waiting does not occupy a core.
constexpr milliseconds pause{1};
/// Longest wait for the end of the other processes. mpirun kills processes a second after its request to end.
constexpr milliseconds patience{500};

/// The runs that remain, and the number of runs that other processes have received. Any thread may call its
/// functions.
class Handout {
 public:
  explicit Handout(const PlanRuns& runs) : runs_(runs), count_(analysis::runs_of(runs.plan)) {}

  /// Returns numbers of remaining runs for one process: `idle` runs, and up to `ahead` more within a fair
  /// share, so that all processes end at about the same time.
  std::vector<std::uint64_t> hand_out(std::uint64_t idle, std::uint64_t ahead, std::uint64_t processes) {
    const std::lock_guard lock(guard_);
    const std::uint64_t part = (count_ - cursor_ + returned_.size()) / (2 * processes);
    const std::uint64_t most = std::max(idle, std::min(idle + ahead, part));
    std::vector<std::uint64_t> numbers;
    while (numbers.size() < most)
      if (const std::optional<std::size_t> n = take())
        numbers.push_back(*n);
      else
        break;
    out_ += numbers.size();
    return numbers;
  }
  void came_back(std::size_t made, const std::vector<std::uint64_t>& unmade = {}) {
    const std::lock_guard lock(guard_);
    out_ -= made + unmade.size();
    returned_.insert(returned_.end(), unmade.begin(), unmade.end());
    moved_.notify_all();
  }
  /// Returns a run for the leader's threads. Waits while other processes have runs, because a run may be
  /// returned.
  std::optional<std::size_t> next() {
    std::unique_lock lock(guard_);
    while (!over_ && !runs_.stop.stop_requested()) {
      if (const std::optional<std::size_t> n = take()) return n;
      if (out_ == 0) break;
      moved_.wait_for(lock, milliseconds(20));
    }
    moved_.notify_all();
    return {};
  }
  void give_up() {
    const std::lock_guard lock(guard_);
    over_ = true;
    moved_.notify_all();
  }

 private:
  std::optional<std::size_t> take() {
    if (!returned_.empty()) {
      const std::size_t n = returned_.back();
      returned_.pop_back();
      return n;
    }
    while (cursor_ < count_)
      if (const std::size_t n = cursor_++; !runs_.wanted || runs_.wanted(n)) return n;
    return {};
  }

  const PlanRuns& runs_;
  const std::size_t count_;
  std::mutex guard_;
  std::condition_variable moved_;
  std::size_t cursor_ = 0, out_ = 0;
  std::vector<std::uint64_t> returned_;
  bool over_ = false;
};

/// The leader's threads. The destructor ends and joins them, also if another part of the leader's work fails.
class Crew {
 public:
  Crew(const PlanRuns& runs, Handout& handout) : handout_(handout), thread_([this, runs] { work(runs); }) {}
  ~Crew() { handout_.give_up(); }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  bool done() const { return done_; }
  void complain() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void work(PlanRuns runs) {
    runs.take = [this, take = std::move(runs.take)](analysis::RunRecord&& record) {
      try {
        take(std::move(record));
      } catch (...) {
        handout_.give_up();
        throw;
      }
    };
    try {
      make_runs(runs, std::max(1U, runs.jobs), [this] { return handout_.next(); });
    } catch (...) {
      error_ = std::current_exception();
    }
    done_ = true;
  }

  Handout& handout_;
  std::exception_ptr error_;
  std::atomic<bool> done_{false};
  std::jthread thread_;  // last member, because the thread uses the other members
};

class Leader {
 public:
  Leader(Cluster& cluster, const PlanRuns& runs, const Briefing& briefing)
      : cluster_(cluster), runs_(runs), briefing_(briefing), handout_(runs) {}

  bool lead() {
    tell_all(letters::Begin{runs_.plan, *runs_.columns, std::max(1U, runs_.jobs), briefing_.made_of});
    Crew crew(runs_, handout_);
    while (!crew.done()) {
      if (!take_letters()) std::this_thread::sleep_for(pause);
      feed();
    }
    const bool all = farewell();
    crew.complain();
    return all;
  }

 private:
  static std::runtime_error another_build() {
    return std::runtime_error(
        "other nodes run another build of sixstep; install the same build on all nodes");
  }
  void tell_all(const letters::Letter& letter) {
    const std::string bytes = letters::bytes_of(letter);
    for (unsigned rank = 1; rank < cluster_.size; ++rank) cluster_.send(rank, bytes);
  }

  bool take_letters() {
    bool some = false;
    while (std::optional<Mail> mail = cluster_.receive()) {
      std::optional<letters::Letter> letter = letters::read(mail->bytes);
      if (!letter) throw another_build();
      std::visit([&](auto& content) { take(mail->from, content); }, *letter);
      some = true;
    }
    return some;
  }

  void take(unsigned, letters::Rows& rows) {
    for (analysis::RunValues& row : rows.rows) {
      row.point = analysis::point_of_run(runs_.plan, row.number);
      base::Result<analysis::RunRecord> record = analysis::RunRecord::of(runs_.columns, std::move(row));
      if (!record) throw another_build();
      runs_.take(std::move(*record));
    }
    handout_.came_back(rows.rows.size());
  }
  void take(unsigned from, letters::Hungry& hungry) { hungry_[from] = hungry; }
  void take(unsigned from, letters::Question& question) {
    cluster_.send(from,
                  letters::bytes_of(letters::Answer{question.number, briefing_.answer(question.bytes)}));
  }
  void take(unsigned from, letters::Gone& gone) {
    gone_[from] = true;
    hungry_.erase(from);
    handout_.came_back(0, gone.unmade);
  }
  template <class Other>
  void take(unsigned, Other&) {}  // a process never sends the leader a message of the leader's kinds

  /// Sends runs to the processes that have requested runs. A process for which no run remains stays in
  /// hungry_, because a run may be returned.
  void feed() {
    for (auto one = hungry_.begin(); one != hungry_.end();) {
      const auto& [rank, hunger] = *one;
      letters::Runs runs{handout_.hand_out(hunger.idle, hunger.ahead, cluster_.size)};
      if (runs.numbers.empty()) return;
      cluster_.send(rank, letters::bytes_of(runs));
      one = hungry_.erase(one);
    }
  }

  bool farewell() {
    tell_all(letters::End{});
    std::optional<steady_clock::time_point> deadline;
    while (gone_.size() + 1 < cluster_.size) {
      if (take_letters()) continue;
      if (runs_.stop.stop_requested() && !deadline) deadline = steady_clock::now() + patience;
      if (deadline && steady_clock::now() > *deadline) return false;
      std::this_thread::sleep_for(pause);
    }
    return true;
  }

  Cluster& cluster_;
  const PlanRuns& runs_;
  const Briefing& briefing_;
  Handout handout_;
  std::map<unsigned, letters::Hungry> hungry_;
  std::map<unsigned, bool> gone_;
};

}  // namespace

bool lead_plan(Cluster& cluster, const PlanRuns& runs, const Briefing& briefing) {
  return Leader(cluster, runs, briefing).lead();
}

void dismiss(Cluster& cluster, int exit) {
  const std::string bytes = letters::bytes_of(letters::Dismissed{static_cast<std::uint64_t>(exit)});
  for (unsigned rank = 1; rank < cluster.size; ++rank) cluster.send(rank, bytes);
}

}  // namespace batch
