// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/man_page.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <string_view>
#include <vector>

#include "faces/cli/exit_code.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/keys/key_tree.hpp"

namespace cli {
namespace {

/// Escapes hyphens and backslashes for roff. Wraps lines at 78 characters, and no line begins like a roff
/// command.
std::string roff(std::string_view text) {
  constexpr std::size_t longest_line = 78;
  std::string out;
  std::size_t begin = 0;  // beginning of the line
  for (std::size_t n = 0; n < text.size(); ++n) {
    const char c = text[n];
    const std::size_t word = std::min(text.find(' ', n + 1), text.size()) - n;
    if (c == ' ' && out.size() - begin + word > longest_line) {
      out += '\n';
      begin = out.size();
      continue;
    }
    if (out.size() == begin && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    if (c == '\n') begin = out.size();
  }
  return out;
}

std::string bold(std::string_view text) { return fmt::format("\\fB{}\\fR", roff(text)); }
std::string italic(std::string_view text) { return fmt::format("\\fI{}\\fR", roff(text)); }

/// An entry with a term and its meaning.
std::string entry(const std::string& term, std::string_view meaning) {
  return fmt::format(".TP\n{}\n{}\n", term, roff(meaning));
}

bool is_shown(const CLI::Option& option) { return option.get_name() != "--help"; }

std::string term_of(const CLI::Option& option) {
  if (option.get_positional()) return italic(option.get_name(true));
  std::string term = bold(option.get_name());
  if (option.get_items_expected_max() > 0) term.append(" ").append(italic("value"));
  return term;
}

std::string meaning_of(const CLI::Option& option) {
  std::string text = option.get_description();
  if (!option.get_default_str().empty()) text.append("; default ").append(option.get_default_str());
  return text;
}

std::string synopsis(const std::string& path, const CLI::App& verb) {
  std::string line = bold(path);
  bool options = false;
  for (const CLI::Option* option : verb.get_options()) {
    if (!option->get_positional()) {
      options = options || is_shown(*option);
      continue;
    }
    const std::string name = italic(option->get_name(true)) + (option->get_expected_max() > 1 ? " ..." : "");
    line += option->get_required() ? fmt::format(" {}", name) : fmt::format(" [{}]", name);
  }
  return options ? fmt::format("{} [{} ...]", line, italic("option")) : line;
}

using Verbs = std::vector<std::pair<std::string, const CLI::App*>>;

/// Adds the command lines of all verbs and their subcommands.
void add_verbs(const std::string& path, const CLI::App& app, Verbs& out) {
  const auto inner = app.get_subcommands([](const CLI::App*) { return true; });
  if (inner.empty()) out.emplace_back(path, &app);
  for (const CLI::App* verb : inner) add_verbs(path + " " + verb->get_name(), *verb, out);
}

std::string commands(const CLI::App& app, const Verbs& verbs) {
  std::string text = ".SH COMMANDS\n";
  for (const auto& [path, verb] : verbs) {
    text += fmt::format(".SS {}\n{}.\n", roff(path), roff(verb->get_description()));
    for (const CLI::Option* option : verb->get_options())
      if (is_shown(*option)) text += entry(term_of(*option), meaning_of(*option));
    if (verb->get_footer() != app.get_footer()) text += fmt::format(".PP\n{}", roff(verb->get_footer()));
  }
  return text;
}

/// The keys and tables at the root of a file.
std::string keys_of_file(const std::vector<text::KeyEntry>& keys) {
  std::string text;
  for (const text::KeyEntry* key : text::keys_in(keys, "")) {
    const std::string name = key->type == text::KeyType::table  ? fmt::format("[{}]", key->path)
                             : key->type == text::KeyType::list ? fmt::format("[[{}]]", key->path)
                                                                : key->path;
    text += entry(bold(name), std::string(key->about.meaning) + (key->about.required ? " (required)" : ""));
  }
  return text;
}

std::string files() {
  std::string text =
      ".SH SCENARIO FILES\n"
      "A scenario is a TOML file.\nThe name of every key contains its unit. For an unknown key, the error\n"
      "names the key that is probably meant.\n"
      "These are its keys and tables;\n"
      ".B sixstep help\n.I TABLE\nlists the keys of a table, and\n.B sixstep help\n.I KEY\n"
      "prints unit, range, default and words.\n";
  return text + keys_of_file(text::scenario_keys()) +
         ".PP\nA motor file is a TOML file of the motor's data sheet;\n.B sixstep motor new\nwrites one to "
         "be "
         "filled in.\n"
         ".SH PLAN FILES\n"
         "A plan is a TOML file that names a scenario and the keys that differ\nbetween its runs;\n"
         ".B sixstep run\n"
         "accepts a plan wherever it accepts a\nscenario.\nThese are its keys:\n" +
         keys_of_file(text::plan_keys());
}

constexpr std::string_view examples =
    ".SH EXAMPLES\nA scenario to start from, its report, and the same scenario with a lower bus voltage:\n.PP\n.nf\n.RS\nsixstep new first\nsixstep run first.toml \\-\\-html first.html\nsixstep run first.toml \\-\\-set supply.voltage_V=20\n.RE\n.fi\n.PP\nThree PWM periods, and a hundred drives within the tolerances, in a file that a\nlater call continues:\n.PP\n.nf\n.RS\nsixstep run first.toml \\-\\-vary pwm.period_s=20us:60us:3\nsixstep run first.toml \\-\\-tolerances \\-\\-runs 100 \\-\\-store first.sqlite\n.RE\n.fi\n.PP\nGains of a speed cascade, checked over the sheet's tolerances, as a\nscenario:\n.PP\n.nf\n.RS\nsixstep design maxon\\-251601 \\-\\-mode speed \\-\\-toml drive.toml\n.RE\n.fi\n";

}  // namespace

std::string man_page(const CLI::App& app) {
  Verbs verbs;
  add_verbs("sixstep", app, verbs);
  std::string text = fmt::format(".TH SIXSTEP 1 \"\" \"sixstep {}\" \"User Commands\"\n", SIXSTEP_VERSION);
  text += fmt::format(".SH NAME\nsixstep \\- {}\n.SH SYNOPSIS\n.nf\n", roff(app.get_description()));
  for (const auto& [path, verb] : verbs) text += fmt::format("{}\n", synopsis(path, *verb));
  text +=
      ".fi\n.SH DESCRIPTION\n"
      "Simulates motor, bridge, sensors and the controller code itself, finds every\n"
      "commutation, diode and PWM event exactly, and reports whether your requirements\n"
      "hold.\nEvery number states its unit, frame and source.\n";
  text += commands(app, verbs) + files();
  text += ".SH EXIT STATUS\n";
  for (const ExitMeaning& exit : exit_meanings)
    text += entry(bold(std::to_string(static_cast<int>(exit.code))), exit.meaning);
  text += ".SH ENVIRONMENT\n" + entry(bold("NO_COLOR"), "if set and not empty, the output has no colours");
  return text + std::string(examples);
}

}  // namespace cli
