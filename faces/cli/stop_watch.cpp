// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/stop_watch.hpp"

#include <chrono>
#include <utility>

#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"

namespace cli {

StopWatch::StopWatch(std::function<bool()> also)
    : watch_([this, also = std::move(also)](const std::stop_token& done) {
        while (!done.stop_requested()) {
          if (interrupted() || also()) stop_.request_stop();
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
      }) {}

}  // namespace cli
