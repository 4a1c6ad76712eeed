#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Messages that must be printed: the heating at a current limit, the supply that a clearance assumes, and a data
sheet that contradicts itself."""
import json
import math
import re
import unittest

from program import SOURCE, ProgramTest

CORTEX = str(SOURCE / "data/scenarios/firmware/cortex-m.toml")
SHEET = (SOURCE / "data/motors/maxon-251601.toml").read_text()


class Conditions(ProgramTest):
    def test_the_time_that_a_winding_withstands_its_limit_is_that_of_two_bodies(self):
        """Integrates the temperatures of winding and housing step by step from 25 to 125 degC. It uses the worse ends
        of the ranges on the sheet (5.3 K/W, 11.7 s)."""
        remarks = json.loads(self.run_program("run", CORTEX, "--json", "-").stdout)
        told = re.search(r"lets ([\d.]+) A flow.*withstands this current for .* from 25 degC, and by the worse ends of the thermal ranges for ([\d.]+) s", json.dumps(remarks))
        current, seconds = map(float, told.groups())
        self.assertAlmostEqual(current, 0.195 / 33.5e-3, delta=0.01)
        winding = housing = 25.0
        t, dt, loss = 0.0, 1e-3, 1.03 * current**2
        while winding < 125:
            across = (winding - housing) / 5.3
            winding += dt * (loss * (1 + 0.00393 * (winding - 25)) - across) / (11.7 / 5.3)
            housing += dt * (across - (housing - 25) / 4.25) / (212 / 4.25)
            t += dt
        self.assertAlmostEqual(seconds / t, 1, delta=0.01)
        within = self.run_program("run", CORTEX, "--set", "control.speed.torque_limit_Nm=0.078", "--json", "-", code=None).stdout
        self.assertNotIn("nominal current", within)

    def test_the_worse_ends_of_the_thermal_ranges_are_told_beside_the_values(self):
        """A motor file with the worse ends as its values has the same time. This time is also the upper limit of
        protection.stall_s."""
        def seconds(*words):
            return float(re.search(r"for ([\d.]+) s; no protection", self.run_program("run", CORTEX, *words).stdout).group(1))
        ends = seconds()
        worse = ("resistance_winding_housing_K_W=5.3", "time_constant_winding_s=11.7")
        told = self.run_program("run", CORTEX, *(w for end in worse for w in ("--set", f"motor_override.thermal_{end}"))).stdout
        self.assertAlmostEqual(float(re.search(r"withstands this current for ([\d.]+) s from 25", told).group(1)), ends, delta=0.02 * ends)
        for part, code in ((0.98, 0), (1.02, 2)):
            self.run_program("export", "header", CORTEX, "--set", f"protection.stall_s={part * ends}", "--out", "d.hpp", "--force", code=code)

    def test_all_that_a_clearance_states_is_printed(self):
        """Each warning and note in the header's comment is also a line on the terminal. The same is true for each
        reason that the user has overridden."""
        (self.path / "bare.toml").write_text("\n".join(line for line in SHEET.splitlines() if not re.match("thermal_|max_|nominal_current", line)))
        bare = (SOURCE / "data/scenarios/firmware/cortex-m.toml").read_text().replace('"maxon-251601"', '"bare.toml"')
        (self.path / "bare-drive.toml").write_text(bare)
        limit = ("--set", "motor_override.max_speed_rpm=2000")
        for words, said in (((CORTEX, *limit), "the rotor reached 3"), ((CORTEX,), "withstands this current for 12.8 s"),
                            ((CORTEX, "--set", "bridge.dead_time_s=50e-9"), "dead_time_s = 50 ns is short"),
                            ((CORTEX, "--set", "protection.over_speed_rad_s=3000", "--despite", "a trial"), "protects nothing"),
                            (("bare-drive.toml",), "not checked: whether the winding withstands")):
            made = self.run_program("export", "header", *words)
            told = [line.split(": ", 1)[1] for line in made.stderr.splitlines()]
            self.assertTrue(any(said in line for line in told), (words, made.stderr))
            comment = made.stdout.split("#pragma once")[0]
            stated = re.findall(r"^// Note: (.*?)\.?$", comment, re.M)
            for heading in ("Warnings of that run:", "This reason overrides these findings:"):
                if heading in comment:
                    lines = comment.split(f"// {heading}\n")[1].splitlines()
                    stated += [line[5:] for line in lines[:next(n for n, line in enumerate(lines) if not line.startswith("//   "))]]
            self.assertEqual(sorted(told), sorted(stated), words)

    def test_a_clearance_names_the_supply_that_it_needs(self):
        """Compares the note with a run of the same drive on the stated supply. If that run fails, the note must be
        printed."""
        brakes = ("--set", "protection.brake_current_A=2", "--set", "supply.capacitance_F=1e-3")
        sinks = (*brakes, "--set", "supply.sinks=true")
        cleared = self.run_program("export", "header", CORTEX, *sinks)
        self.assertRegex(cleared.stderr, r"with a supply that takes no current back, protection.brake_current_A = 2 ends a stop at 0\.8 s in a fault: over-voltage")
        self.assertRegex(cleared.stdout, r"bool cleared = true; .*whose supply takes current back")
        self.assertIn("setpoint_limit = 300 rad/s is the largest reference", cleared.stderr)
        self.run_program("export", "header", CORTEX, *brakes, "--out", "no.hpp", code=1)
        large = ("--set", "supply.capacitance_F=20e-3")
        self.assertNotIn("with a supply that takes no current back", self.run_program("export", "header", CORTEX, *sinks, *large).stderr)
        self.run_program("export", "header", CORTEX, *brakes, *large, "--out", "yes.hpp")

    def test_the_example_for_a_bench_holds_on_any_supply_within_its_tolerances(self):
        """The example passes as it is, without its load, and with displaced Hall edges."""
        cleared = self.run_program("export", "header", CORTEX)
        self.assertNotIn("takes current back", cleared.stderr + cleared.stdout)
        for load in ("0.02", "0"):
            self.run_program("run", CORTEX, "--set", f"load.torque_Nm={load}", "--tolerances", "--runs", "20")

    def test_a_drive_without_protection_is_told(self):
        """A note and a constant in the header state that the drive has no protection. The product drive has
        protection and no such note."""
        self.run_program("design", "maxon-251601", "--mode", "speed", "--quick", "--toml", "lean.toml")
        for file, told in (("lean.toml", True), (CORTEX, False)):
            cleared = self.run_program("export", "header", file)
            for text in (cleared.stderr, cleared.stdout):
                self.assertEqual("has no protection: the bridge stays on at over-current" in text, told, file)
            self.assertEqual(bool(re.search(r"bool cleared = true; .*that your firmware protects", cleared.stdout)), told)

    def test_a_nominal_speed_lies_between_no_load_and_a_warm_motor(self):
        line = 6710 - 1.03 / 33.5e-3**2 * 83.4e-3 * 30 / math.pi
        drop = 6710 - line
        for speed, verdict, code in ((6800, "BROKEN", 1), (6710, "BROKEN", 1), (1.06 * line, "BROKEN", 1), (line, "ok", 0),
                                     (5240, "ok", 0), (6710 - 2.3 * drop, "ok", 0), (6710 - 3.5 * drop, "doubt", 0)):
            (self.path / "a.toml").write_text(SHEET.replace("value = 5240", f"value = {speed:.0f}"))
            told = self.run_program("motor", "check", "a.toml", code=code).stdout
            self.assertRegex(told, rf"\n  {verdict} +nominal speed ", f"{speed}")

    def test_a_contradiction_is_told_wherever_the_sheet_is_used(self):
        (self.path / "a.toml").write_text(SHEET.replace("value = 23.3,", "value = 32.3,"))
        words = "the motor's sheet contradicts itself: stall current disagrees with the other values"
        self.assertIn(words, self.run_program("design", "a.toml", "--quick").stdout)
        self.assertIn(words, self.run_program("new", "mine", "--motor", "a.toml", "--mode", "current").stdout)
        self.assertIn(words, self.run_program("run", "mine.toml").stdout)
        self.assertNotIn("contradicts", self.run_program("design", "maxon-251601", "--quick").stdout)
        field = (SOURCE / "data/scenarios/gallery/field-weakened.toml").read_text()
        (self.path / "field.toml").write_text(re.sub('(?m)^motor = .*$', 'motor = "a.toml"', field))
        told = self.run_program("design", "--scenario", "field.toml", code=None).stdout
        self.assertIn(words, told)
        self.assertRegex(told, "^(usable, |NOT USABLE)")

    def test_a_value_of_one_digit_is_named(self):
        (self.path / "a.toml").write_text(re.sub(r"resistance_ohm        = \{ value = 1.03", "resistance_ohm = { value = 1", SHEET, count=1)
                                          .replace("range = [0.978, 1.03]", "range = [0.978, 1.03]"))
        told = self.run_program("motor", "check", "a.toml", code=None).stdout
        self.assertIn("resistance_ohm = 1 is read as 1 +- 50 %", told)

    def test_figures_with_the_sensor_are_of_one_loop(self):
        """The delay margin is the phase margin divided by the crossover frequency. This is true in the rows that
        include the speed sensor."""
        text = self.run_program("design", "--scenario", CORTEX, "--quick").stdout
        def last(row, unit):
            return float(re.search(rf"{row} with the speed's sensor .* ([\d.]+) {unit}\n", text).group(1))
        phase, crossover, delay = last("phase margin", "deg"), last("crossover", "Hz"), last("delay margin", "ms")
        self.assertAlmostEqual(delay / (1e3 * phase / 360 / crossover), 1, delta=0.005)

    def test_an_option_takes_its_unit(self):
        plain = self.run_program("design", "maxon-251601", "--quick", "--period", "25e-6", "--json", "-").stdout
        self.assertEqual(self.run_program("design", "maxon-251601", "--quick", "--period", "25us", "--json", "-").stdout
                         .replace("25us", "25e-6"), plain)
        self.run_program("design", "maxon-251601", "--period", "25V", code=2)


if __name__ == "__main__":
    unittest.main()
