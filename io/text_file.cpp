// SPDX-License-Identifier: Apache-2.0
#include "io/text_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

namespace io {
namespace {

base::Problem unreadable(const std::string& path, int reason) {
  return {.where = path + ":",
          .limit = std::string("cannot be read: ") + std::strerror(reason),
          .cure = reason == EISDIR ? "name a file in it" : "check the path and the permission to read it"};
}

}  // namespace

base::Result<std::string> read_text(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) return unreadable(path, errno);
  std::string text;
  char block[1 << 14];
  while (const std::size_t got = std::fread(block, 1, sizeof block, file.get())) text.append(block, got);
  if (std::ferror(file.get())) return unreadable(path, errno);
  return text;
}

base::Result<std::string> read_regular_text(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
      !std::filesystem::is_directory(status))
    return base::Problem{
        .where = path + ":", .limit = "cannot be read: it is no regular file", .cure = "name a file"};
  return read_text(path);
}

}  // namespace io
