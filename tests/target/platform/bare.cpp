// SPDX-License-Identifier: Apache-2.0
// The common part of Cortex-M and RISC-V. Semihosting writes characters and reads files.
#include "faces/firmware/bare/semihosting.hpp"
#include "tests/target/platform/platform.hpp"

namespace target {

void put(char c) { write_character(c); }
std::uint16_t refill(const char* name, std::uint8_t* to, std::uint16_t bytes) {
  static Word file = 0;
  Word length = 0;
  while (name[length] != 0) ++length;
  if (file == 0) file = open_to_read(name, length);
  return file == 0 ? std::uint16_t{0} : static_cast<std::uint16_t>(read_file(file, to, bytes));
}
void call_entry(bool, void (*entry)()) { entry(); }
std::uint32_t steps_wanted() { return 10000; }

}  // namespace target
