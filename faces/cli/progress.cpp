// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <numeric>

#include "faces/cli/terminal.hpp"

namespace cli {
namespace {

using std::chrono::duration;
using std::chrono::milliseconds;

constexpr milliseconds first_after{500}, then_every{100};
constexpr std::size_t longest_bar = 30;

/// A duration as text: "0:05", "12:40", "3:00:12".
std::string clock_text(double seconds) {
  constexpr double most = 359'999;
  const auto s = static_cast<long>(std::clamp(seconds + 0.5, 0.0, most));
  if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

std::string bar(double fraction, std::size_t width) {
  const auto full = static_cast<std::size_t>(fraction * static_cast<double>(width));
  return fmt::format("[{:-<{}}] ", std::string(full, '#'), width);
}

}  // namespace

Progress::Progress(Work work, bool quiet) : work_(std::move(work)), at_s_(work_.seconds.size()) {
  pieces_ = work_.before;
  if (quiet || terminal_width(stderr) == 0) return;
  drawer_ = std::jthread([this](const std::stop_token& stop) {
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any wake;
    bool drawn = false;
    for (milliseconds wait = first_after;; wait = then_every) {
      wake.wait_for(lock, stop, wait, [] { return false; });
      if (stop.stop_requested()) break;
      print(fmt::format("\r{}\x1b[K", line(terminal_width(stderr))), stderr);
      drawn = true;
    }
    if (drawn) print("\r\x1b[K", stderr);
  });
}

Progress::~Progress() = default;  // the thread ends here and clears its line

void Progress::finished(std::size_t run) {
  reached(run, work_.seconds[run]);
  runs_.fetch_add(1, std::memory_order_relaxed);
}

std::string Progress::line(std::size_t width) const {
  const double elapsed = duration<double>(std::chrono::steady_clock::now() - start_).count();
  double done = 0.0, total = 0.0;
  std::string what;
  if (work_.pieces > 0) {
    const std::size_t pieces = pieces_.load(std::memory_order_relaxed);
    done = static_cast<double>(pieces);
    total = static_cast<double>(work_.pieces);
    what = fmt::format("{} of {} {}", pieces, work_.pieces, work_.of);
  } else {
    for (const std::atomic<double>& t : at_s_) done += t.load(std::memory_order_relaxed);
    total = std::accumulate(work_.seconds.begin(), work_.seconds.end(), 0.0);
    if (work_.seconds.size() > 1)
      what = fmt::format("{} of {} runs  ", runs_.load(std::memory_order_relaxed), work_.seconds.size());
    what += fmt::format("{:.3g} of {:.3g} s simulated  {:.3g} x real time", done, total, done / elapsed);
  }
  const auto before = static_cast<double>(work_.before);
  const double fraction = total > 0 ? std::clamp(done / total, 0.0, 1.0) : 0.0;
  std::string text = fmt::format("{:3.0f} %  ", 100 * fraction);
  if (done > before) text += clock_text(elapsed * (total - done) / (done - before)) + " left  ";
  text += what;
  // The last column stays empty, because a terminal would otherwise begin the next line. The bar's length is
  // a multiple of ten, which avoids flicker.
  const std::size_t room = width > text.size() + 4 ? (width - text.size() - 4) / 10 * 10 : 0;
  if (room > 0) text = bar(fraction, std::min(room, longest_bar)) + text;
  return text.substr(0, width - 1);
}

}  // namespace cli
