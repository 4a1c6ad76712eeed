# SPDX-License-Identifier: Apache-2.0
"""position_laws.py: laws of the gallery's scenarios about the estimated rotor position, and about the sensors of
position and current."""
from math import atan, atan2, cos, degrees, exp, pi, radians, sin, sqrt

from gallery_sheet import (I_N, J, K_E, K_T, L, LOOP_GAIN, L_S, PAIRS, R, SECTOR, STALL, T, U,
                           halves, lagged, near, read_late)


def late(degrees):
    """The mean torque as a part of K_t i, if the pair is switched `degrees` too late."""
    return 1 - degrees**2 / 7200


SEEN_LATE = PAIRS * 300 * 100e-6 * 180 / pi  # the delay of an edge in electrical degrees: a filter of 100 us at 300 rad/s
# the electrical degrees until the current has commutated to the next phase
PASSED_LATE = PAIRS * 300 * 3 * 2 * L_S / (U + 2 * K_E * 300) * 180 / pi
SWING = 2 * pi * sqrt(J / (PAIRS * K_T * 1.5 * I_N))  # s; the period of the oscillation about the pair's rest angle
SLOWEST, RAMP = 0.05 * U / K_T, (K_T * I_N * (1.5 - 0.5) - 0.01) / (2 * J)  # rad/s at the end of the ramp; rad/s^2
LONGEST_RAMP = 2 * 2 * SLOWEST / RAMP + 12 * pi / 3 / PAIRS / SLOWEST
# s; the time in which the drive detects a rotor that already turns.
LISTENED = 6 * L_S * 2.5 * I_N / U + 2 * T + 2 * pi / 3 / PAIRS / SLOWEST


def two_period_pulses():
    """The duration of the pulses in s, and the largest shaft angle in degrees by which they turn the rotor
    (design/loops/pulse_start.hpp)."""
    apart, t, l_d, l_q, i_sat, most = 5 * T, 1.5 * T, 0.24e-3, 0.34e-3, 40, 1.5 * I_N
    i = STALL * (1 - exp(-R * t / 2 / (l_d * (1 - 2 / sqrt(3) * most / 2 / i_sat))))
    p = pi / 3 * K_T * i * t
    depth = 2 / sqrt(3) * l_d * i / (2 * i_sat * (l_d + l_q) / 2)
    uneven = PAIRS * (l_q - l_d) * i**2 * 2 / 3 * t + 6 * sqrt(3) / 16 * depth * p
    return 64 * T + 48 * apart, degrees(8 * apart / J * (2 * p + 12 * uneven))


PULSED, TURNED = two_period_pulses()


def closed_loop_peak(damping):
    """The largest gain of (2 D w s + w^2)/(s^2 + 2 D w s + w^2), with the damping D and the Laplace variable s."""
    return max(abs((1 + 2j * damping * x) / (1 - x * x + 2j * damping * x)) for x in (n / 1000 for n in range(1, 3000)))


def link_reads(reading, lag=1 / (2 * pi * 150e3)):
    """The mean current of a centred pulse, if the sensor in the DC link samples `reading` in the middle of the pulse.
    The sensor has a lag, and outside of the pulse the link has no current."""
    low, high = 0.0, 1.0
    for _ in range(60):
        middle, x = (low + high) / 2, 0.0
        a, b = halves(middle)
        bottom = STALL * (1 - a) / (1 - a * b) * b
        for _ in range(100):
            x = lagged(x, STALL, bottom, lag, middle * T) * exp(-(1 - middle) * T / lag)
        low, high = (middle, high) if lagged(x, STALL, bottom, lag, middle * T / 2) < reading else (low, middle)
    return low * STALL


def half_count(value):
    return value - 20.48 / 2**16, value + 20.48 / 2**16


def tracking(bandwidth, period):
    """K_p and K_i of a critically damped tracking loop of type 2 (design/loops/tracking_loop.hpp)."""
    x = 2 * pi * bandwidth / sqrt(3 + sqrt(10)) * period
    return 1 - exp(-2 * x), (1 - exp(-x))**2


