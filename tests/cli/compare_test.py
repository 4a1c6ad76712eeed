#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep compare MOTOR: its text and its files, and the input that it refuses. A scenario that it writes is the
scenario that it ran."""
import html
import json
import math
import pathlib
import re
import sqlite3
import subprocess
import tempfile
import unittest
from contextlib import closing

import cells
from program import PROGRAM, ProgramTest

MOTOR = "maxon-251601"
R_OHM = 1.03  # terminal resistance on the sheet
# The gauges that make up each figure of a comparison, by their labels in the scenarios: the added ones and the subtracted ones.
MADE_OF = {
    "settling after the start": (["settling of the start"], []),
    "overshoot of the start": (["overshoot of the start"], []),
    "peak current of the start": (["peak current of the start"], []),
    "error after the load step": (["largest error after the load step"], []),
    "settling after the load step": (["settling of the load step"], []),
    "peak current of the deceleration": (["peak current of the deceleration"], []),
    "swing of the low speed": (["swing of the low speed"], []),
    "rms torque ripple": (["torque ripple, rms"], []),
    "peak-to-peak torque ripple": (["torque ripple, peak to peak"], []),
    "dip of the torque below its mean": (["mean torque"], ["least torque"]),
    "distortion of the phase current": (["distortion of a phase's current"], []),
    "copper loss": (["copper loss"], []),
    "bridge loss": (["conduction loss", "switching loss"], []),
    "total loss": (["copper loss", "conduction loss", "switching loss"], []),
    "turn-ons of a switch": (["turn-ons of a switch"], []),
    "rms torque ripple at the low speed": (["torque ripple at the low speed, rms"], []),
}
SHORT_NAMES = dict(zip(("settles", "overshoot", "peak", "load error", "load settles", "brake peak", "slow swing", "ripple rms",
                        "ripple p-p", "dip", "THD", "copper", "bridge", "losses", "turn-ons", "slow ripple"), MADE_OF, strict=True))


RUNS, SEED = 2, 3


class Compare(ProgramTest):
    """Runs one comparison with all its files. The tests read these files."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.made = pathlib.Path(folder.name)
        words = ["compare", MOTOR, "--runs", f"{RUNS}", "--seed", f"{SEED}", "--json", "c.json", "--csv", "c.csv", "--html", "c.html",
                 "--store", "c.sqlite", "--write", "all"]
        result = subprocess.run([PROGRAM, *words], cwd=cls.made, capture_output=True, text=True, timeout=600)
        if (result.returncode, result.stderr) != (0, ""):
            raise AssertionError(result.stderr + result.stdout)
        cls.printed = result.stdout
        cls.told = json.loads((cls.made / "c.json").read_text())
        cls.controllers = {c["name"]: c for c in cls.told["controllers"]}

    def scenario(self, name):
        return self.made / "all" / (name.replace(",", "").replace(" ", "-") + ".toml")

    def alone(self, name, *words):
        """Runs one controller alone. Returns the digest, the figures by their labels, and whether the run passes."""
        self.run_program("run", str(self.scenario(name)), *words, "--json", "one.json", "--force", code=None)
        digest, figures = cells.figures_alone(self.path / "one.json")
        return digest, figures, json.loads((self.path / "one.json").read_text())["passed"]

    def figure_of(self, figures, phrase):
        """Computes one figure of the comparison from the measured figures of a run."""
        labels = {name.partition(" [")[0]: math.inf if x is None else x for name, x in figures.items()}
        plus, minus = MADE_OF[phrase]
        return sum(labels[label] for label in plus) - sum(labels[label] for label in minus)

    def test_prints_and_writes(self):
        self.assertIn("Six-step or field-oriented?", self.printed)
        self.assertEqual(set(MADE_OF), set(self.told["units"]))
        for name, controller in self.controllers.items():
            self.assertIn(name, self.printed)
            self.assertEqual(set(controller["nominal"]), set(self.told["units"]))
        # This line marks a file of sixstep, which the command may overwrite.
        self.assertRegex((self.made / "c.csv").read_text(), r"^# sixstep \d")
        rows = cells.lines_of_csv(self.made / "c.csv")
        self.assertEqual([row["controller"] for row in rows], [name for name in self.controllers for _ in ("nominal", "worst")])

    def test_every_cell_is_that_of_the_run_alone(self):
        """The store, the CSV, the JSON, the page and the tables agree with the same runs, which are repeated one by
        one from the written scenarios."""
        stored = cells.of_store(self.made / "c.sqlite")
        self.assertEqual(len(stored), RUNS * len(self.controllers))
        rows = {(row["controller"], row["drive"]): row
                for row in cells.lines_of_csv(self.made / "c.csv")}
        for name in ("six-step, soft", "hysteresis, comparators", "field-oriented"):
            _, nominal, holds = self.alone(name)
            self.assertEqual(self.controllers[name]["holds"], holds)
            worst, held = {phrase: self.figure_of(nominal, phrase) for phrase in MADE_OF}, 0
            for drive in range(RUNS):
                digest, figures, holds = self.alone(name, "--seed", f"{SEED}", "--drive", f"{drive}")
                row = next(row for row in stored if row["controller"] == name and row["run"] % RUNS == drive)
                self.assertEqual((row["digest"], bool(row["passed"])), (digest, holds))
                for figure, measured in figures.items():
                    self.assertEqual(row[figure], measured, (name, drive, figure))
                R, U = row["drive: motor_override.resistance_ohm [ohm]"], 24
                self.assertTrue(0.9 * R_OHM <= R <= 1.1 * R_OHM, R)
                self.assertLessEqual(row["peak current of the start [A]"], 2 * U / R)
                held += holds
                worst = {phrase: max(x, self.figure_of(figures, phrase)) for phrase, x in worst.items()}
            self.assertEqual(self.controllers[name]["drives_that_hold"], held)
            for kind, wanted in (("nominal", {p: self.figure_of(nominal, p) for p in MADE_OF}), ("worst", worst)):
                for phrase, exact in wanted.items():
                    told, cell = self.controllers[name][kind][phrase], rows[name, kind][f"{phrase} [{self.told['units'][phrase]}]"]
                    self.assertEqual(math.inf if told == "never" else told, exact, (name, kind, phrase))
                    self.assertEqual(float(cell), exact, (name, kind, phrase))

    def test_tables_and_page_show_the_same(self):
        """Each cell of the four printed tables is equal to the value with the same name in the JSON."""
        page = html.unescape((self.made / "c.html").read_text(encoding="utf-8"))
        tables = [[re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", re.sub("</?b>", "", row)) for row in re.findall(r"<tr>(.*?)</tr>", table)]
                  for table in re.findall(r"<table>(.*?)</table>", page, re.S)]
        for words in self.told["words"] + self.told["notes"]:
            self.assertIn(f"<li>{words}</li>", page)
        blocks = [block.splitlines() for block in self.printed.split("\n\n") if block.startswith("  controller")]
        self.assertEqual(len(blocks), 4)
        self.assertEqual(tables, [[re.split(r"  +", line.strip()) for line in block] for block in blocks])
        for kind, block in zip(("nominal", "nominal", "worst", "worst"), blocks):
            head, *lines = [re.split(r"  +", line.strip()) for line in block]
            self.assertEqual(len(lines), len(self.controllers))
            for name, *line in lines:
                controller = self.controllers[name]
                for column, cell in zip(head[1:], line, strict=True):
                    if column in SHORT_NAMES:
                        phrase = SHORT_NAMES[column]
                        exact = controller[kind][phrase]
                        exact = math.inf if exact == "never" else exact
                        shown = cells.shown(cell, self.told["units"][phrase])
                        near = shown == exact or abs(shown - exact) <= 0.0051 * abs(exact) + 0.0005 * (phrase.startswith("distortion"))
                        self.assertTrue(near, (name, kind, column, cell, exact))
                    if column == "hold":
                        self.assertEqual(cell, f"{controller['drives_that_hold']} of {RUNS}")
                    if column == "holds":
                        self.assertEqual(cell, "yes" if controller["holds"] else "NO")
            self.assertTrue(set(head[1:]) - set(SHORT_NAMES) <= {"hold", "holds", "lowest", "tick", "flash"}, head)

    def test_the_figures_keep_the_laws(self):
        """The worst drive is not better than the nominal drive. At most as many drives pass as were drawn. The
        current is at most what the bus drives through a winding with 0.9 R, or twice this current if a hard or
        complementary bridge reverses the voltage. No time is longer than its part of the course. The losses are the
        sum of copper and bridge."""
        course_s = max(float(x) for x in re.findall(r"^duration_s = (\S+)", self.scenario("six-step, soft").read_text(), re.M))
        for name, controller in self.controllers.items():
            self.assertTrue(controller["runs"] and controller["holds"], name)
            self.assertEqual(controller["drives"], RUNS)
            self.assertLessEqual(controller["drives_that_hold"], RUNS)
            for figure, nominal in controller["nominal"].items():
                worst = controller["worst"][figure]
                self.assertTrue("never" in (nominal, worst) or worst >= nominal, (name, figure))
            for kind in ("nominal", "worst"):
                f = controller[kind]
                self.assertLessEqual(f["peak current of the start"], 24 / (0.9 * R_OHM), (name, kind))
                self.assertLessEqual(f["peak current of the deceleration"], 2 * 24 / (0.9 * R_OHM), (name, kind))
                for time in ("settling after the start", "settling after the load step"):
                    self.assertTrue(f[time] == "never" or 0 <= f[time] <= course_s, (name, kind, time))
                self.assertTrue(0 <= f["distortion of the phase current"] < 2, (name, kind))
                self.assertTrue(0 < f["copper loss"] < 24 * 24 / (0.9 * R_OHM), (name, kind))
                self.assertLessEqual(f["total loss"], (f["copper loss"] + f["bridge loss"]) * (1 + 1e-12), (name, kind))
            f = controller["nominal"]
            self.assertAlmostEqual(f["total loss"], f["copper loss"] + f["bridge loss"], delta=1e-12)

    def test_draws_a_page(self):
        page = (self.made / "c.html").read_text(encoding="utf-8")
        names = list(self.controllers)
        for n, name in enumerate(names):  # the response to the load, and the numbered point
            self.assertEqual(page.count(f'aria-label="{n + 1} {name}"'), 1, name)
            self.assertRegex(page, f"<circle[^>]*/><text[^>]*>{n + 1}</text>")
        trades = page.partition('aria-label="Torque ripple against losses"')[2].partition("</svg>")[0]
        self.assertEqual(trades.count("<circle"), len(names))
        figures = {name: (c["nominal"]["rms torque ripple"], c["nominal"]["total loss"]) for name, c in self.controllers.items()}
        front = [n for n, (r, l) in figures.items() if not any(a <= r and b <= l and (a, b) != (r, l) for a, b in figures.values())]
        self.assertEqual(trades.count('style="fill:var(--main)"'), len(front))
        least = min(figures, key=lambda n: figures[n][0])
        self.assertRegex(page, f"least rms torque ripple</dt>\\s*<dd>{least}: ")

    def test_a_scenario_is_written_for_each(self):
        self.assertEqual(len(list((self.made / "all").iterdir())), len(self.controllers))

    def test_a_store_is_gone_on_with_and_tells_the_same(self):
        store = self.path / "c.sqlite"
        store.write_bytes((self.made / "c.sqlite").read_bytes())
        before = cells.of_store(store)
        with closing(sqlite3.connect(store)) as db:
            db.execute("delete from run where run % 3 = 1")
            db.commit()
        words = ["compare", MOTOR, "--runs", f"{RUNS}", "--seed", f"{SEED}", "--store", "c.sqlite"]
        self.run_program(*words, "--resume", "--json", "c.json", "--html", "c.html")
        self.assertEqual((self.path / "c.json").read_bytes(), (self.made / "c.json").read_bytes())
        pages = [(folder / "c.html").read_text(encoding="utf-8").partition("<h1>")[2].partition("<footer")[0] for folder in (self.path, self.made)]
        self.assertEqual(*pages)
        self.assertEqual(cells.of_store(store), before)
        other = self.run_program(*words, "--voltage", "20", "--resume", code=2)
        self.assertIn("c.sqlite", other.stderr)
        there = self.run_program(*words, code=2)
        self.assertIn("--resume", there.stderr)
        with closing(sqlite3.connect(store)) as db:
            db.execute("update run set f7 = f7 / 2 where run = 3")
            db.commit()
        self.assertIn("c.sqlite: is damaged: run 3 ", self.run_program(*words, "--resume", code=2).stderr)

    def test_tells_the_lowest_speed(self):
        lowest = {name: c["lowest_speed_rad_s"] for name, c in self.controllers.items()}
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
