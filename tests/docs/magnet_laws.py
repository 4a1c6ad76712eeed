# SPDX-License-Identifier: Apache-2.0
"""magnet_laws.py: laws of the gallery's field-oriented scenarios without a rotor sensor
(design/loops/field_estimate.hpp)."""
from math import degrees, pi, sqrt

from gallery_sheet import J, K_T, PAIRS, R, U, near

PERIOD, LIMIT, COULOMB = 50e-6, 0.1, 5e-3  # s, N m, N m
PEAK = K_T / (2 * sqrt(3) * 0.5 * 3 / pi)  # V s; the mean of the sine over a pair's sector is 3/pi of its largest value, sqrt 3 PEAK
CIRCLE, FULL_A = U / sqrt(3), LIMIT / (1.5 * PEAK)

# The effect of a rounding error of half a digit in each of four samples, relative to the current's response to the injected
# pulse.
L_D, L_Q, DIGIT = 0.24e-3, 0.34e-3, 2 * 10.24 / 2**12
PULSE = min(CIRCLE / 4, FULL_A / 5 * L_D / PERIOD)
ROUNDED = degrees(DIGIT / 2 * 8 / 4 / (PULSE * PERIOD * (1 / L_D - 1 / L_Q)))

# A round rotor is aligned first. Then the drive rotates it until the flux observer takes effect.
STARTS = 10 * (2 * J * R / 2 / (1.5 * PEAK**2) + PEAK / (PAIRS * R / 2 * FULL_A))
FOLLOWED = 0.1 * CIRCLE / PEAK
RAMP = FOLLOWED / (LIMIT / 8 / J)
DRIVEN = (200 - FOLLOWED) * J / (LIMIT - COULOMB)
SETTLED = 0.06

STANDS = near(degrees(0.45), 1e-9)
LAWS = {
    "field-injection": [(None, ROUNDED), (-ROUNDED, None), STANDS, (200 - 0.03, 200 + 0.03)],
    "field-observer": [(STARTS + RAMP, STARTS + RAMP + DRIVEN + SETTLED), (200 - 0.025, 200 + 0.025), (None, 0.5)],
}
