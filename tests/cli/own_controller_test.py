#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A user's controller that ends the program, crashes, overwrites memory, changes the rounding mode or does not
return. The message names the controller and the place, and no file of the program is wrong
(tests/files/controllers/misbehaving/)."""
import json
import os
import pathlib
import platform
import re
import signal
import subprocess
import time
import unittest

from program import PROGRAM, ProgramTest, Started

CONTROLLER = pathlib.Path(PROGRAM).parent / "controllers/misbehaves.so"
SCENARIO = f"""
motor = "maxon-251601"
duration_s = {{duration}}
[control]
drive = "own"
mode = "current"
[control.own]
controller = "{CONTROLLER}"
[reference]
value = 2
unit = "A"
[[require]]
metric = "max"
signal = "current"
label = "most"
max = 1000
"""
WHO = rf"^{re.escape(str(CONTROLLER))}: the controller "
ENDS = "; the program ends here, and unfinished results are lost\n$"
AT_20 = r" in step 20, at t = 0\.000570 s"

# The message for each way to end the program, and the steps in which it may occur.
WAYS = {"exit": r"ended the program by exit\(\)", "quick_exit": r"ended the program by exit\(\)", "_exit": r"ended the program by _exit\(\)",
        "_Exit": r"ended the program by _exit\(\)", "abort": r"ended itself by abort\(\) \(SIGABRT\)", "null": r"crashed \(SIGSEGV: .*\)",
        "divide": r"crashed \(SIGFPE: .*\)", "illegal": r"crashed \(SIG(ILL|TRAP).*\)", "recursion": r"crashed \(SIG(SEGV|BUS): .*\)",
        "pthread_exit": r"ended its thread, for example by pthread_exit\(\)"}
PLACES = {"load": " while it was loaded", "design": " in its design", "start": " in its start", "step": AT_20, "hall": r" in its hall\(\) after step \d+, after t = [\d.]+ s"}


class OwnController(Started):
    def setUp(self):
        super().setUp()
        (self.path / "a.toml").write_text(SCENARIO.format(duration=0.01))

    def behaving(self, deed, *words, by=1, at=20):
        """Deletes the files of the last run, and runs the controller with the given error. Returns exit code,
        standard output and standard error."""
        for name in set(self.names()) - {"a.toml", "s.sqlite", "s.sqlite.stopped"}:
            (self.path / name).unlink()
        made = subprocess.run([PROGRAM, *(words or ("run", "a.toml", "--csv", "o.csv", "--json", "o.json"))], cwd=self.path, capture_output=True, text=True, timeout=60,
                              env={**os.environ, "MISBEHAVES": deed, "MISBEHAVES_BY": str(by), "MISBEHAVES_AT": str(at)}, check=False)
        return made.returncode, made.stdout, made.stderr

    def nothing_is_left(self, *but):
        self.assertEqual(self.names(), sorted(["a.toml", *but]))

    def is_named(self, deed, said, *words, by=1):
        with self.subTest(deed, by=by):
            code, out, told = self.behaving(deed, *words, by=by)
            self.assertEqual(code, 3, told)
            self.assertRegex(told, WHO + said)
            self.assertEqual(out, "", "no verdict")
            self.nothing_is_left()

    def test_no_header_of_another_drive_is_written_for_it(self):
        """A header configures the library's drives. A header with the figures of this run would flash another
        controller."""
        for words in ((), ("--despite", "a trial")):
            made = subprocess.run([PROGRAM, "export", "header", "a.toml", *words, "--out", "d.hpp"], cwd=self.path, capture_output=True, text=True, check=False)
            self.assertEqual(made.returncode, 2, made.stderr)
            self.assertIn('control.drive = "own" has its constants in its own source', made.stderr)
            self.nothing_is_left()

    def test_whatever_ends_the_program_is_told_by_name_and_place(self):
        for way, said in WAYS.items():
            for place, where in PLACES.items():
                self.is_named(f"{place}-{way}", said + where + ENDS)

    def test_a_thread_of_its_own_that_ends_the_program(self):
        self.is_named("thread-exit", r"ended the program by exit\(\) in a thread that it had started" + ENDS)

    def test_what_is_written_beside_its_bytes(self):
        beside = r"(wrote to memory outside its {0}|crashed \(SIGSEGV: .*\))"
        for by in (1, 2, 8, 15, 16, 17, 32, 64, 255, 256, 1000, 4095, 4096):
            self.is_named("behind-state", beside.format("state") + AT_20 + ENDS, by=by)
            self.is_named("behind-config", beside.format("config") + " in its design" + ENDS, by=by)
            self.is_named("behind-answer", beside.format("answer") + AT_20 + ENDS, by=by)
        self.is_named("before-state", "wrote to memory outside its state" + AT_20 + ENDS)
        self.is_named("before-config", "wrote to memory outside its config in its design" + ENDS)
        for deed in ("far-before-state", "into-config", "stack"):
            self.is_named(deed, r"(crashed|gave up).*" + AT_20 + ENDS)
        self.is_named("bad-name", r"crashed \(SIGSEGV: .*\) while it was loaded" + ENDS)
        self.is_named("bad-sentence", r"crashed \(SIGSEGV: .*\) in its design" + ENDS)
        self.is_named("exception-at-work", r"crashed \(SIGFPE: .*\)" + AT_20 + ENDS)

    def test_what_it_says_of_itself_is_bounded(self):
        for deed, said in (("huge", "config_bytes"), ("no-step", "step"), ("no-list", "must be an array of `parameters`"), ("nothing", "returned a null pointer"), ("long-sentence", "a" * 1000)):
            code, _, told = self.behaving(deed)
            self.assertEqual((code, said in told, len(told) < 2000), (2, True, True), told[:3000])
            self.nothing_is_left()

    def test_how_it_rounds_stays_its_own(self):
        """The bits are the same as with a controller that does not change the processor's state, in this run and in
        every later run."""
        digest = lambda: json.loads((self.path / "o.json").read_text())["digest"]
        self.assertEqual(self.behaving("well")[0], 0)
        well, rows = digest(), (self.path / "o.csv").read_text()
        for deed in ("rounding", "exceptions") + (("flush-to-zero",) if platform.machine() == "x86_64" else ()):
            with self.subTest(deed):
                code, _, told = self.behaving(deed, "run", "a.toml", "--csv", "o.csv", "--json", "o.json", "--force", at=20)
                self.assertEqual(code, 0, told)
                self.assertEqual(digest(), well)
                self.assertEqual((self.path / "o.csv").read_text().splitlines()[3:], rows.splitlines()[3:])

    def test_an_answer_that_no_timer_can_carry_out_ends_the_run(self):
        for deed in ("not-a-number", "endless", "negative", "no-leg", "one-leg", "no-choice", "overlap", "gives-up"):
            with self.subTest(deed):
                code, out, _ = self.behaving(deed, "run", "a.toml")
                self.assertEqual(code, 3)
                self.assertRegex(out, rf"STOPPED by a fault: t = 0\.000570 s {re.escape(str(CONTROLLER))}: the controller answered [\w\[\].]+ = .* in step 20\b")
                code, out, told = self.behaving(deed, "run", "a.toml", "--quiet")
                self.assertEqual((code, out), (3, ""))
                self.assertRegex(told, "^a: stopped by a fault: .+\n$", "a quiet run says why")

    def test_a_change_of_folder_moves_no_file(self):
        code, _, told = self.behaving("other-folder")
        self.assertEqual(code, 0, told)
        self.nothing_is_left("o.csv", "o.json")

    def test_a_comparison_names_it_too(self):
        code, _, told = self.behaving("step-exit", "compare", "maxon-251601", "--own", str(CONTROLLER), "--runs", "2", "--csv", "c.csv")
        self.assertEqual(code, 3)
        self.assertRegex(told, WHO + WAYS["exit"] + " in step 20, ")
        self.nothing_is_left()

    def test_a_plan_goes_on_without_the_run_that_ended_it(self):
        """The controller fails in step 20. Of the four runs only the third has twenty steps, because of its period."""
        (self.path / "a.toml").write_text(SCENARIO.format(duration=0.0006))
        plan = ["run", "a.toml", "--vary", "pwm.period_s=100us,60us,30us,50us", "--store", "s.sqlite", "--jobs", "1"]
        code, _, told = self.behaving("step-abort", *plan)
        self.assertEqual(code, 3)
        self.assertRegex(told, WHO + WAYS["abort"] + AT_20 + ", of run 2" + ENDS)
        code, out, told = self.behaving("step-abort", *plan, "--resume", "--csv", "o.csv")
        self.assertEqual((code, told), (3, ""))
        self.assertRegex(out, rf"1 stopped by a fault, first run 2: {re.escape(str(CONTROLLER))}: the controller ended itself by abort\(\) \(SIGABRT\) in step 20")
        self.assertIn("4 runs: 3 hold every requirement, 1 do NOT\n", out)
        self.nothing_is_left("o.csv", "s.sqlite")
        code, out, _ = self.behaving("well", *plan, "--resume", "--quiet", "--force", "--csv", "o.csv")
        self.assertEqual((code, out), (3, ""), "what stands in the store stays")

    def stuck(self, deed, *words):
        with self.started(*words, env={**os.environ, "MISBEHAVES": deed}) as program:
            time.sleep(0.7)
            program.send_signal(signal.SIGINT)
            told = program.stderr.readline()
            self.assertIsNone(program.poll())
            program.send_signal(signal.SIGINT)
            rest = program.communicate(timeout=10)[1]
        return program.returncode, told + rest

    def test_who_does_not_come_back_is_named_at_ctrl_c(self):
        for place in ("load", "design", "step"):
            with self.subTest(place):
                code, told = self.stuck(f"{place}-loop", "run", "a.toml", "--csv", "o.csv")
                self.assertEqual(code, -signal.SIGINT)
                self.assertRegex(told, WHO + "does not return" + PLACES[place] + r"; press Ctrl-C again to end the program \(or send a second SIGTERM\)\n$")
                self.nothing_is_left()
        code, told = self.stuck("step-loop", "run", "a.toml", "--vary", "supply.voltage_V=20,22", "--store", "s.sqlite", "--jobs", "1")
        self.assertRegex(told, ", of run 0; press")
        code, out, _ = self.behaving("well", "run", "a.toml", "--vary", "supply.voltage_V=20,22", "--store", "s.sqlite", "--resume")
        self.assertEqual(code, 3)
        self.assertIn("the controller does not return in step 20", out)


if __name__ == "__main__":
    unittest.main()
