#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A message names the key that is the cause. Keys that no drive has are refused. If a run takes long or fills the
disk, a message says so before the run."""
import itertools
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
                if cure:  # following the advice must work
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

    def test_a_part_of_the_switching_loss_is_refused(self):
        """If one of the values were missing, the loss would be too small. The message names the missing value."""
        gate = {"gate_current_A": 0.5, "gate_source_charge_C": 6e-9, "gate_drain_charge_C": 10e-9}
        energy = {"turn_on_J": 3e-6, "turn_off_J": 2e-6, "energies_at_V": 24, "energies_at_A": 5}
        for whole in (gate, energy):
            for count in range(1, len(whole) + 1):
                for keys in itertools.combinations(whole, count):
                    if count == 1 and keys[0].startswith("energies_at"):
                        continue  # this drive has no switching loss, and a remark says so
                    sets = [word for key in keys for word in ("--set", f"bridge.{key}={whole[key]}")]
                    ran = self.run_program("run", "a.toml", *sets, code=0 if count == len(whole) else 2)
                    missing = [key for key in whole if key not in keys]
                    self.assertEqual(any(f"bridge.{key} " in ran.stderr for key in missing), bool(missing), (keys, ran.stderr))

    def test_what_takes_long_or_fills_a_disk_is_said_before(self):
        self.assertEqual(self.run_program("run", "a.toml", "--csv", "o.csv").stderr, "")
        for words, said in ((("--csv", "p.csv", "--set", "record.grid_s=1e-9"), r"--csv: one row per 1 ns gives about 10000 million rows, 34\d\d GB; for fewer rows set a longer record\.grid_s"),
                            (("--mat73", "p.mat", "--set", "record.grid_s=1e-9", "--set", 'record.columns=["i_a_A"]'), r"--mat73: one row per 1 ns gives about 10000 million rows, 160 GB; .*"),
                            (("--set", "pwm.period_s=1e-8"), r"the 1000 million control periods of 10 ns take some 17 minutes")):
            with self.subTest(words), self.started("run", "a.toml", "--set", "duration_s=10", *words) as program:
                self.assertRegex(program.stderr.readline(), f"^a: {said}\n$")


if __name__ == "__main__":
    unittest.main()
