// SPDX-License-Identifier: Apache-2.0
#include "text/contest/contest_entries.hpp"

#include <utility>

#include "sixstep/analysis/verify/robust.hpp"
#include "text/scenario/scenario_text.hpp"

namespace text {
namespace {

base::Result<study::Scenario> scenario_of(const analysis::Contestant& who,
                                          const std::vector<analysis::ContestKey>& keys,
                                          const std::string& common, const Resolve& resolve) {
  ReadOptions options{.overrides = {}, .resolve = resolve};
  for (const analysis::ContestKey& key : keys) options.overrides.push_back({key.path, key.value});
  base::Result<study::Scenario> scenario = read_scenario_text("the common scenario", common, options);
  if (!scenario) return scenario;
  scenario->title = std::string(who.name) + ": " + scenario->title;
  scenario->notes = who.sentence;
  scenario->spread = analysis::tolerance_spread(scenario->sheet);
  return scenario;
}

}  // namespace

std::vector<analysis::ContestEntry> contest_entries(const analysis::ContestBench& bench,
                                                    const Resolve& resolve,
                                                    std::span<const analysis::Contestant> all) {
  const std::string common = scenario_text(bench.scenario);
  std::vector<analysis::ContestEntry> out;
  for (const analysis::Contestant& who : all) {
    const base::Result<std::vector<analysis::ContestKey>> keys = analysis::keys_of(who, bench);
    if (keys)
      out.push_back({&who, *keys, scenario_of(who, *keys, common, resolve)});
    else
      out.push_back({&who, {}, keys.problems()});
  }
  return out;
}

}  // namespace text
