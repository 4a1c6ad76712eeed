# SPDX-License-Identifier: Apache-2.0
"""Laws of a design's text. Intermediate values follow from their formulas, comparisons from their two numbers, and
verdicts from their words."""
import re
from math import cos, exp, pi, sin, sqrt

from gallery_sheet import K_T, R, L, T, U
from laws.quantities import quantity

STEP = re.compile(r"^  (\S(?:.*?\S)?) {2,}(-?\d[\d.]*(?:e[-+]?\d+)?)(?: |$)", re.M)


def close(test, spot, name, x, y, part=2e-3, least=0.0):
    test.assertLessEqual(abs(x - y), part * abs(y) + least, f"{spot}: {name} is {x}, by hand {y}")


def steps(text):
    return {m.group(1): float(m.group(2)) for m in STEP.finditer(text)}


def pole_placement(test, spot, s):
    settle, xi = s["T_reg"] * 1e-3, s["xi"]
    w0 = 4.6 / (xi * settle)
    close(test, spot, "w0", s["w0"], w0)
    re_s, im_s = -xi * w0, w0 * sqrt(1 - xi * xi)
    re_z, im_z = exp(re_s * T) * cos(im_s * T), exp(re_s * T) * sin(im_s * T)
    a0 = -exp(-R * T / L)
    b0 = (1 + a0) / R
    for name, value in {"Re s": re_s, "Im s": im_s, "Re z": re_z, "Im z": im_z, "a0": a0, "b0": b0, "c1": -2 * re_z,
                        "c0": re_z**2 + im_z**2, "d1": (-2 * re_z - a0 + 1) / b0, "d0": (re_z**2 + im_z**2 + a0) / b0}.items():
        close(test, spot, name, s[name], value, 1e-5)


def deviations(test, spot):
    """In a row such as "900 us  930 us  +3.33 %" the third number is the relative difference of the first two."""
    for line in spot.text.splitlines():
        cells = re.split(r" {2,}", line.strip())
        for n in range(len(cells) - 2):
            m = re.match(r"^([-+]?\d[\d.]*) %$", cells[n + 2])
            first, second = quantity(cells[n]), quantity(cells[n + 1])
            if m and first and second and first[0] != 0 and first[1] == second[1]:
                room = 2 * (first[2] + second[2]) / abs(first[0]) + 0.01 * abs(float(m.group(1))) / 100 + 1e-4
                test.assertLessEqual(abs((second[0] - first[0]) / abs(first[0]) - float(m.group(1)) / 100), room, f"{spot}: {line}")


def verdict(test, spot):
    """The first line of the text: the nominal value is at most the worst value. A design called USABLE has sufficient
    phase margins and a run that settles."""
    first = spot.text.splitlines()[0]
    for nominal, worst in re.findall(r"settles within \d+ % in ([\d.]+ \w+)(?: \([^)]*\))?, ([\d.]+ \w+) at worst", first):
        test.assertLessEqual(quantity(nominal)[0], quantity(worst)[0], first)
    for nominal, worst in re.findall(r"overshoot ([\d.]+ [\w/]+), ([\d.]+ [\w/]+) at worst", first):
        test.assertLessEqual(quantity(nominal)[0], quantity(worst)[0], first)


def loops(test, spot):
    """Margins by hand. The delay margin is phase/(360 f). A command one period T later reduces the phase by 360 f T.
    The sensitivity is at least as large as the gain margin requires."""
    rows = {}
    for line in spot.text.splitlines():
        cells = re.split(r" {2,}", line.strip())
        if len(cells) >= 2 and quantity(cells[1]):
            rows[cells[0]] = [quantity(c) for c in cells[1:]]
    if "crossover" not in rows or "delay margin, one period late" not in rows:
        return
    for n, f in enumerate(rows["crossover"]):
        at_once, late = (rows[f"phase margin, {when}"][n][0] for when in ("no computation delay", "one period late"))
        if n == 0:  # the delay of an outer loop is within its inner loop
            close(test, spot, "phase margin, one period late", late, at_once - 360 * f[0] * T, 0, 0.2)
            close(test, spot, "delay margin", rows["delay margin, one period late"][n][0], late / 360 / f[0], 1e-2)
        peak = rows["peak of sensitivity, one period late"][n][0]
        test.assertGreaterEqual(peak * 1.01, 1 / (2 * sin(min(late, 90) * pi / 360)), f"{spot}: |S| at the crossover")
        gain = 10**(rows["gain margin, one period late"][n][0] / 20)
        test.assertGreaterEqual(peak * 1.01, gain / (gain - 1), f"{spot}: |S| where the phase is -180")
        test.assertGreaterEqual(rows["bandwidth, -3 dB"][n][0], f[0] * 0.9)


