#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep compare: controllers side by side, what it prints and writes, and what it refuses."""
import csv
import json
import unittest

from program import ProgramTest


class Compare(ProgramTest):
    def test_prints_and_writes(self):
        made = self.run_program("compare", "maxon-251601", "--runs", "1", "--json", "c.json", "--csv", "c.csv", "--write", "own")
        self.assertEqual(made.stderr, "")
        told = json.loads((self.path / "c.json").read_text())
        rows = list(csv.DictReader((self.path / "c.csv").read_text().splitlines()))
        self.assertEqual([r["controller"] for r in rows if r["drive"] == "nominal"], [c["name"] for c in told["controllers"]])
        self.assertEqual(len(rows), 2 * len(told["controllers"]))
        for controller in told["controllers"]:
            self.assertIn(f"\n  {controller['name']} ", made.stdout)
            self.assertTrue(controller["runs"] and controller["holds"], controller["name"])
            for figure, nominal in controller["nominal"].items():
                worst = controller["worst"][figure]
                self.assertTrue("never" in (nominal, worst) or worst >= nominal, (controller["name"], figure))
        self.assertIn("Six-step or field-oriented?", made.stdout)
        self.assertLessEqual(max(len(line) for line in made.stdout.split("Cortex-M4F")[-1].splitlines()), 120)

    def test_a_written_scenario_is_the_run_that_was_compared(self):
        self.run_program("compare", "maxon-251601", "--runs", "0", "--json", "c.json", "--write", "own", "--quiet")
        told = {c["name"]: c for c in json.loads((self.path / "c.json").read_text())["controllers"]}
        self.run_program("run", "own/field-oriented.toml", "--json", "alone.json", "--quiet")
        alone = {c["figure"]: c["measured"] for c in json.loads((self.path / "alone.json").read_text())["comparisons"]}
        self.assertEqual(told["field-oriented"]["nominal"]["copper loss"], alone["copper loss"])

    def test_json_and_csv_are_alone_on_standard_output(self):
        self.assertIn("controllers", json.loads(self.run_program("compare", "maxon-251601", "--runs", "0", "--json", "-").stdout))
        self.assertTrue(self.run_program("compare", "maxon-251601", "--runs", "0", "--csv", "-").stdout.startswith("controller,drive,holds,"))

    def test_refuses_with_a_way_out_and_writes_nothing(self):
        for words, said in ((("nothing",), "motor list"),
                            (("maxon-251601", "--settle", "-1"), "--settle"),
                            (("maxon-251601", "--runs", "-1"), "--runs"),
                            (("example-linear",), "is linear"),
                            (("maxon-251601", "--json", "a", "--csv", "a"), "--csv"),
                            (("maxon-251601", "--json", "/nowhere/c.json"), "/nowhere")):
            with self.subTest(words=words):
                made = self.run_program("compare", *words, code=2)
                self.assertIn(said, made.stderr)
                self.assertEqual(made.stdout, "")
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
