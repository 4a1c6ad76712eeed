#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""design_md_test.py PROGRAM: what docs/design.md quotes is what the program prints.

Above each fenced block a comment says how it is tested; a block without one fails:
  <!-- test: run -->                             is run, with ./run as the program
  <!-- test: excerpt of COMMAND[; exit=N] -->    its lines stand so in the command's output; a line "..." leaves lines out
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else str(REPOSITORY / "build/dev/sixstep")
TEXT = (REPOSITORY / "docs/design.md").read_text(encoding="utf-8")
BLOCK = re.compile(r"(?:^<!-- test: (?P<test>.*?) -->\n)?^```(?P<language>\w*)\n(?P<text>.*?)^```$", re.M | re.S)


def first_missing(quoted, printed):
    """The first quoted line that does not stand in its place, or None. Between two "..." lines follow each other."""
    at, anywhere = 0, False
    for line in quoted:
        if line == "...":
            anywhere = True
            continue
        hit = next((n for n in range(at, len(printed)) if printed[n] == line), None) if anywhere else at
        if hit is None or hit >= len(printed) or printed[hit] != line:
            return line
        at, anywhere = hit + 1, False
    return None


class DesignPage(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        (pathlib.Path(self.folder.name) / "run").symlink_to(PROGRAM)

    def shell(self, command, code=0):
        done = subprocess.run(["bash", "-euc", command], cwd=self.folder.name, stdout=subprocess.PIPE, timeout=120,
                              stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual(done.returncode, code, done.stdout)
        return done.stdout

    def test_every_block_does_what_it_says(self):
        blocks = list(BLOCK.finditer(TEXT))
        self.assertEqual(2 * len(blocks), len(re.findall("^```", TEXT, re.M)))
        self.assertGreater(len(blocks), 8)
        for block in blocks:
            with self.subTest(TEXT[:block.start()].count("\n") + 1):
                word, _, rest = (block["test"] or "").partition(" ")
                if word == "run":
                    self.shell(block["text"])
                    continue
                self.assertEqual(word, "excerpt", "the block does not say how it is tested")
                command, _, code = rest.removeprefix("of ").partition("; exit=")
                self.assertIsNone(first_missing(block["text"].splitlines(), self.shell(command, int(code or 0)).splitlines()))

    def test_what_the_prose_says_of_numbers_is_printed(self):
        prose = BLOCK.sub("", TEXT)
        fast = self.shell("./run design maxon-251601 --settle 0.5e-3 --delay 1 --quick", 1)
        degrees = re.search(r"still has (\d+) degrees of phase", prose)[1]
        self.assertRegex(fast, rf"phase margin, one period late +{degrees}\.\d deg")

    def test_every_option_it_names_exists(self):
        help_text = self.shell("./run design --help")
        for option in set(re.findall(r"--[a-z][a-z-]+", TEXT)):
            self.assertIn(option + " ", help_text)


if __name__ == "__main__":
    unittest.main()
