# SPDX-License-Identifier: Apache-2.0
"""Laws of bench results: the constants of the back-EMF agree in all frames, the intervals contain their value, and
the results agree with the data that made the log."""
import re
from math import pi, sin, sqrt


def between(test, spot, name, x, low, high):
    test.assertTrue(float(low) <= float(x) <= float(high), f"{spot}: {name}: {x} not in {low} .. {high}")


def intervals(test, spot):
    found = re.findall(r"(-?[\d.]+)(?: \w+(?: s/rad)?)? +(-?[\d.]+) \.\. (-?[\d.]+)", spot.text)
    test.assertTrue(found, str(spot))
    for x, low, high in found:
        between(test, spot, "value", x, low, high)


def near(test, spot, name, x, y, part):
    test.assertLessEqual(abs(x - y), part * abs(y), f"{spot}: {name}: {x}, by hand {y}")


def emf(test, spot):
    intervals(test, spot)
    harmonics(test, spot)
    rows, span, periods, hertz = re.search(r"(\d+) rows in ([\d.]+) ms, ([\d.]+) periods of ([\d.]+) Hz", spot.text).groups()
    near(test, spot, "periods = f t", float(periods), float(hertz) * float(span) * 1e-3, 5e-3)
    test.assertGreater(int(rows), 10 * float(periods))
    row = {name: [float(n) for n in (constant, krpm, rpm)] for name, constant, krpm, rpm in re.findall(
        r"^  ((?:line|phase), \w+) +([\d.]+) +[\d.]+ \.\. [\d.]+ +([\d.]+) +([\d.]+)$", spot.text, re.M)}
    for name, (constant, krpm, rpm) in row.items():
        near(test, spot, f"{name}: V/krpm", krpm, constant * 1e-3 * 1000 * pi / 30, 3e-3)
        near(test, spot, f"{name}: rpm/V", rpm, 1000 / krpm, 3e-3)
    pairs = int(re.search(r"^  (\d+) pole pairs", spot.text, re.M).group(1))
    flux = float(re.search(r"flux linkage, mWb +([\d.]+)", spot.text).group(1))
    near(test, spot, "flux linkage = phase fundamental/p", flux, row["phase, fundamental"][0] / pairs, 2e-3)
    hertz, rpm = (float(re.search(pattern, spot.text).group(1)) for pattern in (r"periods of ([\d.]+) Hz", r"pole pairs: ([\d.]+) rpm"))
    near(test, spot, "rpm = 60 f/p", rpm, 60 * hertz / pairs, 3e-4)
    K_t = float(re.search(r"K_t, six-step, mNm/A +([\d.]+)", spot.text).group(1))
    test.assertTrue(row["line, rms"][0] * sqrt(2) * 0.9 <= K_t <= row["line, peak"][0], f"{spot}: mean over the sector, below the peak")


def harmonics(test, spot):
    """Between two terminals no third harmonic of the motor is visible. The sizes and their limits are relative to the
    fundamental."""
    for order, size, low, high in re.findall(r"^  (\d+) +([\d.]+) +([\d.]+) \.\. ([\d.]+) ", spot.text, re.M):
        between(test, spot, f"harmonic {order}", size, low, high)
        test.assertTrue(float(high) < 30 and 2 <= int(order) < 60, f"{spot}: harmonic {order}")
    m = re.search(r"harmonic_orders = \[(\d+)\]\nharmonic_sizes = \[(-?[\d.]+)\]", spot.text)
    if m:
        told = re.search(rf"^  {m.group(1)} +([\d.]+) ", spot.text, re.M).group(1)
        near(test, spot, "harmonic of the file", abs(float(m.group(2))), float(told) / 100, 0.02)
    crest = float(re.search(r"crest factor ([\d.]+)", spot.text).group(1))
    test.assertTrue(1.0 < crest < 1.8, str(spot))
    for peak, low, high in re.findall(r"^  \S+ +([\d.]+) +([\d.]+) \.\. ([\d.]+) +(?:[\d.]+ +)?-?[\d.]+ +[\d.]+ +[\d.]+$", spot.text, re.M):
        between(test, spot, "peak of a channel", peak, low, high)


