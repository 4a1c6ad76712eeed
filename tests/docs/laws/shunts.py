# SPDX-License-Identifier: Apache-2.0
"""Laws of low-side shunts: duty and modulation of their window, by settling, dead time and period of gallery/shunts-*.toml."""
import re
from math import hypot, pi, sqrt

from gallery_sheet import K_T, PAIRS, R, L, U
from laws import design

D = 1 - 2 * (2 + 0.5) / 50  # both times in us of a period of 50 us
E = K_T * pi / 3 / sqrt(3)  # peak of the sine's back-EMF over the speed


def lost(test, spot):
    """Two shunts: the remark's numbers, and the torque 3/2 p psi i_q of 2 A beside the measured one."""
    design.deviations(test, spot)
    m = re.search(r"(\d+) of (\d+) control periods", spot.text)
    duty, most = re.search(r"up to a duty of (\S+) \(", spot.text), re.search(r"up to a modulation of (\S+),", spot.text)
    design.close(test, spot, "duty", float(duty.group(1)), D)
    design.close(test, spot, "modulation", float(most.group(1)), 2 * D - 1)
    design.close(test, spot, "periods of 90 ms", int(m.group(2)), 90e-3 / 50e-6, 0, 1)
    test.assertLess(int(m.group(1)), int(m.group(2)) * (90 - 40) / 90, "the first 40 ms are below the limit")
    test.assertGreater(int(m.group(1)), int(m.group(2)) / 4)
    torque = re.search(r"modulation of 0.88 +(\S+) mN m", spot.text)
    design.close(test, spot, "torque", float(torque.group(1)), 1000 * 3 * E, 1e-3)
    swing, sources = re.search(r"swing of the phase current +(\S+) A +(\S+) A", spot.text), 2 * 2
    test.assertEqual(float(swing.group(1)), sources)
    test.assertLess(float(swing.group(2)), 2 * sources)


def window(test, spot):
    s = design.steps(spot.text)
    most = 4 / sqrt(3) * (D - 0.5)
    for name, value in {"d": D, "m": most}.items():
        design.close(test, spot, name, s[name], value, 1e-4)
    i, w = float(re.search(r"i_q = (\S+) A", spot.text).group(1)), s["w(m)"]
    design.close(test, spot, "voltage at w(m)", hypot(E * w + R / 2 * i, PAIRS * w * L / 2 * i), most * U / sqrt(3), 1e-4)
