// SPDX-License-Identifier: Apache-2.0
#include "faces/loop/installed.hpp"

#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace loop {

namespace {

namespace fs = std::filesystem;

/// The folder of the running program; empty if /proc is not available.
fs::path program_folder() {
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  return failed ? fs::path() : program.parent_path();
}

}  // namespace

fs::path sources_folder() {
  if (const char* const said = std::getenv("SIXSTEP_SOURCES"); said != nullptr) return said;
  const fs::path folder = program_folder();
  if (folder.empty()) return {};
  // A build folder contains a file with the path of the sources, so that the program contains no path of the
  // machine that built it.
  if (std::ifstream noted(folder / "sixstep-sources"); noted) {
    std::string root;
    std::getline(noted, root);
    return root;
  }
  return folder.parent_path() / "share/sixstep";
}

std::string avr_board_program() {
  std::string name = "sixstep-avr-board";
  const fs::path folder = program_folder();
  if (folder.empty()) return name;
  for (const fs::path& file : {folder / name, folder.parent_path() / "libexec/sixstep" / name})
    if (::access(file.c_str(), X_OK) == 0) return file.string();
  return name;
}

std::string unit_binary(int fmi) {
  const std::string name = "sixstep-fmi" + std::to_string(fmi) + ".so";
  const fs::path folder = program_folder();
  if (folder.empty()) return {};
  for (const fs::path& file : {folder / name, folder.parent_path() / "lib/sixstep" / name})
    if (::access(file.c_str(), R_OK) == 0) return file.string();
  return {};
}

}  // namespace loop
