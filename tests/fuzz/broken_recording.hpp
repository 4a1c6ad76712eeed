// SPDX-License-Identifier: Apache-2.0
// A recording of a motor on a bench, damaged as by an exporter, a full disk, an editing error or an attacker.
#pragma once
#include <cstdint>
#include <string>

namespace sixstep::testing {

struct BrokenRecording {
  const char* kind;  ///< kind of the last damage
  std::string text;
};

/// A damaged recording. The seed determines the table and its damage.
BrokenRecording broken_recording(std::uint64_t seed);

}  // namespace sixstep::testing
