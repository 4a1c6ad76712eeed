// SPDX-License-Identifier: Apache-2.0
#include "batch/run.hpp"

#include <algorithm>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "batch/for_each.hpp"

namespace batch {
namespace {

/// Hands out the runs in rising order and puts their results back into it. The run whose turn it is has
/// always begun: whoever waits waits for a run under way.
class Order {
 public:
  explicit Order(const Runs& runs) : runs_(runs) {}

  /// The next run to begin; empty where there is none, or none is to begin any more.
  std::optional<std::size_t> next() {
    std::unique_lock lock(guard_);
    moved_.wait(lock, runs_.stop, [&] { return failed_ || next_ < taken_ + results_ahead; });
    if (failed_ || runs_.stop.stop_requested() || next_ == runs_.count) return {};
    return next_++;
  }

  void ended(std::size_t n, std::optional<RunResult> result) {
    const std::lock_guard lock(guard_);
    if (failed_) return;
    if (result) waiting_.emplace(n, std::move(*result));
    if (runs_.progress && result) runs_.progress(++done_);
    for (auto next = waiting_.begin(); next != waiting_.end() && next->first == taken_;
         next = waiting_.begin()) {
      RunResult one = std::move(next->second);
      waiting_.erase(next);
      if (runs_.take) runs_.take(taken_, std::move(one));
      ++taken_;
    }
    moved_.notify_all();
  }

  void fail() {
    const std::lock_guard lock(guard_);
    failed_ = true;
    moved_.notify_all();
  }

  std::size_t taken() const { return taken_; }

 private:
  const Runs& runs_;
  std::mutex guard_;
  std::condition_variable_any moved_;
  std::map<std::size_t, RunResult> waiting_;
  std::size_t next_ = 0, taken_ = 0, done_ = 0;
  bool failed_ = false;
};

/// Empty where the batch was stopped before the run came to its end.
std::optional<RunResult> run_one(const Runs& runs, std::size_t n) {
  study::Listeners listeners = runs.listeners ? runs.listeners(n) : study::Listeners{};
  bool cut = false;
  if (runs.stop.stop_possible())
    listeners.keep_going = [&, inner = listeners.keep_going](double t_s) {
      cut = cut || runs.stop.stop_requested();
      return !cut && (!inner || inner(t_s));
    };
  RunResult result = study::run(runs.scenario(n), listeners);
  if (cut) return {};
  return result;
}

}  // namespace

std::size_t run(const Runs& runs) {
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const std::size_t threads = std::min<std::size_t>(runs.jobs == 0 ? cores : runs.jobs, runs.count);
  Order order(runs);
  for_each(threads, static_cast<unsigned>(threads), [&](std::size_t) {
    try {
      while (const std::optional<std::size_t> n = order.next()) order.ended(*n, run_one(runs, *n));
    } catch (...) {
      order.fail();  // or those that wait for this run would wait for ever
      throw;
    }
  });
  return order.taken();
}

}  // namespace batch
