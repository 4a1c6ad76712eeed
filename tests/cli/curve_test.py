#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep curve: its table, its files, and the input that it refuses."""
import json
import re
import unittest

from program import SOURCE, ProgramTest

class Curve(ProgramTest):
    def test_curve_prints_a_table_and_writes_whole_files(self):
        shown = self.run_program("curve", "maxon-251601", "--csv", "a.csv", "--json", "a.json", "--html", "a.html").stdout
        self.assertIn("No load: 6709.5 rpm (702.613 rad/s) with 0.1531 A through the winding", shown)
        self.assertEqual(self.names(), ["a.csv", "a.html", "a.json"])
        rows = (self.path / "a.csv").read_text().splitlines()
        self.assertEqual(rows[2], "# command: sixstep curve maxon-251601 --csv a.csv --json a.json --html a.html")
        self.assertTrue(rows[1].startswith("# motor: maxon-251601; "), rows[1])
        # The header of the limits names their conditions, as the table does, and what the first row neglects.
        worse = re.search(r"worse ends of the motor file's ranges \((.*?)\)", " ".join(shown.split())).group(1)
        self.assertIn(f"25 degC ambient and the worse ends {worse}", rows[1])
        self.assertIn("speed 0 without friction", rows[1])
        rows = [row for row in rows if not row.startswith("#")]
        self.assertEqual(len(rows), 42)
        self.assertTrue(rows[0].startswith("speed_rad_s,torque_Nm,air_gap_torque_Nm,ideal_torque_Nm,"))
        curve = json.loads((self.path / "a.json").read_text())
        self.assertNotRegex("\n".join(rows), r"(?i)\b(nan|inf)\b", "what has no value leaves its cell empty")
        last = dict(zip(rows[0].split(","), (float(cell) if cell else None for cell in rows[-1].split(","))))
        self.assertEqual(last["speed_rad_s"], curve["points"][-1]["speed_rad_s"])
        held = dict(zip(rows[0].split(","), (float(cell) if cell else None for cell in rows[1].split(","))))
        self.assertEqual((held["speed_rad_s"], held["torque_Nm"]), (0, held["air_gap_torque_Nm"]))
        self.assertTrue("--html a.html" in (self.path / "a.html").read_text(), "the page names the command that made it")
        self.assertEqual(self.run_program("curve", "maxon-251601", "--quiet").stdout, "")
        self.assertEqual(json.loads(self.run_program("curve", "maxon-251601", "--json", "-").stdout), curve)

    def test_ratings_are_told_with_their_source(self):
        """The ratings of the 251601 are from a set-up file, and the text names this file. Without a named source, the
        text calls them ratings of the sheet."""
        told = self.run_program("curve", "maxon-251601", "--points", "3").stdout
        self.assertIn("\nNominal point, public ESCON set-up file: 83.40 mNm, 5240 rpm, 2.330 A; ", told)
        plain = (SOURCE / "data/motors/maxon-251601.toml").read_text().replace(', source = "public ESCON set-up file"', "")
        (self.path / "plain.toml").write_text(plain)
        self.assertIn("\nNominal point of the sheet: 83.40 mNm", self.run_program("curve", "plain.toml", "--points", "3").stdout)

    def test_speeds_that_the_sheet_does_not_allow_are_told(self):
        told = " ".join(self.run_program("curve", "maxon-251601", "--voltage", "48", "--points", "3").stdout.split())
        allowed, no_load = map(float, re.search(r"The sheet's speed limit is (\d+) rpm, but the no-load speed is (\d+) rpm", told).groups())
        self.assertEqual(allowed, 10000)
        self.assertGreater(no_load, 1.8 * 6710)  # at twice the voltage the speed is about twice as high
        self.assertNotIn("The sheet's speed limit", self.run_program("curve", "maxon-251601", "--points", "3").stdout)

    def test_a_linear_motors_curve_is_in_newtons(self):
        self.run_program("curve", "example-linear", "--points", "5", "--csv", "a.csv", "--json", "a.json", "--html", "a.html", "--quiet")
        rows = [row for row in (self.path / "a.csv").read_text().splitlines() if not row.startswith("#")]
        self.assertTrue(rows[0].startswith("speed_m_s,force_N,air_gap_force_N,ideal_force_N,"))
        linear = json.loads((self.path / "a.json").read_text())
        turning = json.loads(self.run_program("curve", "maxon-251601", "--points", "5", "--json", "-").stdout)
        for a, b in zip(linear["points"], turning["points"]):  # linear motor: the 251601 unrolled, with a radius of 20 mm
            self.assertAlmostEqual(a["force_N"], b["torque_Nm"] / 0.02, 9)
            self.assertAlmostEqual(a["speed_m_s"], b["speed_rad_s"] * 0.02, 10)
        self.assertIn("Force-speed curve of Example", (self.path / "a.html").read_text())

    def test_curve_is_the_same_on_any_number_of_threads(self):
        words = ["curve", "maxon-251601", "--duty", "0.6", "--chopping", "hard", "--points", "7", "--json", "-"]
        self.assertEqual(self.run_program(*words, "--jobs", "1").stdout, self.run_program(*words, "--jobs", "3").stdout)

    def test_curve_refuses_properly(self):
        def told(*words):
            result = self.run_program("curve", *words, "--csv", "a.csv", code=2)
            self.assertEqual(result.stdout, "")
            return result.stderr
        self.assertTrue(told("maxon-251601", "--duty", "0").startswith("--duty = 0 must be in (0, 1]"))
        self.assertTrue(told("maxon-251601", "--duty", "-0.5").startswith("--duty = -0.5 must be in (0, 1]"))
        self.assertTrue(told("maxon-251601", "--voltage", "-24").startswith("--voltage = -24 must be above 0"))
        self.assertTrue(told("maxon-251601", "--points", "1").startswith("--points = 1 must be at least 2"))
        self.assertIn("did you mean soft?", told("maxon-251601", "--chopping", "sof"))
        for option in (("--chopping", "hard"), ("--pwm-period", "1e-4")):
            self.assertIn(f"{option[0]} has no effect at full duty", told("maxon-251601", *option))
        self.assertTrue(told("maxon-251601", "--ambient", "1e5").startswith("--ambient = 1e+05"))
        self.assertIn("did you mean", told("maxon-25160"))
        self.assertEqual(told("mjbots-mj5208"), "--voltage is missing, and the sheet prints no nominal voltage; give the bus voltage in volts\n")
        both = told("maxon-251601", "--pwm-period", "0", "--diode-drop", "-1", "--on-resistance", "-1")
        self.assertEqual([line.split(" = ")[0] for line in both.splitlines()],
                         ["--pwm-period", "--on-resistance", "--diode-drop"])
        self.run_program("curve", "maxon-251601", "--duty", "half", code=2)
        self.run_program("curve", code=2)
        self.assertIn("cannot be written", self.run_program("curve", "maxon-251601", "--html", "no/a.html", code=2).stderr)
        sheet = (SOURCE / "data/motors/maxon-251601.toml").read_text()
        (self.path / "no-inertia.toml").write_text(re.sub(r"inertia_gcm2.*", "", sheet))
        self.assertIn("inertia_gcm2", told("no-inertia"))
        (self.path / "rusty.toml").write_text(sheet + "\ncoulomb_friction_mNm = 900\n")
        self.assertIn("gives less torque than the motor's friction", told("rusty"))
        (self.path / "bare.toml").write_text("\n".join(x for x in sheet.splitlines() if not re.match("thermal|max_winding", x)))
        bare = self.run_program("curve", "bare").stdout
        self.assertIn("No thermal limits: thermal_resistance_winding_housing_K_W, ", bare)
        self.assertEqual(self.names(), ["bare.toml", "no-inertia.toml", "rusty.toml"])


if __name__ == "__main__":
    unittest.main()
