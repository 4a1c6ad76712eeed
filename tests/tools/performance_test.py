#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The tables of tools/performance.py: the figures of a made-up report are right, and a page with another form is
detected."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
sys.dont_write_bytecode = True
import performance  # noqa: E402

ENGINE = {"R/lean": {"per_period": 200e-9, "error": 5e-14},
          "R/general": {"per_period": 500e-9, "error": 6e-14}, "G/general": {"per_period": 600e-9, "error": 1e-14},
          "R/textbook 1 us": {"per_period": 2e-6, "error": 0.0566},
          "R/textbook 0.1 us": {"per_period": 20e-6, "error": 2.9e-3}, "R/tuned 1 us": {"per_period": 1.5e-6},
          "R/tuned 0.1 us": {"per_period": 15e-6}, "R/1 s": {"per_period": 200e-9}, "R/10 s": {"per_period": 220e-9}}
OBSERVERS = {"R/none": {"per_period": 200e-9}, "R/digest": {"per_period": 210e-9},
             "R/study of 10 s": {"per_period": 300e-9}, "G/study of 10 s": {"per_period": 900e-9}}


class Performance(unittest.TestCase):
    def setUp(self):
        self.tables = performance.tables_of(ENGINE, OBSERVERS)
        self.pages = {"README.md": "", "docs/explanation/performance.md": ""}
        for name, place in performance.PLACES.items():
            self.pages[place] += f"<!-- performance: {name} -->\non this\n\n{performance.markdown(self.tables[name])}<!-- end -->\n"

    def wrong(self, place, old, new):
        self.assertIn(old, self.pages[place])
        return performance.differences(self.tables, {**self.pages, place: self.pages[place].replace(old, new)}.get)

    def test_figures(self):
        self.assertEqual(self.tables["speed"][1], ["R", "lean", "200", "150", "5e-14", "10.0x, 5.7 %", "100.0x, 0.29 %", "7.5x", "75.0x"])
        self.assertEqual(self.tables["speed"][2], ["R, as a user runs it, 10 s", "lean", "300", "100", "", "", "", "", ""])
        self.assertEqual(self.tables["speed"][3], ["R", "general", "500", "60", "6e-14", "4.0x, 5.7 %", "40.0x, 0.29 %", "3.0x", "30.0x"])
        self.assertEqual(self.tables["speed"][4], ["G", "general", "600", "50", "1e-14", "", "", "", ""])
        self.assertEqual(self.tables["speed"][5], ["G, as a user runs it, 10 s", "general", "900", "33", "", "", "", "", ""])
        self.assertEqual(self.tables["short"][1:], [["R", "150", "100", "5e-14", "10.0x, 5.7 %", "100.0x, 0.29 %"],
                                                    ["G", "50", "33", "1e-14", "", ""]])
        self.assertEqual(self.tables["growth"][1], ["R", "200", "220", "11.00x"])
        self.assertEqual(self.tables["observers"][1:], [["none", "200", ""], ["digest", "210", "5 %"]])

    def test_other_figures_are_no_difference(self):
        self.assertEqual(self.wrong("docs/explanation/performance.md", "| 200 |", "| 199 |"), [])
        self.assertEqual(self.wrong("README.md", "| 150 |", "| 149 |"), [])

    def test_other_rows_columns_or_markers_are(self):
        for place, old, new in [("docs/explanation/performance.md", "| R | lean |", "| S | lean |"), ("docs/explanation/performance.md", "simulated s per s", "speed"),
                                ("README.md", "| G | 50 |", "| H | 50 |"), ("README.md", "engine alone", "alone"),
                                ("docs/explanation/performance.md", "| digest | 210 | 5 % |\n", ""),
                                ("docs/explanation/performance.md", "performance: growth", "performance: grown")]:
            self.assertEqual(len(self.wrong(place, old, new)), 1, old)


if __name__ == "__main__":
    unittest.main()
