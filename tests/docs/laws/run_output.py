# SPDX-License-Identifier: Apache-2.0
"""Laws of the tables that a run prints. A verdict follows from its limits, a deviation from its two numbers, and a
summary counts the rows above. No quantity exceeds the bounds of motor and supply."""
import re

from laws import recordings
from laws.quantities import quantity
from laws.scenarios import most_of_command

PARTS = re.compile(r" {2,}")
SUMMARY = re.compile(r"^(\d+) experiments?: (.*)$")
LIMIT = re.compile(r"^(?:(<=|>=) )?(.+)$")


def limits(text):
    """(least, most) in SI, from a text such as "<= 1 ms", ">= 4 A", "5.1 .. 5.2 A" or "0.8 .. 0.9". None if the row
    has no requirement."""
    if " .. " in text:
        low, high = text.split(" .. ")
        found = quantity(high)
        unit = re.sub(r"^[-+.\de]+\s*", "", high)
        return quantity(f"{low} {unit}")[0], found[0]
    m = LIMIT.match(text)
    if m.group(1) is None:
        return None
    found = quantity(m.group(2))[0]
    return (None, found) if m.group(1) == "<=" else (found, None)


class Table:
    def __init__(self, test, spot, lines, most):
        self.test, self.spot, self.most = test, spot, most
        self.asked = self.held = self.compared = 0
        self.names = []
        for line in lines:
            self.line(line)

    def line(self, line):
        if not line.startswith("  "):
            self.names.append(line.strip())
            return
        cells = PARTS.split(line.strip())
        if len(cells) >= 4 and cells[3] in ("ok", "FAILED"):
            self.requirement(cells)
        elif len(cells) >= 4 and (recordings.VERDICT.match(cells[3]) or cells[3] == "no verdict: seen once"):
            recordings.row(self.test, self.spot, cells)
            self.compared += 1
        elif len(cells) >= 4 and (cells[3].endswith("%") or cells[3] == "not comparable"):
            self.comparison(cells)
        for cell in cells[1:3]:
            self.possible(line, cell)

    def requirement(self, cells):
        self.asked += 1
        least, most = limits(cells[1])
        measured = quantity(cells[2])
        if measured is None:  # "never", "no value"
            holds = cells[2] == "never" and most is None
        else:
            x, _, half = measured
            inside = (least is None or x >= least - half) and (most is None or x <= most + half)
            outside = (least is not None and x < least + half) or (most is not None and x > most - half)
            self.test.assertTrue(inside if cells[3] == "ok" else outside, f"{self.spot}: {cells}")
            holds = cells[3] == "ok"
        self.test.assertEqual(holds, cells[3] == "ok", f"{self.spot}: {cells}")
        self.held += 1 if holds else 0

    def comparison(self, cells):
        self.compared += 1
        if cells[3] == "not comparable":
            return
        there, here = quantity(cells[1]), quantity(cells[2])
        self.test.assertEqual(there[1], here[1], f"{self.spot}: {cells}")
        told = float(cells[3].split()[0]) / 100
        room = (there[2] + here[2]) * 2 / abs(there[0]) + 0.006 * abs(told) + 1e-6
        self.test.assertLessEqual(abs((here[0] - there[0]) / abs(there[0]) - told), room, f"{self.spot}: {cells}")

    def possible(self, line, cell):
        for part in cell.replace("<=", "").replace(">=", "").split(" .. "):
            found = quantity(part)
            if found is None:
                continue
            x, dimension, _ = found
            self.test.assertLess(abs(x), 1e9, f"{self.spot}: {line}")
            bound = self.most.bound(dimension) if self.most else None
            if bound is not None:
                self.test.assertLessEqual(abs(x), bound, f"{self.spot}: {line.strip()}: more than motor and supply allow")
            if "efficiency" in line.split("  ")[1] and dimension == "1":
                self.test.assertTrue(0 <= x <= 1, f"{self.spot}: {line}")
            if dimension == "degC":
                self.test.assertTrue(-60 <= x <= 600, f"{self.spot}: {line}")


def tables_in(text):
    """(command above it, lines, summary line) for each table of experiments."""
    command, lines, inside = "", [], False
    for line in text.splitlines() + [""]:
        if line.startswith("$ "):
            command = line[2:]
        if line.startswith("experiment  "):
            inside, lines = True, []
        elif inside and SUMMARY.match(line):
            yield command, lines, line
            inside = False
        elif inside and (line.startswith("$ ") or not line.strip()):
            yield command, lines, None
            inside = False
        elif inside and line != "...":
            lines.append(line)


def summary_agrees(test, spot, table, line):
    count, words = SUMMARY.match(line).groups()
    test.assertEqual(int(count), len(table.names), f"{spot}: {line}")
    failed = re.search(r"(\d+) of (\d+) requirements FAILED", words)
    everything = re.search(r"all (\d+) requirements hold", words)
    if failed:
        test.assertEqual((int(failed.group(1)), int(failed.group(2))), (table.asked - table.held, table.asked), f"{spot}: {line}")
    elif everything:
        test.assertEqual((int(everything.group(1)), 0), (table.asked, table.asked - table.held), f"{spot}: {line}")
    elif "the requirement holds" in words:
        test.assertEqual((1, 1), (table.asked, table.held), f"{spot}: {line}")
    else:
        test.assertIn("nothing required", words, f"{spot}: {line}")


def judges(spot):
    return "experiment  " in spot.text and ("required" in spot.text or "expected" in spot.text)


def judge(test, spot, command, written):
    for above, lines, summary in tables_in(spot.text):
        table = Table(test, spot, lines, most_of_command(above or command, written))
        test.assertGreater(table.asked + table.compared, 0, f"{spot}: a table without a row")
        if summary and "..." not in spot.text.splitlines():
            summary_agrees(test, spot, table, summary)
