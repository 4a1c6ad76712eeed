#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every cell of a table of many runs is equal to the figure with the same name in the same run, made alone. This is
true for every kind of file."""
import contextlib
import csv
import json
import math
import re
import sqlite3
import struct
import unittest

import cells
from program import SHORT, SOURCE, ProgramTest

# Figures of different sizes and units. Some of them have no value.
FIGURES = """
[[require]]
metric = "max"
signal = "torque"
label = "greatest torque"
max = 10
[[compare]]
metric = "mean"
signal = "copper_loss_W"
value = 1
source = "none"
label = "heat"
[[compare]]
metric = "reach_time_s"
signal = "current"
level = 22
value = 1
source = "none"
label = "reaches 22 A"
[[compare]]
metric = "mean"
signal = "speed"
value = 0
source = "none"
label = "turning"
"""
SPREAD = """
[[spread]]
key = "motor_override.resistance_ohm"
relative = 0.1
[[spread]]
key = "supply.voltage_V"
relative = 0.05
"""


class Cells(ProgramTest):
    def held(self, more=""):
        """Twenty milliseconds with a held rotor. The current is U/R, and the speed is 0."""
        (self.path / "a.toml").write_text(SHORT.format(limit=25).replace("1e-4", "20e-3") + FIGURES + more)
        return "a.toml"

    def near(self, printed, exact, digits, where):
        if exact is None or printed is None or not math.isfinite(exact):
            self.assertEqual(printed, exact, where)
        else:
            self.assertLessEqual(abs(printed - exact), 0.51 * 10.0 ** -(digits - 1) * abs(exact), where)

    def check(self, words, alone, runs):
        """Compares all tables of a plan with its single runs. `alone` is the command of one run, without the run's
        number."""
        table = self.run_program("run", *words, "--store", "s.sqlite", "--csv", "t.csv", "--json", "t.json", "--html", "t.html", code=None).stdout
        of_csv, of_store = cells.of_csv(self.path / "t.csv"), cells.of_store(self.path / "s.sqlite")
        of_json, of_page = cells.of_json(self.path / "t.json"), cells.of_page(self.path / "t.html")
        self.assertEqual([list(rows[0]) for rows in (of_csv, of_json)], [list(of_store[0])] * 2, "one name everywhere")
        self.assertEqual([len(rows) for rows in (of_csv, of_store, of_json)], [runs] * 3)
        self.assertEqual(list(of_csv[0]), cells.BEFORE + cells.names_of_json(json.loads((self.path / "t.json").read_text())) + cells.BEHIND)
        for n in range(runs):
            self.run_program("run", *alone, str(n), "--json", "one.json", "--force", code=None)
            digest, figures = cells.figures_alone(self.path / "one.json")
            self.assertEqual(len(figures), 5)
            for name, row in (("csv", of_csv[n]), ("store", of_store[n]), ("json", of_json[n])):
                self.assertEqual((row["run"], row["end"], row["digest"]), (n, "whole", digest), name)
                self.assertEqual(bool(row["passed"]), json.loads((self.path / "one.json").read_text())["passed"], name)
                for figure, measured in figures.items():
                    self.assertEqual(row[figure], math.inf if measured is None else measured, (name, n, figure))
                drawn = {key: cell for key, cell in row.items() if key not in figures and key not in cells.BEFORE + cells.BEHIND}
                self.held_rotor(drawn, row)
                for key, cell in drawn.items():
                    page = of_page[key.partition(" [")[0]][n]
                    self.assertEqual(page, cell if isinstance(cell, str) else struct.unpack("f", struct.pack("f", cell))[0])
            for figure, measured in figures.items():
                drawn = of_page[figure.partition(" [")[0]][n]
                self.assertEqual(drawn, math.inf if measured is None else struct.unpack("f", struct.pack("f", measured))[0], figure)
        return table, of_csv

    def held_rotor(self, drawn, row):
        """The law: the current is the voltage divided by the resistance, both of this row."""
        names = {key.removeprefix("drive: ").partition(" [")[0]: cell for key, cell in drawn.items()}
        U, R = names.get("supply.voltage_V", 24), names.get("motor_override.resistance_ohm", 1.03)
        self.assertAlmostEqual(row["current [A]"], U / R, delta=1e-9 * U / R)
        self.assertLessEqual(row["heat [W]"], U * U / R)
        self.assertEqual(row["turning [rad/s]"], 0)

    def test_of_a_plan_without_spread(self):
        self.held()
        words = ["a.toml", "--vary", "supply.voltage_V=12,24", "--vary", "motor_override.resistance_ohm=1:2:3", "--vary",
                 "pwm.chopping=soft,hard"]
        table, rows = self.check(words, [*words, "--only"], 12)
        head, *lines = [re.split(r"  +", line.strip()) for line in table.splitlines()[1:14]]
        self.assertEqual(head[:4], ["run", "supply.voltage_V", "motor_override.resistance_ohm", "pwm.chopping"])
        legend = dict(re.findall(r"^  \[(\d)\] ([^,\n]+)", table, re.M))
        units = {name.partition(" [")[0]: re.sub(r".*\[(.*)\]", r"\1", name) for name in rows[0]}
        for line, row in zip(lines, rows, strict=True):
            self.assertEqual(int(line[0]), row["run"])
            for column, cell in zip(head[4:], line[4:]):
                if figure := legend.get(column.strip("[]")):
                    exact = row[f"{figure} [{units[figure]}]"]
                    self.near(cells.shown(cell, units[figure]), exact, 4, (line, figure))

    def test_of_a_plan_with_spread(self):
        self.held(SPREAD)
        table, rows = self.check(["a.toml", "--runs", "7"], ["a.toml", "--drive"], 7)
        least, greatest = (f(row["current [A]"] for row in rows) for f in (min, max))
        line = re.split(r"  +", next(line for line in table.splitlines() if line.startswith("  current")).strip())
        self.near(cells.shown(line[2], "A"), least, 4, line)
        self.near(cells.shown(line[6], "A"), greatest, 4, line)

    def test_of_both(self):
        self.held(SPREAD)
        words = ["a.toml", "--vary", "motor_override.inductance_mH=0.1,0.2", "--runs", "3"]
        self.check(words, [*words, "--only"], 6)

    def test_names_that_are_alike_or_act(self):
        """No two columns have the same name. No name contains the end of a line or a control sequence, and a
        spreadsheet executes no name as a formula."""
        self.held('[[compare]]\nmetric = "mean"\nsignal = "speed"\nvalue = 0\nsource = "none"\nlabel = "HEAT"\n'
                  '[[compare]]\nmetric = "mean"\nsignal = "copper_loss_W"\nvalue = 0\nsource = "none"\nlabel = "Heat"\n' +
                  "".join(f'[[compare]]\nmetric = "mean"\nsignal = "speed"\nvalue = 0\nsource = "none"\nlabel = "{label}"\n'
                          for label in ('=cmd|\\"/c calc\\"!A1', "+1", "-1", "@SUM(A1)", "\\u001b[31mred\\u001b]0;t\\u0007", "a\\nb",
                                        "\\u202eabc", "\\uff1d1", "run", "a;=1", " =1")))
        self.run_program("run", "a.toml", "--vary", "supply.voltage_V=12,24", "--csv", "t.csv", "--store", "s.sqlite", "--json",
                         "t.json", code=None)
        text = (self.path / "t.csv").read_text()
        self.assertEqual(len(text.splitlines()), 3 + 1 + 2)
        head = next(csv.reader([text.splitlines()[3]]))
        self.assertEqual(len({name.lower() for name in head}), len(head), head)
        for name in head:
            self.assertNotIn(name.lstrip()[0], "=+-@\uff1d", name)
            self.assertTrue(name.isprintable(), name)
        for wanted in ("Heat [W] (2)", "HEAT [rad/s]", "\\u001b[31mred\\u001b]0;t\\u0007 [rad/s]", "a\\u000ab [rad/s]",
                       "'=cmd|\"/c calc\"!A1 [rad/s]", "'-1 [rad/s]"):
            self.assertIn(wanted, head)
        self.assertEqual(list(cells.of_store(self.path / "s.sqlite")[0]), head)
        with contextlib.closing(sqlite3.connect(self.path / "s.sqlite")) as db:
            printed = "".join(name for name, in db.execute('SELECT name FROM "columns"'))
            printed += "".join(sql for sql, in db.execute("SELECT sql FROM sqlite_schema WHERE sql IS NOT NULL"))
        self.assertTrue(printed.isprintable())

    def test_of_points_that_are_searched(self):
        self.held()
        (self.path / "p.toml").write_text('scenario = "a.toml"\nminimise = "heat"\nevaluations = 12\n'
                                          '[[vary]]\nkey = "supply.voltage_V"\nfrom = 6\nto = 24\n'
                                          '[[vary]]\nkey = "motor_override.resistance_ohm"\nfrom = 1\nto = 4\n')
        self.run_program("design", "--optimise", "p.toml", "--store", "s.sqlite", "--json", "p.json", "--toml", "best.toml")
        rows = cells.of_store(self.path / "s.sqlite")
        for row in rows:
            self.held_rotor({key: cell for key, cell in row.items() if key.startswith(("supply", "motor"))}, row)
        row = min(rows, key=lambda row: row["heat [W]"])
        self.run_program("run", "best.toml", "--json", "one.json")
        _, figures = cells.figures_alone(self.path / "one.json")
        best = {cells.with_unit(f["figure"], f["unit"]): f["worst"] for f in json.loads((self.path / "p.json").read_text())["figures"]}
        for figure, measured in figures.items():
            self.assertEqual(row[figure], math.inf if measured is None else measured, figure)
            self.assertEqual({"never": math.inf}.get(best[figure], best[figure]), measured, figure)

    def test_of_points_that_are_searched_with_drives(self):
        """Each row is the run of one drive at one point. The same run, made alone with the values of the row, has the
        same result."""
        self.held('[[spread]]\nkey = "motor_override.inductance_mH"\nrelative = 0.2\n')
        (self.path / "p.toml").write_text('scenario = "a.toml"\nminimise = "heat"\nevaluations = 3\ndrives = 2\n'
                                          '[[vary]]\nkey = "supply.voltage_V"\nfrom = 6\nto = 24\n')
        self.run_program("design", "--optimise", "p.toml", "--store", "s.sqlite", "--quiet")
        rows = cells.of_store(self.path / "s.sqlite")
        self.assertEqual([row["run"] for row in rows], list(range(6)))
        for row in rows:
            self.run_program("run", "a.toml", "--set", f"supply.voltage_V={row['supply.voltage_V [V]']!r}", "--drive",
                             str(row["run"] % 2), "--json", "one.json", "--force", code=None)
            digest, figures = cells.figures_alone(self.path / "one.json")
            self.assertEqual(row["digest"], digest)
            for figure, measured in figures.items():
                self.assertEqual(row[figure], math.inf if measured is None else measured, figure)
        inductances = {row["run"] % 2: row["drive: motor_override.inductance_mH [mH]"] for row in rows}
        self.assertEqual([row["drive: motor_override.inductance_mH [mH]"] for row in rows], [inductances[n % 2] for n in range(6)])

    def test_of_a_loop_that_is_measured(self):
        """The table has one row per frequency of the multisine. CSV, JSON and the printed table have the same
        numbers."""
        drive = str(SOURCE / "data/scenarios/thesis/7.3.1-locked-exact-design.toml")
        told = self.run_program("run", drive, "--bode", "--csv", "b.csv", "--json", "b.json", code=None).stdout
        rows = cells.lines_of_csv(self.path / "b.csv")
        (self.path / "printed.csv").write_text(self.run_program("run", drive, "--bode", "--csv", "-", code=None).stdout)
        self.assertEqual(cells.lines_of_csv(self.path / "printed.csv"), rows, "alone on standard output")
        self.assertNotIn("-", self.names())
        points = json.loads((self.path / "b.json").read_text())["points"]
        lines = [line.split() for line in told.splitlines() if re.match(r"^ +[\d.e+]+  +-?[\d.]+  ", line)]
        self.assertGreater(len(rows), 10)
        for row, point, line in zip(rows, points, lines, strict=True):
            self.assertNotIn(None, row, "more cells than names")
            for name, cell in point.items():
                if name in row:
                    self.assertEqual(float(row[name]), cell, name)
            self.near(float(line[0]), point["frequency_Hz"], 5, line)
            self.assertAlmostEqual(float(line[1]), point["gain_dB"], delta=0.006)
            self.assertAlmostEqual(float(line[2]), point["phase_deg"], delta=0.06)
            self.assertAlmostEqual(float(line[4]), point["designed_gain_dB"], delta=0.006)


if __name__ == "__main__":
    unittest.main()
