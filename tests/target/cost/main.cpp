// SPDX-License-Identifier: Apache-2.0
// Calls the entries of a drive with the inputs of a recorded run, one call per record. It prints the number
// of calls and a digest of all answers. Other programs count: avr_board.cpp, count_instructions.cpp.
#include "tests/target/cost/entries.hpp"
#include "tests/target/platform/platform.hpp"
#include "tests/target/platform/print.hpp"
#include "tests/target/walk/legs.hpp"

extern "C" {
void call_tick();  ///< in calls.S, or defined below
void call_hall();
}
#if !defined TARGET_CALLS_ARE_MARKED
void call_tick() { target::call_entry(false, entry_tick); }
void call_hall() { target::call_entry(true, entry_hall); }
#endif

namespace target {

void run() {
  static std::uint8_t chunk[32 * Record::bytes];
  Digest digest;
  std::uint32_t calls = 0;
  for (std::uint16_t bytes = sizeof chunk; bytes == sizeof chunk;) {
    bytes = refill(TARGET_TEXT(TARGET_DRIVE) ".bin", chunk, sizeof chunk);
    for (std::uint16_t n = 0; n + Record::bytes <= bytes; n = static_cast<std::uint16_t>(n + Record::bytes)) {
      Record record{};
      record.fields(Reader{chunk + n});
      give(record);
      record.kind != 0 ? call_hall() : call_tick();
#if TARGET_FIELD
      mix_legs(digest, *answer);
#else
      mix_command(digest, *answer);
#endif
      ++calls;
    }
  }
  print("answers ");
  print_number(calls);
  print(" ");
  print_hex(digest.value());
  print("\n");
}

}  // namespace target
