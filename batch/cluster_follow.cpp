// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "batch/cluster.hpp"
#include "batch/letters.hpp"

namespace batch {
namespace {

using std::chrono::duration;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// Pause between two checks for messages, so that waiting does not occupy a core.
constexpr milliseconds follower_pause{2};
/// Time between two messages with rows. If the process is killed, the rows since its last message are lost.
constexpr milliseconds rows_every{50};
/// Runs kept in reserve, as seconds of work at the rate since the last request. Longer runs are requested one
/// by one.
constexpr double ahead_s = 0.25;
constexpr double most_ahead = 4096;

letters::Letter letter_of(const Mail& mail) {
  std::optional<letters::Letter> letter = letters::read(mail.bytes);
  if (!letter)
    throw std::runtime_error(
        "the first process runs another build of sixstep; install the same build on all nodes");
  return std::move(*letter);
}

/// Thrown if the plan ends before a question is answered: the leader may have ended, and the run is no longer
/// needed.
struct PlanEnded {};

/// Executes one plan's runs on `jobs` threads; the calling thread exchanges messages with the leader.
class Hand {
 public:
  Hand(Cluster& cluster, const letters::Begin& begin) : cluster_(cluster), begin_(begin) {}

  std::string ask(std::string question) {
    std::unique_lock lock(guard_);
    const std::uint64_t number = asked_++;
    questions_.push_back({number, std::move(question)});
    moved_.notify_all();
    moved_.wait(lock, [&] { return over_ || answers_.contains(number); });
    if (!answers_.contains(number)) throw PlanEnded{};
    return answers_.extract(number).mapped();
  }

  /// Executes the plan's runs and exchanges messages with the leader until the plan ends. Returns the
  /// leader's exit code if the leader dismissed this process during the plan; else empty.
  std::optional<int> work(const Prepare& prepare, const std::function<bool()>& told_to_end) {
    PlanRuns runs{.plan = begin_.plan,
                  .columns = std::make_shared<const analysis::PlanColumns>(begin_.columns),
                  .scenario = prepare(begin_.made_of, begin_.plan,
                                      [this](std::string question) { return ask(std::move(question)); }),
                  .wanted = {},
                  .take = [this](analysis::RunRecord&& record) { keep(std::move(record)); },
                  .stop = stop_.get_token(),
                  .jobs = static_cast<unsigned>(begin_.jobs)};
    std::atomic<bool> done{false};
    std::exception_ptr error;
    const std::jthread crew([&] {
      try {
        make_runs(runs, runs.jobs, [this] { return next(); });
      } catch (const PlanEnded&) {
        // Rows of runs in progress are not sent; `open_` lists these runs.
      } catch (...) {
        error = std::current_exception();
      }
      done = true;
    });
    while (!done) {
      while (const std::optional<Mail> mail = cluster_.receive()) take(letter_of(*mail));
      if (told_to_end()) end();
      speak();
    }
    if (error) std::rethrow_exception(error);
    const std::lock_guard lock(guard_);
    send_rows();
    send(letters::Gone{{open_.begin(), open_.end()}});
    return dismissed_;
  }

 private:
  // Functions for the threads that make runs:

  std::optional<std::size_t> next() {
    std::unique_lock lock(guard_);
    ++idle_;
    moved_.notify_all();
    work_came_.wait(lock, [&] { return over_ || !ready_.empty(); });
    --idle_;
    if (over_) return {};
    const std::size_t n = ready_.front();
    ready_.pop_front();
    return n;
  }

  void keep(analysis::RunRecord&& record) {
    const std::lock_guard lock(guard_);
    open_.erase(record->number);
    rows_.push_back(*record);
    ++made_;
  }

  // Functions for the thread that exchanges messages:

  void take(const letters::Letter& letter) {
    const std::lock_guard lock(guard_);
    if (const auto* runs = std::get_if<letters::Runs>(&letter)) {
      ready_.insert(ready_.end(), runs->numbers.begin(), runs->numbers.end());
      open_.insert(runs->numbers.begin(), runs->numbers.end());
      hungry_ = false;
      work_came_.notify_all();
    } else if (const auto* answer = std::get_if<letters::Answer>(&letter)) {
      answers_[answer->to] = answer->bytes;
      moved_.notify_all();
    } else if (const auto* dismissed = std::get_if<letters::Dismissed>(&letter)) {
      dismissed_ = static_cast<int>(dismissed->exit);
      stop_all();
    } else if (std::holds_alternative<letters::End>(letter)) {
      stop_all();
    }
  }

  void end() {
    const std::lock_guard lock(guard_);
    stop_all();
  }
  void stop_all() {
    over_ = true;
    stop_.request_stop();
    work_came_.notify_all();
    moved_.notify_all();
  }

  /// Sends the pending messages, then pauses.
  void speak() {
    std::unique_lock lock(guard_);
    for (const letters::Question& question : std::exchange(questions_, {})) send(question);
    if (steady_clock::now() - rows_sent_ >= rows_every) send_rows();
    if (!hungry_ && !over_) ask_for_work();
    moved_.wait_for(lock, follower_pause);
  }

  void send_rows() {
    if (rows_.empty()) return;
    send(letters::Rows{std::exchange(rows_, {})});
    rows_sent_ = steady_clock::now();
  }

  void ask_for_work() {
    const auto now = steady_clock::now();
    const double pace = static_cast<double>(made_) / duration<double>(now - asked_at_).count();
    const auto ahead = static_cast<std::size_t>(std::min(pace * ahead_s, most_ahead));
    if (idle_ == 0 && ready_.size() * 2 >= ahead) return;
    if (idle_ == 0 && ahead == 0) return;
    hungry_ = true;
    send(letters::Hungry{idle_, ahead - std::min(ahead, ready_.size())});
    made_ = 0;
    asked_at_ = now;
  }

  void send(const letters::Letter& letter) { cluster_.send(0, letters::bytes_of(letter)); }

  Cluster& cluster_;
  const letters::Begin& begin_;
  std::stop_source stop_;
  std::mutex guard_;
  std::condition_variable moved_, work_came_;
  std::deque<std::uint64_t> ready_;
  std::set<std::uint64_t> open_;  ///< received runs that have no row yet
  std::vector<analysis::RunValues> rows_;
  std::vector<letters::Question> questions_;
  std::map<std::uint64_t, std::string> answers_;
  std::uint64_t asked_ = 0, made_ = 0, idle_ = 0;
  bool hungry_ = false, over_ = false;
  std::optional<int> dismissed_;
  steady_clock::time_point asked_at_ = steady_clock::now(), rows_sent_{};
};

}  // namespace

int follow(Cluster& cluster, const Prepare& prepare, const std::function<bool()>& told_to_end) {
  for (;;) {
    const std::optional<Mail> mail = cluster.receive();
    if (!mail) {
      std::this_thread::sleep_for(follower_pause);
      continue;
    }
    const letters::Letter letter = letter_of(*mail);
    if (const auto* dismissed = std::get_if<letters::Dismissed>(&letter))
      return static_cast<int>(dismissed->exit);
    if (const auto* begin = std::get_if<letters::Begin>(&letter)) {
      if (const std::optional<int> exit = Hand(cluster, *begin).work(prepare, told_to_end)) return *exit;
    } else if (const auto* runs = std::get_if<letters::Runs>(&letter))
      // The leader sent these numbers before it received the notice that this process has left the plan. They
      // are returned.
      cluster.send(0, letters::bytes_of(letters::Gone{runs->numbers}));
  }
}

}  // namespace batch
