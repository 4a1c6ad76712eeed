// SPDX-License-Identifier: Apache-2.0
// Finds the possible next words of a command line, for every shell.
#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace cli {

struct Candidate {
  std::string word;     ///< the whole word; if it ends in = or /, the user continues it
  std::string meaning;  ///< meaning of the word; may be empty
};

/// Candidates for the last of `words` (which may be empty), given the words before it. `words` does not
/// include the program's name. Verbs and options come from their declarations; keys, motors and words from
/// their descriptions; files from their folders.
std::vector<Candidate> completions(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace cli
