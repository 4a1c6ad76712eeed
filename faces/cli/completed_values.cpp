// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/completed_values.hpp"

#include <CLI/App.hpp>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "faces/cli/choose.hpp"
#include "faces/cli/design_command.hpp"
#include "faces/cli/schema_command.hpp"
#include "faces/loop/cores.hpp"
#include "sixstep/analysis/plan/plan_description.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/escape/escape.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/keys/key_tree.hpp"
#include "text/motor/motor_library.hpp"
#include "text/motor/motor_template.hpp"

namespace cli {
namespace {

namespace fs = std::filesystem;
using Candidates = std::vector<Candidate>;

/// Folders, and files with one extension ("": any), that begin with the typed text. Hidden files are listed
/// only after a typed dot.
Candidates files(const std::string& current, std::string_view extension, bool folders_only = false) {
  const std::size_t cut = current.rfind('/');
  const std::string folder = cut == std::string::npos ? "" : current.substr(0, cut + 1);
  const std::string start = current.substr(folder.size());
  Candidates found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(start) || (name.front() == '.' && start.empty())) continue;
    if (text::visible(name) != name) continue;  // shells show candidates unescaped, one per line
    // A name that begins with - gets the prefix "./": the parser would read it as an option.
    const std::string path = (name.front() == '-' && folder.empty() ? "./" : folder) + name;
    if (entry.is_directory(error))
      found.push_back({path + "/", ""});
    else if (!folders_only && name.ends_with(extension))
      found.push_back({path, ""});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.word < b.word; });
  return found;
}

Candidates motors(const std::string& current) {
  Candidates found;
  for (const std::string& name : text::built_in_motors()) found.push_back({name, "built-in"});
  const Candidates own = files(current, ".toml");
  found.insert(found.end(), own.begin(), own.end());
  return found;
}

template <class Choices>
Candidates words(const Choices& choices) {
  Candidates found;
  for (const auto& choice : choices) found.push_back({std::string(choice.word), std::string(choice.meaning)});
  return found;
}

Candidates keys(std::string_view behind, bool tables) {
  Candidates found;
  for (const text::KeyEntry& key : text::scenario_keys())
    if (tables || !text::is_table(key))
      found.push_back({key.path + std::string(behind), std::string(key.about.meaning)});
  return found;
}

/// Before the =, "key=" for each key; after the =, the words of the key or the values of a flag.
Candidates settings(const std::string& current) {
  const std::size_t equals = current.find('=');
  if (equals == std::string::npos) return keys("=", false);
  const std::vector<text::KeyEntry>& all = text::scenario_keys();
  const text::KeyEntry* key = text::find_key(all, current.substr(0, equals));
  Candidates found;
  if (!key) return found;
  const std::string start = current.substr(0, equals + 1);
  for (const auto& [word, meaning] : key->choices) found.push_back({start + word, meaning});
  for (const auto& [turning, word, meaning] : key->linear_choices) found.push_back({start + word, meaning});
  if (key->type == text::KeyType::flag) found = {{start + "true", ""}, {start + "false", ""}};
  if (key->path == "motor")
    for (const std::string& name : text::built_in_motors()) found.push_back({start + name, "built-in"});
  return found;
}

Candidates styles() {
  Candidates found;
  for (const std::string& style : text::template_styles()) found.push_back({style, ""});
  return found;
}

/// The modes that a verb accepts. No verb accepts "off", in which all gates are off; `design` does not accept
/// "duty", which needs no gains.
Candidates modes(const CLI::App& verb) {
  Candidates found = words(study::mode_choices);
  std::erase_if(found, [&](const Candidate& c) {
    return c.word == "off" || (c.word == "duty" && verb.get_name() == "design");
  });
  return found;
}

/// Names of emulated cores and of firmware maps.
Candidates cores(const std::string& current) {
  Candidates found;
  for (const loop::Core& core : loop::cores())
    found.push_back({std::string(core.name), std::string(core.title)});
  const Candidates maps = files(current, ".toml");
  found.insert(found.end(), maps.begin(), maps.end());
  return found;
}

Candidates known_words(const CLI::App& verb, const std::string& name) {
  if (name == "--mode") return modes(verb);
  if (name == "--chopping") return words(study::chopping_choices);
  if (name == "--arithmetic") return words(study::arithmetic_choices);
  if (name == "--sampling") return words(analysis::sampling_choices);
  if (name == "--method") return words(method_choices);
  if (name == "--style") return styles();
  if (name == "--between")
    return {{"lines", "two terminals"}, {"star", "a terminal and one point common to all"}};
  if (name == "KIND") return words(schema_kinds);
  if (name == "SHELL") return {{"bash", ""}, {"zsh", ""}, {"fish", ""}};
  if (name == "KEY") return keys("", true);
  return {};
}

}  // namespace

Candidates values_of(const CLI::App& verb, const CLI::Option& option, const std::string& current) {
  const std::string name = option.get_positional() ? option.get_name(true) : option.get_name();
  if (Candidates found = known_words(verb, name); !found.empty()) return found;
  if (name == "--set" || name == "--vary") return settings(current);
  if (name == "FILE" || name == "SCENARIO" || name == "--optimise") return files(current, ".toml");
  if (name == "--on") return cores(current);
  if (name == "MOTOR" || name == "--motor") return motors(current);
  if (name == "NAME") return verb.get_name() == "new" ? Candidates{} : motors(current);
  if (name == "--data") return files(current, "", true);
  // CLI11 gives numbers another type name. Every other option without a list is the path of an output file.
  return option.get_type_name() == "TEXT" ? files(current, "") : Candidates{};
}

}  // namespace cli
