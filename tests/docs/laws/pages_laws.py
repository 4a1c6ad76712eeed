# SPDX-License-Identifier: Apache-2.0
"""Which law judges which block. A block is found by its page and a piece of its text or heading."""
import re

from laws import bench, contest, curve, design, drives, run_output, series, tables
from page import REPOSITORY

# What a reader writes or runs is no result.
INPUT = {"run", "write", "file", "shell", "chip", "host", "scenario", "programs", "trips", "exported", "export", "example", "blocks"}

TEST_NAMED = re.compile(r"`(\w+)\.\*`|`(tests/[\w/*.]+|\w+_test\.cpp|\w+_tests|\w+_test\.py)`")


def measured_by_a_test(test, spot):
    """The table repeats what named tests hold, each by a law of its own: those tests are there."""
    named = [group for m in TEST_NAMED.finditer(section_of(spot)) for group in m.groups() if group]
    test.assertTrue(named, f"{spot}: names no test that measures it")
    for name in named:
        if "/" in name:
            found = list(REPOSITORY.glob(name.rstrip("/")))
        elif name.endswith(("_test.cpp", "_test.py")):
            found = list((REPOSITORY / "tests").rglob(name))
        elif name.endswith("_tests"):
            found = (REPOSITORY / "tests" / name.removesuffix("_tests")).is_dir()
        else:
            found = any(f"TEST({name}," in f.read_text(encoding="utf-8") for f in (REPOSITORY / "tests").rglob("*_test.cpp"))
        test.assertTrue(found, f"{spot}: {name} is no test")


def section_of(spot):
    """The text between the block's heading and the next one of any level."""
    page = (REPOSITORY / spot.page).read_text(encoding="utf-8")
    start = page.index(f"# {spot.heading}\n")
    end = re.search(r"\n#+ ", page[start:])
    return page[start:start + end.start() if end else len(page)]


def definition(test, spot):
    """Names, ranges, commands and formulas: no number in it is a result."""
    test.assertNotRegex(spot.text, r"\d+ experiments?:", str(spot))


def default_in_range(test, spot):
    """Of a table of keys: a number that stands in for what is not given lies in the key's own range."""
    if "default" not in spot.head():
        return
    range_at, default_at = spot.head().index("value"), spot.head().index("default")
    for cells in spot.rows():
        if len(cells) <= max(range_at, default_at):
            continue
        m = re.match(r"^`?(-?[\d.]+(?:e[-+]?\d+)?)`?$", cells[default_at])
        if not m:
            continue
        x, asked = float(m.group(1)), cells[range_at]
        for words, holds in ((r"above (-?[\d.e+-]+)", lambda a: x > a), (r"at least (-?[\d.e+-]+)", lambda a: x >= a),
                             (r"at most (-?[\d.e+-]+)", lambda a: x <= a), (r"below (-?[\d.e+-]+)", lambda a: x < a)):
            bound = re.search(words, asked)
            if bound:
                test.assertTrue(holds(float(bound.group(1).rstrip("."))), f"{spot}: {cells}")


def message(test, spot):
    """A message repeats what was given, or what is allowed: no result."""
    test.assertNotRegex(spot.text, r"\d+ experiments?:|at worst", str(spot))


def motor_check(test, spot):
    """Each relation's deviation is that of its two sides, and its verdict that of what is tolerated."""
    rows = re.findall(r"^  (ok|BROKEN|known) +(\S.*?) {2,}(\S.*?) {2,}([\d.]+) +([\d.]+) .*? ([-+][\d.]+) % +([-+][\d.]+) +([-+][\d.]+) %", spot.text, re.M)
    for verdict, name, _, computed, printed, told, low, high in rows:
        deviation = 100 * (float(computed) / float(printed) - 1)
        test.assertLess(abs(deviation - float(told)), 0.12, f"{spot}: {name}")
        inside = float(low) <= float(told) <= float(high)
        test.assertEqual(verdict == "ok", inside, f"{spot}: {name}")
    model = dict(re.findall(r"^  (R_s|L_s|K_e|K_t|J|tau_e|tau_m|I_st) +([\d.]+) ", spot.text, re.M))
    x = {name: float(text) for name, text in model.items()}
    if {"R_s", "L_s", "tau_e", "tau_m", "J", "K_t"} <= set(x):
        curve.same(test, spot, "tau_e", x["tau_e"], x["L_s"] / x["R_s"], 1e-3)
        curve.same(test, spot, "tau_m", x["tau_m"], 2 * x["R_s"] * x["J"] * 1e-7 / (x["K_t"] * 1e-3)**2 * 1e3, 1e-3)
    test.assertTrue(rows or model or "hold" in spot.text, str(spot))


def capacitor_store(test, spot):
    """The least sum of the page's own table of that plan, and as many runs as it has that pass."""
    table = (REPOSITORY / spot.page).read_text(encoding="utf-8")
    rows = re.findall(r"^ +\d+ +[\d.]+ us +(\w+) +[\d.]+ [nu]s +(.*?) +ok$", table, re.M)
    for chopping, least, runs in re.findall(r"│ (\w+) +│ ([\d.]+) +│ (\d+) ", spot.text):
        sums = [sum(float(x) for x in re.findall(r"([\d.]+) W", cells)[:2]) for name, cells in rows if name == chopping]
        test.assertEqual(int(runs), len(sums), str(spot))
        test.assertLess(abs(min(sums) - float(least)), 0.006, f"{spot}: {chopping}")


