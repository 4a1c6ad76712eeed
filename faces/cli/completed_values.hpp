// SPDX-License-Identifier: Apache-2.0
// The values that an option or argument takes, as far as they can be listed.
#pragma once
#include <string>
#include <vector>

#include "faces/cli/completions.hpp"

namespace CLI {
class Option;
}

namespace cli {

/// `current`: what has been typed of the value; for files it says which folder is looked into. Numbers cannot
/// be listed; of any other text that has no list of its own, files are.
std::vector<Candidate> values_of(const CLI::App& verb, const CLI::Option& option, const std::string& current);

}  // namespace cli
