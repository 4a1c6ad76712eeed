// SPDX-License-Identifier: Apache-2.0
// Runs a chip with its own firmware in an emulator, register by register. The chip replaces the drive
// (rig/chip_drive.hpp).
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "faces/loop/cores.hpp"
#include "faces/loop/one_processor.hpp"
#include "faces/loop/talk.hpp"
#include "sixstep/rig/chip_port.hpp"

namespace loop {

/// An emulated chip. Only the thread that started it may use it.
class Chip {
 public:
  /// Loads the image; the chip is in reset. Problems: the emulator is missing or does not start.
  static base::Result<std::unique_ptr<Chip>> start(const Core& core, const std::string& image);

  /// The port is valid while this object exists.
  rig::ChipPort port();
  double clock_Hz() const { return greeting_.clock_Hz; }
  /// The times of the chip's interrupts so far; empty if the emulator has ended.
  rig::ChipTimes times();

 private:
  Chip() = default;
  bool understood() const;

  OneProcessor processor_;
  std::optional<Talk> talk_;
  rig::ChipGreeting greeting_{.word = 0};
};

}  // namespace loop
