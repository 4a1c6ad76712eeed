// SPDX-License-Identifier: Apache-2.0
// A recording of a motor on a bench, broken: by an exporter, by a full disk, by someone who edited it, or by someone
// who means it.
#pragma once
#include <cstdint>
#include <string>

namespace sixstep::testing {

struct BrokenRecording {
  const char* kind;  ///< of the last thing that was done to it
  std::string text;
};

/// The seed decides all of it.
BrokenRecording broken_recording(std::uint64_t seed);

}  // namespace sixstep::testing
