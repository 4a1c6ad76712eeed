// SPDX-License-Identifier: Apache-2.0
// Exchanges calls and answers with another program over two pipes, which are its descriptors 3 and 4.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "faces/loop/child.hpp"
#include "faces/loop/descriptor.hpp"
#include "faces/loop/rooms.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/rig/lockstep_core.hpp"

namespace loop {

/// A connection to another program. This program must ignore SIGPIPE, as `sixstep` does, because the end of
/// the other program is reported as a CoreTrouble.
class Talk {
 public:
  /// Starts the emulator with an image, and waits at most half a minute for the image's greeting. Problems:
  /// the emulator is missing, too many files are open, or no greeting arrived.
  static base::Result<Talk> begin(std::vector<std::string> emulator, const std::string& image, void* greeting,
                                  std::size_t bytes);

  /// Sends all bytes, or reports that the other program has ended.
  rig::CoreTrouble say(const void* from, std::size_t bytes);
  /// Reads all bytes; each part must arrive within `limit_ms`.
  rig::CoreTrouble hear(void* to, std::size_t bytes, int limit_ms);
  /// Sends a call and reads the answer. If the answer takes more than five seconds, the program counts as
  /// hanging.
  rig::CoreTrouble ask(const void* call, std::size_t call_bytes, void* answer, std::size_t answer_bytes);

 private:
  Talk(Child&& child, Descriptor&& to, Descriptor&& from)
      : child_(std::move(child)), to_(std::move(to)), from_(std::move(from)) {}

  Child child_;
  Descriptor to_, from_;
};

/// The Problem of a greeting that did not arrive, because of `trouble`.
base::Problem no_greeting(const std::string& program, rig::CoreTrouble trouble);

}  // namespace loop
