// SPDX-License-Identifier: Apache-2.0
// Fuzzes the scenario reader with arbitrary bytes. The result is a scenario, or problems with messages, never
// a crash. An accepted scenario must compile or be refused with a message.
#include <cstdint>

#include "tests/fuzz/libfuzzer/complaints.hpp"
#include "text/scenario/scenario_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  const auto scenario = text::read_scenario_text("fuzz.toml", std::move(text));
  if (scenario)
    fuzzing::must_compile(*scenario);
  else
    fuzzing::must_say_something(scenario.problems());
  return 0;
}
