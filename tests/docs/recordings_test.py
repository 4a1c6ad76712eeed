#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""recordings_test.py PROGRAM: the program's results for recorded real motors agree with published measurements."""
import json
import math
import pathlib
import sys
import unittest

from page import REPOSITORY, Desk, Page, walk

PROGRAM = pathlib.Path(sys.argv.pop(1)).absolute() if len(sys.argv) > 1 else REPOSITORY / "build/dev/sixstep"


class Recordings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.desk = Desk(PROGRAM)
        cls.addClassCleanup(cls.desk.close)

    def emf(self, words):
        return json.loads(self.desk.shell(f"./run motor emf data/recordings/{words} --json"))

    def test_the_bly172s_is_a_sine_of_38_3_mV_s(self):
        """Another least-squares fit found a peak of 2.010 V at 33.4 Hz, and 38.3 mV s/rad. Each number is rounded to
        its last digit."""
        told = self.emf("bly172s-emf.csv --pole-pairs 4")
        peak = told["constants_V_s_per_electrical_rad"]["line_peak"]
        self.assertAlmostEqual(4e3 * peak["value"], 38.3, delta=0.05 + 38.3 * (0.05 / 33.4 + 0.0005 / 2.01))
        self.assertTrue(4e3 * peak["low"] < 38.3 < 4e3 * peak["high"])
        self.assertIn('back_emf = "sine"', self.desk.shell("./run motor emf data/recordings/bly172s-emf.csv --pole-pairs 4"))

    def test_the_trampa_has_a_fifth_harmonic_of_3_4_to_3_7_percent(self):
        told = self.emf("trampa6340-emf.csv --between lines --speed 1000")
        self.assertEqual(told["pole_pairs"], 7)
        parts = {h["order"]: h["part"] for h in told["harmonics"]}
        self.assertTrue(0.034 < parts[5]["value"] < 0.037)
        self.assertTrue(0.004 < parts[3]["value"] < 0.009)
        self.assertTrue(0.002 < parts[7]["value"] < 0.005)
        first, second = (channel["fundamental_V"]["value"] for channel in told["channels"])
        self.assertAlmostEqual(first / second, 1, delta=0.004)

    def test_the_losses_of_cut_tops_are_those_of_a_cut_sine(self):
        """The losses are computed a second time, without the page's formulas: from the samples of the wave, its
        Fourier integral, and the wave without the mean of its thirds of a turn."""
        rows = {line.split("|")[1].strip(): [float(cell.split()[0]) for cell in line.split("|")[2:-1]]
                for line in Page("docs/howto/measure-the-back-emf.md").text.splitlines() if line.startswith(("| cut off, 1", "| fundamental too low", "| peak too low"))}
        count = 14400
        for cut, fundamental, peak in zip(*(rows[name] for name in ("cut off, 1 - c", "fundamental too low by", "peak too low by"))):
            c = 1 - cut / 100
            wave = [max(-c, min(c, math.sin(2 * math.pi * n / count))) for n in range(count)]
            first = 2 / count * sum(u * math.sin(2 * math.pi * n / count) for n, u in enumerate(wave))
            between = [u - (u + wave[(n + count // 3) % count] + wave[(n + 2 * count // 3) % count]) / 3 for n, u in enumerate(wave)]
            for told, true in ((fundamental, 100 * (1 - first)), (peak, 100 * (1 - max(between)))):
                self.assertAlmostEqual(told, true, delta=0.5 * 10 ** (-1 if told >= 10 else -2) + 1e-4)

    def test_what_the_simulator_was_told_is_found_again(self):
        for _ in walk(Page("docs/howto/find-the-hall-order.md"), self.desk):  # the commands of the page write turned.csv
            pass
        told = json.loads(self.desk.shell("./run motor identify turned.csv --json"))
        place, edges = told["place"], [2, -1, 0, -3, 1, 1]
        self.assertEqual(place["wires"][0]["hall_lines"], "132")
        for found, true in [(place["offset_deg"], 7), (place["hysteresis_deg"], 1.5), (place["delay_s"], 50e-6),
                            *((edge["own_deg"], own) for edge, own in zip(told["edges"], edges))]:
            self.assertTrue(found["low"] < true < found["high"], (found, true))


if __name__ == "__main__":
    unittest.main()
