#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The manual's drawings show all peaks, and their scales are right."""
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
import svg_panels


class Drawing(unittest.TestCase):
    def test_thinning_keeps_each_peak_and_the_ends(self):
        points = [(n / 1000, 0.0) for n in range(1000)] + [(n / 1000, float(n == 1234)) for n in range(1000, 3001)]
        kept = svg_panels.thinned(points)
        self.assertLess(len(kept), 20)
        self.assertIn((1.234, 1.0), kept)
        self.assertEqual((kept[0], kept[-1]), (points[0], points[-1]))

    def test_thinning_leaves_what_is_sparse(self):
        points = [(float(n), n * 0.5) for n in range(50)]
        self.assertEqual(svg_panels.thinned(points), points)

    def test_ticks_are_round_and_within(self):
        for low, high in ((0, 1), (-3.3, 0.2), (14.91, 15.0), (0, 4500)):
            ticks = svg_panels.ticks(low, high)
            self.assertTrue(4 <= len(ticks) <= 9, ticks)
            self.assertTrue(low - 1e-9 <= ticks[0] and ticks[-1] <= high + 1e-9, ticks)
            self.assertRegex(f"{ticks[1] - ticks[0]:.0e}", r"^[125]e")

    def test_a_level_line_keeps_its_ends_and_a_jump_both_its_sides(self):
        curve = [(0, 1), (1, 1), (2, 1), (2, 3), (3, 3)]
        drawn = svg_panels.path(curve, lambda x, y: (10.0 * x, 10.0 * y), "#000000", False)
        self.assertEqual(re.search(r' d="(.*?)"', drawn)[1], "M0.0 10.0L20.0 10.0L20.0 30.0L30.0 30.0")

    def test_the_scale_is_where_its_numbers_say(self):
        drawn = svg_panels.drawing("a title", [{"title": "y", "curves": [("c", [(0, 0), (10, 40)], False)]}], [0, 10], "time in ms")
        labels = {float(v): float(y) for y, v in re.findall(r'y="([\d.]+)" text-anchor="end">(-?[\d.]+)<', drawn)}
        ends = re.search(r'd="M[\d.]+ ([\d.]+)L[\d.]+ ([\d.]+)"', drawn)
        self.assertAlmostEqual(labels[0] - 4, float(ends[1]), delta=0.1)
        self.assertAlmostEqual(labels[40] - 4, float(ends[2]), delta=0.1)


if __name__ == "__main__":
    unittest.main()
