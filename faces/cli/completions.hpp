// SPDX-License-Identifier: Apache-2.0
// What may stand next on the command line: one answer for every shell.
#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace cli {

struct Candidate {
  std::string word;     ///< the whole word; one that ends in = or / is to be continued
  std::string meaning;  ///< may be empty
};

/// Candidates for the last of `words` (which may be empty), given those before it; the program's own name is
/// not among them. Verbs and options come from their declarations, keys, motors and words from where they are
/// described; files are looked for in their folders.
std::vector<Candidate> completions(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace cli