def noise_rms():
    """The rms noise of the current reference. The noise is the mean of two samples, filtered by the tracking loop and
    the PI controller."""
    k_p, k_i = tracking(500, T)
    w = angle = out = before = squares = 0.0
    for n in range(3000):
        error = (0.5 if n < 2 else 0) - angle
        w += k_i * error
        angle += w + k_p * error
        out += 1.582e-3 * -w / T - 1.5806e-3 * before
        before = -w / T
        squares += (out * 0.78 / K_T)**2
    return sqrt((5e-3**2 + (5 / 4096)**2 / 12) * squares) / (2 * cos(radians(60)))


def missed_rms(each=360 * PAIRS / 4096, mean=400 * 2 * pi / 100):
    """The rms delay of a commutation in degrees. It has two causes: sampling, and the edges missed since the index."""
    period = 100 * PAIRS * T * 180 / pi
    u, scatter = (period + each) / 2, (period**2 + each**2) / 12
    return sqrt(each**2 * (mean / 2 + mean**2 / 3) + each * mean * u + u**2 + scatter)


def pole_noise():
    """The mean square of the mean of two samples after two poles. The poles are those of the lag in
    design/loops/sensorless_observer.hpp."""
    m = 0.2 * pi / 3 / PAIRS * K_T / U / T - 0.5
    p, slow, estimate, squares = m / (2 + m), 0.0, 0.0, 0.0
    for n in range(200):
        slow += (1 - p) * ((0.5 if n < 2 else 0) - slow)
        estimate += (1 - p) * (slow - estimate)
        squares += estimate**2
    return squares


LOOK = sqrt(6) * 0.05 / (2 * K_E * 60 / 30) * sqrt(26) / 4  # degrees; the error of a commutation at 60 rad/s, with single samples
E_20 = pi / 3 / PAIRS / 20  # s; the duration of a sector at 20 rad/s
CHIP_LAG = degrees(atan(1e4 * PAIRS * 2e-6**2 / tracking(200, 2e-6)[1]))
PERIOD = PAIRS * T * 180 / pi  # electrical degrees per period, for each rad/s
ROUNDS = degrees(sqrt(2) / 2 * 5 / 4096 / 2) + 360 / 65536
COUNT = 360 / 16384


RUBBED = 60 / PAIRS * 0.01 / (K_T * 1.99)  # degrees; the error about the angle at which a pair has no torque


def ramp(part):
    return K_T * 1.99 * part, K_T * 2.01 * part


def around(value, by):
    return value - by, value + by