def clipped(test, spot):
    """A sine that is cut off at the level c. The fundamental is its Fourier integral. Between two terminals the
    orders 3, 9, 15.. do not contribute to the peak."""
    rows = [[float(x) for x in re.findall(r"([\d.]+) %", line)] for line in spot.text.splitlines() if "%" in line]
    steps = 20000
    for cut, fundamental, peak in zip(*rows, strict=True):
        wave = [max(-1 + cut / 100, min(1 - cut / 100, sin(2 * pi * n / steps))) for n in range(steps)]
        orders = [2 / steps * sum(x * sin(k * 2 * pi * n / steps) for n, x in enumerate(wave)) for k in (1, 3, 9, 15, 21, 27)]
        top = 1 - cut / 100 - sum(size * (-1) ** (k // 2) for size, k in zip(orders[1:], (3, 9, 15, 21, 27)))
        near(test, spot, "fundamental", fundamental, 100 * (1 - orders[0]), 0.02)
        near(test, spot, "peak", peak, 100 * (1 - top), 0.05)


def held_against(test, spot):
    printed = float(re.search(r"= ([\d.]+) V/krpm: CONTRADICTS", spot.text).group(1))
    for constant, told in re.findall(r"^    \S+ +([\d.]+) +([-+][\d.]+) %", spot.text, re.M):
        test.assertLess(abs(100 * (float(constant) / printed - 1) - float(told)), 0.1, str(spot))


def identify(test, spot):
    """The log is simulated. The scenario above it states the true values."""
    for name, value, low, high in re.findall(r"^  (offset|hysteresis|delay|flux linkage) +([\d.]+) \S+ +([\d.]+) \.\. ([\d.]+)", spot.text, re.M):
        between(test, spot, name, value, low, high)
        truth = {"offset": 7.0, "hysteresis": 1.5, "delay": 50.0, "flux linkage": 0.0335 / 2 / 8 * 12 / pi**2 * 1e3}[name]
        test.assertLessEqual(abs(truth - float(value)), 2.5 * max(float(high) - float(value), float(value) - float(low)), f"{spot}: {name}")
    places = [2, -1, 0, -3, 1, 1]
    for edge, place, low, high in re.findall(r"^  (\d) +\d+ deg +\d+ \d+ +(-?[\d.]+) +(-?[\d.]+) \.\. (-?[\d.]+)", spot.text, re.M):
        between(test, spot, f"edge {edge}", place, low, high)
        test.assertLess(abs(places[int(edge)] - float(place)), 0.2, f"{spot}: edge {edge}")
    m = re.search(r"(\d+) edges, (\d+) forward and (\d+) backward", spot.text)
    test.assertEqual(int(m.group(1)), int(m.group(2)) + int(m.group(3)))
    unused = sum(int(n) for n in re.findall(r"^  (\d+) edges? (?:left out|not used)", spot.text, re.M))
    seen = sum(int(n) for n in re.findall(r"^  \d +\d+ deg .* (\d+)$", spot.text, re.M))
    test.assertEqual(int(m.group(1)), seen + unused, f"{spot}: edges")


def commission_sheet(test, spot):
    """The printed error is the difference of the found and the true value, and is within the printed bound."""
    rows = re.findall(r"^  (\S.*?) {2,}([-\d.]+) (\S+) {2,}([-\d.]+) \S+ {2,}([-+][\d.]+) (\S+) {2,}([\d.]+) \S+$", spot.text, re.M)
    test.assertGreaterEqual(len(rows), 9, str(spot))
    for name, found, unit, truth, off, off_unit, bound in rows:
        off_by = float(found) - float(truth)
        if off_unit == "%":
            off_by *= 100 / float(truth)
        test.assertLess(abs(off_by - float(off)), 0.02 + 0.01 * abs(off_by), f"{spot}: {name}")
        test.assertLessEqual(abs(off_by), float(bound), f"{spot}: {name}")
    at = 0.0
    for begin, lasts in re.findall(r"^  \w+ +([\d.]+) s +([\d.]+) s$", spot.text, re.M):
        test.assertLess(abs(float(begin) - at), 2e-3, f"{spot}: phases follow each other")
        at = float(begin) + float(lasts)


def commission_constants(test, spot):
    rows = re.findall(r"(R|L|psi) +([\d.]+) \S+ ([-+][\d.]+) \(([\d.]+)\) %", spot.text)
    test.assertGreaterEqual(len(rows), 18, str(spot))
    for name, _, off, bound in rows:
        test.assertLessEqual(abs(float(off)), float(bound), f"{spot}: {name}")
    sheet = {"maxon-251601": (0.515, 0.286, 0.0335 / 2 / 8 * 12 / pi**2 * 1e3)}
    for motor, (R, L, psi) in sheet.items():
        m = re.search(rf"{motor} +ideal +R +([\d.]+) ohm .*?L +([\d.]+) mH .*?psi +([\d.]+) mVs", spot.text)
        for x, y in zip(m.groups(), (R, L, psi)):
            near(test, spot, motor, float(x), y, 3e-3)


def hall_places(test, spot):
    rows = re.findall(r"offset +(-?[\d.]+): found +(-?[\d.]+) degrees, worst edge off by ([\d.]+)", spot.text)
    test.assertGreaterEqual(len(rows), 15)
    for offset, found, worst in rows:
        # The rest angle of a rotor with trapezoidal back-EMF differs by up to 1.12 degrees from the angle of a sinusoidal field.
        test.assertLessEqual(abs(float(found) - float(offset)), 1.12, str(spot))
        test.assertLessEqual(float(worst), 1.12, str(spot))


TRUTH = {"resistance_ohm": 1.03, "flux_linkage_mWb": 0.0335 / 2 / 8 * 12 / pi**2 * 1e3, "inductance_mH": 0.572, "viscous_friction_Nm_s": 7.3e-6,
         "coulomb_friction_mNm": 0.0, "inertia_gcm2": 135.0}


def guide_emf(test, spot):
    """The recording is of the 251601: its flux linkage and torque constant lie in the intervals."""
    flux, low, high = map(float, re.search(r"flux linkage, mWb +([\d.]+) +([\d.]+) \.\. ([\d.]+)", spot.text).groups())
    test.assertTrue(low <= flux <= high and low <= TRUTH["flux_linkage_mWb"] <= high, str(spot))
    K_t, low, high = map(float, re.search(r"K_t, six-step, mNm/A +([\d.]+) +([\d.]+) \.\. ([\d.]+)", spot.text).groups())
    test.assertTrue(low <= K_t <= high and low <= 33.5 <= high, str(spot))
    rows, span, periods, hertz, least, most = map(float, re.search(
        r"(\d+) rows in ([\d.]+) s, ([\d.]+) periods of ([\d.]+) Hz \(([\d.]+) \.\. ([\d.]+)\)", spot.text).groups())
    near(test, spot, "105 rad/s", hertz, 8 * 105 / (2 * pi), 1e-4)
    near(test, spot, "periods", periods, hertz * span, 5e-3)
    test.assertTrue(rows > 10 * periods and least < hertz < most, str(spot))
    near(test, spot, "rpm", float(re.search(r"8 pole pairs: ([\d.]+) rpm", spot.text).group(1)), 60 * hertz / 8, 1e-4)


def guide_coast(test, spot):
    """B w/J of the 251601 in the middle of the recording."""
    hertz, change = map(float, re.search(r"periods of ([\d.]+) Hz .* changing by (-[\d.]+) Hz/s", spot.text).groups())
    near(test, spot, "B w/J", change, -TRUTH["viscous_friction_Nm_s"] / (TRUTH["inertia_gcm2"] * 1e-7) * hertz, 2e-3)
    near(test, spot, "rpm", float(re.search(r"pole pairs: ([\d.]+) rpm", spot.text).group(1)), 60 * hertz / 8, 1e-4)


def guide_parameters(test, spot):
    """The truth lies within the bounds; percent and range are those of value and half width."""
    rows = re.findall(r"(?m)^(\w+) +([\d.e-]+) \+- +([\d.e-]+) \S.*?(?: +([\d.]+) %)? +(\d+) % of the variance", spot.text)
    test.assertEqual([row[0] for row in rows], list(TRUTH), str(spot))
    for key, value, half, percent, share in rows:
        x, half = float(value), float(half)
        test.assertLessEqual(abs(x - TRUTH[key]), half, f"{spot}: {key}")
        test.assertTrue(0 < float(share) <= 100, f"{spot}: {key}")
        if percent:
            test.assertLess(abs(100 * half / x - float(percent)), 0.06 + 0.03 * float(percent), f"{spot}: {key}")
        low, high = map(float, re.search(rf"(?m)^{key} = .*range = \[([\d.e-]+), ([\d.e-]+)\]", spot.text).groups())
        test.assertLess(abs(low - max(0.0, x - half)) + abs(high - x - half), 0.11 * half, f"{spot}: {key}")


def guide_table(test, spot):
    """Minutes make half an hour, and the uncertainties are those that the page computes."""
    from page import Page
    computed = Page(spot.page).texts("output")[-1]
    test.assertEqual(30, sum(int(cells[2]) for cells in spot.rows()), str(spot))
    for at, key in enumerate(("resistance_ohm", "flux_linkage_mWb", "inductance_mH", "viscous_friction_Nm_s", "inertia_gcm2")):
        told = re.search(r"[\d.]+ %", spot.rows()[at][4]).group(0)
        test.assertRegex(computed, rf"(?m)^{key} .* {re.escape(told)} ", str(spot))
    dry = re.search(r"coulomb_friction_mNm +[\d.]+ \+- +([\d.]+) mNm", computed).group(1)
    test.assertIn(f"{dry} mNm", spot.rows()[3][4], str(spot))


# Constants of the simulated bench in docs/howto/fit-a-motor.md.
FIT_TRUTH = {"resistance_ohm": 1.2, "inductance_mH": 0.5, "torque_constant_mNm_A": 31, "inertia_gcm2": 110,
             "viscous_friction_Nm_s": 9e-6, "coulomb_friction_mNm": 4}


def fit_rows(spot):
    """Key: fitted value and bounds."""
    rows = {}
    for line in spot.text.split("\n"):
        cells = re.split(r" {2,}", line.strip())
        bounds = re.fullmatch(r"(\S+) \.\. (\S+)", cells[3]) if len(cells) > 3 else None
        if bounds:
            rows[cells[0]] = tuple(map(float, (cells[2].split()[0], *bounds.groups())))
    return rows


def fit(test, spot):
    """The bounds of a simulated bench contain its true constants; those of a real recording agree with `motor emf`."""
    rows = fit_rows(spot)
    for key, (x, low, high) in rows.items():
        between(test, spot, key, x, low, high)
    if "inertia_gcm2" in rows:
        for key, truth in FIT_TRUTH.items():
            between(test, spot, key, truth, *rows[key][1:])
            test.assertLess(rows[key][2] - rows[key][1], 0.05 * truth, f"{spot}: {key}")
        return
    x, low, high = rows["torque_constant_mNm_A"]
    test.assertTrue(35.3 < x < 37.9 and low < 36.6 < high, f"{spot}: motor emf finds 36.6, 35.3 to 37.9")
    # The recording of motor emf has 501.11 rpm, 493.6 to 506.
    near(test, spot, "speed", rows["initial.speed_rad_s"][0], 501.11 * pi / 30, 5e-3)
