# SPDX-License-Identifier: Apache-2.0
"""The law of each block. A block is found by its page and a part of its text or heading."""
import re

from laws import (bench, capacitor, commutation, contest, curve, design, drives, firmware, recordings, run_output, series, sheets,
                  shunts, tables)
from page import REPOSITORY

# Blocks with a reader's input contain no results.
INPUT = {"run", "c", "write", "file", "chip", "host", "programs", "python"}

TEST_NAMED = re.compile(r"`(\w+)\.\*`|`(tests/[\w/*.]+|\w+_test\.cpp|\w+_tests|\w+_test\.py)`")


def measured_by_a_test(test, spot):
    """The table repeats results that named tests check. These tests must exist."""
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
    """The text from the block's heading to the next heading of any level."""
    page = (REPOSITORY / spot.page).read_text(encoding="utf-8")
    start = page.index(f"# {spot.heading}\n")
    end = re.search(r"\n#+ ", page[start:])
    return page[start:start + end.start() if end else len(page)]


def definition(test, spot):
    """Names, ranges, commands and formulas: none of the numbers is a result."""
    test.assertNotRegex(spot.text, r"\d+ experiments?:", str(spot))


def default_in_range(test, spot):
    """In a table of keys, each default that is a number is within the range of its key."""
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
    """A message repeats the user's input, or the allowed values: none of its numbers is a result."""
    test.assertNotRegex(spot.text, r"\d+ experiments?:|at worst", str(spot))


def motor_check(test, spot):
    """Each deviation follows from the two sides of the relation. Each verdict follows from the deviation and its
    tolerance."""
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
    """The smallest sum, and the number of passing runs, agree with the table of this plan on its page."""
    table = (REPOSITORY / "docs/reference/plan-file.md").read_text(encoding="utf-8")
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
    """The linear model holds the voltage for the whole period. The current of a shorter pulse decays from the pulse's
    end on. Thus the measured gain is smaller by the same amount at every frequency."""
    from math import exp, log10
    from gallery_sheet import L, R, T, U
    rows = re.findall(r"^ +([\d.]+) +(-?[\d.]+) +(-?[\d.]+) +[\d.]+ +(-?[\d.]+) +(-?[\d.]+)$", spot.text, re.M)
    test.assertTrue(rows)
    d, x = 5 * R / U, R * T / L
    for _, measured, phase, designed, by_design in rows:
        by_hand = 20 * log10(exp(-(1 - d) * x) * x / (1 - exp(-x)))
        test.assertLess(abs(float(measured) - float(designed) - by_hand), 0.03, str(spot))
        test.assertLess(abs(float(phase) - float(by_design)), 1, str(spot))


def bode_of_a_locked_rotor(test, spot):
    """With a locked rotor the measured loop agrees with the designed loop within 3 %."""
    rows = re.findall(r"^ +(crossover|phase margin) +([\d.]+) \w+ +([\d.]+) \w+$", spot.text, re.M)
    test.assertEqual(len(rows), 2, str(spot))
    for name, measured, designed in rows:
        test.assertLess(abs(float(measured) / float(designed) - 1), 0.03, f"{spot}: {name}")


def session(test, spot):
    """With duty and a load torque the speed rises by at most K_t U/R/J per second."""
    times, speeds = zip(*((float(t), float(w)) for t, w in re.findall(r"^([\d.]+) ms: ([\d.]+) rad/s", spot.text, re.M)))
    from gallery_sheet import J, K_T, STALL
    test.assertLess(speeds[1] - speeds[0], K_T * STALL / J * 1e-3 * (times[1] - times[0]), str(spot))
    test.assertGreater(speeds[1], speeds[0])


