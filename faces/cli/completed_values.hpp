// SPDX-License-Identifier: Apache-2.0
// Lists the values of an option or argument, if they can be listed.
#pragma once
#include <string>
#include <vector>

#include "faces/cli/completions.hpp"

namespace CLI {
class Option;
}

namespace cli {

/// `current`: the typed part of the value; for files it determines the folder. Numbers have no list. A text
/// argument without a list of words gets a list of files.
std::vector<Candidate> values_of(const CLI::App& verb, const CLI::Option& option, const std::string& current);

}  // namespace cli
