// SPDX-License-Identifier: Apache-2.0
#include "text/toml/file_kind.hpp"

#include <fmt/format.h>

#include <set>
#include <string>
#include <vector>

#include "text/keys/key_catalog.hpp"

namespace text {
namespace {

/// The words that may be at the top level of a file with these keys.
std::set<std::string> first_words(const std::vector<KeyEntry>& keys) {
  std::set<std::string> words;
  const auto add = [&](std::string_view path) { words.emplace(path.substr(0, path.find('.'))); };
  for (const KeyEntry& entry : keys) {
    add(entry.path);
    for (const base::Spelling& spelling : entry.about.also) add(spelling.key);
  }
  return words;
}

}  // namespace

std::optional<base::Problem> taken_for(FileKind wanted, const Document& document) {
  const std::set<std::string> of_scenario = first_words(scenario_keys()),
                              of_motor = first_words(sheet_keys());
  const bool scenario = wanted == FileKind::scenario;
  const std::set<std::string>& own = scenario ? of_scenario : of_motor;
  const std::set<std::string>& other = scenario ? of_motor : of_scenario;
  bool of_other = false;
  for (const auto& [key, node] : document.root()) {
    const bool here = own.contains(std::string(key.str())), there = other.contains(std::string(key.str()));
    if (here && !there) return {};
    of_other |= there && !here;
  }
  if (!of_other) return {};
  const auto name = document.root()["motor"].value<std::string>();
  return base::Problem{
      .where = fmt::format("{}:1:1:", document.name()),
      .limit = scenario ? "is a motor file, not a scenario" : "is a scenario, not a motor file",
      .cure = scenario ? fmt::format("write a scenario for this motor with: sixstep new first --motor {}",
                                     document.name())
              : name   ? fmt::format("name the scenario's motor, {}", *name)
                       : std::string("name a motor file, or a built-in motor of sixstep motor list")};
}

}  // namespace text
