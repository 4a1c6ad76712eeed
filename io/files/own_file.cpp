// SPDX-License-Identifier: Apache-2.0
#include "io/files/own_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace io {
namespace {

/// How a format begins, and what stands before the version; the second may follow a little later.
struct Mark {
  std::string_view begin, name;
};
constexpr Mark marks[] = {{"", "# sixstep "},  // CSV
                          {"", "# Made by sixstep "},
                          {"// ", "// Made by sixstep "},
                          {"", "$version sixstep "},
                          {"", "MATLAB 5.0 MAT-file, sixstep "},
                          {"", "MATLAB 7.3 MAT-file, sixstep "},
                          {"", "{\n  \"sixstep\": \""},
                          {"<!doctype html>", "<meta name=\"generator\" content=\"sixstep "}};

bool begins_as(const Mark& mark, std::string_view text) {
  if (!text.starts_with(mark.begin)) return false;
  const std::size_t at = mark.begin.empty() ? 0 : text.find(mark.name);
  if (at == text.npos || text.substr(at, mark.name.size()) != mark.name) return false;
  const std::string_view version = text.substr(at + mark.name.size());
  return !version.empty() && version.front() >= '0' && version.front() <= '9';
}

}  // namespace

bool is_foreign(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code failed;
  if (!fs::is_regular_file(path, failed) || fs::file_size(path, failed) == 0) return false;
  constexpr std::size_t looked_at = 512;
  char bytes[looked_at];
  std::ifstream file(path, std::ios::binary);
  file.read(bytes, looked_at);
  const std::string_view text(bytes, static_cast<std::size_t>(file.gcount()));
  return std::ranges::none_of(marks, [&](const Mark& mark) { return begins_as(mark, text); });
}

}  // namespace io
