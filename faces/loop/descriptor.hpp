// SPDX-License-Identifier: Apache-2.0
// Closes a file descriptor exactly once, and makes a pipe of two descriptors.
#pragma once
#include <fcntl.h>
#include <unistd.h>

#include <utility>

namespace loop {

class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }

  int number() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }
  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }

 private:
  int number_ = -1;
};

/// A pipe. A started program inherits an end only if the end is listed in Command::given.
struct Pipe {
  Descriptor read, write;
};

/// Creates a pipe. The ends are empty if the system has no more descriptors.
inline Pipe made_pipe() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return {};
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

}  // namespace loop
