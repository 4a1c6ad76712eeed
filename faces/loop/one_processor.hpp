// SPDX-License-Identifier: Apache-2.0
// Keeps a thread and the processes that it starts on one processor. Two programs that wait for each other
// never run at the same time, and waking a sleeping processor takes longer than a task switch
// (loop_benchmark: twice as many calls per second).
#pragma once
#include <sched.h>

#include <atomic>

namespace loop {

class OneProcessor {
 public:
  /// Selects the next processor among those that the thread may use.
  OneProcessor() {
    static std::atomic<unsigned> turn{0};
    if (::sched_getaffinity(0, sizeof before_, &before_) != 0) return;
    unsigned skip = turn++ % static_cast<unsigned>(CPU_COUNT(&before_));
    for (int n = 0; n < CPU_SETSIZE; ++n) {
      if (!CPU_ISSET(n, &before_) || skip-- > 0) continue;
      cpu_set_t one;
      CPU_ZERO(&one);
      CPU_SET(n, &one);
      kept_ = ::sched_setaffinity(0, sizeof one, &one) == 0;
      return;
    }
  }
  OneProcessor(const OneProcessor&) = delete;
  OneProcessor& operator=(const OneProcessor&) = delete;
  /// Must be destroyed in the thread that constructed it.
  ~OneProcessor() {
    if (kept_) ::sched_setaffinity(0, sizeof before_, &before_);
  }

 private:
  cpu_set_t before_{};
  bool kept_ = false;
};

}  // namespace loop
