// SPDX-License-Identifier: Apache-2.0
// What holds for every scenario, however it was drawn or broken: a list of laws, each of which says how much
// of what it allows a case used. A new law is one line in scenario_laws.cpp.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sixstep::testing {

struct LawUsed {
  const char* law;
  double part;  ///< 1 is all that is allowed
  bool broken() const { return !(part <= 1.0); }
};

struct Examined {
  std::string kind;  ///< what was drawn: firmware and arithmetic, or how the text was broken
  bool accepted = false;
  std::string refused_at;  ///< the first key or place that was complained about
  std::string ended;       ///< how the run of an accepted one ended
  std::vector<LawUsed> laws;
  std::string words;  ///< what was said that should not have been, for a reader of a failure
};

/// One scenario as an engineer might write it: written, read back, checked, run, run watched, and run from
/// snapshots.
Examined examine_drawn(std::uint64_t seed);

/// One text that is broken in some way: read, checked, and where it is accepted after all, run for a while.
Examined examine_hostile(std::uint64_t seed);

/// The text of either, for a closer look.
std::string drawn_text(std::uint64_t seed);
std::string hostile_text(std::uint64_t seed);

}  // namespace sixstep::testing
