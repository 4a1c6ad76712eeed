#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""./run and ./test in a copy of a checkout with its build folder build the sources of the copy. The test uses the
real scripts and a project of one line."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PROJECT = """cmake_minimum_required(VERSION 3.25)
project(small LANGUAGES C)
add_executable(sixstep sixstep.c)
enable_testing()
add_test(NAME says COMMAND sixstep)
"""
PRESETS = """{"version": 6, "configurePresets": [
  {"name": "release", "generator": "Ninja", "binaryDir": "${sourceDir}/build/release"},
  {"name": "dev", "generator": "Ninja", "binaryDir": "${sourceDir}/build/dev"}]}
"""
NOTHING = {"tools/install.sh": "#!/bin/bash\n", "tools/check_format.sh": "#!/bin/bash\n", "tools/check_layers.py": ""}


class CopiedCheckout(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.original = pathlib.Path(folder.name) / "a checkout"
        (self.original / "tools").mkdir(parents=True)
        for name in ("run", "test", "tools/configure.sh", "tools/parts.sh"):
            shutil.copy2(SOURCE / name, self.original / name)
        for name, text in NOTHING.items():
            (self.original / name).write_text(text)
            (self.original / name).chmod(0o755)
        (self.original / "CMakeLists.txt").write_text(PROJECT)
        (self.original / "CMakePresets.json").write_text(PRESETS)
        self.say(self.original, "original")

    def say(self, checkout, word):
        (checkout / "sixstep.c").write_text(f'#include <stdio.h>\nint main(void) {{ puts("{word}"); return 0; }}\n')

    def call(self, checkout, *words):
        result = subprocess.run(["./" + words[0], *words[1:]], cwd=checkout, capture_output=True, text=True, timeout=120,
                                env={name: value for name, value in os.environ.items() if name != "SIXSTEP_PARTS"})
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout, result.stderr

    def test_run_builds_the_copy(self):
        self.assertEqual(self.call(self.original, "run", "x")[0], "original\n")
        copy = self.original.with_name("copy")
        shutil.copytree(self.original, copy)
        self.say(copy, "copy")
        out, told = self.call(copy, "run", "x")
        self.assertEqual(out, "copy\n")
        self.assertIn(f"build/release was made for {self.original}, not for this copy of it: making it anew\n", told)
        out, told = self.call(copy, "run", "x")
        self.assertEqual((out, "anew" in told), ("copy\n", False), "once")
        self.assertEqual(self.call(self.original, "run", "x")[0], "original\n", "which is left alone")

    def test_run_builds_what_was_moved(self):
        self.call(self.original, "run", "x")
        moved = self.original.with_name("moved")
        self.original.rename(moved)
        self.assertEqual(self.call(moved, "run", "x")[0], "original\n")

    def test_a_link_to_the_checkout_is_no_copy(self):
        self.call(self.original, "run", "x")
        link = self.original.with_name("link")
        link.symlink_to(self.original)
        self.assertNotIn("anew", self.call(link, "run", "x")[1])

    def test_test_builds_the_copy(self):
        self.call(self.original, "test")
        copy = self.original.with_name("copy")
        shutil.copytree(self.original, copy)
        self.say(copy, "copy")
        out, _ = self.call(copy, "test")
        self.assertIn(f"build/dev was made for {self.original}, not for this copy of it: making it anew\n", out)
        self.assertEqual(subprocess.run([copy / "build/dev/sixstep"], capture_output=True, text=True).stdout, "copy\n")


if __name__ == "__main__":
    unittest.main()
