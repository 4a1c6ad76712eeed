// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/plan_storing.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "sixstep/base/written.hpp"
#include "text/escape/escape.hpp"
#include "text/plan/plan_file.hpp"
#include "text/scenario/scenario_text.hpp"

namespace cli {
namespace {

/// In a problem, replaces the store's words by the names of the options.
void in_store_options(base::Problem& problem) {
  const auto replace = [](std::string& text, std::string_view word, std::string_view option) {
    if (const std::size_t at = text.find(word); at != std::string::npos)
      text.replace(at, word.size(), option);
  };
  replace(problem.cure, "(resume)", "with --resume");
  replace(problem.cure, "(force)", "with --force");
}

}  // namespace

base::Result<files::PlanStore> store_of(const RunArguments& a, const ReadPlan& plan, std::string identity) {
  files::StoredPlan stored{.plan = std::move(identity),
                           .inputs = base::written_hex(plan.origin.digest),
                           .title = plan.title,
                           .motor = plan.origin.motor,
                           .scenario = plan.origin.scenario,
                           .command = plan.origin.command,
                           .scenario_text = text::scenario_text(plan.nominal),
                           .columns = plan.columns};
  return store_at(store_path(a, plan.name), a.plan.resume, a.paths.force, std::move(stored));
}

std::string kept_in(const std::string& store) {
  if (store.empty() || !std::filesystem::exists(store)) return "";
  return fmt::format("the finished runs are in {}; to continue, repeat the command with --resume",
                     text::visible(store));
}

std::string left_behind(const std::vector<std::string>& partial_files, const std::string& store) {
  std::string files;
  for (const std::string& file : partial_files) files += (files.empty() ? "" : ", ") + text::visible(file);
  std::string kept = kept_in(store);
  if (files.empty()) return kept;
  return "the finished part is in " + files + (kept.empty() ? "" : "; " + kept);
}

std::string unit_of(const std::string& key) {
  const base::Result<std::string> unit = text::unit_of_key(key);
  return unit ? *unit : std::string();
}

base::Result<files::PlanStore> store_at(const std::string& path, bool resume, bool force,
                                        files::StoredPlan plan) {
  base::Result<files::PlanStore> store = resume ? files::PlanStore::resume(path, std::move(plan))
                                                : files::PlanStore::create(path, std::move(plan), force);
  if (store) return store;
  base::Problems problems = store.problems();
  for (base::Problem& problem : problems) in_store_options(problem);
  return problems;
}

}  // namespace cli