def held_by_the_supply(test, spot):
    """The pair is at the supply, and then its diodes connect it against the supply. The current consists of two
    exponentials with the time constant L/R."""
    from math import exp
    from gallery_sheet import STALL, TAU
    on, off = (float(x) for x in re.findall(r"^([\d.]+) A$", spot.text, re.M))
    test.assertLess(abs(on - STALL * (1 - exp(-100e-6 / TAU))), 1e-6, str(spot))
    test.assertLess(abs(off - (on + STALL) * exp(-50e-6 / TAU) + STALL), 2e-6, str(spot))


def signals_at_2_ms(test, spot):
    """In a driven pair the sum of the currents is 0. The current loop controls 5 A within a ripple of U T/(4 L)."""
    from gallery_sheet import L, T, U
    a, b, c = (float(x) for x in re.findall(r"^i_._A = (-?[\d.]+) A", spot.text, re.M))
    test.assertLess(abs(a + b + c), 2e-4, str(spot))
    test.assertLess(abs(a - 5), U * T / (4 * L), str(spot))
    test.assertIn("t_s = 0.0020 s", spot.text)


def first_lines(test, spot):
    """A current of 5 A accelerates the rotor by K_t 5 A/J, less friction."""
    from gallery_sheet import J, K_T
    for t, speed, current in re.findall(r"^([\d.]+) ms +([\d.]+) rad/s +([\d.]+) A$", spot.text, re.M):
        most = K_T * 5 / J * 1e-3 * float(t)
        test.assertTrue(0.85 * most < float(speed) < 1.01 * most and abs(float(current) - 5) < 0.4, str(spot))


def costs_of_calls(test, spot):
    """The goals of the C library. One step takes at least as long as its part of a long advance. A load takes longer
    than opening a file, because it also simulates."""
    us = {name.strip(): float(x) for name, x in re.findall(r"^(.*?) +([\d.]+) us$", spot.text, re.M)}
    test.assertLess(us["open a file"], 1000)
    test.assertLess(us["open a file"], us["open the first file"])
    test.assertLess(us["read a value"], 0.05)
    test.assertLess(us["a period of one long advance"], us["advance by a period"])
    test.assertLess(us["copy"], us["open a file"])
    test.assertLess(us["open a file"], us["load"])


def rows_at_the_leader(test, spot):
    """Reading and storing a row takes most of the leader's time. This time limits the number of rows per second,
    which the page states."""
    times = [float(cells[1].split()[0]) for cells in spot.rows()]
    page = (REPOSITORY / spot.page).read_text(encoding="utf-8")
    test.assertIn(f"make {times[0] + times[1]:.1f} us", page)
    promised = float(re.search(r"with (\d+) 000 rows a second", page).group(1)) * 1e3
    test.assertLess(promised, 1e6 / (times[0] + times[1]), str(spot))
    letters = float(spot.rows()[0][2])
    test.assertLess(abs(promised * letters * 1e-6 - float(re.search(r"are (\d+) MB/s", page).group(1))), 1, str(spot))


