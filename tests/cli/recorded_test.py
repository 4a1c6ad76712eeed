#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep run with [[compare]] of a recording: table, JSON, page, exit code; packed, damaged and endless files."""
import gzip
import json
import re
import unittest

from program import SOURCE, ProgramTest

SCENARIO = """motor = "maxon-251601"
duration_s = 0.02
[control]
mode = "duty"
[reference]
value = 0.5
[load]
dynamometer_times_s = [0]
dynamometer_rad_s = [150]
[record]
grid_s = 1e-6
columns = ["u_a_V", "i_a_A"]
"""
COMPARE = """[[compare]]
file = "{file}"
signal = "u_a_V"
column = "u_a"
figures = ["high_s", "period_s", "difference_rms"]
level = 12
longest_s = 20e-6
{more}
"""


class Recorded(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.path / "plain.toml").write_text(SCENARIO)
        self.run_program("run", "plain.toml", "--csv", "plain.csv", "--quiet")
        rows = [line.split(",")[1] for line in (self.path / "plain.csv").read_text().splitlines() if line[0] in "-0123456789"]
        self.recording = "# Sample interval: 1e-6 s\nu_a [V]\n" + "\n".join(rows) + "\n"
        (self.path / "r.csv").write_text(self.recording)
        (self.path / "r.csv.gz").write_bytes(gzip.compress(self.recording.encode()))

    def scenario(self, file, more=""):
        (self.path / "s.toml").write_text(SCENARIO + COMPARE.format(file=file, more=more))
        return "s.toml"

    def compared(self, *words):
        text = self.run_program("run", *words, "--json", "-", "--quiet", code=None).stdout
        return json.loads(text)

    def test_a_recording_of_the_run_itself_is_within(self):
        for file in ("r.csv", "r.csv.gz"):
            told = self.compared(self.scenario(file))
            self.assertEqual([c["verdict"] for c in told["compare"]], ["within"] * 3, told)
            self.assertTrue(told["passed"])
            high, period, apart = told["compare"]
            self.assertAlmostEqual(high["measured"], 15e-6, delta=high["uncertainty"] + 1e-6)
            self.assertAlmostEqual(period["measured"], 30e-6, delta=1e-7)
            self.assertLess(apart["measured"], 1e-9)

    def test_another_duty_is_beyond_and_fails_only_with_a_tolerance(self):
        told = self.run_program("run", self.scenario("r.csv"), "--set", "reference.value=0.6", code=0).stdout
        self.assertRegex(told, r"time above the level, .* beyond by [0-9.]+ us \(\+- [0-9.]+ [nu]s\)")
        self.assertIn("recorded    simulated", re.sub("  +", "    ", told))
        self.assertRegex(told, r"nothing required, \d of 3 recorded figures within their uncertainty")
        told = self.run_program("run", self.scenario("r.csv", "tolerance_percent = 5"), "--set", "reference.value=0.6", code=1).stdout
        self.assertIn("FAILED", told)
        self.assertFalse(self.compared("s.toml", "--set", "reference.value=0.6")["passed"])
        self.run_program("run", self.scenario("r.csv", "tolerance_percent = 50"), "--set", "reference.value=0.6", code=0)  # 28 % at most
        self.run_program("run", self.scenario("r.csv", "tolerance_percent = 5"), code=0)

    def test_a_page_draws_both_and_the_difference(self):
        self.run_program("run", self.scenario("r.csv"), "--html", "p.html", "--quiet", code=0)
        page = (self.path / "p.html").read_text(encoding="utf-8")
        for word in ("r.csv over u_a_V", "recorded less simulated", "within"):
            self.assertIn(word, page)

    def test_a_plan_has_its_figures_as_columns(self):
        told = self.run_program("run", self.scenario("r.csv"), "--vary", "reference.value=0.4,0.5,0.6", code=0).stdout
        self.assertIn("time above the level, voltage of terminal a", told)
        self.assertRegex(told, r"(?m)^ +1 +0\.5 +1[45]\.\d* us")

    def test_shipped_scenarios_of_real_motors_run(self):
        names = sorted((SOURCE / "data/measured").glob("*.toml"))
        self.assertEqual(len(names), 5)
        for name in names:
            told = self.compared(str(name))
            self.assertTrue(told["compare"], name)
            for c in told["compare"]:
                self.assertIn(c["verdict"], ("within", "beyond", "none"), f"{name}: nothing fails without a tolerance")

    def test_what_is_packed_wrongly_is_refused(self):
        whole = gzip.compress(self.recording.encode())
        (self.path / "cut.gz").write_bytes(whole[:len(whole) // 2])
        (self.path / "bad.gz").write_bytes(whole[:40] + bytes(b ^ 255 for b in whole[40:80]) + whole[80:])
        (self.path / "head.gz").write_bytes(b"\x1f\x8b")
        (self.path / "bomb.gz").write_bytes(gzip.compress(b"0\n" * (70 << 20)))
        (self.path / "twice.gz").write_bytes(gzip.compress(whole))
        for name, said in (("cut.gz", "damaged or incomplete"), ("bad.gz", "damaged or incomplete"), ("head.gz", "damaged or incomplete"),
                           ("bomb.gz", "larger than 128 MiB"), ("twice.gz", "twice.gz"), (".", "folder"), ("/dev/zero", "not a regular file")):
            told = self.run_program("run", self.scenario(name), code=2).stderr
            self.assertIn(said, told)


if __name__ == "__main__":
    unittest.main()