def counted(test, spot):
    for part, whole in re.findall(r"(\d+) of (\d+)", spot.text):
        test.assertLessEqual(int(part), int(whole), str(spot))


def rotor_angles(test, spot):
    m = re.search(r"(\d+) rotor angles: north right in all, (\d+) beyond an edge of its sector, worst angle off by ([\d.]+) degrees", spot.text)
    test.assertTrue(int(m.group(2)) < int(m.group(1)) and float(m.group(3)) < 30, str(spot))


def bode(test, spot):
    """The linear loop holds its voltage over the period; a pulse that ends sooner decays from its end on: lower by that at every line."""
    from math import exp, log10
    from gallery_sheet import L, R, T, U
    rows = re.findall(r"^ +([\d.]+) +(-?[\d.]+) +(-?[\d.]+) +[\d.]+ +(-?[\d.]+) +(-?[\d.]+)$", spot.text, re.M)
    test.assertTrue(rows)
    d, x = 5 * R / U, R * T / L
    for _, measured, phase, designed, by_design in rows:
        by_hand = 20 * log10(exp(-(1 - d) * x) * x / (1 - exp(-x)))
        test.assertLess(abs(float(measured) - float(designed) - by_hand), 0.03, str(spot))
        test.assertLess(abs(float(phase) - float(by_design)), 1, str(spot))


def session(test, spot):
    """Duty and torque: the speed rises, at most by K_t U/R/J."""
    times, speeds = zip(*((float(t), float(w)) for t, w in re.findall(r"^([\d.]+) ms: ([\d.]+) rad/s", spot.text, re.M)))
    from gallery_sheet import J, K_T, STALL
    test.assertLess(speeds[1] - speeds[0], K_T * STALL / J * 1e-3 * (times[1] - times[0]), str(spot))
    test.assertGreater(speeds[1], speeds[0])


def rows_at_the_leader(test, spot):
    """Reading and storing a row is what limits the rows a second that the page promises."""
    times = [float(cells[1].split()[0]) for cells in spot.rows()]
    page = (REPOSITORY / spot.page).read_text(encoding="utf-8")
    test.assertIn(f"make {times[0] + times[1]:.1f} us", page)
    promised = float(re.search(r"with (\d+) 000 rows a second", page).group(1)) * 1e3
    test.assertLess(promised, 1e6 / (times[0] + times[1]), str(spot))
    letters = float(spot.rows()[0][2])
    test.assertLess(abs(promised * letters * 1e-6 - float(re.search(r"are (\d+) MB/s", page).group(1))), 1, str(spot))


BY_TEXT = [
    ("docs/firmware.md", "kHz pulses", drives.bring_up_avr), ("docs/control.md", "least that flows", drives.beyond_the_bus),
    ("docs/motors.md", "| oz-in-s2", drives.trade_units), ("docs/firmware.md", "| | do | measure |", drives.bring_up), ("docs/cluster.md", "| for each row |", rows_at_the_leader),
    ("docs/curve.md", "rpm ", curve.judge), ("docs/manual/faq.md", "rpm ", curve.judge),
    ("docs/manual", "drives, seed", series.judge_drives),
    ("docs/many-runs.md", "verdict", series.judge_plan), ("docs/many-runs.md", "limited by", series.judge_best_pwm),
    ("docs/many-runs.md", "least_W", capacitor_store), ("docs/manual/control.md", "$ sixstep compare", contest.judge),
    ("docs/bench.md", "Constant  ", bench.emf), ("docs/bench.md", "CONTRADICTS", bench.held_against),
    ("docs/bench.md", "cut off, 1 - c", bench.clipped),
    ("docs/bench.md", "hysteresis  ", bench.identify), ("docs/commissioning.md", "off by     bound", bench.commission_sheet),
    ("docs/commissioning.md", "psi ", bench.commission_constants), ("docs/commissioning.md", "worst edge off", bench.hall_places),
    ("docs/commissioning.md", "rotor angles", rotor_angles), ("docs/wiring.md", "theory   speed", tables.wiring),
    ("docs/control.md", "at the first try, up to speed", drives.starts), ("docs/control.md", "duty from 10 to 100 %", drives.throttle),
    ("docs/control.md", "lost once in", counted), ("docs/bode.md", "coherence  designed", bode),
    ("README.md", "case      ", tables.reference),
    ("README.md", "| case |", tables.speed_in_short), ("docs/performance.md", "| observer |", tables.observers),
    ("docs/performance.md", "| case | kernel |", tables.speed), ("docs/performance.md", "| case |", tables.growth), ("docs/performance.md", "| part |", tables.shares),
    ("docs/trust.md", "| accepted |", tables.trust), ("docs/trust.md", "| law |", tables.trust),
    ("docs/cluster.md", "| ranks |", tables.cluster_measured), ("docs/cluster.md", "| a run |", tables.cluster_limits),
    ("docs/firmware.md", "| digests |", tables.digests), ("docs/firmware.md", "| function |", tables.block_costs),
    ("docs/firmware.md", "| core | arithmetic |", tables.drive_costs), ("docs/own-controller.md", "core        step", tables.own_cost),
    ("docs/firmware.md", "less the simulation", drives.laid_over), ("docs/session.md", "the same bits again", session),
    ("docs/manual/position.md", "known by", tables.position), ("docs/motors.md", "$ sixstep motor list", tables.motor_list),
    ("docs/motors.md", "  Relation ", motor_check), ("docs/manual/tour.md", "  Relation ", motor_check),
    ("docs/manual/faq.md", "motor show kv.toml | grep K_t", drives.kv), ("docs/manual/faq.md", "torque_constant_Nm_A = 0.42", drives.frames),
    ("docs/manual/faq.md", "braking, soft", drives.braking), ("docs/manual/faq.md", '"device"', drives.devices),
    ("docs/manual/tour.md", "held as", drives.exported), ("docs/manual/faq.md", "cases match", counted),
    ("docs/manual/tour.md", "settles to", design.judge), ("docs/manual/faq.md", "Fastest settling", design.judge),
    ("docs/design.md", "", design.judge),
    ("docs/scenario.md", "| key |", default_in_range),
]
# Messages of the program, which repeat what was given or what is allowed.
MESSAGES = [("docs/manual/tour.md", "tells the drive currents"), ("docs/bench.md", "short.csv: "),
            ("docs/manual/faq.md", "coil.toml:4"), ("docs/manual/faq.md", "motor show kv.toml | grep pole"), ("docs/motors.md", "mine.toml"),
            ("docs/manual/tour.md", "dampng"), ("docs/manual/tour.md", "relations hold"), ("docs/manual/tour.md", "line_"), ("docs/manual/tour.md", "help control.current.damping"),
            ("docs/manual/faq.md", "'mean current  '"), ("docs/manual/tour.md", "hot-plug.toml | head"),
            ("docs/manual/faq.md", "grep ripple")]
