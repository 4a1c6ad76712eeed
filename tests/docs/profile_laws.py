# SPDX-License-Identifier: Apache-2.0
"""profile_laws.py: laws of the gallery's position moves, by a step and by a profile with ramps of its acceleration."""
from math import radians, sqrt

from gallery_sheet import B, J, K_T, near

WAY, V, A, JERK, K_P = radians(720), 100, 3000, 0.6e6, 0.5  # rad, rad/s, rad/s2, rad/s3, rad/s per degree
RISES = A / JERK
MIDDLE = A * ((0.008 + 0.03) / 2 - RISES / 2)  # rad/s, between 8 and 30 ms
LASTS = RISES / 2 + sqrt(2 / A * (0.02 * WAY - A * RISES**2 / 24))  # s; the time for the last 2 % of the distance
ARRIVES = WAY / V + V / A + RISES - LASTS
STRIDE = 1e-4

LAWS = {
    "position-step": [(0.1 / K_T, 0.1 / K_T)],
    "position-profile": [near((J * A + B * MIDDLE) / K_T, 0.02), (-V / K_P / 1000, V / K_P / 1000), (ARRIVES, ARRIVES + 4 * STRIDE),
                         (720 * (1 - 1e-4), None), (None, 720 * (1 + 1e-4))],
}
