#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""[believed] and offset_deg on the command line: settings, the axis of a plan, design, and an exported header."""
import json
import math
import re
import unittest

from program import SOURCE, ProgramTest

GALLERY = SOURCE / "data/scenarios/gallery"
# N m/A and A: the torque constant of the 251601 with a sine, and the current in belief-offset.toml.
K, CURRENT = 1.5 * 33.5e-3 / 1.6539867, 5.0


class Believed(ProgramTest):
    def figures(self, name, *settings):
        words = [word for setting in settings for word in ("--set", setting)]
        told = self.run_program("run", str(GALLERY / f"{name}.toml"), *words, "--quiet", "--json", "-", code=None).stdout
        return json.loads(told)

    def test_torque_follows_the_cosine_of_the_offset_less_the_believed_one(self):
        for mounted, believed in ((27, 0), (27, 27), (0, -40), (-60, 30)):
            told = self.figures("belief-offset", f"sensors.resolver.offset_deg={mounted}",
                                f"believed.sensor_offset_deg={believed}")
            torque = told["require"][0]["measured"]
            self.assertAlmostEqual(torque / (K * CURRENT), math.cos(math.radians(mounted - believed)), delta=0.005)

    def test_a_plan_varies_a_belief(self):
        self.run_program("run", str(GALLERY / "belief-pole-pairs-hall.toml"), "--vary", "believed.pole_pairs=4,8,10",
                         "--json", "a.json", code=None)
        rows = json.loads((self.path / "a.json").read_text())["rows"]
        for row, pole_pairs in zip(rows, (4, 8, 10)):
            self.assertEqual(row[3], pole_pairs)
            self.assertAlmostEqual(row[4], 100 * pole_pairs / 8, delta=1.5)

    def test_a_design_tells_what_each_belief_costs_and_uses_it(self):
        told = self.run_program("design", "--scenario", str(GALLERY / "belief-inductance.toml"), "--json", "a.json", code=None).stdout
        self.assertRegex(told, r"Costs of wrong beliefs\n  - the drive believes L = 0\.572 instead of 0\.286 mH")
        design = json.loads((self.path / "a.json").read_text())
        self.assertEqual(len(design["wrong_beliefs"]), 1)
        self.assertAlmostEqual(design["model"]["q_axis_inductance_H"], 0.572e-3)
        told = self.run_program("design", "--scenario", str(GALLERY / "belief-inductance.toml"), code=None).stdout
        self.assertIn("L = 0.572 mH", told)

    def design(self, name, *replaced, code=None):
        """Of a scenario of the gallery, with a part of its text replaced."""
        text = (GALLERY / f"{name}.toml").read_text()
        if replaced:
            self.assertIn(replaced[0], text)
            text = text.replace(*replaced)
        (self.path / "mine.toml").write_text(text)
        return self.run_program("design", "--scenario", "mine.toml", code=code).stdout

    def test_a_field_oriented_design_judges_the_motor_itself(self):
        """No torque in the mean, torque of the wrong sign, an unstable loop: not usable, as the run shows."""
        for name, *replaced in (("belief-offset-past-90",), ("belief-pole-pairs-encoder",),
                                ("belief-inductance", "value = 0.572", "value = 3")):
            self.assertIn("NOT USABLE: ", self.design(name, *replaced, code=1).splitlines()[0], name)
        for name in ("belief-offset", "belief-torque-constant", "belief-resistance"):
            self.assertRegex(self.design(name, code=0).splitlines()[0], r"^usable, \d+ warning", name)
        self.assertIn("on the motor itself the current loop overshoots", self.design("belief-resistance", code=0))
        right = self.design("belief-offset", "[pwm]", "[believed]\nsensor_offset_deg = 27\n\n[pwm]", code=0)
        self.assertEqual(right.splitlines()[0], "good")
        self.assertNotIn("the drive believes", right)

    def test_limits_by_the_bus_are_the_motors(self):
        """U/sqrt 3 over the magnet of the motor, whatever is believed; the torque of the highest current is twice the believed limit."""
        told = self.design("belief-torque-constant", code=0)
        at = {name: float(re.search(rf"\n  {re.escape(name)} +([\d.]+)", told).group(1)) for name in ("w_0", "K_q i_q")}
        e = 33.5e-3 / 1.6539867  # V s, peak of a phase
        self.assertAlmostEqual(at["w_0"] / (24 / math.sqrt(3) / e), 1, delta=1e-4)
        self.assertAlmostEqual(at["K_q i_q"], 0.2, delta=1e-4)
        self.assertRegex(told, r"\nmaxon .*psi = 0\.00253176 V s.*\nthe drive believes .*psi = 0\.00126588 V s")

    def test_a_scenario_may_have_the_name_of_its_motor(self):
        self.run_program("design", "teknic-m2310p", "--quick", "--toml", "teknic-m2310p.toml", code=None)
        told = self.run_program("run", "teknic-m2310p.toml", code=None)
        self.assertNotIn("is a scenario, not a motor file", told.stdout + told.stderr)
        self.assertIn("experiment", told.stdout)

    def test_a_header_has_the_beliefs(self):
        def header(name, *settings):
            words = [word for setting in settings for word in ("--set", setting)]
            return self.run_program("export", "header", str(GALLERY / f"{name}.toml"), "--despite", "a test", *words, code=None).stdout
        self.assertRegex(header("belief-pole-pairs-hall"), r"uint8_t pole_pairs = 12;")
        self.assertRegex(header("belief-pole-pairs-hall"), r"// motor .*: 8 pole pairs, .*\n// believed +12 pole pairs, ")
        offset = header("belief-offset", "believed.sensor_offset_deg=90")
        self.assertIn("sensor_offset = 0x40000000u;", offset)
        self.assertNotIn("sensor_offset =", header("belief-offset"))

    def test_refusals_name_the_key(self):
        for setting, words in (("believed.pole_pairs=0", "believed.pole_pairs = 0 must lie in 1 to 500"),
                               ("believed.pole_pairs=6", "believed.pole_pairs = 6 is not a multiple of the resolver's 4"),
                               ("believed.inductance_mH=1e-6", "believed.inductance_mH"),
                               ("sensors.resolver.offset_deg=400", "sensors.resolver.offset_deg = 400 must lie in -360 to 360"),
                               ("believed.poles=4", "believed.poles is not a key here")):
            done = self.run_program("run", str(GALLERY / "belief-offset.toml"), "--set", setting, code=2)
            self.assertIn(words, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