# Pages and tables that define: names, formulas, commands, exit codes, and pages of code.
DEFINES = {"docs/architecture.md", "docs/model.md", "docs/notation.md", "docs/figures.md", "docs/results.md", "docs/command-line.md",
           "docs/contributing.md", "docs/scenario.md"}
DEFINING = [("README.md", "| task |"), ("docs/glossary.md", "| term |"),
            ("docs/bench.md", "| column |"), ("docs/bode.md", "| what stands there |"), ("docs/commissioning.md", "| phase |"),
            ("docs/curve.md", "| row |"), ("docs/curve.md", "| column |"), ("docs/control.md", "| limit |"), ("docs/control.md", "| what | exit code |"),
            ("docs/control.md", "| law | what it is |"), ("docs/control.md", "| pattern | chopped is |"), ("docs/control.md", "| chopped is |"),
            ("docs/control.md", "| angle"), ("docs/control.md", "| header |"), ("docs/control.md", "| for |"), ("docs/control.md", "| at rest |"),
            ("docs/firmware.md", "| core | compiler |"), ("docs/firmware.md", "| the scenario says |"), ("docs/firmware.md", "# How main.c"),
            ("docs/firmware.md", "| what | STM32F303 |"), ("docs/firmware.md", "--uart board.csv"), ("docs/cluster.md", "./test --mpi"),
            ("docs/cluster.md", "| | |"), ("docs/motors.md", "| key |"), ("docs/motors.md", "| relation |"), ("docs/many-runs.md", "| key of a plan |"),
            ("docs/many-runs.md", "title = "), ("docs/many-runs.md", "minimise = "), ("docs/many-runs.md", "sixstep run data/scenarios"),
            ("docs/session.md", "| change |"), ("docs/session.md", "| refused change |"), ("docs/wiring.md", "| in a cell |"), ("docs/manual/control.md", "| column |"),
            ("docs/manual/position.md", "| you need |"), ("docs/own-controller.md", "$ "), ("docs/own-controller.md", "| it |"), ("docs/firmware.md", "| log of |")]
# Tables whose every row a named test measures and holds to a law of its own.
HELD_BY_TESTS = [("docs/control.md", "| result |"), ("docs/control.md", "| experiment |"), ("docs/control.md", "| board |"),
                 ("docs/control.md", "| loop | told |"), ("docs/control.md", "| pattern | free phase"),
                 ("docs/control.md", "| law | a step")]


NO_RESULTS = (definition, message, measured_by_a_test, default_in_range)


def first_of(rows, spot):
    return next((row for row in rows if spot.page.startswith(row[0]) and row[1] in spot.text), None)


def law_of(spot):
    if spot.kind in INPUT:
        return None
    if row := first_of(BY_TEXT, spot):
        return row[2]
    if run_output.judges(spot):
        return None
    if spot.page in DEFINES or first_of(DEFINING, spot):
        return definition
    if first_of(MESSAGES, spot):
        return message
    if first_of(HELD_BY_TESTS, spot):
        return measured_by_a_test
    return None
