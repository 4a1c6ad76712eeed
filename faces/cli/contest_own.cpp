// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/contest_own.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "files/controller_file.hpp"
#include "files/text_file.hpp"
#include "text/contest/own_cost.hpp"
#include "text/escape/escape.hpp"

namespace cli {
namespace {

/// Adds the problems of a file, with the option that names the file.
void tell_at(const std::string& option, const base::Problems& problems, base::Problems& found) {
  for (base::Problem problem : problems) {
    problem.where = problem.where.empty() ? option : option + " " + problem.where;
    found.push_back(std::move(problem));
  }
}

void take_controller(const std::string& file, Contestants& out, base::Problems& found) {
  const std::string path = std::filesystem::absolute(file).string();
  const base::Result<text::NamedText> loaded = files::load_controller(path);
  if (!loaded) return tell_at("--own", loaded.problems(), found);
  const sixstep_controller& is = *loaded->controller;
  const std::string_view name = is.name;
  if (std::any_of(out.all.begin(), out.all.end(), [&](const auto& other) { return other.name == name; }))
    found.push_back({"--own " + file, '"' + std::string(name) + '"', "is the name of another controller",
                     "give this controller a different name"});
  const std::string& keys = out.texts.emplace_back(
      fmt::format("control.drive = own; control.own.controller = {}", text::toml_text(path)));
  out.all.push_back({name, keys, is.sentence});
}

/// Adds the counts of a file of tools/own_cost.sh to the controller that the file names.
void take_count(const std::string& file, Contestants& out, base::Problems& found) {
  const base::Result<std::string> json = files::read_regular_text(file);
  if (!json) return tell_at("--own-cost", json.problems(), found);
  const base::Result<text::OwnCost> counted = text::own_cost_of(*json);
  if (!counted) return tell_at("--own-cost " + file, counted.problems(), found);
  const auto first_own = out.all.begin() + static_cast<std::ptrdiff_t>(analysis::contestants().size());
  const auto who = std::find_if(first_own, out.all.end(),
                                [&](const auto& own) { return own.name == counted->controller; });
  if (who == out.all.end()) {
    found.push_back({"--own-cost " + file, '"' + counted->controller + '"', "is not a controller of --own",
                     "also name this controller with --own, or leave its --own-cost out"});
    return;
  }
  who->tick = out.texts.emplace_back(counted->cost.tick);
  who->flash_bytes = out.texts.emplace_back(counted->cost.flash_bytes);
}

}  // namespace

base::Result<Contestants> contestants_of(const OwnArguments& own) {
  const std::span<const analysis::Contestant> library = analysis::contestants();
  Contestants out{{library.begin(), library.end()}, {}};
  base::Problems found;
  for (const std::string& file : own.files) take_controller(file, out, found);
  if (found.empty())
    for (const std::string& file : own.counts) take_count(file, out, found);
  if (!found.empty()) return found;
  return out;
}

void declare_own(CLI::App& verb, OwnArguments& own) {
  verb.add_option(
          "--own", own.files,
          "shared object of a user's controller, compared with the built-in controllers; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  verb.add_option(
          "--own-cost", own.counts,
          "file that tools/own_cost.sh --json wrote for one of these controllers, for the columns tick and flash; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
}

}  // namespace cli
