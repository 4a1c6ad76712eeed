# SPDX-License-Identifier: Apache-2.0
"""Laws of many runs: the order of the statistics, the counts, the verdicts and their limits, and the sums of a plan."""
import re
from math import sqrt

from laws.quantities import quantity
from laws.scenarios import motor, read, terminal_ohm
from page import REPOSITORY

CELL = re.compile(r" {2,}")
R_TT = terminal_ohm(motor(read(REPOSITORY / "data/scenarios/pwm-at-12-A.toml")["motor"]))


def statistics(test, spot, line, drives):
    cells = CELL.split(line.strip())
    required, numbers, holds = cells[1], cells[2:-1], cells[-1]
    values = [quantity(cell) for cell in numbers]
    test.assertEqual(8 - 1, len(values), f"{spot}: {line}")
    least, low, median, high, most, mean, deviation = [v[0] for v in values]
    test.assertEqual(sorted([least, low, median, high, most]), [least, low, median, high, most], f"{spot}: {line}")
    test.assertTrue(least <= mean <= most, f"{spot}: {line}")
    # The deviation of numbers within [least, most] with that mean is bounded (Bhatia and Davis).
    test.assertLessEqual(deviation, sqrt((most - mean) * (mean - least)) * 1.01, f"{spot}: {line}")
    held, drawn = map(int, re.match(r"(\d+) of (\d+)", holds).groups())
    test.assertEqual(drives, drawn, f"{spot}: {line}")
    bound = quantity(required.split(" ", 1)[1])[0]
    if held == drawn:
        test.assertTrue(most <= bound if required.startswith("<=") else least >= bound, f"{spot}: {line}")
    else:
        test.assertLess(held, drawn)


def judge_drives(test, spot):
    drives = int(re.search(r"^(\d+) drives", spot.text, re.M).group(1))
    rows = [line for line in spot.text.splitlines() if re.search(r" {2}\d+ of \d+$", line)]
    test.assertTrue(rows, str(spot))
    for line in rows:
        statistics(test, spot, line, drives)


def meets(value, asked):
    m = re.search(r"at (most|least) (.*)$", asked)
    if not m:
        return None
    bound = quantity(m.group(2))[0]
    return value <= bound if m.group(1) == "most" else value >= bound


def judge_plan(test, spot):
    """The table of a plan. "!" marks a figure that misses its limit. FAIL marks a run with such a figure, FAULT a run
    that was stopped. The line below has their counts."""
    asked = dict(re.findall(r"^  \[(\d)\] (.*)$", spot.text, re.M))
    passed = runs = 0
    for line in spot.text.splitlines():
        cells = CELL.split(line.strip())
        if not re.match(r"^\d+$", cells[0]) or cells[-1] not in ("ok", "FAIL", "FAULT"):
            continue
        figures = cells[-1 - len(asked):-1]
        misses = 0
        for n, cell in enumerate(figures):
            value, held = quantity(cell.removesuffix(" !")), meets(0, asked[str(n + 1)])
            if held is None:
                test.assertFalse(cell.endswith("!"), f"{spot}: {line}: nothing is asked of [{n + 1}]")
                continue
            bound = quantity(re.search(r"at (?:most|least) (.*)$", asked[str(n + 1)]).group(1))
            if value[0] != bound[0]:  # the printed numbers are equal, so either verdict is possible
                test.assertEqual(not meets(value[0], asked[str(n + 1)]), cell.endswith("!"), f"{spot}: {line}")
            misses += cell.endswith("!")
        if cells[-1] != "FAULT":
            test.assertEqual("FAIL" if misses else "ok", cells[-1], f"{spot}: {line}")
        passed, runs = passed + (cells[-1] == "ok"), runs + 1
    which_pwm(test, spot)
    told = re.search(r"^(\d+) runs: (?:(\d+) hold every requirement, (\d+) do NOT|all hold)", spot.text, re.M)
    test.assertEqual((str(runs), str(passed), str(runs - passed)), told.groups(), str(spot))


def which_pwm(test, spot):
    """12 A at 24 V. The copper loss is R I^2 and a part of the ripple. The switching loss is proportional to the
    frequency, and the ripple increases with the period. The current in the capacitor is at most the motor's current."""
    if "switching loss" not in spot.text:
        return
    found = {}
    for cells in (CELL.split(line.strip()) for line in spot.text.splitlines()):
        if cells[0].isdigit() and cells[-1] in ("ok", "FAIL"):
            found.setdefault((cells[2], cells[3]), []).append([quantity(c.removesuffix(" !"))[0] for c in [cells[1]] + cells[4:9]])
    least = R_TT * 12**2
    for which, rows in found.items():
        for period, switching, ripple, capacitor, conduction, copper in rows:
            first = rows[0]
            test.assertLess(abs(switching * period / (first[1] * first[0]) - 1), 0.06, f"{spot}: {which}: {period}")
            test.assertTrue(0.98 * least <= copper <= 1.25 * least, f"{spot}: {which}: copper {copper}")
            test.assertTrue(0 < conduction < 12 * 1.0, f"{spot}: {which}: less than a volt in the bridge")
            test.assertTrue(0 < capacitor <= 12, f"{spot}: {which}")
            test.assertLess(ripple, 0.4, f"{spot}: {which}")
        test.assertEqual(sorted(row[2] for row in rows), [row[2] for row in rows], f"{spot}: {which}: ripple grows with the period")


def judge_best_pwm(test, spot):
    """Each figure of the optimum is within its limit, and each key is within its range. The figure that limits the
    optimum is at its limit."""
    limited = re.search(r"limited by ([^(]*?) \(", spot.text).group(1)
    for name, value, asked in re.findall(r"^  (\S.*?) {2,}(\S+ ?(?:\S+ ?)*?)(?:  (at most .*|in .*))?$", spot.text, re.M):
        if asked.startswith("at most"):
            x, bound = quantity(value)[0], quantity(asked.removeprefix("at most "))[0]
            test.assertLessEqual(x, bound, f"{spot}: {name}")
            if name == limited:
                test.assertLess(bound - x, 0.02 * bound, f"{spot}: {name} is told to be the limit")
        if asked.startswith("in "):
            low, high = (quantity(end)[0] for end in asked.removeprefix("in ").split(" .. "))
            test.assertTrue(low <= quantity(value)[0] <= high, f"{spot}: {name}")
    told = dict(re.findall(r"--set (\S+?)=(\S+)", spot.text))
    for key, value in told.items():
        shown = quantity(re.search(rf"^  {re.escape(key)} +(\S+ \S+)", spot.text, re.M).group(1))
        test.assertLessEqual(abs(shown[0] - float(value)), shown[2] * 1.01, f"{spot}: {key}")
