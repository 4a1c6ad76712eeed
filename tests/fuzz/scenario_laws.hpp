// SPDX-License-Identifier: Apache-2.0
// Laws that hold for every scenario, drawn or damaged: each gives the used part of its tolerance. A new law is one line in
// scenario_laws.cpp.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sixstep::testing {

struct LawUsed {
  const char* law;
  double part;  ///< 1 is the whole tolerance
  bool broken() const { return !(part <= 1.0); }
};

struct Examined {
  std::string kind;  ///< the drawn firmware and arithmetic, or the kind of damage
  bool accepted = false;
  std::string refused_at;  ///< first refused key or place
  std::string ended;       ///< end of an accepted scenario's run
  std::vector<LawUsed> laws;
  std::string words;  ///< the offending message, for the report of a failure
};

/// One scenario of the kind that an engineer writes: written, read back, checked, run, run watched, and run from snapshots.
Examined examine_drawn(std::uint64_t seed);

/// One damaged text: read, checked, and run for a while if it is accepted.
Examined examine_hostile(std::uint64_t seed);

/// The text of either, for inspection.
std::string drawn_text(std::uint64_t seed);
std::string hostile_text(std::uint64_t seed);

}  // namespace sixstep::testing
