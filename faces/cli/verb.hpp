// SPDX-License-Identifier: Apache-2.0
// Declares a verb of the command line. The verb's options and its function are in a separate file; main.cpp
// lists the verbs.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "faces/cli/exit_code.hpp"

namespace CLI {
class App;
}

namespace cli {

struct Verb {
  const CLI::App* app;  ///< converts to true if the verb's word was given
  /// The verb's function. Its argument is the command line in a form that a shell reads back.
  std::function<Exit(const std::string& command)> call;
};

/// Returns a function that stores the command line in `arguments` and calls `verb` with `arguments`. The
/// parser has written the options into `arguments`.
template <class Arguments>
std::function<Exit(const std::string&)> calling(Exit (*verb)(const Arguments&),
                                                std::shared_ptr<Arguments> arguments) {
  return [verb, arguments = std::move(arguments)](const std::string& command) {
    arguments->command = command;
    return verb(*arguments);
  };
}

// Functions that add an option which several verbs have:
void take_data(CLI::App& verb, std::string& folder);             ///< --data
void take_sets(CLI::App& verb, std::vector<std::string>& sets);  ///< --set
void take_force(CLI::App& verb, bool& force);                    ///< --force
void take_jobs(CLI::App& verb, unsigned& jobs, const std::string& what = "runs");

}  // namespace cli
