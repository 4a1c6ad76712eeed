// SPDX-License-Identifier: Apache-2.0
// Writes values as bytes that are equal on every processor. A whole number or a double takes eight bytes, the
// least significant byte first. A text or list begins with its length. All bits of a double are kept, also of
// a NaN.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace batch {

class ByteWriter {
 public:
  void whole(std::uint64_t x) {
    for (int n = 0; n < 8; ++n) bytes_.push_back(static_cast<char>(x >> 8 * n & 0xFF));
  }
  void number(double x) { whole(std::bit_cast<std::uint64_t>(x)); }
  void text(std::string_view text) {
    whole(text.size());
    bytes_ += text;
  }
  template <class T, class Write>
  void list(const std::vector<T>& list, Write write) {
    whole(list.size());
    for (const T& entry : list) write(entry);
  }

  std::string&& bytes() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads the bytes of a ByteWriter. Reading fails beyond the end or at an impossible length. After a failure,
/// nothing more is read.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  /// Whether all bytes were read without an error.
  bool whole_read() const { return !failed_ && rest_.empty(); }
  bool failed() const { return failed_; }

  std::uint64_t whole() {
    const std::string_view bytes = take(8);
    std::uint64_t x = 0;
    for (std::size_t n = bytes.size(); n-- > 0;) x = x << 8 | static_cast<unsigned char>(bytes[n]);
    return x;
  }
  double number() { return std::bit_cast<double>(whole()); }
  std::string text() { return std::string(take(whole())); }
  template <class T, class Read>
  std::vector<T> list(Read read) {
    std::vector<T> list;
    // Every entry has at least eight bytes. A length that exceeds the remaining bytes is refused, so that it
    // reserves no memory.
    const std::uint64_t length = whole();
    if (length > rest_.size() / 8) failed_ = true;
    for (std::uint64_t n = 0; n < length && !failed_; ++n) list.push_back(read());
    return list;
  }
  /// One of the first `count` values of an enumeration.
  template <class E>
  E choice(std::uint64_t count) {
    const std::uint64_t x = whole();
    if (x < count) return static_cast<E>(x);
    failed_ = true;
    return E{};
  }
  bool yes() { return choice<int>(2) == 1; }

 private:
  std::string_view take(std::uint64_t count) {
    failed_ = failed_ || count > rest_.size();
    if (failed_) return {};
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  std::string_view rest_;
  bool failed_ = false;
};

}  // namespace batch
