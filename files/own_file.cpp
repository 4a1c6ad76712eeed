// SPDX-License-Identifier: Apache-2.0
#include "files/own_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "files/text_file.hpp"
#include "sixstep/base/written.hpp"
#include "text/escape/escape.hpp"

namespace files {
namespace {

/// The first characters of a file format, and the text before the version. A few other bytes may be between
/// them.
struct Mark {
  std::string_view begin, name;
};
constexpr Mark marks[] = {{"", "# sixstep "},  // the format CSV
                          {"// ", "// Made by sixstep "},
                          {"", "$version sixstep "},
                          {"", "MATLAB 5.0 MAT-file, sixstep "},
                          {"", "MATLAB 7.3 MAT-file, sixstep "},
                          {"", "{\n  \"sixstep\": \""},
                          {"<?xml ", "<testsuites name=\"sixstep "},
                          {"<svg ", "<desc>Made by sixstep "},
                          {"PK", "generationTool=\"sixstep "},
                          {"<!doctype html>", "<meta name=\"generator\" content=\"sixstep "}};

bool begins_as(const Mark& mark, std::string_view text) {
  if (!text.starts_with(mark.begin)) return false;
  const std::size_t at = mark.begin.empty() ? 0 : text.find(mark.name);
  if (at == text.npos || text.substr(at, mark.name.size()) != mark.name) return false;
  const std::string_view version = text.substr(at + mark.name.size());
  return !version.empty() && version.front() >= '0' && version.front() <= '9';
}

constexpr Mark text_mark{"", "# Made by sixstep "};

std::string digest_words(std::string_view text) {
  return fmt::format(", digest {}: ", base::written_hex(text_digest(std::string(text))));
}

/// Whether the digest in the first line is the digest of the text after it.
bool is_unchanged(std::string_view text) {
  const std::size_t end = std::min(text.find('\n'), text.size() - 1);
  return text.substr(0, end).find(digest_words(text.substr(end + 1))) != text.npos;
}

}  // namespace

std::string with_own_mark(std::string_view command, const std::string& text) {
  return fmt::format("{}" SIXSTEP_VERSION "{}{}\n{}", text_mark.name, digest_words(text),
                     text::visible(command), text);
}

std::string csv_head(std::string_view command) {
  return fmt::format("# sixstep " SIXSTEP_VERSION "\n# command: {}\n", text::visible(command));
}

bool is_foreign(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code failed;
  if (!fs::is_regular_file(path, failed) || fs::file_size(path, failed) == 0) return false;
  constexpr std::size_t looked_at = 512;
  char bytes[looked_at];
  std::ifstream file(path, std::ios::binary);
  file.read(bytes, looked_at);
  const std::string_view text(bytes, static_cast<std::size_t>(file.gcount()));
  if (begins_as(text_mark, text)) {
    std::string whole(text);
    whole.append(std::istreambuf_iterator<char>(file.rdbuf()), {});
    return !is_unchanged(whole);
  }
  return std::ranges::none_of(marks, [&](const Mark& mark) { return begins_as(mark, text); });
}

}  // namespace files
