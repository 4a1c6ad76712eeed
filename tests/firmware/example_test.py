#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""example_test.py configs PROGRAM | cortex_m CLANG NM | avr CLANG NM

configs: the command in the comment of each drive_config.hpp writes this file.
a chip:  the example compiles for the chip with all warnings as errors. Its undefined functions are only those of the
         chip's compiler: no floating point on the AVR, and only memory functions on the Cortex-M."""
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = REPOSITORY / "faces" / "firmware" / "example"
LICENCE = "// SPDX-License-Identifier: Apache-2.0\n"
FLAGS = ["-std=c++20", "-ffreestanding", "-nostdinc++", "-fno-exceptions", "-fno-rtti", "-Wall", "-Wextra", "-Wpedantic",
         "-Wshadow", "-Wconversion", "-Wno-sign-conversion", "-Wdouble-promotion", "-Wmissing-field-initializers", "-Werror",
         "-Os", f"-I{REPOSITORY}", f"-I{REPOSITORY}/faces/firmware/bare"]
TARGET = {"cortex_m": ["--target=thumbv7em-none-eabihf", "-mcpu=cortex-m4"],
          "avr": ["--target=avr", "-mmcu=atmega2560"]}
MEMORY = r"memcpy|memmove|memset|__aeabi_mem\w+"
# Integer multiplication and division, and the symbols with which the start code of avr-libc clears and copies sections.
MAY_NEED = {"cortex_m": MEMORY,
            "avr": MEMORY + r"|__u?divmod[qhs]i4|__mul[qhs]i3|__mulsi3|__ashl\w+|__lshr\w+|__do_(clear_bss|copy_data)"}
KIND, TOOLS = sys.argv.pop(1), []


