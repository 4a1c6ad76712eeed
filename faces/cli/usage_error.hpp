// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "faces/cli/exit_code.hpp"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace cli {

/// Handles a command line that calls no verb. Prints the requested help or version. Otherwise prints the
/// error in the form of all other messages; for an unknown word, it suggests the nearest known word.
Exit usage_error(CLI::App& app, const CLI::ParseError& error, const std::string& last_word);

}  // namespace cli
