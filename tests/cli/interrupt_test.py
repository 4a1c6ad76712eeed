#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C and SIGTERM end every verb at any time. The message names the files with the finished part, and no file is
called complete.

The work of each verb lasts much longer than the test, and the signal comes at a random instant. The seed is printed,
and SIXSTEP_SEED repeats it. `-v` prints the time until the verb ends."""
import contextlib
import itertools
import math
import os
import random
import re
import signal
import sqlite3
import subprocess
import sys
import time
import unittest

from program import SOURCE, Started, hall_log, some

SEED = int(os.environ.get("SIXSTEP_SEED", random.randrange(1 << 30)))
R3 = str(SOURCE / "data/scenarios/reference/R3.toml")
PLAN = str(SOURCE / "data/plans/best-pwm.toml")
SERIES = str(SOURCE / "data/scenarios/current-square-series.toml")
LONG = ["--set", "duration_s=1e4", "--set", "record.grid_s=1e-3"]
# On an idle machine the program needs 0.2 s. With other tests in parallel it needs longer.
BOUND_S = 5.0
ROUNDS = len(some(range(4), 2))
TOLD = {signal.SIGINT: 130, signal.SIGTERM: 143}

BEGUN_OR_NOT = r"^(long: interrupted at [\d.e-]+ s of 10000 s|interrupted before the first run began)\n$"

# None of these runs ends within the test. The rotor is held, so that only the duration makes a run long.
ENDLESS = """
motor = "maxon-251601"
duration_s = 1e4
[control]
mode = "current"
[reference]
value = 2
[load]
locked = true
[pwm]
delay_periods = 1
[sensors]
currents = "phases"
current_range_A = 20
[record]
grid_s = 1e-3
[[require]]
metric = "final"
signal = "current"
max = 3
"""


class Ends(Started):
    """For each verb: its arguments, the expected messages on both streams, and the files that remain."""

    def setUp(self):
        super().setUp()
        (self.path / "long.toml").write_text(ENDLESS)
        self.random = random.Random(f"{SEED} {self.id()}")
        self.slowest = 0.0

    def tearDown(self):
        if "-v" in sys.argv:
            print(f"{self.id().split('.')[-1]}: {1e3 * self.slowest:.0f} ms at most, seed {SEED}", file=sys.stderr)
        super().tearDown()

    def stopped(self, *words, after=(0.02, 0.8), sent=None):
        """Stops a verb by a signal. Returns whether the program handled the signal, and all its messages."""
        sent = sent or self.random.choice(list(TOLD))
        wait = self.random.uniform(*after)
        with self.started(*words) as program:
            time.sleep(wait)
            self.assertIsNone(program.poll(), "it is to be stopped at work")
            begin = time.monotonic()
            program.send_signal(sent)
            try:
                out, told = program.communicate(timeout=BOUND_S)
            except subprocess.TimeoutExpired:
                self.fail(f"{words} goes on after {sent.name} at {wait:.3f} s, seed {SEED}")
            self.slowest = max(self.slowest, time.monotonic() - begin)
        # The signal itself ends the program if the handler is not installed yet, or if no output must be closed.
        self.assertIn(program.returncode, (TOLD[sent], -sent), (words, wait, SEED, out + told))
        return program.returncode > 0, out + told

    def nothing_is_left(self, *words, told, rounds=ROUNDS, **how):
        listened = 0
        before = self.names()
        for _ in range(rounds):
            heard, said = self.stopped(*words, **how)
            self.assertEqual(said, told + "\n" if heard else "", SEED)
            self.assertEqual(self.names(), before, "nothing half written, nothing hidden")
            listened += heard
        return listened

    def test_run(self):
        for _ in range(ROUNDS):
            heard, said = self.stopped("run", "long.toml")
            if heard:
                self.assertRegex(said, BEGUN_OR_NOT, SEED)

    def test_run_while_it_starts(self):
        """The signal may arrive after the program has installed its handler and before a run begins."""
        for _ in range(20):
            heard, said = self.stopped("run", "long.toml", after=(0.0, 0.08))
            self.assertRegex(said, BEGUN_OR_NOT if heard else "^$", SEED)

    def test_run_with_every_file(self):
        for _ in range(2):
            heard, said = self.stopped("run", "long.toml", "--csv", "a.csv", "--html", "a.html", "--json", "a.json", after=(0.3, 0.8))
            self.assertEqual(heard, "a.partial.html" in self.names())
            self.assertEqual([name for name in self.names() if "partial" not in name], ["long.toml"])
            self.assertIn("the finished part is in a.partial.csv, a.partial.json, a.partial.html\n", said)

    def test_a_comparison(self):
        (self.path / "other.toml").write_text(ENDLESS)
        self.nothing_is_left("run", "long.toml", "other.toml", "--html", "c.html", after=(0.2, 0.8),
                             told="the comparison: interrupted; nothing was written")

    def test_a_series_says_of_how_many_drives_it_speaks(self):
        for _ in range(ROUNDS):
            heard, said = self.stopped("run", SERIES, "--runs", "1000000", after=(0.3, 0.8))
            self.assertTrue(heard)
            self.assertNotRegex(said, r"\d+ drives, seed 1: all hold")
            ended = re.search(r"^interrupted after (\d+) of 1000000 drives, seed 1: of these all hold every requirement$", said, re.M)
            self.assertTrue(ended or said == "interrupted before the first of 1000000 drives ended\n", said)
            if ended:
                self.assertGreaterEqual(said.count(f" {ended[1]} of {ended[1]}\n"), 2, said)

    def rows(self, store):
        with contextlib.closing(sqlite3.connect(self.path / store)) as read:
            return read.execute("SELECT COUNT(*) FROM run").fetchone()[0]

    def test_a_plan_names_what_it_leaves_and_how_to_go_on(self):
        """The message names the partial files and the number of runs in the store. With --resume no run is repeated."""
        files = ["--csv", "o.csv", "--json", "o.json", "--junit", "o.xml"]
        for store, quiet in itertools.product((False, True), (False, True)):
            words = ["run", SERIES, "--runs", "1000000", *files, *(["--store", "o.sqlite"] if store else []), *(["--quiet"] if quiet else [])]
            with self.started(*words) as program:
                time.sleep(0.8)
                program.send_signal(signal.SIGINT)
                told = program.communicate(timeout=60)[1]
            self.assertEqual(program.returncode, 130, told)
            left = "current-square-series: interrupted; the finished part is in o.partial.csv, o.partial.json"
            kept = "; the finished runs are in o.sqlite; to continue, repeat the command with --resume"
            self.assertIn(left + (kept if store else "") + "\n", told)
            self.assertIn("the verdicts of the finished runs are in o.partial.xml\n", told)
            self.assertEqual([name for name in self.names() if name.startswith("o.")],
                             ["o.partial.csv", "o.partial.json", "o.partial.xml"] + (["o.sqlite"] if store else []))
            for name in self.names():
                if name.startswith("o.partial"):
                    (self.path / name).unlink()
            if store:
                before = self.rows("o.sqlite")
                with self.started(*words[:-1] if quiet else words, "--resume") as program:
                    time.sleep(0.8)
                    program.send_signal(signal.SIGINT)
                    told = program.communicate(timeout=60)[1]
                self.assertIn(kept, told)
                self.assertGreater(self.rows("o.sqlite"), before)
                for name in self.names():
                    if name.startswith("o."):
                        (self.path / name).unlink()

    def test_a_search_and_a_contest_name_the_store_that_has_their_runs(self):
        for words, what in ((["design", "--optimise", PLAN], "the search"), (["compare", "maxon-251601", "--runs", "2000"], "compare maxon-251601")):
            with self.subTest(what), self.started(*words, "--jobs", "1", "--store", "s.sqlite") as program:
                self.wait_until(lambda: (self.path / "s.sqlite").exists(), seconds=60)
                time.sleep(0.3)
                program.send_signal(signal.SIGINT)
                told = program.communicate(timeout=60)[1]
                self.assertEqual(program.returncode, 130, told)
                self.assertIn(f"{what}: interrupted; the finished runs are in s.sqlite; to continue, repeat the command with --resume\n", told)
            (self.path / "s.sqlite").unlink()

    def test_curves(self):
        for duty, latest in (("1", 0.1), ("0.5", 0.5)):
            for jobs in ((), ("--jobs", "1")):
                self.nothing_is_left("curve", "maxon-251601", "--duty", duty, "--points", "10000", "--csv", "k.csv", *jobs,
                                     told="curve maxon-251601: interrupted; nothing was written", after=(0.05, latest), rounds=2)

    def test_a_single_point_of_a_curve(self):
        """The chopping is much faster than the rotor. One point of this curve takes minutes."""
        self.nothing_is_left("curve", "maxon-251601", "--duty", "0.5", "--points", "2", "--pwm-period", "1e-9",
                             told="curve maxon-251601: interrupted; nothing was written", after=(0.1, 0.8))

    def test_wirings(self):
        heard = self.nothing_is_left("motor", "wiring", "baldor-bsm90n-175", "--jobs", "1", "--svg", "w.svg", after=(0.1, 0.8), rounds=2,
                                     told="motor wiring baldor-bsm90n-175: interrupted; nothing was written")
        self.assertGreater(heard, 0)

    def test_a_commissioning(self):
        """Commissioning the motor of a wheel hub takes nine seconds of simulated time."""
        heard = self.nothing_is_left("motor", "commission", "hoverboard-hub", "--voltage", "36", "--html", "c.html", "--write", "c.toml", after=(0.05, 0.5), rounds=2,
                                     told="motor commission hoverboard-hub: interrupted; nothing was written")
        self.assertGreater(heard, 0)

    def test_an_identification(self):
        """A log of twenty thousand edges with voltages takes ten seconds to identify."""
        lines = hall_log(turns=3400, rows=30).splitlines()
        wave = [f",{math.cos(math.radians(12 * n - 30)):.3f},{math.cos(math.radians(12 * n - 150)):.3f}" for n in range(30)]
        (self.path / "log.csv").write_text(lines[0] + ",u_ab,u_bc\n" + "".join(line + wave[n % 30] + "\n" for n, line in enumerate(lines[1:])))
        heard = self.nothing_is_left("motor", "identify", "log.csv", "--html", "a.html", "--write", "a.toml", after=(0.5, 2.5), rounds=ROUNDS,
                                     told="motor identify log.csv: interrupted; nothing was written")
        self.assertGreater(heard, 0)

    def test_a_design(self):
        slow = ["design", "maxon-251601", "--mode", "position", "--settle", "1", "--jobs", "1", "--toml", "d.toml"]
        self.nothing_is_left(*slow, told="design maxon-251601: interrupted; nothing was written", after=(0.1, 0.5))

    def test_an_export(self):
        heard = self.nothing_is_left("export", "header", "long.toml", "--out", "d.hpp", after=(0.1, 0.8),
                                     told="export long.toml: interrupted; nothing was written")
        self.assertGreater(heard, 0)

    def test_verbs_that_only_print(self):
        """These verbs end at once and write no files. The signal ends the verb, or arrives after its end."""
        for words in ("new --full", "new fresh", "motor list", "motor show maxon-251601", "motor check maxon-251601", "motor new",
                      "schema", "man", "help"):
            for sent in TOLD:
                with self.subTest(words), self.started(*words.split()) as program:
                    time.sleep(self.random.uniform(0, 0.02))
                    program.send_signal(sent)
                    program.communicate(timeout=BOUND_S)
                    self.assertIn(program.returncode, (0, -sent) if words != "new fresh" else (0, 2, -sent))
        self.assertEqual([name for name in self.names() if name.startswith(".")], [])


if __name__ == "__main__":
    print(f"seed {SEED}", file=sys.stderr)
    unittest.main()
