// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/not_called.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
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

/// The innermost verb that was read, and the words that lead there.
struct Called {
  const CLI::App* verb;
  std::string path = "sixstep";

  explicit Called(const CLI::App& app) : verb(&app) {
    for (auto inner = verb->get_subcommands(); !inner.empty(); inner = verb->get_subcommands()) {
      verb = inner.front();
      path.append(" ").append(verb->get_name());
    }
  }
  std::string help() const { return path + " --help tells more"; }
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

/// Short words differ in a letter or two by a slip: nearest() asks for more likeness.
std::string nearest_verb(const std::string& word, const std::vector<std::string>& verbs) {
  for (int distance = 1; distance <= 2; ++distance)
    for (const std::string& verb : verbs)
      if (text::edit_distance(word, verb) <= distance) return verb;
  return "";
}

/// A key of the scenario that was written as an option: "--duration".
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
    return {word, "", "is no command of " + called.path,
            fmt::format("did you mean sixstep run {}?", text::shell_word(word))};
  std::string near = is_option ? text::nearest(word, options_of(*called.verb)) : nearest_verb(word, verbs);
  if (is_option && near.empty()) near = setting_meant(*called.verb, word);
  const char* kind = is_option || verbs.empty() ? "argument" : "command";
  return {.where = word,
          .limit = fmt::format("is no {} of {}", kind, called.path),
          .cure = near.empty() ? called.path + " --help lists them" : fmt::format("did you mean {}?", near)};
}

/// "--csv" of "--csv: 1 required TEXT missing", "FILE" of "FILE is required".
std::string option_in(const std::string& told) { return told.substr(0, told.find_first_of(": ")); }

Problem missing(const Called& called, const std::string& told) {
  const std::string name = option_in(told);
  const CLI::Option* option = called.verb->get_option_no_throw(name);
  return {.where = called.path,
          .limit = fmt::format("needs {}{}", name, option ? ": " + option->get_description() : ""),
          .cure = called.help()};
}

Problem wrong_count(const Called& called, const std::string& told) {
  const std::string name = option_in(told);
  if (told.find("missing") == std::string::npos)
    return {.where = name, .limit = "is given more than once", .cure = "keep one"};
  const CLI::Option* option = called.verb->get_option_no_throw(name);
  return {.where = name,
          .limit = "needs a value behind it",
          .cure = option ? "it means: " + option->get_description() : called.help()};
}

/// "Could not convert: --points = 1e9": the type that the option has says what it takes.
Problem no_number(const Called& called, const std::string& told) {
  const std::string name = option_in(told.substr(told.find(": ") + 2));
  const std::size_t equals = told.find(" = ");
  const CLI::Option* option = called.verb->get_option_no_throw(name);
  const bool whole = option && option->get_type_name() != "FLOAT";
  return {.where = name,
          .value = equals == std::string::npos ? "" : told.substr(equals + 3),
          .limit = whole ? "must be a whole number, in digits alone" : "must be a number, without its unit",
          .cure = option ? "it means: " + option->get_description() : called.help()};
}

/// "--jobs: Value 0 not in range 1 to 1024".
Problem out_of_range(const Called& called, const std::string& told) {
  constexpr std::string_view value = "Value ", range = " not in range ";
  const std::size_t begin = told.find(value), end = told.find(range);
  if (begin == std::string::npos || end == std::string::npos) return {called.path, "", told, called.help()};
  return {.where = option_in(told),
          .value = told.substr(begin + value.size(), end - begin - value.size()),
          .limit = "must be a whole number in " + told.substr(end + range.size()),
          .cure = called.help()};
}

Problem problem_of(const Called& called, const CLI::ParseError& error) {
  const std::vector<std::string> left = called.verb->remaining(true);
  const std::string told = error.what();
  // What nobody takes explains what is missing.
  if (!left.empty()) return unknown_word(called, left.front());
  if (!verbs_of(*called.verb).empty())
    return {.where = called.path,
            .limit = fmt::format("needs a command: {}", fmt::join(verbs_of(*called.verb), ", ")),
            .cure = called.help()};
  if (dynamic_cast<const CLI::RequiredError*>(&error)) return missing(called, told);
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) return wrong_count(called, told);
  if (dynamic_cast<const CLI::ConversionError*>(&error)) return no_number(called, told);
  if (dynamic_cast<const CLI::ValidationError*>(&error)) return out_of_range(called, told);
  const std::string_view excludes = " excludes ";
  if (const std::size_t cut = told.find(excludes); cut != std::string::npos)
    return {.where = told.substr(0, cut),
            .limit = "does not go together with " + told.substr(cut + excludes.size()),
            .cure = "leave one of them out"};
  return {called.path, "", told, called.help()};
}

}  // namespace

Exit not_called(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream asked_for, ignored;
  if (app.exit(error, asked_for, ignored) == 0) {
    print(asked_for.str());
    return Exit::ok;
  }
  const Called called(app);
  // Who calls the program without a word wants to know what it is.
  if (called.verb == &app && app.remaining(true).empty()) {
    print(app.help(), stderr);
    return Exit::bad_input;
  }
  return refused({problem_of(called, error)});
}

}  // namespace cli