def limits(test, spot):
    """The limits by bus and PWM at the nominal current of the 251601."""
    if "current ripple" not in spot.text or "voltage left" not in spot.text:
        return
    a = exp(-T / 2 * R / L)
    ripple = U / R * (1 - a) / (1 + a)
    close(test, spot, "ripple at duty 0.5", float(re.search(r"current ripple +([\d.]+) A", spot.text).group(1)), ripple, 1e-2)
    left = dict((float(w), float(v)) for v, w in re.findall(r"(-?[\d.]+) V at (\d+)", spot.text))
    for w, volts in left.items():
        close(test, spot, f"voltage left at {w} rad/s", volts, U - 2.33 * R - K_T * w, 0, 0.06)
    held = float(re.search(r"holds the torque up to ([\d.]+) rad/s, from 4 E", spot.text).group(1))
    close(test, spot, "speed up to which a duty holds the torque at a commutation", held, (U - 1.5 * R * 2.33) / (2 * K_T), 0, 0.06)


def hall(test, spot):
    """The speed from Hall edges: the duration of a sector, and the delay of the mean over k sectors."""
    m = re.search(r"w_low +([\d.]+) rad/s.*\n +T +([\d.]+) ms +\(pi/3\)/\(p w_low\)", spot.text)
    if m:
        close(test, spot, "T", float(m.group(2)) * 1e-3, pi / 3 / 8 / float(m.group(1)), 1e-4)
    for line in spot.text.splitlines():  # at a lower speed the loop is not faster
        cells = re.split(r" {2,}", line.strip())
        if cells[0].startswith("Hall, ") and len(cells) == 4:
            times = [quantity(c)[0] for c in cells[1:]]
            test.assertEqual(times, sorted(times, reverse=True), f"{spot}: {line}")
            # The longest delay is (k + 1)/2 sectors, which decreases with the speed. The settling time decreases by at most the
            # same ratio.
            test.assertLessEqual(times[0] / times[2], 5.05, f"{spot}: {line}")


