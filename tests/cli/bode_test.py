#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep run --bode: what it prints and writes, and what it refuses."""
import json
import math
import unittest

from program import SOURCE, ProgramTest

LOCKED = str(SOURCE / "data/scenarios/thesis/7.3.1-locked-exact-design.toml")
NO_LOOP = str(SOURCE / "data/scenarios/thesis/7.2-no-load.toml")


class Bode(ProgramTest):
    def test_prints_and_writes(self):
        made = self.run_program("run", LOCKED, "--bode", "--json", "b.json", "--csv", "b.csv", "--html", "b.html")
        self.assertEqual(made.stderr, "")
        self.assertIn("current around -5 A", made.stdout)
        told = json.loads((self.path / "b.json").read_text())
        self.assertEqual(len((self.path / "b.csv").read_text().splitlines()), 1 + len(told["points"]))
        self.assertIn("Frequency response of", (self.path / "b.html").read_text())
        self.assertAlmostEqual(told["measured"]["crossover_Hz"] / told["designed"]["crossover_Hz"], 1, delta=0.03)
        self.assertTrue(all(math.isfinite(p["gain_dB"]) for p in told["points"]))

    def test_json_is_alone_on_standard_output(self):
        made = self.run_program("run", LOCKED, "--bode", "--amplitude", "0.5", "--json", "-")
        self.assertEqual(json.loads(made.stdout)["amplitude"], 0.5)
        self.assertIn("coherence", made.stderr)

    def test_refuses_with_a_way_out_and_writes_nothing(self):
        for words, said in (((NO_LOOP, "--bode"), "has no loop"),
                            ((LOCKED, "--bode", "--vary", "supply.voltage_V=20:28:3"), "--vary has nothing to do with --bode"),
                            ((LOCKED, "--bode", "--out", "all"), "--out has nothing to do with --bode"),
                            ((LOCKED, "--amplitude", "1"), "--bode"),
                            ((LOCKED, "--bode", "--amplitude", "-1"), "--amplitude"),
                            ((LOCKED, "--bode", "--set", "reference.shape=constant", "--set", "reference.value=0"), "--amplitude"),
                            ((LOCKED, "--bode", "--json", "/nowhere/b.json"), "/nowhere")):
            with self.subTest(words=words[1:]):
                made = self.run_program("run", *words, code=2)
                self.assertIn(said, made.stderr)
                self.assertEqual(made.stdout, "")
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
