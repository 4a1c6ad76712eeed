#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""gallery_laws_test.py: the limits in data/scenarios/gallery follow from the laws that the files name.

No simulation runs here. Each limit is computed from the motor's sheet and from the keys of the scenario. It must
agree with the file within one unit of the last digit. A requirement without a law fails."""
import cmath
import decimal
import tomllib
import unittest
from math import acos, atan2, cos, cosh, exp, hypot, log, pi, radians, sin, sinh, sqrt

import belief_laws
import magnet_laws
import position_laws
import profile_laws
from gallery_sheet import A, B, B_OFF, J, K_E, K_T, L, L_S, PAIRS, R, SECTOR, STALL, T, TAU, U, halves, near, read_late
from page import REPOSITORY


def ripple(d):
    a, b = halves(d)
    return STALL * (1 - a) * (1 - b) / (1 - a * b)


def foot_duty(foot):
    """The duty of soft chopping at which the lowest current of the ripple is `foot`, by bisection."""
    low, high = 0.0, 1.0
    for _ in range(100):
        middle = (low + high) / 2
        a, b = halves(middle)
        low, high = (middle, high) if STALL * (b - a * b) / (1 - a * b) < foot else (low, middle)
    return low


def overshoot(kp, ki, reference):
    """The overshoot of the samples. It is computed from the difference equation of the loop, with the exact effect of
    a pulse."""
    decay, current, voltage, before, largest = exp(-T / TAU), 0.0, 0.0, 0.0, 0.0
    for _ in range(100):
        error = reference - current
        voltage = min(max(voltage + kp * (error - before) + ki * before, -U), U)
        before, d = error, voltage / U
        # Otherwise the current falls against the full bus voltage.
        current = (current * decay + STALL * (exp(-(1 - d) * T / TAU) - decay) if d >= 0
                   else max(0.0, (current + STALL) * decay - STALL))
        largest = max(largest, current - reference)
    return largest


def hysteresis_frequency(current, band):
    low, high = current - band, current + band
    return 1 / (TAU * log((STALL - low) / (STALL - high)) + TAU * log(high / low))


def made_up(settle, damping, full_torque, steps, end):
    """The position in rad at the end, if the integral of the speed controller winds up. It is the integral of the
    speed reference, less a part that belongs to the final value of the controller's integral. Returns lower and upper
    limit."""
    w0 = 4.6 / (damping * settle)
    z = cmath.exp(complex(-damping * w0, w0 * sqrt(1 - damping**2)) * T)
    pole = exp(-T * B / J)
    gain = full_torque / B * (1 - pole)
    ki = (abs(z)**2 + 1 - 2 * z.real) / gain
    asked = sum(w * (until - at) for (at, w), until in zip(steps, [at for at, _ in steps[1:]] + [end]))
    middle, sampling = asked - B * steps[-1][1] / full_torque * T / ki, full_torque / J * T / 2 * end
    return middle - sampling, middle + sampling


FLOATING = 2 / 3 * K_E * 100 * 0.75 * T / L_S  # A; the largest current pulse of the free phase
FLOATING_LATE = 2 / 3 * (2 * K_E * 100 / SECTOR) * T**2 / 2 / L_S  # A; the same for an off-time that contains the middle of the sector
BURST = (K_T * 1.25 - 0.02) * 0.02 / J
BRAKE = (K_T * 100 - 2 * R) / U  # the duty at which the braking current at 100 rad/s is 2 A
IN_BAND = 1e-9 / 0.4
AMPLIFIED = read_late(5, 1 / (2 * pi * 160e3), 1e-6)
DIP = 3 * L / (U - 2 * K_T * 200) / (pi / 3 / PAIRS / 200)  # the part of a sector that a commutation takes at 200 rad/s


def after_commutation(emf, current):
    """The current of the staying phase when the leaving phase has no current. The duty is the constant duty that
    drives this current through the pair."""
    duty_V = 2 * emf + R * current
    leaving, staying = (duty_V + 2 * emf) / (1.5 * R), (4 * emf - duty_V) / (1.5 * R)
    return (current + staying) * leaving / (leaving + current) - staying


def commutation_held(emf, current, speed):
    """The lower limit of the current with a duty step. The first term is the largest decrease caused by the back-EMF
    of the leaving phase, the second the decrease in one period without the step."""
    sectors = L_S * current / (2 * emf + 0.75 * R * current) / (pi / 3 / PAIRS / speed)
    return current * (1 - sectors / 4) - (2 * emf + R / 2 * current) / (3 * L_S) * T


COMMUTATING = K_E * 150  # V
PAIR_RIPPLE = (2 * COMMUTATING + 3 * R) * (1 - (2 * COMMUTATING + 3 * R) / U) * T / (2 * L)  # A; half of the current ripple at 3 A


def fifth(x):
    """The torque of two phases divided by K_e I. x is the angle from the middle of their sector, and the back-EMF has
    7 % of fifth harmonic."""
    return sqrt(3) * (cos(x) - 0.07 * cos(5 * x))


def largest_fifth():
    return max(fifth(n * pi / 6 / 20000) for n in range(20001))


def salient_tau(electrical_deg):
    """The time constant of the phases a and b on a held salient rotor, by model.md (7)."""
    return 2 * (0.29e-3 + 0.05e-3 * cos(radians(2 * (electrical_deg - 150) - 120))) / R


TURN_W = 100 * pi / 3  # 1000 rpm
LOOP = 3 * 0.2 * pi / 3 * K_T * TURN_W / hypot(1.5 * R, 3 * PAIRS * TURN_W * 1.5 * L)
LOOP_LOSS = 1.5 * R * LOOP**2 / 6
K_E_FIFTH = K_T / (3 / pi * sqrt(3) * (1 - 0.07 / 5))
IGBT = (U - 2 * 1.2) / (R + 2 * 0.02)
FADES = 0.02 / 2 / 2e-6
RINGS = sqrt(1 / (2e-6 * 470e-6) - FADES**2)
LOAD_J = 4e-5
SHAFT = sqrt(2 * (1 / J + 1 / LOAD_J))
GEARED = K_T * 5 / (J + 1.215e-4 / 9) * 5e-3
RADIUS = 0.02  # m; with this radius the linear motor has the data of the 251601
MASS = J / RADIUS**2

R_B, R_1, C_1, C_BUS = 0.08, 0.05, 0.4, 470e-6  # ohm, ohm, F, F: the battery's model and the bus capacitor
SAG = U / (R + R_B + R_1)
TAKEN = (0.3 * U + R_1 * C_1 * SAG * R_1 + R * C_BUS * (SAG * R - U) - L * SAG) / (R + R_B + R_1)  # A s, in 0.3 s


def recovered(t):
    """The bus voltage after the stall. The vector y = (U_0 - u, v_1) follows y' = A y, with the bus voltage u and its
    source U_0. exp(A t) has a closed form, because A has two rows and two columns."""
    a, b = 1 / (R_B * C_BUS), 1 / (R_B * C_1)
    middle, det = -(a + b + 1 / (R_1 * C_1)) / 2, a / (R_1 * C_1)
    root = sqrt(middle**2 - det)
    lacks, v_1 = U - SAG * R, SAG * R_1
    return U - exp(middle * t) * (cosh(root * t) * lacks + sinh(root * t) / root * (a * (v_1 - lacks) - middle * lacks))


TOPS = sqrt(2) * 18 - 2 * 0.8


def mains(pulses):
    """The limits behind a rectifier with the given pulses per period. The duty is 0.2, the rotor is held, and the
    capacitance is 4.7 mF."""
    d, period = 0.2, 1 / 50 / pulses
    fall = (d**2 * TOPS / R * period + d * (1 - d) * d * TOPS / R * T) / 4.7e-3
    feeds = acos((TOPS - fall + 2 * 0.8) / (sqrt(2) * 18)) / pi / 50  # s, upper bound
    off, least = period - feeds, d * (TOPS - fall) / R
    return [(None, TOPS), (d * least * off / 4.7e-3, fall), (least * sqrt(d * off / period * (1 + d * off / feeds)), None)]


FALLS, SLOWS = 0.6 * 0.67 / 20 / (J + 0.6 * 1e-3 / 400), B / (J + 0.6 * 1e-3 / 400)


def falling(begin):
    """The increase of the speed from 70 to 100 ms, if the load falls from the instant `begin` on."""
    return FALLS / SLOWS * (exp(-SLOWS * (0.07 - begin)) - exp(-SLOWS * (0.1 - begin)))


PUMP_J = J + 3e-5
WATER, CHURN = 0.056 / 200 + B, 0.004 / 100 + B
CLOSES = PUMP_J / WATER * log((0.06 + 300 * B) / (0.004 + 100 * B))
C_W, C_H, R_WH = 17.7 / 4.5, 212 / 4.25, 4.5
HOT = C_W * (100 + 0.00393 * 100**2 / 2) * R / 12**2
BUILD = 2 * L / (U - K_T * 20) / (pi / 3 / PAIRS / 20)  # part of a sector in which the current of 2 A rises at 20 rad/s
PASSES = 1.5 * 2 * L / U / (pi / 3 / PAIRS / 20)  # part of a sector in which 2 A change to another phase


def pulse(sign):
    """The time until the current along the axis of a saturating magnet is 10 A. The sign says whether the current
    acts with or against the magnet. It follows from model.md (7) with a correction for the saturation."""
    a, ends = sign * 2 / sqrt(3) / 40, log(1 - R * 10 / U)
    return 2 * 0.24e-3 * (-ends / R + a * (10 / R + U * ends / R**2))


def losses(period):
    """Switching loss, conduction loss and junction temperature at a chopped duty of 0.2. Each device has 10 mohm, and
    all losses heat one junction."""
    d, tau, stall = 0.2, L / (R + 0.02), U / (R + 0.02)
    a, b = exp(-d * period / tau), exp(-(1 - d) * period / tau)
    high = stall * (1 - a) / (1 - a * b)
    low, lacks = high * b, stall - high * b
    on = stall**2 * d * period - 2 * stall * lacks * tau * (1 - a) + lacks**2 * tau / 2 * (1 - a**2)  # integral of i^2 over the on-time
    off = high**2 * tau / 2 * (1 - b**2)
    switching = U / 2 * (low + high) * 20e-9 / 0.1 / period
    return [near(switching), near(0.02 * (on + off) / period), near(25 + 40 * (switching + 0.01 * on / period))]


def weakened(w):
    """The rms phase current at a speed at which only friction brakes. The voltage is 0.95 of the circle, and i_d is
    found by bisection."""
    # The voltage vector is constant over a period, and the rotor turns by 2 x. Thus the mean voltage has the factor sin(x)/x.
    turns = w * PAIRS * T / 2
    circle, i_q, low, high = 0.95 * U / sqrt(3) * sin(turns) / turns, B * w / (1.5 * K_E_SINE), -K_E_SINE / PAIRS / L_S, 0.0
    for _ in range(100):
        i_d = (low + high) / 2
        v = hypot(R / 2 * i_d - w * PAIRS * L_S * i_q, R / 2 * i_q + w * PAIRS * L_S * i_d + w * K_E_SINE)
        low, high = (low, i_d) if v > circle else (i_d, high)
    return hypot(low, i_q) / sqrt(2)


K_E_SINE = K_T * pi / 3 / sqrt(3)  # K_t over the sector mean of a sine between two phases
HELD = hypot(R / 2 * 5.5 + 20 * K_E_SINE, 20 * PAIRS * L_S * 5.5) * T / 4 / L_S

F_1 = 4 / pi * sin(pi / 6) / (pi / 6)  # the fundamental of a trapezoid with a flat top of 120 degrees
SHAPED = 1.5 * K_E * F_1 * 4  # the torque at 4 A
# The upper bound of the torque change in N m. The current and the shape vector have their largest size, 4/3. The voltage that
# keeps the current constant is missing for a quarter of a period.
LEFT = 1.5 * K_E * 4 / 3 * hypot(R / 2 * 4 + 20 * K_E * 4 / 3, 20 * PAIRS * L_S * 4) * T / 4 / L_S
COPPER = 1.5 * R / 2 * 4**2


def finite_set():
    """The band of the currents, and the time from 6 to -6 A with the fastest and with the slowest vector. The period
    is 20 us."""
    period, emf = 20e-6, 20 * K_E_SINE
    band = 2 / (3 * sqrt(3)) * (1 - exp(-period / TAU)) / (R / 2) * U
    def falls(volts, to):
        end = (volts + emf) / (R / 2)
        return TAU * log((6 + end) / (to + end))
    return [(None, 6 + band), (6 - band, None), (period + falls(2 * U / 3, -4.8), 2 * period + falls(U / sqrt(3), -6)), (None, 1 / (2 * period))]


# (min, max) of each requirement. None: the file has no such limit.
LAWS = {
    **position_laws.LAWS,
    **magnet_laws.LAWS,
    **profile_laws.LAWS,
    **belief_laws.LAWS,
    "chopping-soft": [near(0.5 * STALL), near(ripple(0.5)), (0, 0)],
    "chopping-hard": [near((2 * 0.75 - 1) * STALL), near(2 * ripple(0.75)),
                      near(-STALL * (1 - 2 * A + A * B_OFF) / (1 - A * B_OFF))[::-1]],
    "free-phase-soft": [(0, 0), (FLOATING * (1 - 4 * T / SECTOR) * (1 - 0.75 * T * R / L), FLOATING)],
    "free-phase-hard": [(0, 0)],
    "free-phase-pwm-on-pwm": [(0, 0), (0, FLOATING_LATE), (-1e-12, 0)],
    "commutation-plain": [(K_T * (after_commutation(COMMUTATING, 3) - PAIR_RIPPLE), None)],
    "commutation-duty-step": [(K_T * (commutation_held(COMMUTATING, 3, 150) - PAIR_RIPPLE), None)],
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
    "machine-sine-field": [near(1.5 * K_E_SINE * 5.5, 5e-4), (None, 1.5 * K_E_SINE * (5.5 + HELD)), (1.5 * K_E_SINE * (5.5 - HELD), None)],
    "shape-constant": [near(SHAPED, 1e-3), (SHAPED * 4 / 3 / F_1 - LEFT, SHAPED * 4 / 3 / F_1 + LEFT), (SHAPED * 2 / sqrt(3) / F_1 - LEFT, SHAPED * 2 / sqrt(3) / F_1 + LEFT)],
    "shape-followed": [near(SHAPED, 1e-3), (None, SHAPED + LEFT), (SHAPED - LEFT, None), near(COPPER * F_1**2 * sqrt(3) * pi / 8, 1e-3)],
    "finite-set": finite_set(),
    "field-weakened": [near(900, 1e-4 / 0.9), near(weakened(900), 1e-3)],
    "stiction": [(0, 0), (0, BURST), (0, 0)],
    "wind-up-none": [(None, T + 1e-3), near(300, 1e-3)],
    "wind-up": [made_up(0.02, 0.9, 0.1, [(0, 900), (0.25, 300)], 0.8), near(300, 1e-3)],
    "one-shunt": [(5 - 0.005 - 0.22 * T / TAU / 24, 5 + 0.005 + 0.22 * T / TAU / 24), (None, 2e-6 / T * STALL)],
    "shunts-three": [(0.99 * 3 * K_E_SINE, 1.01 * 3 * K_E_SINE)] * 2,
    "shunts-two": [(0.99 * 3 * K_E_SINE, 1.01 * 3 * K_E_SINE)],
    "slow-amplifier": [(AMPLIFIED - 20.48 / 2**16, AMPLIFIED + 20.48 / 2**16)],
    "wrong-gains": [near(overshoot(4.1, 4.0, 2.0))],
    "sampled-too-slowly": [(0.02 - 2 * 500e-6, None)],
    "reversal": [(J * 392 / (K_T * (3 + U * T / 4 / L) + B * 200), J * 392 / (K_T * 3) / (1 - DIP / 2)), (None, -2)],
    "delta-loop": [near(LOOP_LOSS, 1e-5), near(-LOOP_LOSS / TURN_W, 1e-5)[::-1], (0, 0)],
    "salient-q": [near(salient_tau(30), 1e-5)],
    "salient-beside": [near(salient_tau(0), 1e-5)],
    "machine-fifth": [(K_E_FIFTH * largest_fifth() * 4.99, K_E_FIFTH * largest_fifth() * 5.01),
                      (K_E_FIFTH * fifth(PAIRS * 20 * 6.5e-3 - pi / 6) * 4.99, K_E_FIFTH * fifth(PAIRS * 20 * 6.5e-3 - pi / 6) * 5.01)],
    "cogging": [near(sqrt(2 * 5e-3 / (48 * J))), near(180 / 48)],
    "phases-stray": [(K_E * 2.04 * 4.99, K_E * 2.04 * 5.01), (K_E * 1.96 * 4.99, K_E * 1.96 * 5.01)],
    "igbt": [near(IGBT), near(2 * IGBT * (1.2 + 0.02 * IGBT), 1e-5)],
    "hot-plug": [near(U + 23.5 * exp(-pi * FADES / RINGS)), near((pi - atan2(RINGS, FADES)) / RINGS, 1e-5)],
    "braking-chopper": [near(28, 1e-9), near(27, 1e-9)],
    "elastic-shaft": [near(3 * (J - LOAD_J) / (J + LOAD_J))[::-1], near(pi / 2 / SHAFT)],
    "gear": [near(GEARED, 0.01 / 5)],
    "fan": [near(J / 4e-7 / 300), near(300 / (1 + 4e-7 * 300 * 0.5 / J))],
    "weight": [near(-sqrt(2 * 0.05 / (J + 1e-3)))[::-1], near(180)],
    "broken-wire": [(0, 0), (K_T * 1.99, K_T * 2.01), (0, 0)],
    "wires-swapped": [(None, 360 / PAIRS), (-2 * pi / PAIRS / 0.05, 2 * pi / PAIRS / 0.05)],
    "wires-mirrored": [near(-K_T * STALL)[::-1], near(STALL)],
    "linear-motor": [(0.9 * 2 * (MASS + 0.1) / 15, None), near(5 + B / RADIUS**2 * 2, 2e-3)],
    "battery-sag": [near(SAG), near(SAG * R), near(recovered(0.5e-3)), near(recovered(20e-3)), near(1 - TAKEN / 7200, 1e-8)],
    "mains-single-phase": mains(2),
    "mains-three-phase": mains(6),
    "gear-losses": [(None, 0), (None, 0), (falling(0.06), falling(0.061))],
    "dynamometer": [near(-(2e-3 + B * w + J * dw))[::-1] for w, dw in [(125, 250), (375, 250), (375, -250)]],
    "pump": [near(CLOSES), near(CLOSES + PUMP_J / CHURN * log(2))],
    "hot-winding": [(HOT, HOT / (1 - 100 / R_WH * R * 1.393 / 12**2)), (None, 25 + 12**2 / R * 12 / C_H)],
    "open-switch": [(0, 0), (K_T * 1.99, K_T * 2.01), (2 / 3 * K_T * 1.99 * (1 - BUILD / 4), 2 / 3 * K_T * 2.01 * (1 + 3 / 8 * PASSES))],
    "pulse-north": [near(pulse(1))],
    "pulse-south": [near(pulse(-1))],
    "losses-20-khz": losses(50e-6),
    "losses-100-khz": losses(10e-6),
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