# (min, max) of each requirement. None: the file has no such limit.
LAWS = {
    "hall-hysteresis": [near(5 + 10, 1e-4 / 15), near(10 - 5, 1e-4 / 5)],
    "hall-magnets": [near(3, 1e-4 / 3), (LOOP_GAIN * 100 * (360 / 357 - 360 / 363), None)],
    "hall-glitches": [(None, 6 * 100 * PERIOD * (1 + T / SECTOR + 0.004)), near(100, T / SECTOR + 0.004)],
    "hall-inverted": [ramp(3.5e-3 / E_20), ramp(1 - (10e-3 - E_20) / E_20)],
    "hall-stuck": [ramp(1), ramp(1 - (49e-3 - 7 * E_20) / E_20)],
    "hall-interpolated": [(None, 300 * (PERIOD + PAIRS * 1e-6 * 180 / pi))],
    "encoder-misses": [near(missed_rms(), 0.1)],
    "load-side-incremental": [around(radians(45), radians(2 * COUNT)), around(radians(45), radians(2 * COUNT)),
                              around(90 + degrees(2 * 0.1 / 10), 4 * COUNT), around(90 - degrees(2 * 0.1 / 10), 4 * COUNT)],
    "resolver-skew": [around(180 - 2, ROUNDS), around(180 + degrees(atan2(1 / 1.02 - sin(radians(2)), cos(radians(2)))), ROUNDS),
                      around(270, ROUNDS)],
    "resolver-noise": [near(noise_rms(), 4 * 0.0154)],
    "resolver-tracking": [(CHIP_LAG, CHIP_LAG + 100 * PERIOD + 360 / 2**14),
                          (None, 200 * PERIOD + 360 / 2**14)],
    "amplifier-drift": [half_count(read_late(5, 1e-12, 0)), half_count(read_late(5, 1e-12, 0)), half_count(read_late(5 / 1.02, 1e-12, 0))],
    "link-transducer": [half_count(link_reads(5)), half_count(link_reads(4.8))],
    "sensorless-noise": [(LOOK * sqrt(0.5), LOOK)],
    "sensorless-luenberger": [(None, LOOK / 0.88 * sqrt(pole_noise()))],
    "sensorless-sliding-mode": [near(60, T * 60 * PAIRS * 3 / pi + 0.004)],
    "sensorless-flux-linkage": [around(30 * (1 / sqrt(0.88) - 1), 60 * PERIOD / 2)],
    # The delay is shorter than an off-time. The lead compensates the low-pass of the comparators.
    "sensorless-comparators": [(None, 60 * PERIOD)],
    "hall-glitch": [near(100, T / SECTOR + 0.004)],
    "hall-60": [near(100, T / SECTOR + 0.004)],
    "hall-offset": [(2 * K_T * late(15) * (1 - (2 * L / (U - K_T * 20) + 3 * 1.5 * 2 * L / U) / (2 * pi / PAIRS / 20)), 2 * K_T * late(15)),
                    (K_T * 1.99 * 3 / 4, K_T * 2.01 * 3 / 4)],
    "hall-delay": [(2 * K_T * late(SEEN_LATE + PASSED_LATE), 2 * K_T * late(SEEN_LATE))],
    "hall-misplaced": [(LOOP_GAIN * 100 * (60 / 55 - 60 / 66), None),
                       (None, K_T / J * LOOP_GAIN * 100 * (60 / 55 - 60 / 66) * SECTOR)],
    "hall-misplaced-six": [(None, K_T / J * (LOOP_GAIN * 100 * (1 - 60 / 66) * SECTOR / 10 + 0.6 * 2 * T)), near(100, T / SECTOR + 0.004)],
    # An upper bound. The angle of an edge is right within two ticks of 1 us, and a time within one more tick. This is true at
    # both ends of the narrowest sector and in both directions. The error acts for the duration of the widest sector.
    "hall-calibrated": [(None, K_T / J * (LOOP_GAIN * 100 * 4 * 3e-6 / (SECTOR * 55 / 60) * SECTOR * 66 / 60 + 0.6 * 2 * T)), near(100, T / SECTOR + 0.004)],
    "encoder": [(450 - 2 * 360 / 4096, 450 + 2 * 360 / 4096)],
    "absolute-encoder": [(1000 - 2 * 360 / 2**14, 1000 + 2 * 360 / 2**14), (None, 2 * 360 / 2**14)],
    "encoder-missed": [(180 + 38 * 360 / 4096, 180 + 42 * 360 / 4096), (450 - 2 * 360 / 4096, 450 + 2 * 360 / 4096)],
    "absolute-bad-track": [(K_T * 1.99, K_T * 2.01), (-K_T * 2.01, -K_T * 1.99)],
    "resolver-broken-winding": [(K_T * 1.99, K_T * 2.01), (K_T * 1.99 / 2, K_T * 2.01 / 2)],
    "encoder-stuck-line": [around((30 + 90) / PAIRS, RUBBED), around(0, 1e-9)],
    "resolver-excitation": [ramp(1), ramp(1)],
    "load-side-encoder": [(90 + degrees(2 * 0.1 / 40) - 4 * 360 / 2**16, 90 + degrees(2 * 0.1 / 40) + 4 * 360 / 2**16)],
    "resolver": [(2 * 0.02 * 100, 2 * 0.02 * 100 * closed_loop_peak(0.7))],
    "sensorless-start": [(12 * SWING, 12 * SWING + LONGEST_RAMP + 0.1), (None, 100 * PAIRS * T * 180 / pi), near(100, T / SECTOR + 0.004)],
    "sensorless-pulses": [(PULSED + 95 * J / (K_T * 1.5 * I_N), LISTENED + PULSED + LONGEST_RAMP + 0.1), (degrees(0.3) - TURNED, None)],
    "sensorless-held": [(None, 0)],
    "sensorless-fallback": [(None, 1e-6), (None, 100 * PAIRS * T * 180 / pi), near(100, T / SECTOR + 0.004)],
}
