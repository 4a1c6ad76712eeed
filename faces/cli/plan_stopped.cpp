// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/plan_stopped.hpp"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <utility>

#include "files/controller_watch.hpp"

namespace cli {
namespace {

std::string stopped_beside(const files::PlanStore& store) {
  return store.path().empty() ? "" : store.path() + ".stopped";
}

analysis::RunRecord stopped_row(const ReadPlan& plan, std::size_t number, std::string why) {
  return analysis::RunRecord::without_figures(plan.columns, number,
                                              analysis::point_of_run(plan.scenarios->plan(), number),
                                              analysis::RunEnd::fault, std::move(why));
}

}  // namespace

void note_stopped_runs(const files::PlanStore& store, bool goes_on) {
  const std::string path = stopped_beside(store);
  std::error_code none;
  if (!goes_on && !path.empty()) std::filesystem::remove(path, none);
  files::note_stopped_runs_in(path);
}

std::set<std::size_t> take_stopped_runs(const ReadPlan& plan, files::PlanStore& store) {
  std::set<std::size_t> taken;
  std::ifstream file(stopped_beside(store));
  for (std::string line; std::getline(file, line);) {
    const std::size_t tab = line.find('\t');
    std::size_t number = 0;
    const char* const end = line.data() + std::min(tab, line.size());
    if (tab == line.npos || std::from_chars(line.data(), end, number).ptr != end) continue;
    if (number >= analysis::runs_of(plan.scenarios->plan()) || store.has(number)) continue;
    if (taken.insert(number).second) store.add(stopped_row(plan, number, line.substr(tab + 1)));
  }
  return taken;
}

void forget_stopped_runs(const files::PlanStore& store) {
  files::note_stopped_runs_in("");
  std::error_code none;
  if (!store.path().empty()) std::filesystem::remove(stopped_beside(store), none);
}

}  // namespace cli
