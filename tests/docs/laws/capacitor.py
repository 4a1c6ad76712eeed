# SPDX-License-Identifier: Apache-2.0
"""Laws of docs/howto/size-a-capacitor.md: the current in the capacitor of a chopped drive, the worst duty, and the
energy of braking."""
import re
import tomllib
from math import sqrt

from laws.quantities import quantity
from laws.scenarios import motor, terminal_ohm, value
from laws.spots import spots_of

CELL = re.compile(r" {2,}")


def written(page, name):
    return tomllib.loads(next(s.text for s in spots_of(page) if s.kind == "write" and s.detail == name))


def least_and_worst(law):
    """The duty at which law(duty) is largest, and this largest value, on a fine grid."""
    grid = [n / 12000 for n in range(1, 12000)]
    worst = max(grid, key=law)
    return worst, law(worst)


def worst_duty(test, spot):
    """A limited current I gives the rms current I sqrt(d (1 - d)), with the duty d. On a held rotor I is d U/R."""
    limited, held = (row[1:] for row in spot.rows())
    test.assertEqual((0.5, 0.5), least_and_worst(lambda d: sqrt(d * (1 - d))))
    test.assertIn("I/2 rms", limited[1])
    test.assertEqual("0.5", limited[0])
    rms, ripple = least_and_worst(lambda d: d * sqrt(d * (1 - d))), least_and_worst(lambda d: d * d * (1 - d))
    told_rms, told_ripple = re.match(r"([\d.]+) for the rms current, (\d+/\d+) ", held[0]).groups()
    a, b = map(int, told_ripple.split("/"))
    test.assertLess(abs(float(told_rms) - rms[0]) + abs(a / b - ripple[0]), 1e-3, str(spot))
    test.assertLess(abs(float(re.match(r"([\d.]+) U/R rms", held[1]).group(1)) - rms[1]), 1e-3, str(spot))
    part, whole = map(int, re.search(r"(\d+) U T_s/\((\d+) R C\)", held[1]).groups())
    test.assertLess(abs(part / whole - ripple[1]), 1e-6, str(spot))


def capacitor_current(test, spot):
    """At half the duty the capacitor has half the motor current, within 6 % for ripple and commutations. At
    standstill it has I sqrt(d (1 - d)). As a function of the speed the rms current has one maximum, at most one row
    away from a duty of 0.5. The page names this row."""
    current = written(spot.page, "capacitor.toml")["reference"]["value"]
    rows = [[quantity(c) for c in CELL.split(line.strip())] for line in spot.text.splitlines() if re.match(r"^ +\d+  ", line)]
    test.assertGreater(len(rows), 3, str(spot))
    carried, duty = [row[3][0] for row in rows], [row[4][0] for row in rows]
    test.assertLess(abs(carried[0] / (current * sqrt(duty[0] * (1 - duty[0]))) - 1), 0.05, str(spot))
    worst = carried.index(max(carried))
    test.assertLess(abs(carried[worst] / (current / 2) - 1), 0.06, str(spot))
    test.assertLessEqual(abs(worst - min(range(len(duty)), key=lambda n: abs(duty[n] - 0.5))), 1, str(spot))
    told = re.search(r"near (\d+) rad/s it is about ([\d.]+) A", spot.before)
    if told:
        test.assertLess(abs(float(told.group(2)) - carried[worst]), 6e-3, str(spot))
        test.assertEqual(float(told.group(1)), rows[worst][1][0], str(spot))
    test.assertEqual(sorted(carried[:worst + 1]) + sorted(carried[worst + 1:], reverse=True), carried, str(spot))


def braking(test, spot):
    """The energy of a smooth current gives an upper limit of the bus voltage. The measured rise is less than a tenth
    below this limit. With a brake chopper the voltage stays at its upper threshold."""
    s = written(spot.page, "braking.toml")
    sheet = motor(s["motor"])
    J, K_t, R = value(sheet["inertia_gcm2"]) * 1e-7, value(sheet["torque_constant_mNm_A"]) * 1e-3, terminal_ohm(sheet)
    U0, C, w0, I = s["supply"]["voltage_V"], s["supply"]["capacitance_F"], s["initial"]["speed_rad_s"], -s["reference"]["value"]
    most = s["require"][0]["max"]
    from_formula = J * (w0 - R * I / K_t)**2 / (most**2 - U0**2)
    test.assertLess(abs(C / from_formula - 1), 5e-3, str(spot))
    page = next(x.before for x in spots_of(spot.page) if x.detail == "braking.toml")
    told = [float(x) * 1e-3 for x in re.search(r"gives ([\d.]+) mF, at most ([\d.]+) mF", page).groups()]
    test.assertLess(abs(told[0] / from_formula - 1), 5e-3, str(spot))
    test.assertLess(abs(told[1] / (J * w0**2 / (most**2 - U0**2)) - 1), 5e-3, str(spot))
    reached, chopped = [quantity(CELL.split(line.strip())[2])[0] for line in spot.text.splitlines() if line.startswith("  ")]
    bound = sqrt(U0**2 + J / C * (w0 - R * I / K_t)**2)
    test.assertTrue(bound - 0.1 * (bound - U0) < reached < bound, f"{spot}: {reached} of {bound}")
    test.assertEqual(float(re.search(r"brake_on_V=(\d+)", spot.text).group(1)), round(chopped, 2), str(spot))
