#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""inserted_functions_test.py CLANG NM: compiles the control library for chips. Its undefined functions are exactly
those in docs/reference/blocks.md. Every row of that table must be necessary on some chip, so that a superfluous row
fails."""
import fnmatch
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[3]
FLAGS = ["-std=c++20", "-ffreestanding", "-nostdinc++", "-fno-exceptions", "-fno-rtti", f"-I{REPOSITORY}",
         f"-I{REPOSITORY}/faces/firmware/bare"]
CHIPS = {"Cortex-M4": ["--target=thumbv7em-none-eabihf", "-mcpu=cortex-m4"],
         "Cortex-M0": ["--target=thumbv6m-none-eabi", "-mcpu=cortex-m0"],
         "RV32IMC": ["--target=riscv32", "-march=rv32imc", "-mabi=ilp32"],
         "ATmega2560": ["--target=avr", "-mmcu=atmega2560", "-DSIXSTEP_ANY_COMPILER"]}
TOOLS = []


def listed():
    """For each row of the table: the patterns of the names, and the chips that the row lists."""
    section = (REPOSITORY / "docs/reference/blocks.md").read_text(encoding="utf-8").partition("## Which functions the linker needs")[2]
    rows = [line.split("|")[1:4] for line in section.splitlines() if re.match(r"\| [^-f]|\| `", line)]
    return [(re.findall(r"`([^`]+)`", names), CHIPS if where.strip() == "all" else where) for _, names, where in rows]


class InsertedFunctions(unittest.TestCase):
    def needed(self, chip, optimised):
        with tempfile.TemporaryDirectory() as folder:
            sources = sorted(pathlib.Path(__file__).parent.glob("*.cpp"))
            names = set()
            for source in sources:
                out = pathlib.Path(folder) / (source.stem + ".o")
                subprocess.run([TOOLS[0], *CHIPS[chip], *FLAGS, optimised, "-c", source, "-o", out], check=True)
                told = subprocess.run([TOOLS[1], "-u", out], capture_output=True, text=True, check=True).stdout
                names |= set(told.split()) - {"U"}
            return names

    def test_the_linker_is_asked_for_what_the_page_lists(self):
        rows = listed()
        self.assertGreaterEqual(len(rows), 5)
        seen = [set() for _ in rows]
        for chip in CHIPS:
            for name in self.needed(chip, "-Os") | self.needed(chip, "-O2"):
                fits = [n for n, (patterns, where) in enumerate(rows)
                        if chip in where and any(fnmatch.fnmatchcase(name, p) for p in patterns)]
                self.assertTrue(fits, f"{chip} needs {name}, which docs/reference/blocks.md does not list")
                for n in fits:
                    seen[n].add(chip)
        for (patterns, where), chips in zip(rows, seen):
            self.assertEqual({c for c in CHIPS if c in where} - chips, set(), f"who needs {patterns}?")


if __name__ == "__main__":
    TOOLS = sys.argv[1:3]
    del sys.argv[1:3]
    unittest.main()