class Examples(unittest.TestCase):
    def compiled(self, chip, config):
        """Compiles the example with the drive_config.hpp of the folder `config`."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        out = pathlib.Path(folder.name) / "main.o"
        done = subprocess.run([TOOLS[0], *TARGET[chip], *FLAGS, f"-I{config}", "-c", EXAMPLES / chip / "main.cpp", "-o", out],
                              capture_output=True, text=True, check=False)
        return done, out

    @unittest.skipIf(KIND == "configs", "compiles")
    def test_compiles_and_needs_no_library(self):
        done, out = self.compiled(KIND, EXAMPLES / KIND)
        self.assertEqual(done.returncode, 0, done.stderr)
        symbols = subprocess.run([TOOLS[1], "-u", out], capture_output=True, text=True, check=True).stdout.split()
        needed = [s for s in symbols if s != "U" and not re.fullmatch(MAY_NEED[KIND], s)]
        self.assertEqual(needed, [])
        defined = subprocess.run([TOOLS[1], "--defined-only", out], capture_output=True, text=True, check=True).stdout
        for entry in {"cortex_m": ["ADC1_2_IRQHandler", "TIM1_CC_IRQHandler", "TIM1_BRK_IRQHandler", "TIM2_IRQHandler", "USART2_IRQHandler",
                                   "NMI_Handler"], "avr": ["__vector_29", "__vector_11"]}[KIND]:
            self.assertIn(f"T {entry}\n", defined)

    @unittest.skipUnless(KIND == "avr", "the AVR's board alone")
    def test_a_drive_for_another_board_does_not_compile(self):
        for pattern, instead, said in (("adc_bits = 10;", "adc_bits = 12;", "the ATmega2560's converter has 10 bits: set sensors.adc_bits = 10"),
                                       (r"dead_time_ps = \d+;", "dead_time_ps = 0;", "bridge.dead_time_s"),
                                       ("bool cleared = true;", "bool cleared = false;", "not cleared for a bridge"),
                                       ("in_middle = true;", "in_middle = false;", "the middle of the on-time"),
                                       (r"dead_time_ps = \d+;", "dead_time_ps = 5062501;", "5 us or less")):
            text, times = re.subn(pattern, instead, (EXAMPLES / "avr" / "drive_config.hpp").read_text())
            self.assertEqual(times, 1)
            with self.subTest(instead), tempfile.TemporaryDirectory() as folder:
                (pathlib.Path(folder) / "drive_config.hpp").write_text(text)
                done, _ = self.compiled("avr", folder)
                self.assertNotEqual(done.returncode, 0)
                self.assertIn(said, done.stderr)

    @unittest.skipUnless(KIND == "cortex_m", "its image is the one that asks for them")
    def test_a_header_without_dead_time_or_clearance_does_not_compile(self):
        for old, new, words in (("dead_time_ps = 500000;", "dead_time_ps = 0;", "without a dead time both switches of a leg are on"),
                                ("bool cleared = true;", "bool cleared = false;", "not cleared for a bridge")):
            text = (EXAMPLES / "cortex_m" / "drive_config.hpp").read_text()
            self.assertEqual(text.count(old), 1)
            with tempfile.TemporaryDirectory() as folder:
                (pathlib.Path(folder) / "drive_config.hpp").write_text(text.replace(old, new))
                done, _ = self.compiled("cortex_m", folder)
                self.assertNotEqual(done.returncode, 0)
                self.assertIn(words, done.stderr)
                image = subprocess.run([REPOSITORY / "tools/firmware_image.sh", "stm32f303", f"{folder}/drive_config.hpp", f"{folder}/out"],
                                       capture_output=True, text=True, check=False)
                self.assertEqual(image.returncode, 1)
                self.assertFalse((pathlib.Path(folder) / "out").exists())
                if "is missing; tools/" not in image.stderr:
                    self.assertIn("has no dead time" if "dead" in old else "--despite builds the image all the same", image.stderr)

    @unittest.skipUnless(KIND == "cortex_m", "the AVR's drive times no edges")
    def test_a_header_of_another_clock_does_not_compile(self):
        """With a clock of 1 MHz, the default of a scenario, every speed would be 72 times too low. The over-speed
        protection would then not act."""
        text = (EXAMPLES / "cortex_m" / "drive_config.hpp").read_text()
        held = re.search(r"double timer_Hz = (\S+);", text)[1]
        scenario = tomllib.loads((REPOSITORY / "data/scenarios/firmware/cortex-m.toml").read_text())
        self.assertEqual(float.fromhex(held), scenario["sensors"]["capture_Hz"])
        for old, new, words in ((held, (1e6).hex(), "set sensors.capture_Hz to clock_Hz"), ("in_middle = false", "in_middle = true", "at the start of a period")):
            with self.subTest(new), tempfile.TemporaryDirectory() as folder:
                (pathlib.Path(folder) / "drive_config.hpp").write_text(text.replace(old, new))
                done, _ = self.compiled("cortex_m", folder)
                self.assertNotEqual(done.returncode, 0)
                self.assertIn(words, done.stderr)

    @unittest.skipIf(KIND == "configs", "compiles")
    def test_a_compiler_that_is_known_to_be_wrong_is_stopped(self):
        source = f'#include "sixstep/control/fixed.hpp"\nsixstep::control::{"Q31" if KIND == "avr" else "Q15"} x;\n'
        def told(*flags):
            done = subprocess.run([TOOLS[0], *TARGET[KIND], *FLAGS, *flags, "-fsyntax-only", "-x", "c++", "-"], input=source,
                                  capture_output=True, text=True, check=False)
            return done.stderr
        old = ["-Wno-builtin-macro-redefined", "-U__clang_major__", "-D__clang_major__=14"]
        if KIND == "avr":
            self.assertIn("compiles drives wrongly for the AVR", told(*old))
            self.assertIn("passes structs of 32-bit formats wrongly", told())
            self.assertEqual(told(*old, "-DSIXSTEP_ANY_COMPILER"), "")
        else:
            self.assertEqual(told(*old), "")
        self.assertIn("needs C++20", told("-std=c++17"))

    @unittest.skipUnless(KIND == "configs", "exports")
    def test_configs_are_what_their_command_writes(self):
        for chip in TARGET:
            there = EXAMPLES / chip / "drive_config.hpp"
            text = there.read_text()
            command = re.search(r"^//   sixstep (.*) --out (\S+)$", text, re.M)
            self.assertEqual(command.group(2), there.relative_to(REPOSITORY).as_posix())
            made = subprocess.run([TOOLS[0], *shlex.split(command.group(1))], cwd=REPOSITORY, capture_output=True, text=True, check=True)
            self.assertEqual(text, LICENCE + made.stdout.replace(command.group(1), f"{command.group(1)} --out {command.group(2)}", 1),
                             "run the command again, and keep the licence line above it")


if __name__ == "__main__":
    TOOLS = [sys.argv.pop(1) for _ in sys.argv[1:]]
    unittest.main()
