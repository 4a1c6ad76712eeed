#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep compare MOTOR: what it prints and writes, that a scenario it writes is the one it ran, and what it refuses."""
import csv
import json
import sqlite3
import unittest
from contextlib import closing

from program import ProgramTest

MOTOR = "maxon-251601"


class Compare(ProgramTest):
    def test_prints_and_writes(self):
        made = self.run_program("compare", MOTOR, "--runs", "0", "--json", "c.json", "--csv", "c.csv")
        self.assertEqual(made.stderr, "")
        self.assertIn("Six-step or field-oriented?", made.stdout)
        told = json.loads((self.path / "c.json").read_text())
        for controller in told["controllers"]:
            self.assertIn(controller["name"], made.stdout)
            self.assertEqual(set(controller["nominal"]), set(told["units"]))
        rows = list(csv.DictReader((self.path / "c.csv").read_text().splitlines()))
        self.assertEqual([row["controller"] for row in rows], [c["name"] for c in told["controllers"]])

    def test_draws_a_page(self):
        told = json.loads(self.run_program("compare", MOTOR, "--runs", "0", "--json", "-", "--html", "c.html").stdout)
        page = (self.path / "c.html").read_text(encoding="utf-8")
        names = [c["name"] for c in told["controllers"]]
        for n, name in enumerate(names):  # its answer to the load, and its number among the trades
            self.assertEqual(page.count(f'aria-label="{n + 1} {name}"'), 1, name)
            self.assertRegex(page, f"<circle[^>]*/><text[^>]*>{n + 1}</text>")
        trades = page.partition('aria-label="Torque ripple against losses"')[2].partition("</svg>")[0]
        self.assertEqual(trades.count("<circle"), len(names))
        figures = {c["name"]: (c["nominal"]["rms torque ripple"], c["nominal"]["loss in all"]) for c in told["controllers"]}
        front = [n for n, (r, l) in figures.items() if not any(a <= r and b <= l and (a, b) != (r, l) for a, b in figures.values())]
        self.assertEqual(trades.count('style="fill:var(--main)"'), len(front))
        least = min(figures, key=lambda n: figures[n][0])
        self.assertRegex(page, f"least rms torque ripple</dt>\\s*<dd>{least}: ")
        self.run_program("compare", MOTOR, "--runs", "0", "--quiet", "--html", "again.html")
        again = (self.path / "again.html").read_text(encoding="utf-8")
        self.assertEqual(again.partition("<h1>")[2].partition("<footer")[0], page.partition("<h1>")[2].partition("<footer")[0])

    def test_a_written_scenario_is_the_one_that_ran(self):
        made = self.run_program("compare", MOTOR, "--runs", "0", "--json", "-", "--write", "all")
        told = {c["name"]: c for c in json.loads(made.stdout)["controllers"]}
        self.assertEqual(len(list((self.path / "all").iterdir())), len(told))
        for name, file in (("six-step, soft", "six-step-soft"), ("field-oriented", "field-oriented")):
            alone = json.loads(self.run_program("run", f"all/{file}.toml", "--json", "-").stdout)
            copper = [c["measured"] for c in alone["compare"] if c["figure"] == "copper loss"]
            self.assertEqual(copper, [told[name]["nominal"]["copper loss"]])

    def test_worst_is_no_better_than_nominal(self):
        told = json.loads(self.run_program("compare", MOTOR, "--runs", "1", "--json", "-").stdout)
        for controller in told["controllers"]:
            self.assertTrue(controller["runs"] and controller["holds"], controller["name"])
            for figure, nominal in controller["nominal"].items():
                worst = controller["worst"][figure]
                self.assertTrue("never" in (nominal, worst) or worst >= nominal, (controller["name"], figure))

    def test_a_store_is_gone_on_with_and_tells_the_same(self):
        whole = self.run_program("compare", MOTOR, "--runs", "2", "--json", "-").stdout
        self.run_program("compare", MOTOR, "--runs", "2", "--quiet", "--store", "c.sqlite")
        with closing(sqlite3.connect(self.path / "c.sqlite")) as store:
            before = sorted(store.execute("select number, digest from run").fetchall())
            store.execute("delete from run where number % 3 = 1")
            store.commit()
        again = self.run_program("compare", MOTOR, "--runs", "2", "--store", "c.sqlite", "--resume", "--json", "-").stdout
        self.assertEqual(again, whole)
        with closing(sqlite3.connect(self.path / "c.sqlite")) as store:
            self.assertEqual(sorted(store.execute("select number, digest from run").fetchall()), before)
        other = self.run_program("compare", MOTOR, "--runs", "2", "--voltage", "20", "--store", "c.sqlite", "--resume", code=2)
        self.assertIn("c.sqlite", other.stderr)
        there = self.run_program("compare", MOTOR, "--runs", "2", "--store", "c.sqlite", code=2)
        self.assertIn("--resume", there.stderr)

    def test_tells_the_lowest_speed(self):
        told = json.loads(self.run_program("compare", MOTOR, "--runs", "0", "--json", "-").stdout)["controllers"]
        lowest = {c["name"]: c["lowest_speed_rad_s"] for c in told}
        self.assertTrue(all(w is None or w > 0 for w in lowest.values()), lowest)
        self.assertTrue(any(w is not None for w in lowest.values()), lowest)

    def test_refuses_with_a_way_out_and_writes_nothing(self):
        for words, said in ((("no-such-motor",), "no-such-motor"), (("example-linear",), "linear"),
                            ((MOTOR, "--voltage", "2"), "--voltage"), ((MOTOR, "--json", "/nowhere/c.json"), "/nowhere"),
                            ((MOTOR, "--json", "c.json", "--csv", "c.json"), "c.json")):
            with self.subTest(words=words):
                made = self.run_program("compare", *words, code=2)
                self.assertIn(said, made.stderr)
                self.assertEqual(made.stdout, "")
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
