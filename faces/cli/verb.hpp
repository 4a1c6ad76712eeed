// SPDX-License-Identifier: Apache-2.0
// A verb of the command line: its options and what it does stand side by side in its own file; main.cpp lists
// the verbs.
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
  const CLI::App* app;  ///< true once its word was read
  /// Called with the command line as a shell would take it again.
  std::function<Exit(const std::string& command)> call;
};

/// What `arguments`, which the options write into, asks for. They remember the command that they came from.
template <class Arguments>
std::function<Exit(const std::string&)> calling(Exit (*verb)(const Arguments&),
                                                std::shared_ptr<Arguments> arguments) {
  return [verb, arguments = std::move(arguments)](const std::string& command) {
    arguments->command = command;
    return verb(*arguments);
  };
}

// Options that several verbs have.
void take_data(CLI::App& verb, std::string& folder);             ///< --data
void take_sets(CLI::App& verb, std::vector<std::string>& sets);  ///< --set
void take_force(CLI::App& verb, bool& force);                    ///< --force
void take_jobs(CLI::App& verb, unsigned& jobs, const std::string& what = "runs");

}  // namespace cli
