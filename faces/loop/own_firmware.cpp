// SPDX-License-Identifier: Apache-2.0
#include "faces/loop/own_firmware.hpp"

#include <algorithm>
#include <filesystem>

#include "text/firmware_map/firmware_map.hpp"

namespace loop {

namespace {

namespace fs = std::filesystem;

/// An option of the board's program (faces/loop/avr/board.cpp) with pins: "--hall=K0,K1,K2".
std::string pins(const char* option, const std::vector<std::string>& names) {
  std::string word = option;
  for (const std::string& name : names) word += (word.back() == '=' ? "" : ",") + name.substr(1);
  return word;
}

}  // namespace

base::Result<Core> own_firmware(const std::string& path, const std::string& text) {
  const base::Result<text::FirmwareMap> map = text::read_firmware_map(path, text);
  if (!map) return map.problems();
  const fs::path elf = fs::path(path).parent_path() / map->elf;
  std::error_code none;
  if (!fs::is_regular_file(elf, none))
    return base::Problem{path + ": elf", map->elf, "is no file",
                         "build the firmware first, or name the ELF file that the linker wrote"};
  const std::span<const Core> known = cores();
  const auto avr =
      std::find_if(known.begin(), known.end(), [](const Core& core) { return core.by_registers; });
  Core core = *avr;
  core.elf = elf.string();
  core.setpoint_range = map->setpoint_range;
  std::string inputs = "--inputs=";
  for (const int input : map->currents) inputs += std::to_string(input) + ",";
  core.emulator.insert(core.emulator.end(),
                       {pins("--hall=", map->hall), pins("--upper=", map->upper),
                        pins("--lower=", map->lower), inputs + std::to_string(map->potentiometer)});
  return core;
}

}  // namespace loop
