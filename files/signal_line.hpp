// SPDX-License-Identifier: Apache-2.0
// Formats and writes text without the C library's allocator and locks, which a signal handler must not use.
#pragma once
#include <unistd.h>

#include <cstdint>
#include <string_view>

namespace files {

/// One line; longer text is truncated.
class SignalLine {
 public:
  SignalLine& operator<<(std::string_view text) {
    for (const char c : text)
      if (used_ + 1 < sizeof text_)
        text_[used_++] = static_cast<unsigned char>(c) < ' ' && c != '\t' ? '?' : c;
    return *this;
  }
  SignalLine& operator<<(std::uint64_t n) {
    char digits[20];
    std::size_t count = 0;
    do digits[count++] = static_cast<char>('0' + n % 10);
    while ((n /= 10) != 0);
    while (count > 0) *this << std::string_view(&digits[--count], 1);
    return *this;
  }
  std::string_view line() {
    text_[used_] = '\n';
    return {text_, used_ + 1};
  }

 private:
  char text_[1024];
  std::size_t used_ = 0;
};

inline void write_out(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t taken = ::write(descriptor, text.data(), text.size());
    if (taken <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(taken));
  }
}

}  // namespace files
