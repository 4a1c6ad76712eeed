// SPDX-License-Identifier: Apache-2.0
// A chip in its emulator, register by register: it runs a firmware of its own in the drive's place (rig/chip_drive.hpp).
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "faces/loop/cores.hpp"
#include "faces/loop/one_processor.hpp"
#include "faces/loop/talk.hpp"
#include "sixstep/rig/chip_port.hpp"

namespace loop {

/// Of the thread that starts it.
class Chip {
 public:
  /// Loads the image; the chip stands at its reset. Problems: an emulator that is missing or does not start.
  static base::Result<std::unique_ptr<Chip>> start(const Core& core, const std::string& image);

  /// Stays valid as long as this does.
  rig::ChipPort port();
  double clock_Hz() const { return greeting_.clock_Hz; }
  /// What its interrupts took until now; of a chip that is gone nothing.
  rig::ChipTimes times();

 private:
  Chip() = default;
  bool understood() const;

  OneProcessor processor_;
  std::optional<Talk> talk_;
  rig::ChipGreeting greeting_{.word = 0};
};

}  // namespace loop
