# SPDX-License-Identifier: Apache-2.0
"""Laws of the comparison of controllers: bounds of the figures for this motor, sums, and that the worst drive is not
better than the nominal drive."""
import re

from laws.quantities import quantity
from laws.scenarios import motor, terminal_ohm

CELL = re.compile(r" {2,}")
MORE_IS_WORSE = {"settles", "overshoot", "peak", "load error", "load settles", "brake peak", "slow swing", "ripple rms", "ripple p-p", "dip",
                 "THD", "copper", "bridge", "losses", "turn-ons", "slow ripple"}


def tables(text):
    """(worst, {controller: {column: cell}}) for each table. worst: true if the table is below the heading "Worst of"."""
    worst, rows, columns = False, None, None
    for line in text.splitlines():
        if line.startswith("Worst of"):
            worst = True
        cells = CELL.split(line.strip())
        if cells[0] == "controller":
            columns, rows = cells[1:], {}
        elif rows is not None and len(cells) == len(columns) + 1 and line.startswith("  "):
            rows[cells[0]] = dict(zip(columns, cells[1:]))
        elif rows:
            yield worst, rows
            rows = columns = None


def number(cell):
    found = quantity(cell.removesuffix(" *"))
    return found and found[0]


def judge(test, spot):
    name = re.search(r"sixstep compare (\S+)", spot.text).group(1)
    sheet = motor(name)
    supply = float(re.search(r"one bus, ([\d.]+) V", spot.text).group(1))
    R = terminal_ohm(sheet)
    period = quantity(re.search(r"one PWM period, ([\d.]+ \w+)", spot.text).group(1))[0]
    speed = float(re.search(r"one high speed, ([\d.]+) rad/s", spot.text).group(1))
    drives = int((re.search(r"Worst of the nominal motor and (\d+) drives", spot.text) or [0, 0])[1])
    torque_limit = quantity(re.search(r"one torque limit, ([\d.]+ m?N m)", spot.text).group(1))[0]
    bound = {"peak": 2 * supply / R, "brake peak": 2 * supply / R, "overshoot": speed, "load error": speed, "slow swing": 2 * speed,
             "settles": 5.0, "load settles": 5.0, "ripple rms": 2 * torque_limit, "ripple p-p": 4 * torque_limit, "dip": 2 * torque_limit,
             "slow ripple": 2 * torque_limit, "THD": 2.0, "turn-ons": 1.02 / period, "copper": supply**2 / R, "bridge": supply**2 / R,
             "losses": supply**2 / R, "lowest": speed}
    nominal, of_worst = {}, {}
    for worst, rows in tables(spot.text):
        for controller, cells in rows.items():
            (of_worst if worst else nominal).setdefault(controller, {}).update(cells)
            for column, cell in cells.items():
                x = number(cell)
                if column in bound and x is not None:
                    test.assertTrue(0 <= x <= bound[column], f"{spot}: {controller}: {column} is {cell}, at most {bound[column]:.4g}")
                if column in bound:
                    test.assertTrue(x is not None or cell.removesuffix(" *") in ("-", "never"), f"{spot}: {controller}: {column} is {cell}")
    test.assertGreater(len(nominal), 10, str(spot))
    for controller, cells in nominal.items():
        total = [number(cells[c]) for c in ("copper", "bridge", "losses")]
        if None not in total:
            test.assertLess(abs(total[0] + total[1] - total[2]), 0.01 * total[2] + 2e-3, f"{spot}: {controller}: losses are the sum")
        if number(cells["ripple rms"]) is not None:
            test.assertLessEqual(2 * number(cells["ripple rms"]), number(cells["ripple p-p"]) * 1.01, f"{spot}: {controller}")
            test.assertLessEqual(number(cells["dip"]), number(cells["ripple p-p"]) * 1.01, f"{spot}: {controller}")
    for controller, cells in of_worst.items():
        hold = re.match(r"(\d+) of (\d+)", cells["hold"])
        test.assertEqual(drives, int(hold.group(2)), f"{spot}: {controller}")
        for column in MORE_IS_WORSE & set(cells):
            a, b = number(nominal[controller][column]), number(cells[column])
            if a is not None and b is not None:
                test.assertGreaterEqual(b * 1.006, a, f"{spot}: {controller}: the worst {column} is better than the nominal one")
    if of_worst:
        test.assertEqual(set(nominal), set(of_worst), str(spot))
        # A drive with a wide nominal margin passes with a part of its tolerances.
        test.assertTrue(any(not cells["hold"].startswith("0 of") for cells in of_worst.values()), f"{spot}: not one drive of any controller holds")
    sentences(test, spot, nominal)


def sentences(test, spot, nominal):
    """A sentence such as "(6.82 A; the next controller: 6 % more)": the number is in the table, in the row of the same
    controller."""
    text = re.sub(r"\s+", " ", spot.text[spot.text.rfind("* least value of"):])
    for controller in nominal:
        m = re.search(rf"{re.escape(controller)} has these least values: (.*?)\. ", text)
        for told in re.findall(r"\(([\d.]+ [^;]+); the\s+next\s+controller", m.group(1)) if m else ():
            cells = [c.removesuffix(" *") for c in nominal[controller].values()]
            test.assertIn(told, cells, f"{spot}: {controller}")
