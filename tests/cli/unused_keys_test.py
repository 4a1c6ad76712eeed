#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every key has an effect or a message. A number or switch of the schema that changes nothing in a run is named in a
remark, or is refused."""
import json
import subprocess
import unittest

from program import PROGRAM, Started

BASE = """
motor = "maxon-251601"
duration_s = 2e-3
[control]
mode = "current"
[control.current]
settle_s = 1e-3
damping = 0.9
[reference]
value = 2
[[require]]
metric = "mean"
min = 0
"""

DUTY = """
motor = "maxon-251601"
duration_s = 2e-3
[control]
mode = "duty"
[reference]
value = 0.2
[[require]]
metric = "mean"
min = 0
"""

SPEED = """
motor = "maxon-251601"
duration_s = 60e-3
[control]
mode = "speed"
[control.speed]
settle_s = 10e-3
damping = 0.9
[sensors]
rotor = "hall"
currents = "phases"
current_range_A = 30
bus = "adc"
bus_range_V = 40
[reference]
value = 50
[[require]]
metric = "mean"
min = 0
"""

# Keys without effect on this run: it cannot reach their range, or they affect only a written file.
ELSEWHERE = {
    "motor_override.magnet_loss_percent_K": "acts through [heat], and in the tolerances of designs",
    "control.full_scale.current_A": "of fixed point, which a header may be exported in",
    "control.full_scale.voltage_V": "of fixed point",
    "control.full_scale.speed_rad_s": "of fixed point",
    "control.full_scale.position_deg": "of fixed point",
    "record.grid_s": "rows that nobody asked for here",
    "record.events": "rows that nobody asked for here",
}
AT_REST = {"motor_override.flat_deg": "a wider top than the sector's: no difference while the rotor hardly turns"}
SMOOTH = {"control.smooth_chopping.on": "the current is above its borders"}
TORQUE = {"control.limits.torque_Nm": "a bound that is not reached"}
BUS = {"control.current.measured_bus_from_V": "the measured bus is the source's here, to the bit"}
HALL = {
    "sensors.bus_range_V": "what the board has, whoever reads it",
    "sensors.calibrated": "an amplifier without an offset",
    "sensors.seed": "no noise is drawn",
    "sensors.speed_edges": "as many as the settling allows anyway",
    "sensors.timeout_s": "edges come sooner",
    "sensors.watched": "all codes are possible ones",
}
RUNS = ((BASE, ELSEWHERE | AT_REST | SMOOTH | TORQUE | BUS), (DUTY, ELSEWHERE | AT_REST | SMOOTH), (SPEED, ELSEWHERE | TORQUE | HALL))


class UnusedKeys(Started):
    def setUp(self):
        super().setUp()
        (self.path / "base.toml").write_text(BASE)
        self.schema = json.loads(self.run_program("schema", "scenario").stdout)

    def keys(self, node=None, path=()):
        for name, entry in (node or self.schema).get("properties", {}).items():
            if "$ref" in entry:
                there = self.schema
                for step in entry["$ref"].removeprefix("#/").split("/"):
                    there = there[step]
                entry = there | entry
            if "properties" in entry:
                yield from self.keys(entry, (*path, name))
            else:
                yield ".".join((*path, name)), entry

    @staticmethod
    def another(entry):
        """A value within the range that differs from the default. None if the key is neither a number nor a switch."""
        usual = entry.get("default")
        entry = next((e for e in (entry, *entry.get("oneOf", []), *entry.get("anyOf", [])) if e.get("type") in ("number", "integer", "boolean")), entry)
        kind = entry.get("type")
        if kind == "boolean":
            return "false" if usual is True else "true"
        if kind not in ("number", "integer"):
            return None
        least, most = (entry.get(f"{end}imum", entry.get(f"exclusive{end.title()}imum")) for end in ("min", "max"))
        tries = [usual * 1.3, usual * 0.7, usual + 1, usual - 1] if usual else [0.5, 1, 2, 0.01, 1e-3, 1e-6, 10, 100]
        for value in (round(x) if kind == "integer" else x for x in tries):
            if (least is None or value > least) and (most is None or value < most) and value != usual:
                return repr(value)
        return repr(least if most is None else most)

    def outcome(self, *sets):
        """The result of a run without its remarks, and the remarks. The result is None if the run is refused."""
        words = [word for text in sets for word in ("--set", text)]
        ran = subprocess.run([PROGRAM, "run", "base.toml", "--json", "-", "--quiet", *words], cwd=self.path, capture_output=True, text=True, check=False)
        if ran.returncode == 2:
            return None, ran.stderr
        result = json.loads(ran.stdout)
        remarks = " ".join(result.pop("remarks", []))
        return result, remarks

    def test_every_number_and_switch_acts_or_is_named(self):
        for base, elsewhere in RUNS:
            with self.subTest(base):
                (self.path / "base.toml").write_text(base)
                self.assertEqual(self.silent(), set(elsewhere))

    def silent(self):
        """The keys that have no effect and are not named in a remark."""
        plain, _ = self.outcome()
        seen, silent = 0, set()
        for key, entry in self.keys():
            value = self.another(entry)
            if value is None:
                continue
            result, told = self.outcome(f"{key}={value}")
            key = key.removesuffix(".value")  # a quantity is named without its member `value`
            seen += 1
            if result is None:
                self.assertTrue(any(part in told for part in key.split(".")), f"{key}: {told}")
            elif result == plain and key not in told:
                silent.add(key)
            elif result != plain:
                self.assertNotIn(f"{key} (", told, "named, and it acts")
        self.assertGreater(seen, 200)
        return silent

    def test_sheet_lines_that_the_model_is_not_made_of_are_named(self):
        plain, _ = self.outcome()
        for line in ("no_load_current_mA", "no_load_speed_rpm", "stall_current_A", "nominal_speed_rpm"):
            result, told = self.outcome(f"motor_override.{line}=1234")
            self.assertEqual(result["digest"], plain["digest"], line)
            self.assertIn(f"motor_override.{line} (", told)
        result, told = self.outcome("motor_override.viscous_friction_Nm_s=1e-3")
        self.assertNotEqual(result["digest"], plain["digest"])
        self.assertNotIn("without effect", told)

    def test_gains_of_loops_that_are_not_closed_are_named(self):
        for key, value in (("control.speed.settle_s", "0.01"), ("control.speed.torque_limit_Nm", "0.1"), ("control.current.limit_A", "5")):
            self.assertIn(key + " (", self.outcome(f"{key}={value}")[1])
            result, told = self.outcome('control.mode="speed"', "control.speed.damping=0.9", "control.speed.settle_s=0.01", f"{key}={value}")
            self.assertIsNotNone(result, told)
            self.assertNotIn("without effect", told)

    def test_keys_of_another_metric_are_refused(self):
        own = {"fraction": "reach_time_s", "band": "settling_time_s", "tail": "steady_error", "level": "overshoot", "start": "overshoot"}
        for key, metric in own.items():
            for other in ("mean", *own.values()):
                asked = f'[[require]]\nmetric = "{other}"\n{key} = 0.5\nmax = 1e3\n'
                (self.path / "b.toml").write_text(BASE[:BASE.index("[[require]]")] + asked)
                result = subprocess.run([PROGRAM, "run", "b.toml", "--quiet"], cwd=self.path, capture_output=True, text=True, check=False)
                takes = other == metric or (key == "level" and other != "mean") or (key == "start" and other in ("reach_time_s", "settling_time_s"))
                if takes:
                    self.assertNotEqual(result.returncode, 2, result.stderr)
                else:
                    self.assertEqual(result.returncode, 2, f"{key} of {other}")
                    self.assertIn(f"require.{key}", result.stderr)


if __name__ == "__main__":
    unittest.main()