def sensors(test, spot):
    """The values of an encoder, a resolver or zero crossings. They follow from the formulas that are printed beside
    the numbers."""
    s, text = steps(spot.text), spot.text
    if "(2 pi/4N)/w_low" in text:
        lines = int(re.search(r"encoder, (\d+) lines", text).group(1))
        count = 2 * pi / 4 / lines
        for name, value in {"c": count / s["w_low"] * 1e6, "T": max(T * 1e6, count / s["w_low"] * 1e6), "w_min": count / 0.05}.items():
            close(test, spot, name, s[name], value, 1e-3)
        test.assertTrue(s["T"] / 2 <= s["delay"] <= (s["T"] + s["c"]) / 2 * 1.001, str(spot))
    if "(2 pi/2^n)/(k T_s)" in text:
        turn = 2 * pi / 2**int(re.search(r"absolute encoder, (\d+) bits", text).group(1))
        close(test, spot, "dw", s["dw"], turn / s["T"] * 1e6, 1e-4)
        close(test, spot, "w_min", s["w_min"], s["dw"], 1e-6)
        close(test, spot, "delay", s["delay"], s["T"] / 2 + s["t_l"], 1e-4)
        test.assertLess(abs(s["T"] / (T * 1e6) - round(s["T"] / (T * 1e6))), 1e-6, "whole periods")
    if "dw_3" in s:  # here the sectors are 54 and 66 degrees
        close(test, spot, "dw_3", s["dw_3"], s["w_low"] / 10, 1e-4)
    if "2 D/w_n" in text:
        close(test, spot, "2 D/w_n", s["2 D/w_n"], 2e6 / s["w_n"], 1e-4)
        close(test, spot, "delay", s["delay"], s["2 D/w_n"] + s["t_l"], 1e-4)
        close(test, spot, "t_l", s["t_l"], T * 1e6, 1e-6)
    if "dw_high" in s:  # far above the lowest speed: the same step of the speed, and the immediate response of both loops
        w, dw, I_N, full = s["w_high"], s["dw_high"], 2.33, 2.5 * 2.33
        test.assertTrue(0.89 * (U - R * I_N) / K_T < w < 0.9 * (U - R * I_N) / K_T * 1.001, f"{spot}: w_high")
        if "(2 pi/4N)/w_low" in text:
            close(test, spot, "dw_high", dw, w / s["w_low"] * s["dw"], 1e-4)
        elif "Speed from the absolute" in text:
            close(test, spot, "dw_high", dw, s["dw"], 1e-6)
        else:  # the mean of six Hall edges, with ticks of 1 MHz
            close(test, spot, "dw_high", dw, w / (6e6 * pi / 3 / 8 / w), 1e-4)
        # The crossover with d1 alone is d1 T_max/J, with T_max = K_t 2.5 I_N. The poles of the current loop give its d1.
        close(test, spot, "d1 dw", s["d1 dw"], s["w_c"] * 135e-7 / (K_T * full) * dw, 2e-3)
        close(test, spot, "u_left", s["u_left"], U - K_T * w - R * I_N / 2, 1e-3)
        close(test, spot, "du", s["du"] * (1e-3 if re.search(r"du +\S+ mV", text) else 1), s["d1 dw"] * full * 4.09559, 1e-3)
    if "I_start" in s:
        I_N, J = 2.33, 135e-7
        for name, value in {"w_low": max(4e-3 * s["y_0"] / K_T, 0.05 * U / K_T), "w_high": pi / 3 / 8 / 4 / T, "I_start": 1.5 * I_N,
                            "T_swing": 2e3 * pi * sqrt(J / (8 * K_T * 1.5 * I_N)), "d'": I_N * K_T**2 / (J * U)}.items():
            close(test, spot, name, s[name], value, 1e-4)
        test.assertTrue(0 < s["I_ramp"] < s["I_start"] and 0 < s["a"] < K_T * s["I_start"] / J, str(spot))
    if "phase" in s and "w_c times it" in text:
        test.assertTrue(0 < s["phase"] < 45, f"{spot}: a sensor may not cost all of the phase that is to be left")
        close(test, spot, "phase", s["phase"], s["w_c"] * seconds(text, "delay") * 180 / pi, 1e-4)
    if "T_6" in s:
        close(test, spot, "T_6", seconds(text, "T_6"), pi / 8 * 12 / 7 / s["w_c"], 1e-4)


def seconds(text, symbol):
    """A row of a derivation in s. The row may show us, ms or s."""
    value, unit = re.search(rf"^  {symbol} +([\d.]+) (us|ms|s) ", text, re.M).groups()
    return float(value) * {"us": 1e-6, "ms": 1e-3, "s": 1.0}[unit]


def swing(test, spot):
    """The speed swings by less than twice the no-load speed. With ideal sensors the swing is smaller than with the
    real sensor."""
    m = re.search(r"swings by ([\d.]+) rad/s without end; with ideal sensors the swing is ([\d.]+) rad/s", spot.text)
    if m:
        test.assertTrue(float(m.group(2)) < float(m.group(1)) < 2 * U / K_T, str(spot))
    for angle in re.findall(r"phase margin, one period late +([\d.]+) deg", spot.text):
        test.assertLess(float(angle), 90, str(spot))


