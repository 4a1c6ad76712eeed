// SPDX-License-Identifier: Apache-2.0
// One line on the error stream while work goes on: a bar, what is done, how fast, and how long it will take.
#pragma once
#include <atomic>
#include <chrono>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

namespace cli {

/// What there is to do: runs with their simulated time, or pieces that are all alike.
struct Work {
  std::vector<double> seconds;
  std::size_t pieces = 0;
  const char* of = "drives";  ///< what the pieces are
  std::size_t before = 0;     ///< pieces that were done when the work began
};

/// Shows itself on a terminal alone, and not before half a second has gone; it leaves nothing behind.
class Progress {
 public:
  Progress(Work work, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // From any thread.
  void reached(std::size_t run, double t_s) { at_s_[run].store(t_s, std::memory_order_relaxed); }
  void finished(std::size_t run);
  void pieces_done(std::size_t count) { pieces_.store(count, std::memory_order_relaxed); }

 private:
  std::string line(std::size_t width) const;

  Work work_;
  std::vector<std::atomic<double>> at_s_;
  std::atomic<std::size_t> runs_{0}, pieces_{0};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::jthread drawer_;
};

}  // namespace cli
