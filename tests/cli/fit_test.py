#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep motor fit: constants from logs of simulated benches whose constants are known, and what it says of bad input."""
import json
import random
import tomllib
import unittest

from program import ProgramTest

LOCKED = """
motor = "maxon-251601"
duration_s = 4e-3
load.locked = true
control.mode = "duty"
reference = { shape = "steps", times_s = [0, 0.5e-3], values = [0, 0.3] }
record = { grid_s = 20e-6, columns = ["i_a_A"] }
"""
TRUTH = {"resistance_ohm": 1.2, "inductance_mH": 0.5}


class Fit(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.path / "locked.toml").write_text(LOCKED)
        sets = [word for key, x in TRUTH.items() for word in ("--set", f"motor_override.{key}={x}")]
        self.run_program("run", "locked.toml", "--csv", "exact.csv", "--quiet", *sets)
        draw = random.Random(1)
        rows = [line.split(",") for line in (self.path / "exact.csv").read_text().splitlines() if line[0].isdigit()]
        self.rows = [(float(t), float(i) + 0.1 + draw.gauss(0, 0.05)) for t, i in rows]
        self.write("log.csv", self.rows)

    def write(self, name, rows, head="t_s,i_a_A"):
        (self.path / name).write_text(head + "\n" + "".join(f"{t:.9g},{x:.6g}\n" for t, x in rows))

    def fit(self, *words, code=0):
        return json.loads(self.run_program("motor", "fit", *words, "--json", code=code).stdout)

    def refused(self, *words):
        return self.run_program("motor", "fit", *words, code=2).stderr

    def values(self, found):
        return {v["key"].removeprefix("motor_override."): v for v in found["values"]}

    def assert_truth(self, values):
        for key, truth in TRUTH.items():
            self.assertLessEqual(values[key]["low"], truth, key)
            self.assertGreaterEqual(values[key]["high"], truth, key)
            self.assertLess(values[key]["high"] - values[key]["low"], 0.1 * truth, key)

    def test_the_bounds_contain_the_true_constants(self):
        found = self.fit("log.csv", "locked.toml")
        values = self.values(found)
        self.assert_truth(values)
        self.assertAlmostEqual(values["offset.i_a_A"]["value"], 0.1, delta=0.05)
        self.assertAlmostEqual(found["columns"][0]["difference_rms"], 0.05, delta=0.01)
        self.assertLess(abs(found["columns"][0]["correlation"]), 0.2)
        # A locked rotor shows neither friction nor inertia nor torque constant.
        self.assertEqual({u["key"].split(".")[1] for u in found["undetermined"]},
                         {"torque_constant_mNm_A", "inertia_gcm2", "viscous_friction_Nm_s", "coulomb_friction_mNm"})
        self.assertEqual(values["resistance_ohm"]["frame"], "terminal")

    def test_files_contain_what_is_printed(self):
        found = self.values(self.fit("log.csv", "locked.toml", "--write", "fitted.toml", "--html", "fit.html"))
        motor = tomllib.loads((self.path / "fitted.toml").read_text())
        for key in TRUTH:
            q, v = motor[key], found[key]
            width = v["high"] - v["low"]
            self.assertAlmostEqual(q["value"], v["value"], delta=0.05 * width)
            self.assertAlmostEqual(q["range"][0], v["low"], delta=0.05 * width)
            self.assertAlmostEqual(q["range"][1], v["high"], delta=0.05 * width)
            self.assertEqual(q["source"], "fitted from log.csv")
        # What the recording does not determine stays as the sheet prints it.
        self.assertEqual(motor["inertia_gcm2"]["value"], 135)
        page = (self.path / "fit.html").read_text()
        self.assertIn("i_a_A of log.csv: recorded, and simulated over it", page)
        # The written motor is a motor: with it, the fit begins at its result.
        again = self.values(self.fit("log.csv", "locked.toml", "--set", "motor=\"fitted.toml\""))
        for key in TRUTH:
            self.assertAlmostEqual(again[key]["value"], found[key]["value"], delta=0.1 * (found[key]["high"] - found[key]["low"]))

    def test_the_pair_may_stand_in_either_order_and_columns_may_be_named(self):
        self.write("scope.csv", [(t, x / 10) for t, x in self.rows], "time,CH1")
        found = self.values(self.fit("locked.toml", "scope.csv", "--columns", "i_a_A=CH1*10"))
        self.assert_truth(found)

    def test_a_clock_that_starts_late_is_counted_from_the_first_row(self):
        self.write("late.csv", [(t + 7200, x) for t, x in self.rows])
        result = self.run_program("motor", "fit", "late.csv", "locked.toml", "--json")
        self.assertIn("its clock starts at 7200 s", result.stderr)
        self.assert_truth(self.values(json.loads(result.stdout)))

    def test_a_shift_can_be_fixed(self):
        self.write("moved.csv", [(t + 1e-3, x) for t, x in self.rows])
        found = self.fit("moved.csv", "locked.toml", "--shift=-1e-3")
        self.assert_truth(self.values(found))
        self.assertNotIn("shift_s", self.values(found))

    def test_a_wrong_scenario_is_told_by_the_correlation(self):
        told = self.run_program("motor", "fit", "log.csv", "locked.toml", "--free", "offset").stdout
        self.assertIn("Noise alone does not explain it", told)

    def test_bad_input_is_refused_with_its_cure(self):
        self.assertIn("name each log beside its scenario", self.refused("log.csv"))
        self.assertIn("name each log beside its scenario", self.refused("log.csv", "exact.csv"))
        self.assertIn("give one shift for each log", self.refused("log.csv", "locked.toml", "--shift", "0,1"))
        self.assertIn("is no number of the motor", self.refused("log.csv", "locked.toml", "--free", "motor_override.colour"))
        self.assertIn("--interval", self.refused("log.csv", "locked.toml", "--interval", "0"))
        self.write("labels.csv", [(t, 5) for t, _ in self.rows], "t_s,hall")
        self.assertIn("record a current, a voltage or the speed", self.refused("labels.csv", "locked.toml"))
        self.write("few.csv", self.rows[:5])
        self.assertIn("ten are needed", self.refused("few.csv", "locked.toml"))
        (self.path / "empty.csv").write_text("")
        self.assertIn("is empty", self.refused("empty.csv", "locked.toml"))
        self.assertIn("nothing.toml", self.refused("log.csv", "nothing.toml"))
        self.write("nan.csv", [(t, x if n % 2 else float("nan")) for n, (t, x) in enumerate(self.rows)])
        self.assertIn("nan.csv", self.refused("nan.csv", "locked.toml"))
        for name in ("fitted.toml", "fit.html"):
            self.assertFalse((self.path / name).exists())


if __name__ == "__main__":
    unittest.main(verbosity=1)
