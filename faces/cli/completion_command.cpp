// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/completion_command.hpp"

#include <CLI/App.hpp>

#include <string_view>

#include "faces/cli/choose.hpp"
#include "faces/cli/completion_scripts.hpp"
#include "faces/cli/completions.hpp"
#include "faces/cli/terminal.hpp"

namespace cli {
namespace {

Exit print_script(const std::string& shell) {
  const base::Choice<std::string_view> shells[] = {{"bash", scripts::sixstep_bash(), ""},
                                                   {"zsh", scripts::sixstep_zsh(), ""},
                                                   {"fish", scripts::sixstep_fish(), ""}};
  std::string_view script;
  base::Problems found;
  choose("SHELL", shell, shells, script, found);
  if (!found.empty()) return refused(found);
  print(script);
  return Exit::ok;
}

}  // namespace

Exit answer_shell(const CLI::App& app, const std::vector<std::string>& words) {
  std::string text;
  for (const Candidate& candidate : completions(app, words))
    text += candidate.word + (candidate.meaning.empty() ? "" : "\t" + candidate.meaning) + "\n";
  print(text);
  return Exit::ok;
}

Verb declare_completion(CLI::App& app) {
  CLI::App& completion =
      *app.add_subcommand("completion", "print a script that completes commands in your shell");
  completion.footer(
      "In ~/.bashrc or ~/.zshrc: source <(sixstep completion bash), or zsh. In fish: "
      "sixstep completion fish | source\n");
  const auto shell = std::make_shared<std::string>();
  completion.add_option("SHELL", *shell, "bash, zsh or fish")->required();
  return {&completion, [shell](const std::string&) { return print_script(*shell); }};
}

}  // namespace cli
