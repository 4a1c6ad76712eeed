// SPDX-License-Identifier: Apache-2.0
// Laws for every scenario, random or damaged. Each law returns the fraction of its tolerance that a case
// uses. A new law needs one line in scenario_laws.cpp.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sixstep::testing {

struct LawUsed {
  const char* law;
  double part;  ///< used fraction; 1 is the whole tolerance
  bool broken() const { return !(part <= 1.0); }
};

struct Examined {
  std::string kind;  ///< firmware and arithmetic of a random case, or kind of damage
  bool accepted = false;
  std::string refused_at;  ///< first refused key or place
  std::string ended;       ///< how the run of an accepted scenario ended
  std::vector<LawUsed> laws;
  std::string words;  ///< the message that violates a law, for the report of a failure
};

/// Examines a random scenario. It is written, read back, checked, run, run with observers, and run from
/// snapshots.
Examined examine_drawn(std::uint64_t seed);

/// Examines one damaged text. It is read and checked; if it is accepted, it runs for a while.
Examined examine_hostile(std::uint64_t seed);

/// The text of a random case and of a hostile case, for inspection.
std::string drawn_text(std::uint64_t seed);
std::string hostile_text(std::uint64_t seed);

}  // namespace sixstep::testing
