#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the program in a temporary folder, for the tests of its verbs. Each test is called as TEST.py PROGRAM SOURCE."""
import contextlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, SOURCE = os.path.abspath(sys.argv.pop(1)), pathlib.Path(sys.argv.pop(1)).resolve()

# The rotor is held at full voltage. Thus only the limit decides whether the requirement is met.
SHORT = """
motor = "maxon-251601"
duration_s = 1e-4
[control]
mode = "duty"
[reference]
value = 1
[load]
locked = true
[[require]]
metric = "final"
signal = "current"
label = "current"
max = {limit}
"""


BRISK = re.sub("(?m)^inertia.*$", "inertia_gcm2 = 0.3", (SOURCE / "data/motors/maxon-251601.toml").read_text())
WIRING = "motor wiring brisk.toml --current 15"  # this needs a fifth of the usual time; it is for tests of printed text


def some(cases, count):
    """The first `count` of many similar cases, or all of them with SIXSTEP_ALL_CASES (ctest --preset long). The most
    important cases are first."""
    return list(cases) if os.environ.get("SIXSTEP_ALL_CASES") else list(cases)[:count]


def hall_log(turns, rows=60):
    """A log of Hall lines at constant speed, with `rows` rows in each electrical turn."""
    codes = ["1,0,0", "1,1,0", "0,1,0", "0,1,1", "0,0,1", "1,0,1"]  # docs/reference/notation.md, forward
    return "time [s],hall1,hall2,hall3\n" + "".join(f"{1e-3 * n:.7g},{codes[6 * n // rows % 6]}\n" for n in range(turns * rows))


class ProgramTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def run_program(self, *words, code=0):
        result = subprocess.run([PROGRAM, *words], cwd=self.path, capture_output=True, text=True, timeout=300)
        # None: both exit codes are accepted, 0 (all requirements met) and 1 (a requirement missed).
        self.assertIn(result.returncode, (0, 1) if code is None else (code,), result.stderr + result.stdout)
        return result

    def run_any(self, *words):
        """Runs the program and accepts any exit code."""
        return subprocess.run([PROGRAM, *words], cwd=self.path, capture_output=True, text=True, timeout=300, check=False)

    def write(self, name, limit):
        (self.path / name).write_text(SHORT.format(limit=limit))
        return name

    def names(self, folder="."):
        return sorted(os.listdir(self.path / folder))


class Started(ProgramTest):
    """Starts a program that runs in parallel to the test."""

    @contextlib.contextmanager
    def started(self, *words, **how):
        how = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True} | how
        with subprocess.Popen([PROGRAM, *words], cwd=self.path, **how) as program:
            try:
                yield program
            finally:
                program.kill()

    def wait_until(self, holds, seconds=20):
        deadline = time.monotonic() + seconds
        while not holds():
            self.assertLess(time.monotonic(), deadline, "it never came")
            time.sleep(0.01)
