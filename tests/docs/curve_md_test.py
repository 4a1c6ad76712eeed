#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""curve_md_test.py PROGRAM [--renew]: docs/curve.md shows what the program prints, and the figures in its text are those
of the program's JSON."""
import json
import re

import page


class CurvePage(page.PageTest):
    NAME, FEWEST = "docs/curve.md", 4

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.curve = json.loads(cls.desk.shell("./run curve maxon-251601 --json -"))

    def test_the_figures_in_the_text_are_the_programs(self):
        table = dict(re.findall(r"<!-- figure: ([\w.]+) -->([\d.]+)", self.page.text))
        self.assertGreaterEqual(len(table), 2)
        for path, shown in table.items():
            value = self.curve
            for word in path.split("."):
                value = value[word]
            digits = len(shown.split(".")[1]) if "." in shown else 0
            self.assertEqual(f"{value:.{digits}f}", shown, path)

    def test_the_claims_of_the_text_hold(self):
        ideal, half = self.curve["ideal"], self.curve["points"][20]
        self.assertGreater(1 - half["torque_Nm"] / half["ideal_torque_Nm"], 0.4)  # "more than 40 %"
        ideal_slope = ideal["stall_torque_Nm"] / ideal["no_load_speed_rad_s"]
        self.assertAlmostEqual(-ideal_slope / self.curve["no_load"]["slope_Nm_s"], 2.8, delta=0.05)  # "2.8 times"
        self.assertAlmostEqual(ideal["no_load_speed_rad_s"], 716.4, delta=0.05)

    def test_every_option_is_named(self):
        told = self.shell("./run curve --help")
        for option in set(re.findall(r"--[a-z-]+", told)) - {"--help", "--data", "--quiet"}:
            self.assertRegex(self.page.text, f"`{option}[ `]")


if __name__ == "__main__":
    page.main(CurvePage)
