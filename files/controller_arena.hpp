// SPDX-License-Identifier: Apache-2.0
// Contains the config, the state and the answer of a user's controller while the controller's code runs. Each
// of the three ends at the beginning of a protected page, so that a write beyond its end is caught at the
// writing instruction. A pattern fills the padding before the page and is checked after the call.
#pragma once
#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <new>

#include "files/rooms.hpp"

namespace files {

/// Space for bytes that end at a protected page. The bytes are aligned to 16, the largest alignment that a
/// compiler needs.
class GuardedRoom {
 public:
  explicit GuardedRoom(std::byte* end) : end_(end) {}
  std::byte* take(std::size_t bytes) {
    if (at_ != nullptr && bytes == bytes_) return at_;
    bytes_ = bytes;
    at_ = end_ - (bytes + grain - 1) / grain * grain;
    std::memset(at_ - grain, pattern, grain);
    std::memset(at_ + bytes, pattern, static_cast<std::size_t>(end_ - at_) - bytes);
    return at_;
  }
  bool holds(const void* bytes, std::size_t count) const {
    return at_ != nullptr && bytes_ == count && std::memcmp(at_, bytes, count) == 0;
  }
  /// Whether the padding before and after the bytes is unchanged.
  bool is_whole() const {
    const auto untouched = [](std::byte b) { return b == std::byte{pattern}; };
    return std::all_of(at_ - grain, at_, untouched) && std::all_of(at_ + bytes_, end_, untouched);
  }

 private:
  static constexpr std::size_t grain = 16;
  static constexpr unsigned char pattern = 0xA5;
  std::byte* end_;
  std::byte* at_ = nullptr;
  std::size_t bytes_ = 0;
};

/// The arena of one thread.
class ControllerArena {
 public:
  ControllerArena() : begin_(reserved()), config(room(0)), state(room(1)), answer(room(2)) {}
  ~ControllerArena() { ::munmap(begin_, size); }
  ControllerArena(const ControllerArena&) = delete;
  ControllerArena& operator=(const ControllerArena&) = delete;

  /// Makes the config writable or read-only. Only the controller's design function may write it.
  void let_config_change(bool may) {
    if (may != may_change_)
      ::mprotect(begin_ + forbidden, room_bytes, may ? PROT_READ | PROT_WRITE : PROT_READ);
    may_change_ = may;
  }
  /// Returns the config for the controller's steps. If it is equal to the last config, as usual, nothing is
  /// copied.
  std::byte* set_config(const void* bytes, std::size_t count) {
    if (may_change_ || !config.holds(bytes, count)) {
      let_config_change(true);
      std::memcpy(config.take(count), bytes, count);
      let_config_change(false);
    }
    return config.take(count);
  }

 private:
  static constexpr std::size_t forbidden = 65536, room_bytes = 2 * forbidden;
  static constexpr std::size_t size = 3 * (forbidden + room_bytes) + forbidden;

  static std::byte* reserved() {
    void* const all = ::mmap(nullptr, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (all == MAP_FAILED) throw std::bad_alloc();
    return static_cast<std::byte*>(all);
  }
  GuardedRoom room(std::size_t n) {
    std::byte* const at = begin_ + forbidden + n * (forbidden + room_bytes);
    if (::mprotect(at, room_bytes, PROT_READ | PROT_WRITE) != 0) throw std::bad_alloc();
    return GuardedRoom(at + room_bytes);
  }
  std::byte* begin_;

 public:
  GuardedRoom config, state, answer;

 private:
  bool may_change_ = true;
};

}  // namespace files
