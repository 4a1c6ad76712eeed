#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""readme_test.py PROGRAM SOURCE: does what the README says, in a scratch copy, and compares what it quotes.

Above each fenced block of README.md a comment says how it is tested; a block without one fails:
  <!-- test: programs -->              each line begins with a program of the repository: it exists, may be executed
  <!-- test: run [exit=N] -->          is run, with ./run as the built program
  <!-- test: output -->                is exactly what the block before it printed
  <!-- test: excerpt of COMMAND -->    its lines stand so in the command's output; a line "..." leaves lines out
  <!-- test: file PATH -->             is that file without its licence line, and the scenario passes
  <!-- test: measured -->              differs from machine to machine: not compared
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = os.path.abspath(sys.argv.pop(1)), pathlib.Path(sys.argv.pop(1)).resolve()
BLOCK = re.compile(r"(?:^<!-- test: (?P<test>.*?) -->\n)?^```(?P<language>\w*)\n(?P<text>.*?)^```$", re.M | re.S)


def blocks_of(text):
    found = list(BLOCK.finditer(text))
    assert 2 * len(found) == len(re.findall("^```", text, re.M)), "a fenced block is not closed"
    return [(text[:m.start()].count("\n") + 1, m["test"] or "", m["language"], m["text"]) for m in found]


def lines_in_order(quoted, printed):
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


class Readme(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.text = (SOURCE / "README.md").read_text(encoding="utf-8")
        cls.blocks = blocks_of(cls.text)
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.scratch = pathlib.Path(cls.folder.name)
        for name in ("data", "tools"):
            shutil.copytree(SOURCE / name, cls.scratch / name)
        (cls.scratch / "tests").symlink_to(SOURCE / "tests")
        (cls.scratch / "build/release").mkdir(parents=True)
        (cls.scratch / "build/release/sixstep").symlink_to(PROGRAM)
        (cls.scratch / "build/dev").symlink_to(os.path.dirname(PROGRAM))
        (cls.scratch / "run").symlink_to(PROGRAM)  # the real one installs and builds first

    def shell(self, command, code=0):
        done = subprocess.run(["bash", "-euc", command], cwd=self.scratch, stdout=subprocess.PIPE, timeout=120,
                              stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual(done.returncode, code, done.stdout)
        return done.stdout

    def test_every_block_does_what_it_says(self):
        self.assertGreater(len(self.blocks), 10)
        printed = None
        for line, test, _, text in self.blocks:
            with self.subTest(f"README.md:{line}"):
                word, _, rest = test.partition(" ")
                if word == "run":
                    printed = None
                    printed = self.shell(text, int(rest.removeprefix("exit=") or 0))
                elif word == "output":
                    self.assertEqual(text, printed)
                elif word == "excerpt":
                    output = self.shell(rest.removeprefix("of "))
                    self.assertIsNone(lines_in_order(text.splitlines(), output.splitlines()))
                elif word == "file":
                    licence, _, content = (SOURCE / rest).read_text(encoding="utf-8").partition("\n")
                    self.assertIn("SPDX", licence)
                    self.assertEqual(text, content)
                    self.shell(f"./run run {rest} --quiet")
                elif word == "programs":
                    for command in text.splitlines():
                        self.assertTrue(os.access(SOURCE / command.split()[0], os.X_OK), command)
                else:
                    self.assertEqual(word, "measured", "the block does not say how it is tested")

    def test_two_runs_give_the_same_bits(self):
        scenario = "data/scenarios/thesis/7.4-speed-thesis-gains.toml"
        for name in ("one", "two"):
            self.shell(f"./run run {scenario} --csv {name}.csv --quiet")
        # The comment names the command, and with it the file; all that follows is the same.
        one, two = ((self.scratch / f"{name}.csv").read_text().splitlines()[3:] for name in ("one", "two"))
        self.assertEqual(one, two)

    def test_the_number_of_experiments_is_right(self):
        count = len(list((SOURCE / "data/scenarios/thesis").glob("*.toml")))
        self.assertEqual({int(n) for n in re.findall(r"(\d+) experiments", self.text)}, {count})

    def test_what_is_linked_or_named_exists(self):
        links = re.findall(r"\]\(([^)#]+)\)", self.text)
        named = re.findall(r"`((?:tools|tests|data|docs|sixstep)/[\w./-]+)`", self.text)
        self.assertGreater(len(links), 4)
        for path in links + named:
            if not path.startswith("https://"):
                self.assertTrue((SOURCE / path).exists(), path)
        self.assertLess((SOURCE / "docs/images/report.png").stat().st_size, 300_000)


if __name__ == "__main__":
    unittest.main()
