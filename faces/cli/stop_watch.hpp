// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <stop_token>
#include <thread>

namespace cli {

/// Carries Ctrl-C, of which a signal handler may only leave a note, and what `also` tells to the runs under way.
class StopWatch {
 public:
  explicit StopWatch(std::function<bool()> also = [] { return false; });
  std::stop_token token() const { return stop_.get_token(); }

 private:
  std::stop_source stop_;
  std::jthread watch_;
};

}  // namespace cli
