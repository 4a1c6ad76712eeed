// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/unknown_word.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <vector>

#include "faces/cli/terminal.hpp"
#include "io/key_advice.hpp"

namespace cli {
namespace {

std::string cure_of_command(const CLI::App& app, const std::string& word) {
  if (word.ends_with(".toml")) return fmt::format("did you mean sixstep run {}?", word);
  const std::vector<const CLI::App*> known = app.get_subcommands([](const CLI::App*) { return true; });
  const auto near = std::find_if(known.begin(), known.end(), [&](const CLI::App* command) {
    return io::edit_distance(word, command->get_name()) <= 2;
  });
  return near == known.end() ? "sixstep --help lists them"
                             : fmt::format("did you mean {}?", (*near)->get_name());
}

std::vector<std::string> options_of(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

}  // namespace

Exit unknown_command(const CLI::App& app, const std::string& word) {
  return refused({{.where = word, .limit = "is no command of sixstep", .cure = cure_of_command(app, word)}});
}

Exit unknown_argument(const CLI::App& app) {
  const CLI::App* verb = &app;
  std::string path = "sixstep";
  for (auto inner = verb->get_subcommands(); !inner.empty(); inner = verb->get_subcommands()) {
    verb = inner.front();
    path.append(" ").append(verb->get_name());
  }
  const std::vector<std::string> left = app.remaining(true), options = options_of(*verb);
  const std::string word = left.empty() ? "" : left.front();
  const std::string near = word.starts_with("-") ? io::nearest(word, options) : "";
  return refused({{.where = word,
                   .limit = fmt::format("is no argument of {}", path),
                   .cure = near.empty() ? fmt::format("{} --help lists them", path)
                                        : fmt::format("did you mean {}?", near)}});
}

}  // namespace cli
