// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/help_command.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include "faces/cli/terminal.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/run/run.hpp"
#include "text/escape/escape.hpp"
#include "text/keys/key_advice.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/keys/key_tree.hpp"

namespace cli {
namespace {

using text::KeyEntry;

bool inside(const KeyEntry& entry, const std::string& table) { return entry.path.starts_with(table + "."); }

std::string line(const KeyEntry& entry) {
  const std::string unit = entry.about.unit.empty() ? "" : fmt::format(" [{}]", entry.about.unit);
  return fmt::format("  {:<38} {}{}\n", entry.path, entry.about.meaning, unit);
}

std::string overview(const std::vector<KeyEntry>& scenario, const std::vector<KeyEntry>& sheet,
                     const std::vector<KeyEntry>& plan) {
  std::string text = "Keys of a scenario file (details: sixstep help TABLE or sixstep help KEY):\n";
  for (const KeyEntry& entry : scenario)
    if (entry.path.find('.') == std::string::npos) text += line(entry);
  text += "Keys of a motor file and of [motor_override]:\n";
  for (const KeyEntry& entry : sheet) text += line(entry);
  text += "Keys of a plan file, which makes many runs of a scenario:\n";
  for (const KeyEntry& entry : plan)
    if (entry.path.find('.') == std::string::npos) text += line(entry);
  return text + "Commands: sixstep --help, and sixstep help COMMAND.\n";
}

std::string of_table(const std::vector<KeyEntry>& entries, const KeyEntry& table) {
  std::string text = text::help_text(table);
  for (const KeyEntry& entry : entries)
    if (inside(entry, table.path)) text += line(entry);
  return text;
}

std::string of_key(const KeyEntry& entry) {
  std::string text = text::help_text(entry);
  if (entry.path != "record.columns") return text;
  for (const study::Column& column : study::all_columns())
    text += fmt::format("    {:<20}{}\n", column.name, column.meaning);
  text += "  for a linear motor, in place of the columns for a rotary motor\n";
  const std::vector<study::Column>& linear = study::all_columns(design::MotorKind::linear);
  for (std::size_t n = 0; n < linear.size(); ++n)
    if (linear[n].name != study::all_columns()[n].name)
      text += fmt::format("    {:<20}{}\n", linear[n].name, linear[n].meaning);
  return text;
}

/// The entry whose path ends with this word, if there is exactly one such entry; else null.
const KeyEntry* by_name(const std::vector<KeyEntry>& entries, const std::string& key) {
  const KeyEntry* found = nullptr;
  for (const KeyEntry& entry : entries) {
    if (!entry.path.ends_with("." + key) || inside(entry, "motor_override") || inside(entry, "at")) continue;
    if (found) return nullptr;
    found = &entry;
  }
  return found;
}

bool holds(std::string_view text, std::string_view word) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  return std::search(text.begin(), text.end(), word.begin(), word.end(), same) != text.end();
}

/// The keys, and the words of keys, whose name or meaning contains `word`, one per line; empty if there are
/// none. Keys of `at`, `motor_override` and `compare` are left out, because they repeat keys of other tables.
std::string with_word(const std::vector<KeyEntry>& entries, std::string_view word) {
  std::string text;
  for (const KeyEntry& entry : entries) {
    if (inside(entry, "at") || inside(entry, "motor_override") || inside(entry, "compare")) continue;
    if (holds(entry.path, word) || holds(entry.about.meaning, word)) text += line(entry);
    for (const auto& [choice, meaning] : entry.choices)
      if (holds(choice, word) || holds(meaning, word))
        text += fmt::format("  {:<38} {}\n", fmt::format("{} = \"{}\"", entry.path, choice), meaning);
  }
  return text;
}

/// The verb of this name: `sixstep help COMMAND` means `sixstep COMMAND --help`. If a key has the same name,
/// the help of the key follows below the help of the command.
const CLI::App* command_of(const CLI::App& app, const std::string& name) {
  const auto found = app.get_subcommands([&](const CLI::App* verb) { return verb->get_name() == name; });
  return found.empty() ? nullptr : found.front();
}

Exit help_command(const CLI::App& app, const std::string& key) {
  const std::vector<KeyEntry>& scenario = text::scenario_keys();
  const std::vector<KeyEntry>& sheet = text::sheet_keys();
  const std::vector<KeyEntry>& plan = text::plan_keys();
  if (key.empty()) {
    print(overview(scenario, sheet, plan));
    return Exit::ok;
  }
  const CLI::App* const verb = command_of(app, key);
  const KeyEntry* const same = text::find_key(scenario, key);
  if (verb && same)
    print(fmt::format("{0} is a command and also a key of a scenario; the key follows below.\n\n", key));
  if (verb) print(verb->help(app.get_name()));
  if (const KeyEntry* entry = same) {
    if (verb) print(fmt::format("The key {} of a scenario:\n", key));
    print(is_table(*entry) ? of_table(scenario, *entry) : of_key(*entry));
    return Exit::ok;
  }
  if (verb) return Exit::ok;
  if (const KeyEntry* entry = text::find_key(sheet, key)) {
    print(text::help_text(*entry) + "  in a motor file or in [motor_override]\n");
    return Exit::ok;
  }
  if (const KeyEntry* entry = text::find_key(plan, key)) {
    print((is_table(*entry) ? of_table(plan, *entry) : of_key(*entry)) + "  in a plan file\n");
    return Exit::ok;
  }
  if (const KeyEntry* entry = by_name(scenario, key)) {
    print(of_key(*entry));
    return Exit::ok;
  }
  std::vector<std::string> known;
  for (const std::vector<KeyEntry>* entries : {&scenario, &sheet, &plan})
    for (const KeyEntry& entry : *entries) known.push_back(entry.path);
  std::string near = text::nearest(key, known);
  for (const std::string& path : known)  // a word such as "voltage_V" is the end of a path, and may be
                                         // misspelt
    if (near.empty() && text::edit_distance(path.substr(path.rfind('.') + 1), key) <= 1) near = path;
  constexpr std::size_t shortest_word = 3;
  const bool is_word = key.size() >= shortest_word &&
                       std::all_of(key.begin(), key.end(),
                                   [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; });
  if (near.empty() && is_word) {
    const std::string text = with_word(scenario, key) + with_word(sheet, key) + with_word(plan, key);
    if (!text.empty()) {
      print(fmt::format(
                "No key has the name {}. Keys and values that contain this word in their name or meaning:\n",
                text::visible(key)) +
            text);
      return Exit::ok;
    }
  }
  complain({{.where = key,
             .limit = "is not a key of a scenario or motor file",
             .cure = near.empty() ? "sixstep help lists all keys" : fmt::format("did you mean {}?", near)}});
  return Exit::bad_input;
}

/// `sixstep help motor new` means `sixstep motor new --help`.
Exit help_of_words(const CLI::App& app, const std::vector<std::string>& words) {
  if (words.size() < 2) return help_command(app, words.empty() ? "" : words.front());
  const CLI::App* at = &app;
  std::string before = app.get_name();
  for (std::size_t n = 0; n < words.size(); ++n) {
    const CLI::App* const next = command_of(*at, words[n]);
    if (next == nullptr) {
      complain({{.where = words[n],
                 .limit = "is not a command of " + before,
                 .cure = before + " --help lists all commands; give only one key at a time"}});
      return Exit::bad_input;
    }
    at = next;
    if (n + 1 < words.size()) before += " " + words[n];
  }
  print(at->help(before));
  return Exit::ok;
}

}  // namespace

Verb declare_help(CLI::App& app) {
  CLI::App& help = *app.add_subcommand("help", "explain a key, a table, a command, or all keys");
  const auto words = std::make_shared<std::vector<std::string>>();
  help.add_option("KEY", *words,
                  "key or table, such as supply.voltage_V, pwm or resistance_ohm; or the words of a command")
      ->expected(0, 3);
  return {&help, [&app, words](const std::string&) { return help_of_words(app, *words); }};
}

}  // namespace cli
