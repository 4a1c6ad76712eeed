// SPDX-License-Identifier: Apache-2.0
// A scenario file to start from: the keys that count, each with its meaning above it.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/scenario/scenario.hpp"
#include "text/rooms.hpp"

namespace text {

struct StarterOptions {
  std::string file;   ///< what the file will be called, for the commands in its head
  bool full = false;  ///< every key there is, not only those that a first scenario asks for
};

/// The scenario's file, explained. What the scenario sets stands open; what else is worth a thought in its
/// mode stands behind a #, with the value that holds anyhow, or `nan` where a number must be given. It reads
/// back as the scenario that it was made from, to the bit.
std::string starter_text(const study::Scenario& scenario, const StarterOptions& options);

/// What a reader of that file must know of where its numbers come from; empty: nothing.
std::string starter_note(const study::Scenario& scenario);

}  // namespace text
