#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep motor, and the steps of a user who has a printed data sheet."""
import json
import pathlib
import re
import unittest

from program import SHORT, SOURCE, ProgramTest

PRINTED = (pathlib.Path(__file__).parent / "printed_sheet.txt").read_text()

class Motor(ProgramTest):
    def test_motors_and_version(self):
        self.assertIn("maxon-251601", self.run_program("motor", "list").stdout)
        self.assertIn("data sheet, line 12", self.run_program("motor", "show", "maxon-251601").stdout)
        self.assertIn("did you mean", self.run_program("motor", "show", "maxon-25161", code=2).stderr)
        self.assertTrue(self.run_program("--version").stdout.startswith("sixstep "))

    def test_a_sheet_of_ones_own_from_the_template_to_a_run(self):
        self.assertIn("sixstep motor check mine.toml", self.run_program("motor", "new", "--style", "drone", "mine").stdout)
        self.assertEqual(self.names(), ["mine.toml"])
        self.assertIn("mine.toml already exists", self.run_program("motor", "new", "mine", code=2).stderr)
        text = (self.path / "mine.toml").read_text()
        self.assertEqual(self.run_program("motor", "new", "--style", "drone").stdout, text.replace('"mine"', '"my motor"'))
        for line in self.run_program("motor", "check", "mine.toml", code=2).stderr.splitlines():
            self.assertIn(" must ", line)
        sheet = {"winding": '"12N14P"', "nominal_voltage_V": "14.8", "speed_constant_rpm_V": '{ value = 920, frame = "line-peak" }',
                 "resistance_mohm": '{ value = 117, frame = "terminal" }', "inductance_uH": '{ value = 35, frame = "terminal" }',
                 "inertia_gcm2": "50.6", "idle_current_A": "0.6", "idle_voltage_V": "10"}
        for key, value in sheet.items():
            text, count = re.subn(rf"(?m)^(# )?{key} = .*$", f"{key} = {value}", text)
            self.assertEqual(count, 1, key)
        (self.path / "mine.toml").write_text(text)
        self.assertIn("consistent", self.run_program("motor", "check", "mine.toml").stdout)
        (self.path / "a.toml").write_text(SHORT.format(limit=1000).replace("maxon-251601", "mine"))
        self.run_program("run", "a.toml")

    def test_motor_check_tells_a_contradiction_by_its_exit_code(self):
        shipped = (SOURCE / "data/motors/maxon-251601.toml").read_text()
        (self.path / "a.toml").write_text(shipped)
        self.assertIn("consistent: 6 of 7", self.run_program("motor", "check", "a.toml").stdout)
        (self.path / "a.toml").write_text(shipped.replace("value = 23.3,", "value = 32.3,"))
        result = self.run_program("motor", "check", "a.toml", code=1)
        self.assertRegex(result.stdout, r"BROKEN stall current .*\n")
        self.assertTrue(result.stdout.endswith("INCONSISTENT: 5 of 7 relations hold, 1 broken as known_deviation states, 1 broken\n"), result.stdout)
        checked = json.loads(self.run_program("motor", "check", "--json", "a.toml", code=1).stdout)
        self.assertEqual([r["name"] for r in checked["relations"] if r["verdict"] == "broken"], ["stall current"])
        self.assertIs(checked["consistent"], False)
        (self.path / "a.toml").write_text(shipped.replace('["nominal torque"]', '["stall current"]'))
        self.assertIn("names a relation that holds; remove this name", self.run_program("motor", "check", "a.toml", code=2).stderr)

    def test_motor_check_says_what_a_simulation_lacks(self):
        words = 'name = "a"\npole_pairs = 7\nresistance_ohm = { value = 0.1, frame = "phase" }\n'
        (self.path / "a.toml").write_text(words)
        last = self.run_program("motor", "check", "a.toml").stdout.splitlines()[-1]
        self.assertEqual(last, "consistent: no two values of the sheet can be compared; it cannot be simulated: inductance_mH, "
                               "torque_constant_mNm_A and inertia_gcm2 are missing")
        more = 'inductance_uH = { value = 50, frame = "phase" }\nflux_linkage_mWb = 5\ninertia_gcm2 = 400\n'
        (self.path / "a.toml").write_text(words + more)
        self.assertTrue(self.run_program("motor", "check", "a.toml").stdout.endswith("\nconsistent: no two values of the sheet can be compared\n"))
        (self.path / "a.toml").write_text(words + more + 'simulatable = false\nnot_simulatable_because = "nobody trusts its inertia"\n')
        self.assertIn("; it cannot be simulated: nobody trusts its inertia\n", self.run_program("motor", "check", "a.toml").stdout)

    def test_every_style_is_named_where_one_looks_for_it(self):
        asked = self.run_program("motor", "new", "--help").stdout
        for style in "maxon drone servo faulhaber nanotec portescap hub linear firmware".split():
            self.assertIn(style, asked)
            self.assertIn("sixstep motor check FILE", self.run_program("motor", "new", "--style", style).stdout)

    def test_every_built_in_motor_is_one_line_and_shows_as_json(self):
        lines = self.run_program("motor", "list").stdout.splitlines()[1:]
        listed = json.loads(self.run_program("motor", "list", "--json").stdout)
        self.assertEqual([motor["name"] for motor in listed], [line.split()[0] for line in lines])
        thesis = next(motor for motor in listed if motor["name"] == "maxon-251601")
        self.assertEqual((thesis["pole_pairs"], thesis["terminal_resistance_ohm"], thesis["torque_constant_Nm_A"]), (8, 1.03, 0.0335))
        self.assertGreaterEqual(len(lines), 30)
        for line in lines:
            shown = json.loads(self.run_program("motor", "show", "--json", line.split()[0]).stdout)
            self.assertEqual(shown["model"]["simulatable"], "not simulatable" not in line, line)
            self.assertEqual(shown["model"]["pole_pairs"] or "-", int(line.split()[1]) if line.split()[1] != "-" else "-")

    def test_a_printed_sheet_becomes_verified_gains_with_no_other_file(self):
        self.run_program("motor", "new", "mine")
        text = (self.path / "mine.toml").read_text()
        for number, value in re.findall(r"(?m)^ *(\d+)  .* ([\d.]+)$", PRINTED):
            typed, count = re.subn(rf"(?m)^(# )?(line_{number}_\w+ = )(.*?)(nan|0)(.*)$", rf"\g<2>\g<3>{value}\g<5>", text)
            self.assertEqual(count, 1, number)
            text = typed
        (self.path / "mine.toml").write_text(text)
        self.assertRegex(self.run_program("motor", "check", "mine.toml").stdout, r"\nconsistent: (\d+) of \1 relations hold\n$")
        no_load = json.loads(self.run_program("curve", "mine.toml", "--json", "-").stdout)["no_load"]["speed_rad_s"]
        self.assertAlmostEqual(no_load * 30 / 3.141592653589793 / 5160, 1, 2)
        told = self.run_program("design", "mine.toml", "--mode", "speed", "--toml", "drive.toml").stdout
        self.assertRegex(told, r"^usable.*: the speed loop settles within 10 % in ")
        self.assertEqual(self.run_program("run", "drive.toml", "--json", "verdict.json").returncode, 0)
        gains = json.loads((self.path / "verdict.json").read_text())["gains"]
        self.assertEqual([g["loop"] for g in gains], ["current", "speed"])
        self.assertIn(f"{gains[1]['d1']:.3g}"[:4], told)
        self.assertEqual(self.names(), ["drive.toml", "mine.toml", "verdict.json"])


if __name__ == "__main__":
    unittest.main()
