#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""control_md_test.py COMPILER [PROGRAM]: the snippets of docs/control.md compile as they stand, its figures are what tests of the rig
print, and its table names every block."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from page import REPOSITORY, Page, first_missing

PAGE = Page("docs/control.md")
COMPILER, PROGRAM = "c++", REPOSITORY / "build/dev/sixstep"
WARNINGS = ["-std=c++20", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wno-sign-conversion", "-Wdouble-promotion",
            "-Werror"]


class ControlPage(unittest.TestCase):
    def compile(self, source, *flags):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "snippet.cpp"
            file.write_text(source)
            done = subprocess.run([COMPILER, *WARNINGS, *flags, f"-I{REPOSITORY}", "-c", "-O1", "-o", "/dev/null", file],
                                  capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_chips_snippets_are_one_program_for_a_chip(self):
        chip = PAGE.texts("chip")
        self.assertGreaterEqual(len(chip), 6)
        self.compile("\n".join(chip), "-ffreestanding", "-fno-exceptions", "-fno-rtti")

    def test_the_hosts_snippets_compile(self):
        self.compile("\n".join(PAGE.texts("host")))

    def test_the_shell_lines_run(self):
        with tempfile.TemporaryDirectory() as folder:
            for line in PAGE.texts("shell"):
                subprocess.run(line.replace("tools/", f"{REPOSITORY}/tools/"), shell=True, cwd=folder, check=True)
            self.assertTrue((pathlib.Path(folder) / "sixstep_control.hpp").is_file())

    def test_what_is_exported_goes_into_the_chips_program(self):
        with tempfile.TemporaryDirectory() as folder:
            for line in PAGE.texts("export"):
                line = line.replace("./run", f"'{PROGRAM}'").replace("--out ", f"--out {folder}/")
                subprocess.run(line, shell=True, cwd=REPOSITORY, check=True)
            self.compile("\n".join(PAGE.texts("exported")), "-ffreestanding", "-fno-exceptions", "-fno-rtti", f"-I{folder}")

    def test_what_trips_is_told(self):
        for line in PAGE.texts("trips"):
            done = subprocess.run(line.replace("./run", f"'{PROGRAM}'"), shell=True, cwd=REPOSITORY, capture_output=True,
                                  text=True, check=False)
            self.assertEqual(done.returncode, 3)
            self.assertIn("line H2 does not follow the rotor", done.stdout)

    def test_the_rig_prints_what_is_quoted(self):
        quoted = [b for b in PAGE.blocks if b.word == "excerpt"]
        self.assertGreaterEqual(len(quoted), 3)
        for block in quoted:
            with self.subTest(block.line):
                command = block.detail.removeprefix("of ").replace("build/dev", str(PROGRAM.parent)).split()
                printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
                self.assertIsNone(first_missing(block.text.splitlines(), printed.splitlines()))

    def test_every_snippet_is_tested_and_every_block_named(self):
        self.assertLessEqual({b.word for b in PAGE.blocks}, {"chip", "host", "shell", "export", "exported", "trips", "excerpt"})
        table = PAGE.text.split("<!-- test: blocks -->")[1]
        named = sorted(re.findall(r"`([\w/]+\.hpp)`", table))
        self.assertEqual(named, sorted(p.relative_to(REPOSITORY / "sixstep/control").as_posix() for p in (REPOSITORY / "sixstep/control").rglob("*.hpp")))


if __name__ == "__main__":
    COMPILER = sys.argv.pop(1) if len(sys.argv) > 1 else COMPILER
    PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else PROGRAM
    unittest.main()
