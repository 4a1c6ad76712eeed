// SPDX-License-Identifier: Apache-2.0
// A host, native or under an emulator of user programs: PROGRAM [STEPS].
#include <cstdio>
#include <cstdlib>

#include "tests/target/platform/platform.hpp"

#ifdef TARGET_SIGHTS
#include <map>
#include <string>
#endif

namespace target {
namespace {
std::uint32_t steps = 10000;
}

void put(char c) { std::putchar(c); }
std::uint32_t steps_wanted() { return steps; }

#ifdef TARGET_SIGHTS
namespace {
std::string walked;
std::map<std::string, unsigned> sights;
}  // namespace
void begins(const char* block) { walked = block; }
void saw(const char* what, bool it_is) { sights[walked + ": " + what] += it_is ? 1 : 0; }
void tell_sights() {
  for (const auto& [what, times] : sights) std::printf("# %u %s\n", times, what.c_str());
}
#else
void tell_sights() {}
#endif

}  // namespace target

int main(int argc, char** argv) {
  if (argc > 1) target::steps = static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10));
  target::run();
  target::tell_sights();
  return 0;
}