GUIDE = "docs/howto/measure-a-motor.md"
SHEETS = "docs/explanation/sheets-against-the-model.md"
BY_TEXT = [
    (GUIDE, "K_t, six-step", bench.guide_emf), (GUIDE, "coast.csv: ", bench.guide_coast), (GUIDE, "% of the variance", bench.guide_parameters),
    (GUIDE, "| recording |", bench.guide_table),
    *((SHEETS, f"sheet_points.py {law.__name__}\n", law) for law in (sheets.points, sheets.currents, sheets.power, sheets.fit, sheets.offset,
                                                                     sheets.alternatives, sheets.stall)),
    ("docs/howto/use-the-c-library.md", "read a value", costs_of_calls), ("docs/howto/use-the-c-library.md", "i_b_A = ", signals_at_2_ms),
    ("docs/howto/use-the-c-library.md", "| language |", definition), ("docs/howto/use-the-c-library.md", " rad/s  ", first_lines), ("docs/howto/use-the-c-library.md", "725 A\n", held_by_the_supply),
    ("docs/howto/size-a-capacitor.md", "| worst duty |", capacitor.worst_duty), ("docs/howto/size-a-capacitor.md", "--vary", capacitor.capacitor_current),
    ("docs/howto/size-a-capacitor.md", "braking.toml", capacitor.braking),
    ("docs/howto/find-a-wiring-fault.md", "hall_lines=123,213", drives.crossed_loop), ("docs/howto/flash-an-image.md", "kHz pulses", drives.bring_up_avr), ("docs/reference/field-oriented-drive.md", "least that flows", drives.beyond_the_bus),
    ("docs/howto/take-over-parameters.md", "--from mcconf.xml", drives.taken_over), ("docs/howto/take-over-parameters.md", "--answer resistance=terminal,", drives.answered),
    ("docs/howto/take-over-parameters.md", "--from sketch.ino", drives.asked),
    ("docs/start/your-motor.md", "| oz-in-s2", drives.trade_units), ("docs/howto/flash-an-image.md", "| | do | measure |", drives.bring_up), ("docs/howto/use-a-cluster.md", "| for each row |", rows_at_the_leader),
    ("docs/howto/read-the-curve.md", "rpm ", curve.judge), ("docs/explanation/currents.md", "rpm ", curve.judge),
    ("docs/", "drives, seed", series.judge_drives),
    ("docs/howto/run-many.md", "verdict", series.judge_plan), ("docs/reference/plan-file.md", "verdict", series.judge_plan), ("docs/howto/find-the-best-point.md", "limited by", series.judge_best_pwm),
    ("docs/howto/run-many.md", "least_W", capacitor_store), ("docs/howto/controllers-on-a-", "$ sixstep compare", contest.judge),
    ("docs/howto/fit-a-motor.md", "  fitted  ", bench.fit),
    ("docs/howto/measure-the-back-emf.md", "Constant  ", bench.emf), ("docs/howto/measure-the-back-emf.md", "CONTRADICTS", bench.held_against),
    ("docs/howto/measure-the-back-emf.md", "cut off, 1 - c", bench.clipped),
    ("docs/howto/find-the-hall-order.md", "hysteresis  ", bench.identify), ("docs/howto/commission-a-drive.md", "off by     bound", bench.commission_sheet),
    ("docs/howto/commission-a-drive.md", "psi ", bench.commission_constants), ("docs/howto/commission-a-drive.md", "worst edge off", bench.hall_places),
    ("docs/howto/commission-a-drive.md", "rotor angles", rotor_angles), ("docs/howto/find-a-wiring-fault.md", "theory   speed", tables.wiring),
    ("docs/reference/sensorless-drive.md", "at the first try, up to speed", drives.starts), ("docs/reference/sensorless-drive.md", "duty from 10 to 100 %", drives.throttle),
    ("docs/reference/sensorless-drive.md", "lost once in", counted), ("docs/howto/measure-a-frequency-response.md", "coherence  designed", bode),
    ("docs/howto/measure-a-frequency-response.md", "load.locked=true", bode_of_a_locked_rotor),
    ("README.md", "case      ", tables.reference),
    ("README.md", "| case |", tables.speed_in_short), ("docs/explanation/performance.md", "| observer |", tables.observers),
    ("docs/explanation/performance.md", "| case | kernel |", tables.speed), ("docs/explanation/performance.md", "| case |", tables.growth), ("docs/explanation/performance.md", "| part |", tables.shares),
    ("docs/explanation/drawn-scenarios.md", "| accepted |", tables.trust), ("docs/explanation/drawn-scenarios.md", "| law |", tables.trust),
    ("docs/howto/use-a-cluster.md", "| ranks |", tables.cluster_measured), ("docs/howto/use-a-cluster.md", "| a run |", tables.cluster_limits),
    ("docs/reference/core-bits.md", "| digests |", tables.digests), ("docs/reference/block-costs.md", "| function |", tables.block_costs),
    ("docs/reference/core-costs.md", "| core | arithmetic |", tables.drive_costs), ("docs/howto/write-a-controller.md", "core        step", tables.own_cost),
    ("docs/howto/compare-a-log.md", "minus the simulation", drives.laid_over), ("docs/howto/model-a-load.md", "grep remark", drives.lifted), ("docs/howto/steer-a-run-from-cpp.md", "the same bits again", session),
    ("docs/howto/choose-a-rotor-sensor.md", "known by", tables.position), ("docs/reference/motor-sheets.md", "$ sixstep motor list", tables.motor_list),
    ("docs/reference/motor-sheets.md", "  Relation ", motor_check), ("docs/start/tour.md", "  Relation ", motor_check),
    ("docs/start/sheet-questions.md", "motor show kv.toml | grep K_t", drives.kv), ("docs/start/sheet-questions.md", "torque_constant_Nm_A = 0.42", drives.frames),
    ("docs/explanation/currents.md", "edge before", commutation.judge_edge), ("docs/explanation/currents.md", "spike.toml --set", commutation.judge),
    ("docs/explanation/currents.md", "braking, soft", drives.braking), ("docs/howto/check-heat.md", '"device"', drives.devices),
    ("docs/start/tour-bench-and-chip.md", "held as", drives.exported), ("docs/explanation/accuracy.md", "cases match", counted),
    ("docs/start/tour.md", "settles within", design.judge), ("docs/howto/tune-a-speed-loop.md", "", design.judge), ("docs/howto/choose-pwm.md", "verdict", series.judge_plan), ("docs/howto/choose-pwm.md", "$ ./run design", design.judge),
    ("docs/howto/design-", "", design.judge),
    ("docs/explanation/recordings.md", "recorded   simulated", recordings.verdicts), ("docs/explanation/recordings.md", "within +- ", recordings.verdicts),
    ("docs/explanation/recordings.md", " V left of ", recordings.left_over), ("docs/explanation/recordings.md", "halves thirds", recordings.shares),
    ("docs/explanation/recordings.md", "deg late", recordings.late_edges),
    ("docs/howto/choose-shunts.md", "control periods", shunts.lost), ("docs/howto/choose-shunts.md", "w(m)", shunts.window),
    ("docs/howto/run-a-firmware", "ms throttle", firmware.course), ("docs/reference/keys/", "| key |", default_in_range),
]
# Messages of the program, which repeat the input or the allowed values.
MESSAGES = [("docs/howto/use-the-c-library.md", "must lie in"), ("docs/start/tour-bench-and-chip.md", "gives the drive phase currents"), ("docs/howto/measure-the-back-emf.md", "short.csv: "), ("docs/howto/find-the-hall-order.md", "short.csv: "),
            ("docs/start/sheet-questions.md", "coil.toml:4"), ("docs/start/sheet-questions.md", "motor show kv.toml | grep pole"),
            ("docs/start/tour.md", "dampng"), ("docs/start/tour.md", "relations hold"), ("docs/start/tour.md", "line_"), ("docs/start/tour.md", "help control.current.damping"),
            ("docs/explanation/accuracy.md", "'mean current  '"), ("docs/start/tour-bench-and-chip.md", "hot-plug.toml | head"),
            ("docs/howto/size-a-capacitor.md", "grep ripple")]
