// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "faces/cli/exit_code.hpp"

namespace CLI {
class App;
}

namespace cli {

/// A first word that is no verb: the nearest verb, or `run` for a scenario file.
Exit unknown_command(const CLI::App& app, const std::string& word);

/// A word that nobody takes: the nearest option of the verb that was read.
Exit unknown_argument(const CLI::App& app);

}  // namespace cli
