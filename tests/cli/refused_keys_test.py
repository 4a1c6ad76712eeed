#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A refusal names the key that is the cause, and what no drive has is refused; what takes long or fills a disk is said before."""
import unittest

from program import Started

SPEED = """
motor = "maxon-251601"
duration_s = 1e-3
[control]
mode = "speed"
[reference]
value = 100
"""


class RefusedKeys(Started):
    def setUp(self):
        super().setUp()
        (self.path / "a.toml").write_text(SPEED)

    def test_a_column_without_a_value_names_the_key_that_decides(self):
        causes = {"source_A": ("supply.inductance_H = 0", "supply.inductance_H=1e-6 supply.resistance_ohm=0.1 supply.capacitance_F=1e-4"),
                  "capacitor_A": ("supply.capacitor_resistance_ohm = 0", "supply.capacitor_resistance_ohm=0.01 supply.resistance_ohm=0.1 supply.capacitance_F=1e-4"),
                  "load_speed_rad_s": ("set load.gear or load.stiffness_Nm_rad", "load.gear=2"),
                  "battery_charge": ("supply.source", ""),
                  "winding_degC": ("heat.motor = false", ""), "housing_degC": ("heat.motor = false", ""), "junction_degC": ("heat.devices = false", ""),
                  "i_q_A": ('set control.drive = "field-oriented"', ""), "encoder_A": ("sensors.rotor", ""),
                  "position_ref_deg": ("has no value in this control.mode", "")}
        for column, (cause, cure) in causes.items():
            with self.subTest(column):
                told = self.run_program("run", "a.toml", "--set", f'record.columns=["{column}"]', code=2).stderr
                self.assertIn(f'record.columns = "{column}"', told)
                self.assertIn(cause, told)
                if "control.mode" not in cause:
                    self.assertNotIn("control.mode", told)
                if cure:  # the advice works
                    sets = [word for part in cure.split() for word in ("--set", part)]
                    made = self.run_program("run", "a.toml", "--set", f'record.columns=["{column}"]', "--csv", "o.csv", "--quiet", "--force", *sets)
                    self.assertEqual(made.stderr, "")
                    self.assertIn(f"t_s,{column}\n", (self.path / "o.csv").read_text())

    def test_what_no_switch_takes_is_refused(self):
        for key, most in (("recovery_charge_C", "0.03"), ("gate_source_charge_C", "0.03"), ("gate_drain_charge_C", "0.03"), ("gate_current_A", "200"),
                          ("turn_on_J", "100"), ("turn_off_J", "100"), ("recovery_J", "100")):
            with self.subTest(key):
                told = self.run_program("run", "a.toml", "--set", f"bridge.{key}=1e6", code=2).stderr
                self.assertIn(f"bridge.{key} = 1e6 must lie in 0 to {most};", told)

    def test_what_takes_long_or_fills_a_disk_is_said_before(self):
        self.assertEqual(self.run_program("run", "a.toml", "--csv", "o.csv").stderr, "")
        for words, said in ((("--csv", "p.csv", "--set", "record.grid_s=1e-9"), r"--csv: its rows, one each 1 ns, are some 10000 million, 34\d\d GB; a longer record\.grid_s makes fewer"),
                            (("--mat73", "p.mat", "--set", "record.grid_s=1e-9", "--set", 'record.columns=["i_a_A"]'), r"--mat73: its rows, one each 1 ns, are some 10000 million, 160 GB; .*"),
                            (("--set", "pwm.period_s=1e-8"), r"its 1000 million control periods of 10 ns take some 17 minutes")):
            with self.subTest(words), self.started("run", "a.toml", "--set", "duration_s=10", *words) as program:
                self.assertRegex(program.stderr.readline(), f"^a: {said}\n$")


if __name__ == "__main__":
    unittest.main()
