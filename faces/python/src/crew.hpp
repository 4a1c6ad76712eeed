// SPDX-License-Identifier: Apache-2.0
// Threads that share many small, equal calls.
#pragma once
#include <unistd.h>

#include <atomic>
#include <barrier>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

namespace python {

class Crew {
 public:
  /// `workers`: number of threads including the calling thread, at least 1.
  explicit Crew(std::size_t workers) : gate_(static_cast<std::ptrdiff_t>(workers)) {
    for (std::size_t n = 1; n < workers; ++n) threads_.emplace_back([this] { serve(); });
  }
  ~Crew() {
    if (threads_.empty()) return;
    if (!has_threads()) {  // after a fork the threads do not exist, and joining them would block
      for (std::thread& thread : threads_) thread.detach();
      return;
    }
    work_ = nullptr;
    gate_.arrive_and_wait();
    for (std::thread& thread : threads_) thread.join();
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  /// Whether the threads exist in this process. They do not exist in a forked process, because a fork does
  /// not copy threads.
  bool has_threads() const { return ::getpid() == process_; }

  /// Calls work(n) for each n < count, in any order, and returns after all calls have returned.
  void each(std::size_t count, const std::function<void(std::size_t)>& work) {
    work_ = &work;
    count_ = count;
    next_ = 0;
    if (!threads_.empty()) gate_.arrive_and_wait();
    take();
    if (!threads_.empty()) gate_.arrive_and_wait();
  }

 private:
  static constexpr std::size_t at_once = 4;  // number of adjacent calls that a thread makes at a time, to
                                             // reduce accesses to next_

  void take() {
    for (std::size_t from = next_.fetch_add(at_once); from < count_; from = next_.fetch_add(at_once))
      for (std::size_t n = from; n < from + at_once && n < count_; ++n) (*work_)(n);
  }
  void serve() {
    for (;;) {
      gate_.arrive_and_wait();
      if (work_ == nullptr) return;
      take();
      gate_.arrive_and_wait();
    }
  }

  pid_t process_ = ::getpid();
  std::barrier<> gate_;
  const std::function<void(std::size_t)>* work_ = nullptr;
  std::size_t count_ = 0;
  std::atomic<std::size_t> next_ = 0;
  std::vector<std::thread> threads_;
};

}  // namespace python
