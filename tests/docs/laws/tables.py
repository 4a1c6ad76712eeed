# SPDX-License-Identifier: Apache-2.0
"""Laws of tables that are not the output of one run: counts, speeds, costs, motors."""
import re
import sys
from math import pi

from gallery_sheet import B, R
from laws.quantities import quantity
from laws.scenarios import motor, terminal_ohm, value
from page import REPOSITORY

sys.path.insert(0, str(REPOSITORY / "tools"))
import performance  # noqa: E402

ORDER = ["duty", "hysteresis", "current", "speed", "position", "product"]


def drive_costs(test, spot):
    """A position loop contains a speed loop, a speed loop contains a current loop, and a current loop contains a duty
    drive. No loop costs less than the loops it contains. The cost of 99.9 % of the calls is at most the worst cost."""
    head = spot.head()
    for cells in spot.rows():
        row = dict(zip(head, cells))
        chain = [row[name] for name in ORDER if name in row and name != "hysteresis" and row[name]]
        numbers = [[int(x) for x in re.findall(r"\d+", cell)] for cell in chain]
        if "+" not in chain[0]:
            for pair in numbers:
                test.assertEqual(pair, sorted(pair), f"{spot}: {cells}")
        for inner, outer in zip(numbers, numbers[1:]):
            test.assertLessEqual(inner[0], outer[0] * 1.002, f"{spot}: {cells}")
            test.assertGreater(inner[0], 0)


def block_costs(test, spot):
    """A Cortex-M0 lacks instructions of a Cortex-M3, so no block costs less on it. A Cortex-M4 executes all
    instructions of the M3. A block in 32 bits costs at least as much as in 16 bits, unless its cost is independent of
    the format."""
    head = spot.head()
    test.assertGreater(len(spot.rows()), 50)
    for cells in spot.rows():
        row = dict(zip(head, cells))
        cost = {name: int(row[name]) for name in head[2:] if row.get(name, "").isdigit()}
        m0, m3, m4 = cost.get("Cortex-M0 q15"), cost.get("Cortex-M3 q15"), cost.get("Cortex-M4F q15")
        if m0 and m3:
            test.assertGreaterEqual(m0 * 1.03 + 2, m3, f"{spot}: {cells}")
        if m3 and m4:
            test.assertLess(abs(m3 - m4), 0.05 * m3 + 4, f"{spot}: {cells}")
        if m3 and "Cortex-M3 q31" in cost:
            test.assertGreaterEqual(cost["Cortex-M3 q31"] * 1.1 + 4, m3, f"{spot}: {cells}")
        test.assertTrue(all(0 < x < 1_000_000 for x in cost.values()), f"{spot}: {cells}")


def digests(test, spot):
    """The numbers of digests are equal to those in the table of the target test."""
    stored = (REPOSITORY / "tests/target/digests.txt").read_text(encoding="utf-8")
    for arithmetic, count in spot.rows():
        lines = [line for line in stored.splitlines() if re.search(rf"\b{arithmetic}\b", line) and not line.startswith("#")]
        test.assertEqual(int(count), len(lines), f"{spot}: {arithmetic}")


def speed(test, spot):
    """The simulated seconds per second are 30 us divided by the time for 30 us. A user's run takes at least as long
    as the engine alone. With a tenth of the step, a run takes ten times as long."""
    alone = {}
    for cells in spot.rows():
        name, kernel, ns, per_s = cells[0], cells[1], float(cells[2]), float(cells[3])
        test.assertLess(abs(30e3 / ns - per_s), 0.6 + 0.6 * per_s / ns, f"{spot}: {cells}")
        base = name.split(", as a user")[0]
        if base == name:
            alone[base, kernel] = ns
        else:
            test.assertGreater(ns, alone[base, kernel], f"{spot}: {cells}")
        for coarse, fine in ((5, 6), (7, 8)):
            if cells[coarse]:
                times = [float(cells[n].split("x")[0]) for n in (coarse, fine)]
                test.assertTrue(9 < times[1] / times[0] < 11, f"{spot}: {cells}")
                errors = [float(e) for n in (coarse, fine) for e in re.findall(r"([\d.]+) %", cells[n])]
                test.assertEqual(errors, sorted(errors, reverse=True), f"{spot}: {cells}: a smaller step is no worse")
    test.assertTrue(all(alone[base, "general"] > ns for (base, kernel), ns in alone.items() if kernel == "lean" and (base, "general") in alone))


def speed_in_short(test, spot):
    """Each number is equal to the number in the complete table."""
    whole = performance.written_rows((REPOSITORY / performance.PLACES["speed"]).read_text(encoding="utf-8"), "speed")
    test.assertEqual(performance.short_table(whole), [spot.head(), *spot.rows()], str(spot))