def position(test, spot):
    """The gain is at most the gain that the nominal motor allows. That gain is between the two ends of the search. A
    Hall step is 60/p degrees."""
    found = re.search(r"between ([\d.]+) \(full torque.*?and ([\d.]+) \(no limit", spot.text)
    gain = re.search(r"K_p +([\d.]+) rad/s/deg", spot.text)
    if found and gain:
        low, high, alone = float(found.group(1)), float(found.group(2)), float(re.search(r"nominal motor allows ([\d.]+)", spot.text).group(1))
        test.assertTrue(float(gain.group(1)) <= alone and low < alone < high, str(spot))
    hall_step = re.search(r"Hall step of ([\d.]+) degrees", spot.text)
    if hall_step:
        close(test, spot, "60/p", float(hall_step.group(1)), 7.5, 1e-6)


def linear(test, spot):
    """The 251601 as a linear motor with the radius r = 20 mm: force F = T/r, mass m = J/r^2, pole pitch tau = pi r/p."""
    if "K_f" not in spot.text:
        return
    r = 0.02
    for name, value in {r"K_f = ([\d.]+) N/A": K_T / r, r"m = ([\d.]+) kg": 135e-7 / r**2, r"B = ([\d.]+) N s/m": 7.3e-6 / r**2,
                        r"tau = ([\d.]+) mm": pi * r / 8 * 1e3}.items():
        close(test, spot, name, float(re.search(name, spot.text).group(1)), value, 1e-4)
    v_low = float(re.search(r"v_low +([\d.]+) m/s", spot.text).group(1))
    close(test, spot, "T", float(re.search(r"T +([\d.]+) ms +\(tau/3\)/v_low", spot.text).group(1)), pi * r / 24 / v_low * 1e3, 1e-3)
    d1, d0, K, K_i = map(float, re.search(r"d1 = (\S+), d0 = (\S+) of the force limit per m/s; K = (\S+), K_i = (\S+) per", spot.text).groups())
    close(test, spot, "K", K, d1, 1e-6)
    close(test, spot, "K_i", K_i, d1 + d0, 1e-3)


def field(test, spot):
    s = steps(spot.text)
    if "psi/L_d" in spot.text:
        psi, L_s = float(re.search(r"psi = ([\d.]+) V s", spot.text).group(1)), L / 2
        close(test, spot, "p psi", s["p psi"], 8 * psi, 1e-4)
        close(test, spot, "K_q", s["K_q"], 12 * psi, 1e-4)
        close(test, spot, "psi/L_d", s["psi/L_d"], psi / L_s, 1e-4)
        close(test, spot, "circle", s["U_s/sqrt 3"], U / sqrt(3), 1e-4)
        close(test, spot, "w_0", s["w_0"], U / sqrt(3) / 8 / psi, 1e-4)
        close(test, spot, "d1", s["d1"], s["z"] * (1 - s["z"]) / s["b0"], 1e-4)
        close(test, spot, "d0", s["d0"], s["a0"] * s["d1"], 1e-4)
        close(test, spot, "b0", s["b0"], (1 + s["a0"]) / (R / 2), 1e-4)
        close(test, spot, "p L_d", s["p L_d"], 8 * L_s, 1e-4)
        close(test, spot, "p L_q", s["p L_q"], 8 * L_s, 1e-4)
        close(test, spot, "T_s", s["z"], exp(-s["w"] * T), 1e-4)


def cancellation(test, spot):
    s = steps(spot.text)
    if "K fw" in s:
        close(test, spot, "L w", s["K fw"], L * 3000, 1e-3)
        close(test, spot, "R w T", s["K_i fw"], R * 3000 * T, 1e-3)
        close(test, spot, "d0 = a0 d1", s["d0"], -exp(-R * T / L) * s["d1"], 1e-4)


def judge(test, spot):
    s = steps(spot.text)
    if {"T_reg", "Re z", "d1", "a0"} <= set(s) and "1 ms" in spot.text:
        pole_placement(test, spot, s)
    deviations(test, spot)
    verdict(test, spot)
    loops(test, spot)
    limits(test, spot)
    hall(test, spot)
    sensors(test, spot)
    swing(test, spot)
    position(test, spot)
    linear(test, spot)
    field(test, spot)
    cancellation(test, spot)
