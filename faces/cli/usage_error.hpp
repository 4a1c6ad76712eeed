// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "faces/cli/exit_code.hpp"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace cli {

/// A command line that calls no verb: help or the version that was asked for; else what is wrong with it, in
/// the form of all other messages, with the nearest word for one that nobody takes.
Exit usage_error(CLI::App& app, const CLI::ParseError& error, const std::string& last_word);

}  // namespace cli
