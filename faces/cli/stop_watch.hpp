// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <stop_token>
#include <thread>

namespace cli {

/// Stops the running simulations after Ctrl-C, or when `also` returns true. A signal handler can only set a
/// flag, so a thread polls the flag and `also`.
class StopWatch {
 public:
  explicit StopWatch(std::function<bool()> also = [] { return false; });
  std::stop_token token() const { return stop_.get_token(); }

 private:
  std::stop_source stop_;
  std::jthread watch_;
};

}  // namespace cli
