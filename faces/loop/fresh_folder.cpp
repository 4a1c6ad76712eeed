// SPDX-License-Identifier: Apache-2.0
#include "faces/loop/fresh_folder.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <random>

namespace loop {

namespace {

/// The shell removes the folder repeatedly, because a killed compiler may leave a child process that still
/// writes into the folder.
constexpr const char* waits_and_cleans =
    R"(PATH=/usr/bin:/bin; read -r _; n=0; while [ -e "$0" ] && [ $n -lt 200 ]; do rm -rf -- "$0" 2>/dev/null; n=$((n+1)); [ ! -e "$0" ] || sleep 0.1; done)";

std::string fresh_name() {
  static constexpr char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  std::string name = "sixstep-";
  for (int n = 0; n < 12; ++n) name += letters[random() % (sizeof letters - 1)];
  return name;
}

}  // namespace

base::Result<FreshFolder> FreshFolder::make() {
  std::error_code none;
  const std::string path = (std::filesystem::temp_directory_path(none) / fresh_name()).string();
  Pipe life = made_pipe();
  // The shell that removes the folder starts before the folder exists, so that the folder is removed in every
  // case.
  base::Result<Child> cleaner = Child::start({.words = {"/bin/sh", "-c", waits_and_cleans, path},
                                              .given = {{life.read.number(), 0}},
                                              .temporary = {},
                                              .outlives = true});
  if (!cleaner) return cleaner.problems();
  if (::mkdir(path.c_str(), 0700) != 0)
    return base::Problem{path, "", std::string("cannot be made: ") + std::strerror(errno),
                         "set TMPDIR to a folder in which you may write"};
  return FreshFolder(path, std::move(*cleaner), std::move(life.write));
}

FreshFolder::~FreshFolder() {
  if (!held_) return;
  held_.close();
  cleaner_.wait();
}

}  // namespace loop
