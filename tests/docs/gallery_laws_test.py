#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""gallery_laws_test.py: the limits in data/scenarios/gallery are those of the laws that the files name.

Nothing is simulated here: each limit is computed from the motor's sheet and the scenario's own keys, and must be the
file's to a unit of its last digit. A requirement that stands here under no law fails.
"""
import cmath
import decimal
import tomllib
import unittest
from math import cos, exp, log, pi, sqrt

from page import REPOSITORY

SHEET = tomllib.loads((REPOSITORY / "data/motors/maxon-251601.toml").read_text(encoding="utf-8"))
R, L = SHEET["resistance_ohm"]["value"], SHEET["inductance_mH"]["value"] * 1e-3  # between two terminals
K_T, J = SHEET["torque_constant_mNm_A"]["value"] * 1e-3, SHEET["inertia_gcm2"]["value"] * 1e-7
B = SHEET["viscous_friction_Nm_s"]["value"]
U, PAIRS, T = 24.0, 8, 30e-6
K_E, L_S, TAU = K_T / 2, L / 2, L / R
STALL = U / R


def near(value, part=1e-6):
    """A value and what is allowed around it, as a part of it."""
    return value * (1 - part), value * (1 + part)


def halves(d):
    return exp(-d * T / TAU), exp(-(1 - d) * T / TAU)


def ripple(d):
    a, b = halves(d)
    return STALL * (1 - a) * (1 - b) / (1 - a * b)


def foot_duty(foot):
    """Duty of soft chopping whose ripple has its foot at a current, by halving."""
    low, high = 0.0, 1.0
    for _ in range(100):
        middle = (low + high) / 2
        a, b = halves(middle)
        low, high = (middle, high) if STALL * (b - a * b) / (1 - a * b) < foot else (low, middle)
    return low


def overshoot(kp, ki, reference):
    """Of the samples: the loop's difference equation with the pulse's exact effect."""
    decay, current, voltage, before, largest = exp(-T / TAU), 0.0, 0.0, 0.0, 0.0
    for _ in range(100):
        error = reference - current
        voltage = min(max(voltage + kp * (error - before) + ki * before, -U), U)
        before, d = error, voltage / U
        current = (current * decay + STALL * (exp(-(1 - d) * T / TAU) - decay) if d >= 0  # else against the whole bus
                   else max(0.0, (current + STALL) * decay - STALL))
        largest = max(largest, current - reference)
    return largest


def hysteresis_frequency(current, band):
    low, high = current - band, current + band
    return 1 / (TAU * log((STALL - low) / (STALL - high)) + TAU * log(high / low))


def made_up(settle, damping, full_torque, steps, end):
    """Position in rad that a speed controller whose integral winds up ends at: all that was asked for but what it holds."""
    w0 = 4.6 / (damping * settle)
    z = cmath.exp(complex(-damping * w0, w0 * sqrt(1 - damping**2)) * T)
    pole = exp(-T * B / J)
    gain = full_torque / B * (1 - pole)
    ki = (abs(z)**2 + 1 - 2 * z.real) / gain
    asked = sum(w * (until - at) for (at, w), until in zip(steps, [at for at, _ in steps[1:]] + [end]))
    middle, sampling = asked - B * steps[-1][1] / full_torque * T / ki, full_torque / J * T / 2 * end
    return middle - sampling, middle + sampling


A, B_OFF = halves(0.75)
FLOATING = 2 / 3 * K_E * 100 * 0.75 * T / L_S  # largest pulse of the floating phase
SECTOR = pi / 3 / PAIRS / 100
BURST = (K_T * 1.25 - 0.02) * 0.02 / J
BRAKE = (K_T * 100 - 2 * R) / U  # duty that holds 2 A of braking current at 100 rad/s
IN_BAND = 1e-9 / 0.4
DIP = 3 * L / (U - 2 * K_T * 200) / (pi / 3 / PAIRS / 200)  # part of a sector that a commutation takes at 200 rad/s

# (min, max) of each requirement; None: the file has none.
LAWS = {
    "chopping-soft": [near(0.5 * STALL), near(ripple(0.5)), (0, 0)],
    "chopping-hard": [near((2 * 0.75 - 1) * STALL), near(2 * ripple(0.75)),
                      near(-STALL * (1 - 2 * A + A * B_OFF) / (1 - A * B_OFF))[::-1]],
    "floating-phase-soft": [(0, 0), (FLOATING * (1 - 4 * T / SECTOR) * (1 - 0.75 * T * R / L), FLOATING)],
    "floating-phase-hard": [(0, 0)],
    "dead-time": [(0, 0), near((0.1 - 1e-6 / T) * STALL)],
    "braking-soft": [((U - K_T * 100) / R * (1 - exp(-T / TAU)), None)],
    "braking-complementary": [(None, U * BRAKE * (1 - BRAKE) * T / L + 0.077)],
    "braking-no-sink": [(28, sqrt(U**2 + J / 2e-3 * 300**2))],
    "braking-limited": [(None, 27 + 2 * T / 2e-3)],
    "bus-sag": [near(U * R / (R + 0.2)), near(U / (R + 0.2))],
    "current-pi": [near(5), near(foot_duty(5) * STALL), near(ripple(foot_duty(5))), (1 / T - 1 / 0.015, 1 / T + 1 / 0.015)],
    "current-hysteresis": [near(0.4, IN_BAND), near(TAU * log(1 / (1 - 4.9 / STALL))),
                           (hysteresis_frequency(5, 0.2) - 1 / 0.015, hysteresis_frequency(5, 0.2) + 1 / 0.015)],
    "machine-trapezoid": [(None, K_T * 5.01), (K_T * 4.99, None)],
    "machine-sine": [(pi / 3 * K_T * 4.99, pi / 3 * K_T * 5.01), (pi / 3 * cos(pi / 6) * K_T * 4.99,
                                                                   pi / 3 * cos(8 * 20 * 6.5e-3 - pi / 6) * K_T * 5.01)],
    "stiction": [(0, 0), (0, BURST), (0, 0)],
    "wind-up-none": [(None, T + 1e-3), near(300, 1e-3)],
    "wind-up": [made_up(0.02, 0.9, 0.1, [(0, 900), (0.25, 300)], 0.8), near(300, 1e-3)],
    "hall-glitch": [near(100, T / SECTOR + 0.004)],
    "one-shunt": [(5 - 0.005 - 0.22 * T / TAU / 24, 5 + 0.005 + 0.22 * T / TAU / 24), (None, 2e-6 / T * STALL)],
    "wrong-gains": [near(overshoot(4.1, 4.0, 2.0))],
    "sampled-too-slowly": [(0.02 - 2 * 500e-6, None)],
    "reversal": [(J * 392 / (K_T * (3 + U * T / 4 / L) + B * 200), J * 392 / (K_T * 3) / (1 - DIP / 2)), (None, -2)],
    "fixed-point-coarse": [(5 - 2 * 2000 / 2**15, 5 + 2 * 2000 / 2**15), (None, 5 * exp(-8e-3 / TAU))],
}


class GalleryLaws(unittest.TestCase):
    def test_every_limit_is_that_of_a_law(self):
        folder = REPOSITORY / "data/scenarios/gallery"
        self.assertEqual({file.stem for file in folder.glob("*.toml")}, set(LAWS))
        for name, laws in LAWS.items():
            scenario = tomllib.loads((folder / f"{name}.toml").read_text(encoding="utf-8"), parse_float=decimal.Decimal)
            self.assertEqual(len(scenario["require"]), len(laws), name)
            for requirement, limits in zip(scenario["require"], laws):
                for side, limit in zip(("min", "max"), limits):
                    with self.subTest(f"{name}: {requirement['label']}", side=side):
                        self.limit_is(requirement.get(side), limit)

    def limit_is(self, written, limit):
        if limit is None or written is None:
            self.assertEqual(written, limit)
            return
        digit = 10.0 ** decimal.Decimal(written).as_tuple().exponent
        self.assertLessEqual(abs(float(written) - limit), 1.01 * digit, limit)


if __name__ == "__main__":
    unittest.main()
