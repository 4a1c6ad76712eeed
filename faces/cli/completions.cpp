// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/completions.hpp"

#include <CLI/App.hpp>

#include <algorithm>
#include <functional>
#include <set>
#include <string_view>

#include "faces/cli/completed_values.hpp"

namespace cli {
namespace {

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// The option that a word names, with "--" and up to =; null if the verb does not have this option.
const CLI::Option* option_of(const CLI::App& verb, const std::string& word) {
  return word.starts_with("-") ? verb.get_option_no_throw(word.substr(0, word.find('='))) : nullptr;
}

const CLI::App* inner_verb(const CLI::App& verb, const std::string& word) {
  const std::vector<const CLI::App*> found =
      verb.get_subcommands([&](const CLI::App* inner) { return inner->get_name() == word; });
  return found.empty() ? nullptr : found.front();
}

/// The parser's state after all words except the last.
struct Reading {
  const CLI::App* verb;
  const CLI::Option* open = nullptr;  ///< option whose value is the next word
  std::size_t positionals = 0;
  std::set<const CLI::Option*> given;

  void read(const std::string& word) {
    if (open) {
      open = nullptr;
      return;
    }
    if (const CLI::Option* option = option_of(*verb, word)) {
      given.insert(option);
      if (takes_value(*option) && word.find('=') == std::string::npos) open = option;
      return;
    }
    if (const CLI::App* inner = inner_verb(*verb, word)) {
      *this = Reading{inner};
      return;
    }
    ++positionals;
  }
};

std::string first_name(const CLI::Option& option) {
  return option.get_lnames().empty() ? "-" + option.get_snames().front() : "--" + option.get_lnames().front();
}

void add_options(const Reading& at, std::vector<Candidate>& out) {
  for (const CLI::Option* option : at.verb->get_options())
    if (option->nonpositional() && (!at.given.contains(option) || option->get_expected_max() > 1))
      out.push_back({first_name(*option), option->get_description()});
}

/// The next positional argument. The last positional argument may have several words.
const CLI::Option* next_positional(const Reading& at) {
  std::vector<const CLI::Option*> all;
  for (const CLI::Option* option : at.verb->get_options())
    if (option->get_positional()) all.push_back(option);
  if (all.empty()) return nullptr;
  if (at.positionals < all.size()) return all[at.positionals];
  return all.back()->get_expected_max() > 1 ? all.back() : nullptr;
}

}  // namespace

std::vector<Candidate> completions(const CLI::App& app, const std::vector<std::string>& words) {
  Reading at{&app};
  for (std::size_t n = 0; n + 1 < words.size(); ++n) at.read(words[n]);
  const std::string current = words.empty() ? "" : words.back();
  std::vector<Candidate> out;
  const std::size_t equals = current.find('=');
  if (at.open) {
    out = values_of(*at.verb, *at.open, current);
  } else if (const CLI::Option* option = option_of(*at.verb, current);
             option && equals != std::string::npos) {
    out = values_of(*at.verb, *option, current.substr(equals + 1));
    for (Candidate& candidate : out) candidate.word.insert(0, current, 0, equals + 1);
  } else if (current.starts_with("-")) {
    add_options(at, out);
  } else {
    for (const CLI::App* inner : at.verb->get_subcommands([](const CLI::App*) { return true; }))
      out.push_back({inner->get_name(), inner->get_description()});
    if (const CLI::Option* positional = next_positional(at)) {
      out = values_of(*at.verb, *positional, current);
    } else if (out.empty()) {
      add_options(at, out);
    }
  }
  std::erase_if(out, [&](const Candidate& c) { return !c.word.starts_with(current); });
  return out;
}

}  // namespace cli
