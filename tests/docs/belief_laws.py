# SPDX-License-Identifier: Apache-2.0
"""belief_laws.py: laws for the gallery's drives that assume a wrong value of the motor or sensor ([believed])."""
import cmath
from math import asin, cos, degrees, exp, pi, radians, sin, sqrt

from gallery_sheet import B, J, L_S, PAIRS, R, near
from magnet_laws import PEAK, PERIOD

R_S, K_Q = R / 2, 1.5 * PEAK  # phase resistance; torque per ampere on the q axis


def placed(bandwidth_Hz, resistance, inductance):
    """The coefficients d1 and d0 of a PI controller that cancels the pole of the winding, if the command acts one
    period late (design/loops/field_current.hpp)."""
    a, z = exp(-resistance * PERIOD / inductance), exp(-2 * pi * bandwidth_Hz * PERIOD)
    d1 = z * (1 - z) * resistance / (1 - a)
    return d1, -a * d1


def highest(bandwidth_Hz, resistance, inductance):
    """The largest sample of the current after a unit step. The PI controller is designed for the believed winding and
    acts on the true winding."""
    d1, d0 = placed(bandwidth_Hz, resistance, inductance)
    a, current, voltage, late, before, most = exp(-R_S * PERIOD / L_S), 0.0, 0.0, 0.0, 0.0, 0.0
    for _ in range(400):
        error = 1 - current
        voltage, acts, before = voltage + d1 * error + d0 * before, voltage, error
        current = a * current + (1 - a) / R_S * acts
        most = max(most, current)
    return most


def swings(settle_s, damping, torque, reference, believed_J):
    """The largest sample of the speed after a step. The PI controller is designed for the believed inertia and acts
    on the true inertia."""
    w0 = 4.6 / (damping * settle_s)
    z = cmath.exp(complex(-damping * w0, w0 * sqrt(1 - damping**2)) * PERIOD)
    pole = exp(-PERIOD * B / believed_J)
    b0 = torque / B * (1 - pole)
    d1, d0 = (-2 * z.real + pole + 1) / b0, (abs(z)**2 - pole) / b0
    pole, speed, part, before, most = exp(-PERIOD * B / J), 0.0, 0.0, 0.0, 0.0
    for _ in range(12000):
        error = reference - speed
        part, before = part + d1 * error + d0 * before, error
        speed = pole * speed + torque / B * (1 - pole) * part
        most = max(most, speed)
    return most


def runs_back(current, offset_deg, bandwidth_Hz, after_s):
    """The speed of a free shaft if the current is `offset_deg` away from the normal of the magnet. The decoupling
    then acts on the wrong axis. Thus the current lags behind its reference: the lag is the slope of the back-EMF
    divided by the gain of the integral."""
    d = radians(offset_deg)
    torque = K_Q * current * cos(d)
    slope = PEAK * abs(torque) / J / (sum(placed(bandwidth_Hz, R_S, L_S)) / PERIOD)
    late_q, late_d = (1 - cos(d)) * slope, sin(d) * slope
    torque -= K_Q * (cos(d) * late_q - sin(d) * late_d)
    return torque / B * (1 - exp(-after_s * B / J))


def leads(inductance, torque):
    """The angle error in degrees of a flux observer with this inductance, and the current on the q axis that gives
    the torque."""
    x = (L_S - inductance) * torque / K_Q / (PEAK / PAIRS)  # sin d cos d, with the angle error d
    d = asin(2 * x) / 2
    return degrees(d), torque / K_Q / cos(d)


HELD = 5 * K_Q
BACK = runs_back(2, 120, 800, 0.05)
LEAD, ACROSS = leads(2 * L_S, 0.04 + B * 200)
PEAK_SPEED = swings(0.1, 0.9, 0.1, 20, J / 4)
LAWS = {
    "belief-offset": [(HELD * cos(radians(27.4)), HELD * cos(radians(26.6))), (26.6, 27.4)],
    "belief-offset-past-90": [near(BACK, 0.01)[::-1]],
    "belief-hall-table": [(None, 360 / PAIRS)],
    "belief-pole-pairs-hall": [near(100 * 12 / 8, 1 / 150)],
    "belief-pole-pairs-encoder": [(-0.01 * HELD, 0.01 * HELD), near(HELD / sqrt(2), 0.01)],
    "belief-resistance": [near(2 * highest(400, R, L_S), 0.002)],
    "belief-inductance": [near(2 * highest(2000, R_S, 2 * L_S), 0.002)],
    "belief-observer": [(LEAD - 0.2, LEAD + 0.2), near(ACROSS, 0.003)],
    "belief-torque-constant": [near(2 * 0.1, 0.015)],
    "belief-inertia": [(0.9975 * PEAK_SPEED, 1.005 * PEAK_SPEED)],
}
