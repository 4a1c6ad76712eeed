// SPDX-License-Identifier: Apache-2.0
#include "files/text_file.hpp"

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

#include "sixstep/base/hash.hpp"
#include "text/keys/key_advice.hpp"

namespace files {
namespace {

/// The existing file in the same folder that the user probably meant, if the name is misspelt or lacks .toml.
std::string meant(const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(path).parent_path();
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, error))
    if (entry.is_regular_file(error)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  const std::string name = fs::path(path).filename().string();
  if (std::find(names.begin(), names.end(), name + ".toml") != names.end()) return path + ".toml";
  const std::string near = text::nearest(name, names);
  return near.empty() ? "" : (folder / near).string();
}

base::Problem unreadable(const std::string& path, int reason) {
  if (path == "-") return {"-:", "", "is not a file", "to read from a pipe, name /dev/stdin"};
  const std::string near = reason == ENOENT ? meant(path) : "";
  return {.where = path + ":",
          .limit = std::string("cannot be read: ") + std::strerror(reason),
          .cure = reason == EISDIR ? "name a file in this folder"
                  : near.empty()   ? "check the path and your permission to read the file"
                                   : "did you mean " + near + "?"};
}

constexpr std::size_t most_bytes = std::size_t{128} << 20;  // largest size of a file; a file such as
                                                            // /dev/zero never ends

base::Problem too_large(const std::string& path) {
  return {.where = path + ":",
          .limit = "cannot be read: it is larger than 128 MiB",
          .cure = "name a smaller file"};
}

/// The content of a text packed by gzip; a few packed bytes may become gigabytes.
base::Result<std::string> unpacked(const std::string& path, const std::string& packed) {
  z_stream stream{};
  constexpr int gzip = 15 + 16;
  if (inflateInit2(&stream, gzip) != Z_OK) return too_large(path);
  // zlib's interface lacks const.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string text;
  char block[1 << 14];
  int state = Z_OK;
  while (state == Z_OK && text.size() <= most_bytes) {
    stream.next_out = reinterpret_cast<Bytef*>(block);
    stream.avail_out = sizeof block;
    state = inflate(&stream, Z_NO_FLUSH);
    text.append(block, sizeof block - stream.avail_out);
  }
  inflateEnd(&stream);
  if (text.size() > most_bytes) return too_large(path);
  if (state == Z_STREAM_END) return text;
  return base::Problem{.where = path + ":",
                       .limit = "cannot be read: it is packed by gzip, and damaged or incomplete",
                       .cure = "pack it again"};
}

thread_local ReadLog* log_in_use = nullptr;

}  // namespace

ReadLog::ReadLog() : digest_(base::Hash().value()), outer_(log_in_use) { log_in_use = this; }
ReadLog::~ReadLog() {
  log_in_use = outer_;
  if (outer_) outer_->paths_.insert(outer_->paths_.end(), paths_.begin(), paths_.end());
}

bool ReadLog::has(const std::string& path) {
  std::error_code none;
  for (const ReadLog* log = log_in_use; log; log = log->outer_)
    if (std::ranges::any_of(log->paths_, [&](const std::string& read) {
          return std::filesystem::equivalent(read, path, none);
        }))
      return true;
  return false;
}

void ReadLog::note(const std::string& path, const std::string& text) {
  if (paths_.empty()) first_text_ = text;
  paths_.push_back(path);
  digest_ = text_digest(text, digest_);
}

std::uint64_t text_digest(const std::string& text, std::uint64_t before) {
  base::Hash hash;
  hash.word(before);
  hash.word(text.size());  // with the length, two texts never have the digest of one text with the same
                           // characters
  for (std::size_t at = 0; at < text.size(); at += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    for (std::size_t n = at; n < text.size() && n < at + sizeof word; ++n)
      word |= std::uint64_t{static_cast<unsigned char>(text[n])} << 8 * (n - at);
    hash.word(word);
  }
  return hash.value();
}

base::Result<std::string> read_text(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  const int reason = errno;
  if (!file && log_in_use) log_in_use->note(path, {});
  if (!file) return unreadable(path, reason);
  std::string text;
  char block[1 << 14];
  while (const std::size_t got = std::fread(block, 1, sizeof block, file.get())) {
    text.append(block, got);
    if (text.size() > most_bytes) return too_large(path);
  }
  if (std::ferror(file.get())) return unreadable(path, errno);
  if (text.starts_with("\x1f\x8b")) {
    base::Result<std::string> content = unpacked(path, text);
    if (!content) return content.problems();
    text = std::move(*content);
  }
  if (log_in_use) log_in_use->note(path, text);
  return text;
}

base::Result<std::string> read_regular_text(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
      !std::filesystem::is_directory(status))
    return base::Problem{
        .where = path + ":", .limit = "cannot be read: it is not a regular file", .cure = "name a file"};
  return read_text(path);
}

}  // namespace files
