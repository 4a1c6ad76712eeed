# SPDX-License-Identifier: Apache-2.0
"""Laws of recordings laid over a run: a deviation is that of its two numbers, a verdict that of deviation and uncertainty, the
summary counts the verdicts; a fit leaves at most the signal itself."""
import re

from laws.quantities import quantity

VERDICT = re.compile(r"^(?:([-+][\d.e+-]+) %, )?(?:(within) \+- (.+)|beyond by (.+) \(\+- (.+)\))$")


def row(test, spot, cells):
    """Whether the figure is within; None if it has no verdict."""
    there, here, m = quantity(cells[1]), quantity(cells[2]), VERDICT.match(cells[3])
    if not m:
        test.assertIn(cells[3], ("no verdict: seen once", "not comparable", "not in the recording"), f"{spot}: {cells}")
        return None
    percent, within, room, over, wide = m.groups()
    half = quantity(room or wide)[0]
    apart, printed = abs(here[0] - there[0]), 2 * (there[2] + here[2])
    if there[0] != 0:  # a measurement that knows less than this is none
        test.assertLess(half, 0.4 * abs(there[0]), f"{spot}: {cells}")
    if percent:
        told = float(percent) / 100
        test.assertLess(abs((here[0] - there[0]) / abs(there[0]) - told), 0.011 * abs(told) + printed / abs(there[0]) + 1e-6, f"{spot}: {cells}")
    if within:
        test.assertLessEqual(apart, 1.06 * half + printed, f"{spot}: {cells}")
    else:
        beyond, _, digit = quantity(over)
        test.assertLess(abs(apart - half - beyond), 0.06 * (half + beyond) + printed + digit, f"{spot}: {cells}")
    return bool(within)


def verdicts(test, spot):
    """Each figure of a recording with its verdict, and how many of them the last line counts."""
    found = []
    for line in spot.text.splitlines():
        cells = re.split(r" {2,}", line.strip())
        if line.startswith("  ") and len(cells) >= 4:
            found.append(row(test, spot, cells))
    test.assertTrue(found, str(spot))
    for order, channel in re.findall(r"harmonic (\d+) of channel (\d+)", spot.text):
        test.assertTrue(order in "357" and channel in "12", str(spot))
    m = re.search(r"(\d+) of (\d+) recorded figures within their uncertainty", spot.text)
    if m:
        test.assertEqual((int(m.group(1)), int(m.group(2))), (found.count(True), len(found)), str(spot))


def left_over(test, spot):
    """A fit leaves less than the signal, and no tried cause changes what is left by a twentieth: so the page says."""
    rows = [(float(left), float(whole)) for left, whole in re.findall(r" ([\d.]+) V left of ([\d.]+) V$", spot.text, re.M)]
    test.assertGreater(len(rows), 5, str(spot))
    test.assertEqual({whole for _, whole in rows}, {0.111}, str(spot))
    for number in re.findall(r"[=\[,](-?\d+(?:\.\d+)?)(?=[ ,\]])", spot.text):
        test.assertIn(float(number), (0, -4, -7, -8, 10, -10, 0.1, -0.1, 1e-6, 23.5), str(spot))
    for left, whole in rows:
        test.assertLess(left, whole, str(spot))
        test.assertLess(abs(left / rows[0][0] - 1), 0.05, str(spot))


def shares(test, spot):
    """A part is not above the whole; a symmetrical machine has almost none over thirds; no tried Hall error makes half of the recorded shares."""
    rows = re.findall(r"^(\w+).*? +(\d+) % +(\d+) %$", spot.text, re.M)
    for edges in re.findall(r"edges ([-\d,]+)", spot.text):
        test.assertTrue(all(abs(int(x)) <= 8 for x in edges.split(",")), str(spot))
    recorded = [int(x) for x in rows[0][1:]]
    test.assertEqual((rows[0][0], len(rows)), ("recorded", 5), str(spot))
    test.assertLessEqual(int(rows[1][2]), 2, str(spot))
    for _, halves, thirds in rows[1:]:
        test.assertLess(2 * int(halves), recorded[0], str(spot))
        test.assertLess(2 * int(thirds), recorded[1], str(spot))
    test.assertLess(max(recorded), 100, str(spot))


def late_edges(test, spot):
    """Of 0, 5 and 10 degrees 5 are nearest at both speeds, and the clamp lengthens with the angle: so the page says."""
    rows = re.findall(r"^(\d+) rpm, edges (\d+) deg late: clamp ([\d.]+) us, u_a ([\d.]+) V apart$", spot.text, re.M)
    test.assertEqual([row[:2] for row in rows], [(n, deg) for n in ("493", "3135") for deg in ("0", "5", "10")], str(spot))
    for three in (rows[:3], rows[3:]):
        clamps, apart = [float(row[2]) for row in three], [float(row[3]) for row in three]
        test.assertEqual(clamps, sorted(clamps), str(spot))
        test.assertEqual(min(apart), apart[1], str(spot))
        test.assertLess(max(apart), 1.2 * min(apart), str(spot))
