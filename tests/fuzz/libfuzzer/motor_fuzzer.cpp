// SPDX-License-Identifier: Apache-2.0
// Bytes into the motor file's reader: a sheet, or problems that say something. A sheet that is accepted is
// held against itself, shown, made a model and, where that works, a first scenario.
#include <unistd.h>

#include <cstdint>
#include <fstream>

#include "io/motor_text.hpp"
#include "io/scenario_file.hpp"
#include "sixstep/study/first_scenario.hpp"
#include "tests/fuzz/libfuzzer/complaints.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string file = "/dev/shm/motor." + std::to_string(::getpid()) + ".toml";
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  const auto sheet = io::read_sheet(file);
  if (!sheet) {
    fuzzing::must_say_something(sheet.problems());
    return 0;
  }
  const auto check = sixstep::design::check_sheet(*sheet);
  if (!check)
    fuzzing::must_say_something(check.problems());
  else if (io::sheet_table(*sheet).empty() || io::model_table(*sheet, *check).empty())
    std::abort();
  sixstep::study::FirstWish wish;
  wish.motor = "fuzz";
  wish.sheet = *sheet;
  const auto first = sixstep::study::first_scenario(wish);
  if (first)
    fuzzing::must_compile(*first);
  else
    fuzzing::must_say_something(first.problems());
  return 0;
}
