#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The first day of a user: from a data sheet to gains, a scenario, a verdict and a header that compiles. The drive
has Hall probes, and must have no limit cycle. A drive that is called usable passes, and a drive that fails is not
called usable."""
import json
import re
import subprocess
import unittest

from program import PROGRAM, SOURCE, ProgramTest

# A sheet as it is printed (maxon EC 45 flat, 70 W, catalogue): line number and value.
SHEET = {29: 8, 1: 24, 2: 6110, 3: 232, 4: 4840, 6: 3.26, 10: 0.608, 11: 0.463, 12: 36.9, 16: 181}
USE = """
#include "drive_config.hpp"
static_assert(exported::pole_pairs == 8 && exported::command_delayed);
static_assert(exported::drive.mode == sixstep::control::Mode::speed);
int main() { return exported::drive.current_limit_A > exported::Scalar{} ? 0 : 1; }
"""


class FirstDay(ProgramTest):
    def fill_in_the_sheet(self):
        self.run_program("motor", "new", "mine")
        text = (self.path / "mine.toml").read_text()
        for line, value in SHEET.items():
            text, count = re.subn(rf"(?m)^(?:# )?(line_{line}_\w+ = )(?:\{{ value = nan, source = \"data sheet\"|0)",
                                  lambda m, v=value: m[1] + (f'{{ value = {v}, source = "data sheet"' if "{" in m[0] else str(v)), text)
            self.assertEqual(count, 1, line)
        (self.path / "mine.toml").write_text(text)
        self.run_program("motor", "check", "mine.toml")

    def swing(self, *settings):
        """The peak-to-peak value of the speed at the end of the scenario's run, and whether the run passes."""
        ran = json.loads(self.run_any("run", "drive.toml", "--json", "-", *settings).stdout)
        swings = [r["measured"] for r in ran["require"] if r["figure"] == "swing of the speed at the end"]
        self.assertEqual(len(swings), 1)
        return swings[0], ran["passed"]

    def test_from_the_data_sheet_to_a_compiled_header(self):
        self.fill_in_the_sheet()
        told = self.run_program("design", "mine.toml", "--mode", "speed").stdout
        self.assertRegex(told.splitlines()[0], r"^(good|usable).* with Hall probes, down to .* rad/s, over 2[56] motors within the tolerances$")

        self.run_program("new", "drive", "--motor", "mine.toml")
        text = (self.path / "drive.toml").read_text()
        for line in (r'^rotor = "hall"', r'^currents = "phases"', r'^bus = "adc"', r"^delay_periods = 1", r"^torque_limit_Nm = "):
            self.assertRegex(text, "(?m)" + line)
        swing, passed = self.swing()
        self.assertTrue(passed)
        self.assertLess(swing, 3.6)

        self.run_program("export", "header", "drive.toml", "--arithmetic", "q31", "--out", "drive_config.hpp")
        header = (self.path / "drive_config.hpp").read_text()
        self.assertIn("// Cleared by its run:", header)
        (self.path / "use.cpp").write_text(USE)
        built = subprocess.run(["g++", "-std=c++20", "-Wall", "-Wextra", "-Werror", f"-I{SOURCE}", "use.cpp", "-o", "use"],
                               cwd=self.path, capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(built.returncode, 0, built.stderr)
        self.assertEqual(subprocess.run([self.path / "use"], check=False).returncode, 0)

    def test_a_third_of_that_settling_time_is_refused_by_all_three(self):
        self.fill_in_the_sheet()
        self.run_program("new", "drive", "--motor", "mine.toml")
        settle = float(re.findall(r"(?m)^settle_s = (\S+)", (self.path / "drive.toml").read_text())[-1])
        third = str(settle / 3)
        refused = self.run_program("design", "mine.toml", "--mode", "speed", "--settle", third, code=1).stdout
        self.assertRegex(refused, "^NOT USABLE: ")
        swing, passed = self.swing("--set", f"control.speed.settle_s={third}", "--set", "sensors.speed_edges=1")
        self.assertFalse(passed)
        self.assertGreater(swing, 3.6)
        told = self.run_program("export", "header", "drive.toml", "--set", f"control.speed.settle_s={third}",
                                "--set", "sensors.speed_edges=1", code=1).stderr
        self.assertIn("swing of the speed at the end", told)


if __name__ == "__main__":
    unittest.main()
