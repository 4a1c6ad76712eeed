// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/man_command.hpp"

#include <CLI/App.hpp>

#include "faces/cli/man_page.hpp"
#include "faces/cli/terminal.hpp"

namespace cli {

Verb declare_man(CLI::App& app) {
  CLI::App& man = *app.add_subcommand("man", "print the manual page, for man -l -");
  return {&man, [&app](const std::string&) {
            print(man_page(app));
            return Exit::ok;
          }};
}

}  // namespace cli
