# SPDX-License-Identifier: Apache-2.0
"""gallery_sheet.py: the data of the gallery's motor, and functions that several of its laws use."""
import tomllib
from math import exp, pi

from page import REPOSITORY

SHEET = tomllib.loads((REPOSITORY / "data/motors/maxon-251601.toml").read_text(encoding="utf-8"))
R, L = SHEET["resistance_ohm"]["value"], SHEET["inductance_mH"]["value"] * 1e-3  # between two terminals
K_T, J = SHEET["torque_constant_mNm_A"]["value"] * 1e-3, SHEET["inertia_gcm2"]["value"] * 1e-7
B = SHEET["viscous_friction_Nm_s"]["value"]
U, PAIRS, T = 24.0, 8, 30e-6
K_E, L_S, TAU = K_T / 2, L / 2, L / R
STALL = U / R


def near(value, part=1e-6):
    """The interval around a value; `part` is its relative half width."""
    return value * (1 - part), value * (1 + part)


def halves(d):
    return exp(-d * T / TAU), exp(-(1 - d) * T / TAU)


def lagged(x, final, start, lag, t):
    """The output of a first-order lag after the time t. The output begins at x. The input goes from `start` to
    `final` with the time constant L/R."""
    bent = (start - final) / (1 - lag / TAU)
    return final + bent * exp(-t / TAU) + (x - final - bent) * exp(-t / lag)


def read_late(reading, lag, delay):
    """The mean current of a centred pulse, if the sample in its middle is `reading`. The sensor has a lag and a
    delay. The duty is found by bisection."""
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        a, b = halves(middle)
        top, x = STALL * (1 - a) / (1 - a * b), 0.0
        for _ in range(100):  # many time constants of the lag, so that the initial value has no effect
            x = lagged(x, STALL, top * b, lag, middle * T)
            x = lagged(x, 0, top, lag, (1 - middle) * T)
        late = lagged(x, STALL, top * b, lag, middle * T / 2 - delay)
        low, high = (middle, high) if late < reading else (low, middle)
    return low * STALL


A, B_OFF = halves(0.75)
SECTOR = pi / 3 / PAIRS / 100
I_N = SHEET["nominal_current_A"]["value"]
LOOP_GAIN = 1.582e-3 * 0.78 / K_T  # A per rad/s
