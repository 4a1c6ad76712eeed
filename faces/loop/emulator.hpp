// SPDX-License-Identifier: Apache-2.0
// Runs a core in its emulator, call by call. The core computes the drive in parallel with the host
// (rig/lockstep_core.hpp).
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "faces/loop/cores.hpp"
#include "faces/loop/one_processor.hpp"
#include "faces/loop/talk.hpp"

namespace loop {

/// An emulated core. Only the thread that started it may use it.
class Emulator {
 public:
  /// Loads the image and waits until its program runs. Problems: the emulator is missing or does not start.
  static base::Result<std::unique_ptr<Emulator>> start(const Core& core, const std::string& image);

  /// The port is valid while this object exists.
  rig::CorePort port();
  std::uint64_t calls() const { return calls_; }

 private:
  Emulator() = default;
  rig::CoreTrouble ask(const void* call, std::size_t call_bytes, void* answer, std::size_t answer_bytes);

  OneProcessor processor_;
  std::optional<Talk> talk_;
  rig::CoreGreeting greeting_{.word = 0};  ///< 0 until the program has sent its greeting
  std::uint64_t calls_ = 0;
};

}  // namespace loop
