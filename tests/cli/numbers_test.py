#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Absurd numbers in every option that expects a number. The option is refused with a message, at once, and no file is
written."""
import json
import unittest

from program import ProgramTest

HOSTILE = ["nan", "inf", "-inf", "1e308", "-1e308", "5e-324"]


class Numbers(ProgramTest):
    def refused(self, *words):
        result = self.run_program(*words, code=2)
        self.assertEqual(result.stdout, "")
        self.assertEqual(self.names(), [])
        self.assertNotIn("defect", result.stderr)
        self.assertLess(len(result.stderr), 4000)
        return result.stderr

    def test_options_of_design(self):
        for option in ["--voltage", "--period", "--settle", "--current-settle", "--damping", "--torque-limit", "--load-inertia"]:
            for number in HOSTILE:
                told = self.refused("design", "maxon-251601", "--mode", "speed", option, number, "--toml", "a.toml")
                self.assertTrue(told.startswith(option + " = "), told)
        for number in HOSTILE:
            self.assertIn("--bandwidth", self.refused("design", "maxon-251601", "--method", "cancellation", "--bandwidth", number))
            self.refused("design", "maxon-251601", "--step", number)
            self.assertIn("--angle", self.refused("design", "maxon-251601", "--models", "a.json", "--angle", number))
        self.assertIn("turns the field at", self.refused("design", "maxon-251601", "--voltage", "1e5"))

    def test_options_of_curve(self):
        for option in ["--voltage", "--duty", "--pwm-period", "--on-resistance", "--diode-drop", "--ambient"]:
            for number in HOSTILE:
                if (option, number) == ("--ambient", "5e-324"):
                    continue  # this value is rounded to 0 degC, which is allowed
                self.assertTrue(self.refused("curve", "maxon-251601", option, number, "--csv", "a.csv").startswith(option + " = "))
        for points in ["2147483647", "200001", "-1", "99999999999999999999"]:
            self.assertIn("points", self.refused("curve", "maxon-251601", "--points", points))

    def test_options_of_the_others(self):
        for number in HOSTILE:
            for mode in ["duty", "speed"]:
                self.assertTrue(self.refused("new", "a", "--mode", mode, "--voltage", number).startswith("--voltage = "))
        for count in ["0", "-1", "nan", "1e308", "99999999999999999999"]:
            self.refused("run", "x.toml", "--runs", count)

    def test_a_range_to_export(self):
        file = self.write("a.toml", 23)
        for number in HOSTILE:
            told = self.run_program("export", "header", file, "--arithmetic", "q15", "--range", "current_A=" + number, code=2).stderr
            self.assertIn("must be a number above 0 and at most 1000000", told)

    def test_a_setting_is_held_to_the_same_table(self):
        file = self.write("a.toml", 23)
        for number in HOSTILE:
            told = self.run_program("run", file, "--set", "supply.voltage_V=" + number, "--json", "a.json", code=2).stderr
            self.assertTrue(told.startswith(f"--set supply.voltage_V = {number} must be"), told)
        self.assertEqual(self.names(), ["a.toml"])

    def test_a_run_that_runs_away_is_a_fault_and_its_files_hold_numbers(self):
        file = self.write("a.toml", 23)
        words = ["--set", "load.locked=false", "--set", "load.torque_Nm=-16000", "--set", "duration_s=0.001"]
        result = self.run_program("run", file, *words, "--csv", "a.csv", "--json", "a.json", code=3)
        self.assertIn("the run diverged: the speed is", result.stdout)
        self.assertFalse(json.loads((self.path / "a.json").read_text())["passed"])
        rows = [line for line in (self.path / "a.csv").read_text().splitlines() if not line.startswith("#")]
        self.assertGreater(len(rows), 2)
        for row in rows[1:]:
            self.assertNotRegex(row, "nan|inf")


if __name__ == "__main__":
    unittest.main()
