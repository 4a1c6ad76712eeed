// SPDX-License-Identifier: Apache-2.0
#include "faces/loop/cores.hpp"

#include "faces/loop/installed.hpp"

namespace loop {

namespace {

/// Options of the emulator: virtual time advances only with instructions and never waits. So a run does not
/// depend on the load of the machine.
constexpr const char* deterministic = "shift=10,sleep=off";

std::vector<std::string> qemu(const char* program, const char* board) {
  return {program,
          "-M",
          board,
          "-nographic",
          "-monitor",
          "none",
          "-serial",
          "none",
          "-parallel",
          "none",
          "-icount",
          deterministic,
          "-semihosting-config",
          "enable=on,target=native",
          "-kernel"};
}

Core cortex(std::string_view name, std::string_view title, const char* cpu, const char* board,
            const std::vector<std::string>& more = {}) {
  Core core{name,
            title,
            {"arm-none-eabi-g++", std::string("-mcpu=") + cpu, "-mthumb", "-Wno-psabi"},
            qemu("qemu-system-arm", board),
            "cortex_m.S",
            "cortex_m.ld",
            {"-lgcc"}};
  core.compiler.insert(core.compiler.end(), more.begin(), more.end());
  return core;
}

/// The AVR. clang 14 to 16 produce wrong code for it (docs/reference/core-bits.md). The compiler's flags are
/// in a file in the program's folder, because images to flash use the same file. The flags disable LLVM's
/// replacement of branches and its tables for switches, which cost a fifth more cycles on a chip that shifts
/// bit by bit.
Core avr() {
  return {.name = "avr",
          .title = "ATmega2560",
          .compiler = {"clang++-19"},
          .emulator = {avr_board_program()},
          .start_up = {},
          .linker_script = {},
          .libraries = {},
          .by_registers = true,
          .linker = {"avr-gcc", "-mmcu=atmega2560"}};
}

}  // namespace

std::span<const Core> cores() {
  static const std::vector<Core> all = [] {
    std::vector<Core> made;
    made.push_back(cortex("cortex-m0", "Cortex-M0", "cortex-m0", "microbit"));
    made.push_back(cortex("cortex-m4", "Cortex-M4F", "cortex-m4", "mps2-an386",
                          {"-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"}));
    std::vector<std::string> virt = qemu("qemu-system-riscv32", "virt");
    virt.insert(virt.end() - 1, {"-bios", "none"});
    made.push_back({"riscv",
                    "RV32IMC",
                    {"riscv64-unknown-elf-g++", "-march=rv32imc", "-mabi=ilp32"},
                    std::move(virt),
                    "riscv.S",
                    "riscv.ld",
                    {"-Wl,--no-warn-rwx-segments", "-lgcc"}});
    made.push_back(avr());
    return made;
  }();
  return all;
}

}  // namespace loop
