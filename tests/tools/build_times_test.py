#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The tables of compile times in docs/contributing.md: the rooms add up to the total, and all units are listed in
order."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TEXT = re.search(r"<!-- build times -->\n(.*?)<!-- end -->", (ROOT / "docs/contributing.md").read_text(), re.S)[1]


def rows(cells):
    return [line.strip("| ").split(" | ") for line in TEXT.splitlines() if line.count("|") == cells + 1 and re.search(r"\d \|$", line)]


class BuildTimes(unittest.TestCase):
    def test_rooms_add_up(self):
        objects, total, front, back = map(float, re.match(r"(\d+) objects, (\d+) s .*: (\d+) s front end, (\d+) s back", TEXT).groups())
        rooms = rows(4)
        self.assertGreater(len(rooms), 8)
        self.assertEqual(sum(int(r[1]) for r in rooms), objects)
        self.assertAlmostEqual(sum(float(r[2]) for r in rooms), front, delta=1.5)
        self.assertAlmostEqual(sum(float(r[3]) for r in rooms), back, delta=1.5)
        self.assertAlmostEqual(front + back, total, delta=1)

    def test_the_dearest_come_first_and_are_there(self):
        units = rows(3)
        self.assertEqual(len(units), 40)
        costs = [float(r[1]) + float(r[2]) for r in units]
        for dearer, cheaper in zip(costs, costs[1:]):
            self.assertGreaterEqual(dearer + 0.15, cheaper)
        for unit, *_ in units:
            self.assertTrue((ROOT / unit.split(" .. ")[0]).is_file(), unit)


if __name__ == "__main__":
    unittest.main()
