// SPDX-License-Identifier: Apache-2.0
// The host, either native or under an emulator of user programs: PROGRAM [STEPS].
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
std::uint16_t refill(const char* name, std::uint8_t* to, std::uint16_t bytes) {
  static std::FILE* const file = std::fopen(name, "rb");
  return file ? static_cast<std::uint16_t>(std::fread(to, 1, bytes, file)) : std::uint16_t{0};
}
void call_entry(bool, void (*entry)()) { entry(); }

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
