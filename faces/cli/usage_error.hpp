// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "faces/cli/exit_code.hpp"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace cli {

/// Handles a command line that calls no verb: prints the requested help or version; otherwise reports the error
/// in the form of all other messages, with the nearest word for an unknown one.
Exit usage_error(CLI::App& app, const CLI::ParseError& error, const std::string& last_word);

}  // namespace cli
