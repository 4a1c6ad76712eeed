// SPDX-License-Identifier: Apache-2.0
#include "files/column_spool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>

namespace files {
namespace {

/// Calls pwrite or pread until all bytes are transferred. Returns 0 or errno. A premature end of the file
/// means that another program has shortened it.
template <class Move>
int move_all(Move move, std::size_t bytes, std::uint64_t at) {
  std::size_t done = 0;
  while (done < bytes) {
    const ssize_t moved = move(done, bytes - done, static_cast<off_t>(at + done));
    if (moved == 0) return EIO;
    if (moved > 0)
      done += static_cast<std::size_t>(moved);
    else if (errno != EINTR)
      return errno;
  }
  return 0;
}

}  // namespace

void ColumnSpool::Close::operator()(int* descriptor) const {
  if (*descriptor >= 0) ::close(*descriptor);
  delete descriptor;
}

ColumnSpool::ColumnSpool(const std::string& path, std::size_t columns)
    : columns_(columns), block_(columns * block_rows) {
  const std::filesystem::path folder =
      path.empty() ? std::filesystem::temp_directory_path() : std::filesystem::path(path).parent_path();
  std::string name = (folder / ".sixstep-columns-XXXXXX").string();
  descriptor_.reset(new int(::mkostemp(name.data(), O_CLOEXEC)));
  if (*descriptor_ < 0)
    error_ = errno;
  else
    ::unlink(name.c_str());  // the file is deleted when the program ends, in whatever way it ends
}

void ColumnSpool::row(std::span<const double> numbers) {
  if (error_ != 0) return;
  if (held_ == block_rows) spill();
  if (error_ != 0) return;
  for (std::size_t c = 0; c < columns_; ++c) block_[c * block_rows + held_] = numbers[c];
  ++held_;
}

void ColumnSpool::spill() {
  const std::size_t bytes = block_.size() * sizeof(double);
  const char* from = reinterpret_cast<const char*>(block_.data());
  error_ = move_all(
      [&](std::size_t done, std::size_t n, off_t at) { return ::pwrite(*descriptor_, from + done, n, at); },
      bytes, blocks_ * bytes);
  if (error_ != 0) return;  // after an error the block stays in memory and is not lost
  ++blocks_;
  held_ = 0;
}

bool ColumnSpool::column(std::size_t which, const std::function<bool(std::span<const double>)>& take) {
  constexpr std::size_t bytes = block_rows * sizeof(double);
  std::vector<double> strip(block_rows);
  char* to = reinterpret_cast<char*>(strip.data());
  for (std::size_t b = 0; b < blocks_; ++b) {
    const int failed = move_all(
        [&](std::size_t done, std::size_t n, off_t at) { return ::pread(*descriptor_, to + done, n, at); },
        bytes, (b * columns_ + which) * bytes);
    if (failed != 0) {
      error_ = failed;
      return false;
    }
    if (!take(strip)) return false;
  }
  return held_ == 0 || take(std::span(block_).subspan(which * block_rows, held_));
}

}  // namespace files
