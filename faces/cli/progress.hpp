// SPDX-License-Identifier: Apache-2.0
// Shows one line on standard error during the work: a bar, the finished part, the speed and the remaining time.
#pragma once
#include <atomic>
#include <chrono>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

namespace cli {

/// The work whose progress is shown: runs with their simulated time, or equal pieces.
struct Work {
  std::vector<double> seconds;
  std::size_t pieces = 0;
  const char* of = "drives";  ///< name of the pieces
  std::size_t before = 0;     ///< number of pieces that were finished before the work began
};

/// Shows the line only on a terminal and after half a second, and removes it at the end.
class Progress {
 public:
  Progress(Work work, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // May be called from any thread.
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
