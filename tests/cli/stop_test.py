#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A signal in the first moments of any verb. The verb reports success only if all files are complete and have their
final names.

SIXSTEP_SIGNALS is the number of signals (ctest --preset long: 500). The seed is printed, and SIXSTEP_SEED repeats it."""
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest

from program import PROGRAM, SOURCE, ProgramTest, Started, hall_log

SEED = int(os.environ.get("SIXSTEP_SEED", random.randrange(1 << 30)))
COUNT = int(os.environ.get("SIXSTEP_SIGNALS", "60"))
data = lambda name: str(SOURCE / "data" / name)
PLAN, SERIES, ONE = data("plans/which-pwm.toml"), data("scenarios/current-square-series.toml"), data("scenarios/current-square.toml")
ALONE = ["--jobs", "1"]
VERBS = {
    "plan": ["run", PLAN, *ALONE], "plan, folder": ["run", PLAN, "--out", "o", *ALONE], "plan, files": ["run", PLAN, "--html", "o.html", "--csv", "o.csv", *ALONE],
    "plan, store": ["run", PLAN, "--store", "o.sqlite", *ALONE], "plans on a page": ["run", PLAN, data("plans/best-pwm.toml"), "--html", "o.html", *ALONE],
    "series": ["run", SERIES, "--runs", "200", "--csv", "o.csv", *ALONE], "quiet": ["run", SERIES, "--runs", "200", "--csv", "o.csv", "--quiet", *ALONE],
    "varied": ["run", SERIES, "--vary", "supply.voltage_V=20:28:50", "--json", "-", *ALONE],
    "sobol": ["run", SERIES, "--vary", "supply.voltage_V=20:28", "--vary", "pwm.period_s=20us:40us", "--points", "200", "--csv", "o.csv", *ALONE],
    "looked at": ["run", PLAN, "--dry-run"], "run": ["run", ONE, "--csv", "o.csv", "--set", "duration_s=2"], "two": ["run", ONE, data("scenarios/current-square-board.toml"), "--out", "o", *ALONE],
    "one of a plan": ["run", PLAN, "--only", "3", "--csv", "o.csv"], "bode": ["run", data("scenarios/thesis/7.3.1-locked-exact-design.toml"), "--bode", "--json", "o.json"],
    "optimise": ["design", "--optimise", data("plans/best-pwm.toml"), "--json", "o.json", *ALONE], "design": ["design", "maxon-251601", "--json", "o.json", *ALONE],
    "compare": ["compare", "maxon-251601", "--runs", "2", "--csv", "o.csv", *ALONE], "wiring": ["motor", "wiring", "maxon-251601", "--html", "o.html", *ALONE],
    "commission": ["motor", "commission", "maxon-251601", "--html", "o.html"], "emf": ["motor", "emf", data("recordings/trampa6340-emf.csv"), "--between", "lines", "--pole-pairs", "7", "--html", "o.html"],
    "identify": ["motor", "identify", "log.csv", "--html", "o.html"], "curve": ["curve", "maxon-251601", "--points", "400", "--csv", "o.csv"],
    "header": ["export", "header", ONE, "--out", "o.h", "--despite", "a test"], "new": ["new", "o"], "schema": ["schema"],
}
CODES = {signal.SIGINT: 130, signal.SIGTERM: 143, signal.SIGHUP: 129, signal.SIGQUIT: 131}
MEANINGS = r"interrupted|ended by SIG"


class Stopped(Started):
    def setUp(self):
        super().setUp()
        self.random = random.Random(f"{SEED} {self.id()}")

    def files(self):
        return {os.path.relpath(os.path.join(folder, name), self.path) for folder, _, names in os.walk(self.path) for name in names}

    def fresh(self):
        for name in self.names():
            path = self.path / name
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        (self.path / "log.csv").write_text(hall_log(turns=200, rows=30))

    def stopped(self, words, sent, wait):
        with self.started(*words) as program:
            time.sleep(wait)
            alive = program.poll() is None
            program.send_signal(sent)
            out, told = program.communicate(timeout=60)
        return alive, program.returncode, out, told

    def test_no_verb_that_is_told_to_end_says_that_all_went_well(self):
        whole = {}
        for n in range(COUNT):
            name = list(VERBS)[n % len(VERBS)] if COUNT < 500 else self.random.choice(list(VERBS))
            words, sent, wait = VERBS[name], self.random.choice(list(CODES)), self.random.uniform(0, 0.02)
            self.fresh()
            alive, code, out, told = self.stopped(words, sent, wait)
            with self.subTest(verb=name, signal=sent.name, wait=wait, seed=SEED):
                self.assertEqual([file for file in self.files() if ".sixstep-" in file], [], "nothing hidden is left")
                if not alive:
                    continue
                if code in (0, 1):
                    made = self.files()
                    self.fresh()
                    if name not in whole:
                        whole[name] = subprocess.run([PROGRAM, *words], cwd=self.path, capture_output=True, text=True, check=False), self.files()
                    reference, files = whole[name]
                    self.assertEqual((code, out, made), (reference.returncode, reference.stdout, files), "finished, and in place")
                else:
                    self.assertIn(code, (CODES[sent], -sent))
                if code > 1:
                    self.assertRegex(out + told, MEANINGS, "a word")
                    self.assertLess(sum(line.startswith(("ended by", "interrupted by")) for line in told.splitlines()), 2)

    def test_a_plan_that_never_began_says_so(self):
        """The message is printed as soon as the handler is installed. Before that the signal itself ends the program."""
        heard = 0
        for n in range(200):
            self.fresh()
            alive, code, out, told = self.stopped(["run", PLAN, "--out", "o", *ALONE], signal.SIGTERM, 0.0005 * (n % 60))
            if not alive or code < 0:
                continue
            heard += 1
            self.assertEqual(code, 143, (n, out, told))
            self.assertRegex(out + told, r"interrupted (before the first of 42 runs ended|after \d+ of 42 runs)|^ended by SIGTERM\n$")
            if heard == 10:
                return
        self.fail("the signal never came while it prepared")

    # A square wave with a period of 10 ms over 1e4 s has two million sections. The preparation lasts seconds, and nothing is
    # finished in this time.
    LONG = ["--set", "duration_s=1e4", "--set", "record.grid_s=1e-3", "--set", "reference.period_s=100"]

    def test_a_terminal_that_goes_leaves_what_is_finished(self):
        """The program receives the signal of a closed terminal twice: from the kernel and from the shell."""
        self.fresh()
        with self.started("run", ONE, "--csv", "o.csv", "--mat73", "o.mat", *self.LONG) as program:
            self.wait_until(lambda: len(self.names()) >= 3)
            time.sleep(0.3)
            for _ in range(2):
                program.send_signal(signal.SIGHUP)
            told = program.communicate(timeout=20)[1]
        self.assertEqual(program.returncode, 129, told)
        self.assertEqual(self.names(), ["log.csv", "o.partial.csv", "o.partial.mat"])
        self.assertIn("the finished part is in o.partial.csv, o.partial.mat\n", told)

    def test_nohup_is_heeded(self):
        self.fresh()
        ignored = lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)
        with self.started("run", ONE, *self.LONG, preexec_fn=ignored) as program:
            time.sleep(0.3)
            program.send_signal(signal.SIGHUP)
            time.sleep(0.3)
            self.assertIsNone(program.poll())

    def test_a_limit_of_processor_time_leaves_what_is_finished(self):
        self.fresh()
        limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (1, 30))
        with self.started("run", ONE, "--csv", "o.csv", *self.LONG, preexec_fn=limit) as program:
            told = program.communicate(timeout=60)[1]
        self.assertEqual(program.returncode, 152, told)
        self.assertEqual(self.names(), ["log.csv", "o.partial.csv"], told)

    def test_twice_ends_at_once_and_leaves_nothing_hidden(self):
        """A full pipe stops the program while it prints."""
        self.fresh()
        ours, full = os.pipe()
        os.set_blocking(full, False)
        try:
            while True:
                os.write(full, bytes(4096))
        except BlockingIOError:
            os.set_blocking(full, True)
        with self.started("run", SERIES, "--runs", "20", "--csv", "o.csv", *ALONE, stdout=full) as program:
            self.wait_until(lambda: len(self.names()) >= 2)
            time.sleep(1)
            for _ in range(2):
                program.send_signal(signal.SIGTERM)
                time.sleep(0.2)
            self.assertEqual(program.wait(timeout=10), -signal.SIGTERM)
        os.close(ours)
        os.close(full)
        self.assertEqual([file for file in self.files() if ".sixstep-" in file], [])


if __name__ == "__main__":
    print(f"seed {SEED}", file=sys.stderr)
    unittest.main()
