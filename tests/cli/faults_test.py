#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every call that writes a file fails once, or fails from a certain time on (fault_shim.c). Either the files are as
without the fault, or the exit code is 2 and standard error states the reason. No incomplete file has its final name,
and no hidden file remains.

With SIXSTEP_FAULTS=all every case is tested (ctest --preset long). SIXSTEP_FAULTS may also be a number of random
cases. The seed is printed, and SIXSTEP_SEED repeats it."""
import os
import pathlib
import random
import sqlite3
import subprocess
import sys
import time
import unittest

from program import PROGRAM, SOURCE, ProgramTest

SHIM = pathlib.Path(PROGRAM).parent / "fault_shim.so"
SEED = int(os.environ.get("SIXSTEP_SEED", random.randrange(1 << 30)))
SERIES, ONE = (str(SOURCE / f"data/scenarios/{name}.toml") for name in ("current-square-series", "current-square"))
WORK = {
    "store": ["run", SERIES, "--runs", "60", "--jobs", "1", "--store", "o.sqlite"],
    "formats": ["run", ONE, "--csv", "o.csv", "--json", "o.json", "--html", "o.html", "--vcd", "o.vcd", "--mat", "o.mat", "--mat73", "o.h5", "--junit", "o.xml"],
    "plan": ["run", SERIES, "--runs", "60", "--jobs", "1", "--csv", "o.csv", "--json", "o.json", "--html", "o.html", "--junit", "o.xml"],
    "design": ["design", "maxon-251601", "--quick", "--jobs", "1", "--json", "o.json", "--toml", "o.toml", "--html", "o.html", "--models", "o.mat"],
    "header": ["export", "header", ONE, "--out", "o.h", "--despite", "a test"],
    "unit": ["export", "fmu", ONE, "--out", "o.fmu"],
    "curve": ["curve", "maxon-251601", "--points", "9", "--csv", "o.csv", "--json", "o.json", "--html", "o.html"],
}
EIO, ENOMEM, EACCES, ENOSPC = 5, 12, 13, 28
KINDS = (("write", EIO), ("write", ENOSPC), ("short", 0), ("pwrite", EIO), ("fsync", EIO), ("rename", EACCES), ("truncate", ENOSPC), ("reserve", ENOSPC),
         ("read", EIO), ("pread", EIO), ("close", EIO), ("malloc", ENOMEM))
CALLS = (1, 2, 3, 5, 8, 13, 21, 34, 55)
# The number of allocations depends on the length of a path. The numbers are close together in the part that reads the scenarios
# of a plan.
ALLOCATIONS = (1, 200, 1000, 3000, 6000, *range(8500, 9500, 37), 20000, 50000, 100000)
FAULTS = [(work, kind, reason, at, often) for work in WORK for kind, reason in KINDS for at in (ALLOCATIONS if kind == "malloc" else CALLS)
          # With no memory at all the program cannot print a message.
          for often in ("", "on") if not (often and (kind == "short" or (kind == "malloc" and at == 1)))]


def rows(path):
    with sqlite3.connect(path) as store:
        return {row[0]: row for row in store.execute("SELECT * FROM run ORDER BY 1")}


class Faults(ProgramTest):
    def made(self, work, fault=""):
        for name in self.names():
            (self.path / name).unlink()
        made = subprocess.run([PROGRAM, *WORK[work]], cwd=self.path, capture_output=True, timeout=120, check=False,
                              env={**os.environ, "LD_PRELOAD": str(SHIM), "SIXSTEP_FAULT": fault})
        return made.returncode, made.stderr.decode(errors="replace")

    def whole(self):
        return {name: (self.path / name).read_bytes() for name in self.names() if not name.startswith("o.sqlite") and ".partial" not in name}

    def judge(self, fault, reference, code, told):
        expected, files, stored = reference
        self.assertIn(code, (expected, 2), told)
        self.assertEqual([name for name in self.names() if name.startswith(".")], [], "nothing hidden is left")
        if code == 2:
            self.assertNotIn("internal error", told)
            self.assertRegex(told, r"\w+ \w+", "it says why")
        for name, text in self.whole().items():
            if name == "o.xml" and code == 2:  # o.xml describes the run, and states that the run was stopped
                self.assertTrue(text == files[name] or b"<error" in text, text)
                continue
            self.assertTrue(text == files[name], f"{name} stands whole, and differs")
        if code == expected and expected != 2:
            self.assertEqual(sorted(self.whole()), sorted(files))
        if stored and (self.path / "o.sqlite").exists() and (self.path / "o.sqlite").stat().st_size > 0 and code == expected:
            self.assertEqual(rows(self.path / "o.sqlite"), stored)

    def test_each_fault_is_told_or_does_no_harm(self):
        wanted = os.environ.get("SIXSTEP_FAULTS", "60")
        faults = FAULTS if wanted == "all" else random.Random(SEED).sample(FAULTS, int(wanted))
        references = {}
        for fault in faults:
            work, kind, reason, at, often = fault
            if work not in references:
                code, told = self.made(work)
                references[work] = code, self.whole(), rows(self.path / "o.sqlite") if work == "store" else None
                self.assertIn(code, (0, 1), told)
            with self.subTest(fault=fault, seed=SEED):
                self.judge(fault, references[work], *self.made(work, f"{kind} {at} {reason} {often}"))

    def test_a_mat_7_3_of_the_same_run_has_the_same_bytes(self):
        made = []
        for _ in range(2):
            self.run_program("run", ONE, "--quiet", "--mat73", "o.h5", "--force")
            made.append((self.path / "o.h5").read_bytes())
            time.sleep(1.1)
        self.assertEqual(made[0], made[1])


if __name__ == "__main__":
    print(f"seed {SEED}, {len(FAULTS)} faults", file=sys.stderr)
    unittest.main()