def observers(test, spot):
    rows = spot.rows()
    none = [float(rows[0][n]) for n in (1, 3)]
    for cells in rows[1:]:
        for n, base in ((1, none[0]), (3, none[1])):
            more = 100 * (float(cells[n]) / base - 1)
            test.assertGreater(more, 0, f"{spot}: {cells}")
            told = float(cells[n + 1].removesuffix(" %"))
            test.assertLess(abs(more - told), 0.6 + (100 + told) * 0.6 / base, f"{spot}: {cells}")


def growth(test, spot):
    for cells in spot.rows():
        one, ten = float(cells[1]), float(cells[2])
        test.assertLess(abs(10 * ten / one - float(cells[3].removesuffix("x"))), 0.15, f"{spot}: {cells}")


def shares(test, spot):
    for n in (1, 2):
        total = sum(float(cells[n].removesuffix(" %")) for cells in spot.rows())
        test.assertLess(abs(total - 100), 2.5, f"{spot}: {total} % in all")


def reference(test, spot):
    """The largest differences from float128 are small: a double sums up its rounding errors over some thousand
    segments. A page may omit rows."""
    rows = re.findall(r"^(R\w+|G\w+) .*? (\d+) +(\S+) +(\S+) +(\S+)(?: +(\S+))?$", spot.text, re.M)
    told = int(re.search(r"(\d+) of (\d+) cases match", spot.text).group(2))
    (test.assertLess if "\n...\n" in spot.text else test.assertEqual)(len(rows), told, f"{spot}: rows and cases")
    test.assertGreater(len(rows), 3, str(spot))
    for row in rows:
        for x in row[2:]:
            test.assertLessEqual(float(x or 0), 1e-12, f"{spot}: {row}")
    words = {"Twenty-two": 22, "Twenty-three": 23, "Twenty-four": 24, "Twenty-seven": 27}
    for word, count in words.items():
        if f"{word} trajectories" in (REPOSITORY / spot.page).read_text(encoding="utf-8"):
            test.assertEqual(count, told, f"{spot}: the page says {word}")


def motor_list(test, spot):
    """p, U, R_tt, K_t and J of each motor agree with the motor's file."""
    rows = [line for line in spot.text.splitlines() if re.match(r"^[a-z0-9-]+ +(\d+|-) ", line)]
    test.assertGreaterEqual(len(rows), len(list((REPOSITORY / "data/motors").glob("*.toml"))), "a row for each motor")
    for line in rows:
        name, pairs, volts, ohms, constant, inertia = line.split()[:6]
        sheet = motor(name)
        if "pole_pairs" in sheet:
            test.assertEqual(str(value(sheet["pole_pairs"])), pairs, line)
        if "nominal_voltage_V" in sheet:
            test.assertEqual(float(value(sheet["nominal_voltage_V"])), float(volts), line)
        if "resistance_ohm" in sheet:
            R = terminal_ohm(sheet)
            test.assertTrue(ohms == "-" or abs(float(ohms) - R) < 1e-3 * R, line)
        for x, least, most in ((ohms, 1e-3, 100), (constant, 1, 1e3), (inertia, 1e-2, 1e6)):
            if x != "-" and name != "example-linear":
                test.assertTrue(least <= float(x) <= most, line)
        if constant not in ("-", "linear") and volts != "-" and name != "example-linear" and "no_load_speed_rpm" in sheet:
            # An ideal motor turns at U/K_t. The printed no-load speed differs from this speed by at most a fifth.
            rpm = float(volts) / float(constant) * 1e3 * 9.5493
            test.assertTrue(0.8 < value(sheet["no_load_speed_rpm"]) / rpm < 1.2, line)


def position(test, spot):
    """No rms value is larger than its worst value. No error of a sensor at its correct place is larger than half a
    sector."""
    for cells in spot.rows():
        for cell in cells[1:8]:
            if cell != "-":
                rms, worst = (float(x) for x in cell.split(","))
                test.assertTrue(0 <= rms <= worst <= 30, f"{spot}: {cells}")
        test.assertTrue(0 < float(cells[9].split()[0]) < 20, f"{spot}: {cells}")
        m0, m4 = ([int(x) for x in cells[11].split(", ")] + [0, 0])[:2] if cells[11] != "-" else (1, 0)
        test.assertGreater(m0, m4, f"{spot}: {cells}")


def trust(test, spot):
    """The accepted and the refused scenarios together are all drawn scenarios. The error of each law is at most the
    allowed error."""
    page = (REPOSITORY / spot.page).read_text(encoding="utf-8")
    section = page[page.index(f"### {spot.heading}"):]
    drawn, accepted, refused = map(int, re.search(r"^(\d+) .*?: (\d+) accepted, (\d+) refused with words, 0 laws broken", section, re.M).groups())
    test.assertEqual(drawn, accepted + refused)
    if "accepted" in spot.head():
        if spot.heading == "valid":  # each drawn scenario is of one kind
            test.assertEqual([accepted, refused], [sum(int(c[n]) for c in spot.rows()) for n in (1, 2)], str(spot))
        else:  # one text may have several kinds of damage
            for cells in spot.rows():
                test.assertTrue(int(cells[1]) <= accepted and int(cells[2]) <= refused, f"{spot}: {cells}")
    else:
        for cells in spot.rows():
            test.assertLessEqual(float(cells[1]), 1.0, f"{spot}: {cells}")
    ended = [int(n) for n in re.findall(r"(\d+) (?:cut|stopped by a fault|to its end|tripped)", section[section.index("Accepted runs ended"):].split("\n")[0])]
    test.assertEqual(accepted, sum(ended), f"{spot}: accepted runs ended")


