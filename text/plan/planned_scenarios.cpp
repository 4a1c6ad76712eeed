// SPDX-License-Identifier: Apache-2.0
#include "text/plan/planned_scenarios.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>

#include "sixstep/analysis/verify/robust.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/scenario/spread.hpp"
#include "text/keys/decimal_number.hpp"

namespace text {
namespace {

/// Returns a Resolve that calls `find` only once for each name.
Resolve remembered(Resolve find) {
  struct Memory {
    std::mutex guard;
    std::map<std::tuple<Naming::Kind, std::string, std::string>, base::Result<NamedText>> found;
  };
  if (!find) return find;
  return [find = std::move(find), memory = std::make_shared<Memory>()](const Naming& naming) {
    const std::lock_guard lock(memory->guard);
    const auto key = std::make_tuple(naming.kind, naming.name, naming.from);
    auto known = memory->found.find(key);
    if (known == memory->found.end()) known = memory->found.emplace(key, find(naming)).first;
    return known->second;
  };
}

/// Keys with the same value in all runs: keys that determine the table's columns, and the names of the
/// scenario.
constexpr std::string_view same_in_all[] = {"require", "compare", "record", "spread",
                                            "title",   "notes",   "extends"};

std::string table_of(const std::string& key) { return key.substr(0, key.find_first_of(".[")); }

bool spread_already(const study::Scenario& scenario, const study::Spread& spread) {
  return std::any_of(scenario.spread.begin(), scenario.spread.end(),
                     [&](const study::Spread& other) { return other.key == spread.key; });
}

std::string first_of(const analysis::Axis& axis, bool last) {
  if (!axis.values.empty()) return last ? axis.values.back() : axis.values.front();
  return base::written(last ? axis.to : axis.from);
}

}  // namespace

/// The scenarios of the last few points, because all drives of a point use the same scenario.
struct PlannedScenarios::Recent {
  static constexpr std::size_t most = 16;
  std::mutex guard;
  std::map<std::vector<std::string>, std::shared_ptr<const base::Result<study::Scenario>>> read;
};

PlannedScenarios::PlannedScenarios(PlannedText of, analysis::Plan plan)
    : of_(std::move(of)), plan_(std::move(plan)), recent_(std::make_unique<Recent>()) {
  of_.options.resolve = remembered(std::move(of_.options.resolve));
}

PlannedScenarios::~PlannedScenarios() = default;

base::Result<study::Scenario> PlannedScenarios::nominal() const { return read(of_.options); }

base::Result<study::Scenario> PlannedScenarios::read(const ReadOptions& options) const {
  base::Result<study::Scenario> scenario = read_scenario_text(of_.name, of_.text, options);
  if (!scenario || !of_.sheet_tolerances) return scenario;
  const auto add = [&scenario](std::vector<study::Spread> spreads) {
    for (study::Spread& spread : spreads)
      if (!spread_already(*scenario, spread)) scenario->spread.push_back(std::move(spread));
  };
  add(analysis::tolerance_spread(scenario->sheet));
  add(analysis::hall_edge_spread(*scenario));
  if (base::Problems problems = study::check_spread(*scenario); !problems.empty()) return problems;
  return scenario;
}

base::Result<study::Scenario> PlannedScenarios::at(const std::vector<std::string>& point) const {
  ReadOptions options = of_.options;
  for (std::size_t k = 0; k < point.size(); ++k)
    if (!plan_.axes[k].strays) options.overrides.push_back({plan_.axes[k].key, point[k]});
  base::Result<study::Scenario> scenario = read(options);
  for (std::size_t k = 0; k < point.size() && scenario; ++k) {
    if (!plan_.axes[k].strays) continue;
    const std::optional<double> x = number_alone(point[k]);
    scenario =
        x ? study::strayed_to(*scenario, plan_.axes[k].key, *x)
          : base::Problem{plan_.axes[k].key, point[k], "is not a number, but strays = true requires numbers",
                          "write numbers as values of this key, or remove its strays = true"};
  }
  return scenario;
}

base::Result<analysis::PlannedRun> PlannedScenarios::run(std::size_t n) const {
  return run(analysis::point_of_run(plan_, n), analysis::drive_of_run(plan_, n).value_or(0));
}

base::Result<analysis::PlannedRun> PlannedScenarios::run(const std::vector<std::string>& point,
                                                         std::size_t drive) const {
  std::shared_ptr<const base::Result<study::Scenario>> read;
  {
    const std::lock_guard lock(recent_->guard);
    if (const auto known = recent_->read.find(point); known != recent_->read.end()) read = known->second;
  }
  if (!read) {
    read = std::make_shared<const base::Result<study::Scenario>>(at(point));
    const std::lock_guard lock(recent_->guard);
    if (recent_->read.size() >= Recent::most) recent_->read.clear();
    recent_->read.emplace(point, read);
  }
  if (!*read) return read->problems();
  if (plan_.drives == 0) return analysis::PlannedRun{**read, {}};
  return analysis::planned_drive(**read, plan_.seed, drive);
}

base::Problems PlannedScenarios::check() const {
  base::Problems problems;
  std::vector<std::string> begin;
  for (const analysis::Axis& axis : plan_.axes) begin.push_back(first_of(axis, false));
  for (std::size_t k = 0; k < plan_.axes.size(); ++k) {
    const std::string& key = plan_.axes[k].key;
    if (std::find(std::begin(same_in_all), std::end(same_in_all), table_of(key)) != std::end(same_in_all)) {
      problems.push_back(
          {fmt::format("vary[{}].key", k), key, "must be the same in all runs of a plan",
           "vary keys of the motor, board, control or load; requirements are the same for all runs"});
      continue;
    }
    base::Result<study::Scenario> read = at(begin);
    if (!read && !plan_.axes.empty()) {
      std::vector<std::string> end = begin;
      end[k] = first_of(plan_.axes[k], true);
      if (at(end)) continue;
      for (const base::Problem& problem : read.problems())
        if (std::find(problems.begin(), problems.end(), problem) == problems.end())
          problems.push_back(problem);
    }
  }
  return problems;
}

}  // namespace text
