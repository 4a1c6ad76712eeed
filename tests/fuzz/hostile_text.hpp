// SPDX-License-Identifier: Apache-2.0
// A scenario's text, broken: by someone who mistypes, by a program that writes nonsense, by a full disk, or
// by someone who means it.
#pragma once
#include <cstdint>
#include <string>

namespace sixstep::testing {

struct BrokenText {
  const char* kind;  ///< of the last thing that was done to it
  std::string text;
};

/// The seed decides all of it.
BrokenText broken_text(std::uint64_t seed);

}  // namespace sixstep::testing
