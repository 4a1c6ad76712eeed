// SPDX-License-Identifier: Apache-2.0
// Another program at the ends of two pipes: calls go to it by one, answers come by the other. It finds them as descriptors 3 and 4.
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

/// The program that uses it ignores SIGPIPE, as `sixstep` does: that the other has gone is an answer.
class Talk {
 public:
  /// Starts the emulator with an image and waits for what the program there says of itself first, half a minute at most. Problems: no
  /// such program, too many files open, or nothing said.
  static base::Result<Talk> begin(std::vector<std::string> emulator, const std::string& image, void* greeting,
                                  std::size_t bytes);

  /// All of it, or that the other has gone.
  rig::CoreTrouble say(const void* from, std::size_t bytes);
  /// All of it within so long, for each part that comes.
  rig::CoreTrouble hear(void* to, std::size_t bytes, int limit_ms);
  /// One and then the other, an answer within five seconds: a program that has not answered by then hangs.
  rig::CoreTrouble ask(const void* call, std::size_t call_bytes, void* answer, std::size_t answer_bytes);

 private:
  Talk(Child&& child, Descriptor&& to, Descriptor&& from)
      : child_(std::move(child)), to_(std::move(to)), from_(std::move(from)) {}

  Child child_;
  Descriptor to_, from_;
};

/// That it did not say what it should, after so much trouble.
base::Problem no_greeting(const std::string& program, rig::CoreTrouble trouble);

}  // namespace loop
