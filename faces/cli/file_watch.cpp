// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/file_watch.hpp"

#include <sys/stat.h>

#include <chrono>
#include <thread>

#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"

namespace cli {

FileWatch::FileWatch(std::vector<std::string> paths) : paths_(std::move(paths)), seen_(look()) {}

std::vector<FileWatch::Stamp> FileWatch::look() const {
  std::vector<Stamp> stamps;
  for (const std::string& path : paths_) {
    Stamp stamp;
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0)
      stamp = {status.st_mtim.tv_sec * 1'000'000'000LL + status.st_mtim.tv_nsec, status.st_size,
               status.st_ino};
    stamps.push_back(stamp);
  }
  return stamps;
}

bool FileWatch::wait_for_a_change() const {
  constexpr std::chrono::milliseconds pause{100};
  std::vector<Stamp> before = seen_;
  while (!interrupted()) {
    std::this_thread::sleep_for(pause);
    std::vector<Stamp> now = look();
    if (now != seen_ && now == before) return true;  // the file has stopped changing
    before = std::move(now);
  }
  return false;
}

}  // namespace cli
