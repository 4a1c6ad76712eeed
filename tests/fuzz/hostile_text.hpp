// SPDX-License-Identifier: Apache-2.0
// A scenario text that is damaged as by typing errors, a faulty program, a full disk or an attacker.
#pragma once
#include <cstdint>
#include <string>

namespace sixstep::testing {

struct BrokenText {
  const char* kind;  ///< kind of the last damage
  std::string text;
};

/// A damaged scenario text. Only the seed determines it.
BrokenText broken_text(std::uint64_t seed);

}  // namespace sixstep::testing
