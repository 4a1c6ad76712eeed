// SPDX-License-Identifier: Apache-2.0
// Bytes into the scenario reader: it answers with a scenario or with problems that say something, never with
// a crash. What it accepts must also compile, or say why not.
#include <cstdint>
#include <cstdlib>

#include "io/scenario_file.hpp"
#include "sixstep/study/compile.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  const auto scenario = io::read_scenario_text("fuzz.toml", std::move(text));
  if (!scenario) {
    if (scenario.problems().empty()) std::abort();
    for (const auto& problem : scenario.problems())
      if (problem.where.empty() || problem.limit.empty()) std::abort();
    return 0;
  }
  const auto compiled = sixstep::study::compile(*scenario);
  if (!compiled && compiled.problems().empty()) std::abort();
  return 0;
}