# Pages and tables with definitions: names, formulas, commands, exit codes, and pages with code.
DEFINES = ("docs/architecture.md", "docs/contracts.md", "docs/contributing.md", "docs/reference/model", "docs/reference/notation.md",
           "docs/reference/figures.md", "docs/reference/results.md", "docs/reference/command-line.md", "docs/reference/keys/")
DEFINING = [(GUIDE, "| mistake |"), (SHEETS, "| column |"), (SHEETS, "| you need |"), ("README.md", "| task |"), ("docs/explanation/recordings.md", "| scenario |"), ("docs/explanation/recordings.md", "| cause |"), ("docs/howto/export-an-fmu.md", "| file | content |"), ("docs/howto/export-an-fmu.md", "--kind plant"), ("docs/howto/export-an-fmu.md", "| `--inputs` |"),
            ("docs/howto/use-from-octave-and-simulink.md", ""), ("docs/howto/run-a-firmware", "sixstep_status hal_run"), ("docs/howto/run-a-firmware", "static void advance"),
            ("docs/howto/run-a-firmware", "| file in "), ("docs/howto/run-a-firmware", "| function or macro |"), ("docs/reference/glossary.md", "| term |"),
            ("docs/howto/record-a-motor.md", "| column |"), ("docs/howto/measure-a-frequency-response.md", "| what stands there |"), ("docs/howto/commission-a-drive.md", "| phase |"),
            ("docs/howto/read-the-curve.md", "| row |"), ("docs/howto/read-the-curve.md", "| column |"), ("docs/reference/product-drive.md", "| limit |"), ("docs/howto/put-a-controller-on-a-chip.md", "| what | exit code |"),
            ("docs/reference/loops.md", "| law | what it is |"), ("docs/reference/commutation.md", "| pattern | chopped is |"), ("docs/reference/commutation.md", "| chopped is |"),
            ("docs/reference/", "| angle"), ("docs/reference/blocks.md", "| header |"), ("docs/reference/blocks.md", "| for |"), ("docs/reference/", "| at rest |"),
            ("docs/howto/run-on-a-core.md", "| core | compiler |"), ("docs/howto/run-on-a-core.md", "| the scenario says |"), ("docs/howto/run-on-a-core.md", "# How main.c"),
            ("docs/howto/flash-an-image.md", "| what | STM32F303 |"), ("docs/howto/compare-a-log.md", "--uart board.csv"), ("docs/howto/use-a-cluster.md", "./test --mpi"),
            ("docs/howto/use-a-cluster.md", "| | |"), ("docs/start/your-motor.md", "| key |"), ("docs/reference/motor-sheets.md", "| relation |"), ("docs/reference/plan-file.md", "| key of a plan |"),
            ("docs/reference/plan-file.md", "title = "), ("docs/howto/find-the-best-point.md", "minimise = "), ("docs/howto/run-many.md", "sixstep run data/scenarios"),
            ("docs/howto/steer-a-run-from-cpp.md", "| change |"), ("docs/howto/steer-a-run-from-cpp.md", "| refused change |"), ("docs/howto/find-a-wiring-fault.md", "| in a cell |"), ("docs/howto/choose-a-controller.md", "| column |"),
            ("docs/howto/choose-a-rotor-sensor.md", "| you need |"), ("docs/howto/write-a-controller.md", "$ "), ("docs/howto/write-a-controller.md", "| field |"), ("docs/howto/write-a-controller.md", "| the controller |"), ("docs/howto/compare-a-log.md", "| log of |"), ("docs/howto/compare-a-log.md", "| quantity |"),
            ("docs/howto/take-over-parameters.md", "| program |"), ("docs/howto/choose-shunts.md", "| pulses, sample |")]
# Tables whose rows are all checked by a named test with its own law.
HELD_BY_TESTS = [("docs/reference/", "| result |"), ("docs/reference/fixed-point.md", "| experiment |"), ("docs/reference/sensorless-drive.md", "| board |"),
                 ("docs/reference/loops.md", "| loop | told |"), ("docs/reference/commutation.md", "| pattern | begins to"),
                 ("docs/reference/loops.md", "| law | a step"), ("docs/gallery/beliefs.md", "| wrong belief |")]


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
    if spot.page.startswith(DEFINES) or first_of(DEFINING, spot):
        return definition
    if first_of(MESSAGES, spot):
        return message
    if first_of(HELD_BY_TESTS, spot):
        return measured_by_a_test
    return None
