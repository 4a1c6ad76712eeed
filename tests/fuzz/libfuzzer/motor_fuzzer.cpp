// SPDX-License-Identifier: Apache-2.0
// Fuzzes the motor file's reader with arbitrary bytes. The result is a sheet, or problems with messages. An
// accepted sheet is checked for consistency and printed. It is converted to a motor model and, if possible,
// to a first scenario.
#include <unistd.h>

#include <cstdint>
#include <fstream>

#include "files/scenario_on_disk.hpp"
#include "sixstep/design/loops/drive_design.hpp"
#include "tests/fuzz/libfuzzer/complaints.hpp"
#include "text/motor/motor_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string file = "/dev/shm/motor." + std::to_string(::getpid()) + ".toml";
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  const auto sheet = files::read_sheet(file);
  if (!sheet) {
    fuzzing::must_say_something(sheet.problems());
    return 0;
  }
  const auto check = sixstep::design::check_sheet(*sheet);
  if (!check)
    fuzzing::must_say_something(check.problems());
  else if (text::sheet_table(*sheet).empty() || text::model_table(*sheet, *check).empty())
    std::abort();
  const auto model = sixstep::design::motor_model(*sheet);
  if (!model) {
    fuzzing::must_say_something(model.problems());
    return 0;
  }
  using sixstep::control::Mode;
  for (const Mode mode : {Mode::current, Mode::speed, Mode::position}) {
    const auto design = sixstep::design::design_drive(*model, {.mode = mode});
    if (!design) fuzzing::must_say_something(design.problems());
  }
  return 0;
}