def cluster_measured(test, spot):
    for _, ranks, runs, wall, per_run, of_each in spot.rows():
        total = sum(float(x) for x in of_each.split(","))
        test.assertEqual(int(ranks), len(of_each.split(",")), f"{spot}")
        test.assertLess(abs(total - int(runs) * float(per_run) * 1e-6), 0.03 * total, f"{spot}: CPU of all ranks")
        test.assertLess(max(float(x) for x in of_each.split(",")), float(wall), f"{spot}: a rank has one thread")


def cluster_limits(test, spot):
    for cells in spot.rows():
        run = quantity(re.match(r"[\d.]+ m?s", cells[0]).group(0))[0]
        unit = {"min": 60, "h": 3600, "days": 86400, "s": 1}
        amount, name = cells[1].split()
        test.assertLess(abs(float(amount) * unit[name] - 1e6 * run), 0.07 * 1e6 * run, f"{spot}: {cells}")
        m = re.match(r"([\d.]+) (s|min)", cells[2])
        test.assertLess(abs(float(m.group(1)) * unit[m.group(2)] - 1e6 * run / 6400), 0.17 * 1e6 * run / 6400, f"{spot}: {cells}")


def own_cost(test, spot):
    rows = [line.split() for line in spot.text.splitlines() if re.match(r"^(Cortex|RV32|ATmega)", line)]
    test.assertEqual(5, len(rows))
    for cells in rows:
        step, worst, hall, hall_worst, flash, ram = map(int, cells[1:])
        test.assertTrue(step <= worst and hall <= hall_worst and 0 < flash < 65536 and 0 < ram < 8192, f"{spot}: {cells}")
    by_name = {cells[0]: int(cells[1]) for cells in rows}
    test.assertLess(by_name["Cortex-M4F"], by_name["Cortex-M3"])
    test.assertLess(by_name["Cortex-M3"], by_name["Cortex-M0"])


def wiring(test, spot):
    """Torque per ampere by symmetry. A mirrored wiring has the opposite sign, and a shift of 60 degrees leaves half
    of the torque. The groups have 3, 3, 12 and 18 wirings."""
    rows = {m[0]: m for m in re.findall(r"^  (FORWARD|BACKWARD|hums|(?:forward|backward), (?:early|late)) +(\d+) +(-?\d+) % +(-?\d+) % +(\S+)", spot.text, re.M)}
    test.assertEqual(36, sum(int(m[1]) for m in rows.values()), str(spot))
    for name, m in rows.items():
        test.assertLessEqual(abs(int(m[2]) - int(m[3])), 1, f"{spot}: {name}")
    for one, other in (("FORWARD", "BACKWARD"), ("forward, early", "backward, early"), ("forward, late", "backward, late")):
        test.assertEqual(rows[one][2], str(-int(rows[other][2])), str(spot))
        test.assertEqual(rows[one][4], rows[other][4].removeprefix("-"), f"{spot}: {one}")
    drawn = (REPOSITORY / "docs/images/wiring.svg").read_text(encoding="utf-8")
    cells = {times for times in re.findall(r">×([\d.]+)<", drawn)}
    told = set(re.findall(r"([\d.]+) times the current", spot.text))
    test.assertEqual(cells, told, f"{spot}: a picture's cells say what the table says")
    run = re.search(r"^  FORWARD .* % +(\d+) rpm +([\d.]+) mA +\S+ A +([\d.]+) mA", spot.text, re.M)
    speed, phase, supply = float(run[1]) * pi / 30, 1e-3 * float(run[2]), 1e-3 * float(run[3])
    lost = B * speed**2 + 1.5 * R * phase**2
    test.assertLess(abs(24 * supply - lost), 0.01 * lost, f"{spot}: what settles takes from its supply what it loses")
    stalled, full = map(float, re.search(r"stalled motor draws ([\d.]+) A, .*?, at full duty ([\d.]+) A", spot.text).groups())
    test.assertLess(abs(24 / 1.03 - full), 0.05)
    test.assertLess(abs(stalled / full - 0.1), 0.002, "duty 0.1")
    for peak in re.findall(r" ([\d.]+) A +[\d.]+ m?A  ", spot.text):
        test.assertLessEqual(float(peak), 2 * stalled, str(spot))
