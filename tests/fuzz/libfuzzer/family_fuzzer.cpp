// SPDX-License-Identifier: Apache-2.0
// Fuzzes the scenario reader with a whole folder: x.toml and the files that it may name, which are base.toml,
// own.toml (a motor) and rows.csv. One input contains all files, separated by lines "#### NAME". x.toml is
// the text before the first separator.
#include <stdlib.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>

#include "files/scenario_on_disk.hpp"
#include "tests/fuzz/libfuzzer/complaints.hpp"

namespace {

namespace fs = std::filesystem;

/// The folder is created once and never removed, because the fuzzer may end at any instant. If the system has
/// a folder in memory, it is created there.
const fs::path& folder() {
  static const fs::path made = [] {
    std::error_code none;
    const fs::path memory = "/dev/shm";
    std::string name =
        ((fs::exists(memory, none) ? memory : fs::temp_directory_path()) / "family.XXXXXX").string();
    if (!::mkdtemp(name.data())) std::abort();
    return fs::path(name);
  }();
  return made;
}

std::map<std::string, std::string> parted(std::string text) {
  std::map<std::string, std::string> files{
      {"x.toml", ""}, {"base.toml", ""}, {"own.toml", ""}, {"rows.csv", ""}};
  std::string* into = &files["x.toml"];
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string line = text.substr(at, end - at);
    const std::string name = line.starts_with("#### ") ? line.substr(5, line.size() - 6) : "";
    if (const auto file = files.find(name); file != files.end())
      into = &file->second;
    else
      *into += line;
    at = end;
  }
  return files;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const auto& [name, text] : parted(std::string(reinterpret_cast<const char*>(data), size)))
    std::ofstream(folder() / name, std::ios::binary) << text;
  const auto scenario = files::read_scenario((folder() / "x.toml").string());
  if (scenario)
    fuzzing::must_compile(*scenario);
  else
    fuzzing::must_say_something(scenario.problems());
  return 0;
}
