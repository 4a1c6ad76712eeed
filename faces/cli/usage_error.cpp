// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/usage_error.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "faces/cli/terminal.hpp"
#include "text/escape/escape.hpp"
#include "text/keys/key_advice.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/keys/key_tree.hpp"

namespace cli {
namespace {

using base::Problem;

/// The innermost verb that the parser has read, and the words up to it.
struct Called {
  CLI::App* verb;
  std::string path = "sixstep";

  explicit Called(CLI::App& app) : verb(&app) {
    for (auto inner = verb->get_subcommands(); !inner.empty(); inner = verb->get_subcommands()) {
      verb = inner.front();
      path.append(" ").append(verb->get_name());
    }
  }
  std::string help() const { return path + " --help lists all"; }
};

std::vector<std::string> verbs_of(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::App* inner : verb.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(inner->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The verb that differs from the word by at most two letters, as after a typing error. nearest() requires
/// more similarity than short words can have.
std::string nearest_verb(const std::string& word, const std::vector<std::string>& verbs) {
  for (int distance = 1; distance <= 2; ++distance)
    for (const std::string& verb : verbs)
      if (text::edit_distance(word, verb) <= distance) return verb;
  return "";
}

/// The --set option that the user meant with a key of the scenario written as an option ("--duration").
std::string setting_meant(const CLI::App& verb, const std::string& word) {
  if (!verb.get_option_no_throw("--set")) return "";
  std::vector<std::string> keys;
  for (const text::KeyEntry& key : text::scenario_keys())
    if (!text::is_table(key)) keys.push_back(key.path);
  std::string name = word.substr(0, word.find('='));
  name.erase(0, name.find_first_not_of('-'));
  std::replace(name.begin(), name.end(), '-', '_');
  const std::string near = text::nearest_word(name, keys);
  return near.empty() ? "" : fmt::format("--set {}=..", near);
}

Problem unknown_word(const Called& called, const std::string& word) {
  const std::vector<std::string> verbs = verbs_of(*called.verb);
  const bool is_option = word.starts_with("-");
  if (!is_option && !verbs.empty() && word.ends_with(".toml"))
    return {word, "", "is not a command of " + called.path,
            fmt::format("did you mean sixstep run {}?", text::shell_word(word))};
  std::string near = is_option ? text::nearest(word, options_of(*called.verb)) : nearest_verb(word, verbs);
  if (is_option && near.empty()) near = setting_meant(*called.verb, word);
  const char* kind = is_option || verbs.empty() ? "an argument" : "a command";
  return {.where = word,
          .limit = fmt::format("is not {} of {}", kind, called.path),
          .cure = near.empty() ? called.path + " --help lists them" : fmt::format("did you mean {}?", near)};
}

// The error's details are read from the parsed options: the exception contains only its kind and the parser's
// own text.

std::string meaning(const Called& called, const CLI::Option* option) {
  return option ? "it means: " + option->get_description() : called.help();
}

std::optional<Problem> missing(const Called& called) {
  for (const CLI::Option* option : called.verb->get_options())
    if (option->get_required() && option->count() == 0)
      return Problem{.where = called.path,
                     .limit = fmt::format("needs {}: {}", option->get_name(), option->get_description()),
                     .cure = called.help()};
  return {};
}

/// Reports a wrong number of values. Only the last option can lack a value, because an option reads any next
/// word as its value.
std::optional<Problem> wrong_count(const Called& called, const std::string& last_word) {
  for (const CLI::Option* option : called.verb->get_options())
    if (static_cast<int>(option->results().size()) > option->get_items_expected_max())
      return Problem{.where = option->get_name(), .limit = "is given more than once", .cure = "keep one"};
  return Problem{.where = last_word,
                 .limit = "needs a value behind the option",
                 .cure = meaning(called, called.verb->get_option_no_throw(last_word))};
}

template <class Number>
bool reads(const std::string& word) {
  Number number{};
  return CLI::detail::lexical_cast(word, number);
}

/// Reports a value that is not a number although the option requires one.
std::optional<Problem> no_number(const Called& called) {
  for (const CLI::Option* option : called.verb->get_options()) {
    if (option->count() == 0) continue;
    const std::string type = option->get_type_name(), word = option->results().front();
    const bool whole = type.starts_with("INT") || type.starts_with("UINT");
    if ((whole && !reads<std::int64_t>(word)) || (type.starts_with("FLOAT") && !reads<double>(word)))
      return Problem{.where = option->get_name(),
                     .value = word,
                     .limit = whole ? "must be a whole number" : "must be a number without a unit",
                     .cure = meaning(called, option)};
  }
  return {};
}

/// Reports a value that is out of the limits of integer_in().
std::optional<Problem> out_of_range(const Called& called) {
  for (CLI::Option* option : called.verb->get_options())
    for (std::string word : option->results()) {
      std::string limit;
      try {
        limit = (*option->get_validator(0))(word);
      } catch (const CLI::OptionNotFound&) {
        break;  // the option allows any value
      }
      if (!limit.empty())
        return Problem{.where = option->get_name(), .value = word, .limit = limit, .cure = called.help()};
    }
  return {};
}

std::optional<Problem> excluded(const Called& called) {
  for (const CLI::Option* option : called.verb->get_options())
    for (const CLI::Option* other : option->get_excludes())
      if (option->count() > 0 && other->count() > 0)
        return Problem{.where = option->get_name(),
                       .limit = "cannot be combined with " + other->get_name(),
                       .cure = "leave out one of the two options"};
  return {};
}

Problem problem_of(const Called& called, const CLI::ParseError& error, const std::string& last_word) {
  const std::vector<std::string> left = called.verb->remaining(true);
  // An unknown word is reported, because it explains why an argument is missing.
  if (!left.empty()) return unknown_word(called, left.front());
  if (!verbs_of(*called.verb).empty())
    return {.where = called.path,
            .limit = fmt::format("needs a command: {}", fmt::join(verbs_of(*called.verb), ", ")),
            .cure = called.help()};
  std::optional<Problem> found;
  if (dynamic_cast<const CLI::RequiredError*>(&error)) found = missing(called);
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) found = wrong_count(called, last_word);
  if (dynamic_cast<const CLI::ConversionError*>(&error)) found = no_number(called);
  if (dynamic_cast<const CLI::ValidationError*>(&error)) found = out_of_range(called);
  if (dynamic_cast<const CLI::ExcludesError*>(&error)) found = excluded(called);
  return found ? *found : Problem{called.path, "", error.what(), called.help()};
}

}  // namespace

Exit usage_error(CLI::App& app, const CLI::ParseError& error, const std::string& last_word) {
  std::ostringstream asked_for, ignored;
  if (app.exit(error, asked_for, ignored) == 0) {
    print(asked_for.str());
    return Exit::ok;
  }
  const Called called(app);
  // A call without arguments prints the help.
  if (called.verb == &app && app.remaining(true).empty()) {
    print(app.help(), stderr);
    return Exit::bad_input;
  }
  return refused({problem_of(called, error, last_word)});
}

}  // namespace cli
