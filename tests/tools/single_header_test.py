#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""single_header_test.py COMPILER: the single header has the same tokens as its parts, and compiles alone for a chip."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "tools"))
import single_header  # noqa: E402

COMPILER = "c++"
FLAGS = ["-std=c++20", "-ffreestanding", "-fno-exceptions", "-fno-rtti", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion",
         "-Wno-sign-conversion", "-Wdouble-promotion", "-Werror"]


class SingleHeader(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.header = self.folder / "sixstep_control.hpp"
        subprocess.run([sys.executable, REPOSITORY / "tools" / "single_header.py", "--out", self.header], check=True)
        self.parts = sorted(p.relative_to(REPOSITORY).as_posix() for p in (REPOSITORY / "sixstep/control").rglob("*.hpp")
                            if p.parent.name != "own")  # firmware does not use that interface

    def compile(self, name, source, *flags, include):
        file = self.folder / name
        file.write_text(source)
        done = subprocess.run([COMPILER, *FLAGS, f"-I{include}", *flags, file], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def tokens(self, name, source, include):
        """The preprocessed lines of this repository's headers. Standard headers may be at other places."""
        text = self.compile(name, source, "-E", include=include)
        ours, from_us = [], False
        for line in text.splitlines():
            marker = re.match(r'# \d+ "([^"]*)"', line)
            if marker:
                from_us = "sixstep" in marker.group(1)
            elif from_us and line.strip():
                ours.append(line.strip())
        return ours

    def test_same_tokens_as_its_parts(self):
        order = single_header.ordered(REPOSITORY)
        self.assertEqual(sorted(order), self.parts)
        parts = self.tokens("parts.cpp", "".join(f'#include "{p}"\n' for p in order), REPOSITORY)
        whole = self.tokens("whole.cpp", '#include "sixstep_control.hpp"\n', self.folder)
        self.assertGreater(len(parts), 1000)
        self.assertEqual(whole, parts)

    def test_stops_compilers_that_are_known_to_be_wrong(self):
        text = self.header.read_text()
        self.assertIn("avr-gcc 5 and 7", text.split("#pragma once")[0])
        file = self.folder / "old.cpp"
        file.write_text('#include "sixstep_control.hpp"\n')
        flags = [flag for flag in FLAGS if flag not in ("-std=c++20", "-Werror")]
        for given, said in ((["-std=c++17"], "needs C++20"),
                            (["-std=c++20", "-D__AVR__", "-D__clang__", "-D__clang_major__=14"], "compiles drives wrongly for the AVR")):
            done = subprocess.run([COMPILER, *flags, *given, f"-I{self.folder}", "-fsyntax-only", file], capture_output=True, text=True, check=False)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(said, done.stderr)

    def test_compiles_alone_for_a_chip(self):
        source = ('#include "sixstep_control.hpp"\n#include "sixstep_control.hpp"\n'
                  "static_assert(sixstep::control::Q15(0.5).raw == 16384);\n")
        self.compile("alone.cpp", source, "-fsyntax-only", include=self.folder)

    def test_names_no_file_of_the_repository_in_code(self):
        self.assertNotIn('#include "', self.header.read_text())


if __name__ == "__main__":
    COMPILER = sys.argv.pop(1) if len(sys.argv) > 1 else COMPILER
    unittest.main()
