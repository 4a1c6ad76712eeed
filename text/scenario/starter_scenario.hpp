// SPDX-License-Identifier: Apache-2.0
// Writes a scenario file to start from: the most important keys, each with its meaning above it.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/scenario/scenario.hpp"
#include "text/rooms.hpp"

namespace text {

struct StarterOptions {
  std::string file;   ///< name of the file to be written, for the commands at its beginning
  bool full = false;  ///< true: all keys; false: only the keys of a first scenario
};

/// The scenario's file with explanations. Lines with the scenario's own values are active. Other keys useful
/// in its mode are commented out, with their default, or with `nan` if the user must give a number. The text
/// reads back as the same scenario, to the bit.
std::string starter_text(const study::Scenario& scenario, const StarterOptions& options);

/// A note on the source of the file's numbers; empty if the numbers need no note.
std::string starter_note(const study::Scenario& scenario);

}  // namespace text
