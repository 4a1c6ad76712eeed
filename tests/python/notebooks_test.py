# SPDX-License-Identifier: Apache-2.0
"""Each notebook agrees with its text source, runs from top to bottom, and has the outputs that it shows."""
import importlib.util
import json
import math
import re
import unittest

from package import SOURCE

NOTEBOOKS = SOURCE / "faces" / "python" / "notebooks"
spec = importlib.util.spec_from_file_location("make", NOTEBOOKS / "make.py")
make = importlib.util.module_from_spec(spec)
spec.loader.exec_module(make)


class Notebooks(unittest.TestCase):
    def ran(self, number):
        """Runs a notebook. Returns its names and its printed text. The cells must be equal to the committed file."""
        file = next(NOTEBOOKS.glob(f"{number}-*.py"))
        told, names = make.notebook(file.read_text())
        committed = json.loads(file.with_suffix(".ipynb").read_text())
        self.assertEqual([(c["cell_type"], c["source"]) for c in committed["cells"]], [(c["cell_type"], c["source"]) for c in told["cells"]],
                         "make it anew: faces/python/notebooks/make.py")
        printed = "".join("".join(o.get("text", "")) for c in told["cells"] for o in c.get("outputs", ()))
        self.assertEqual("".join("".join(o.get("text", "")) for c in committed["cells"] for o in c.get("outputs", ())), printed)
        return names, printed

    def test_first_drive(self):
        names, printed = self.ran(1)
        self.assertTrue(names["r"].passed)
        ripple = [float(x) for x in re.findall(r"^\d+us (\S+) A", printed, re.M)]
        duty, current = 2 * 1.03 / 24, 24 * 30e-6 / 0.572e-3
        self.assertAlmostEqual(ripple[0], current * duty * (1 - duty), delta=0.1 * ripple[0])
        self.assertAlmostEqual(ripple[0] / ripple[1], 2, delta=0.2)

    def test_your_motor(self):
        names, _ = self.ran(2)
        self.assertTrue(names["design"].ok)
        # The plant is a pair with R = 0.6 ohm and L = 0.45 mH, and the hold lasts 30 us. The poles are for a settling time of 1
        # ms and a damping of 0.9.
        R, L, T, xi = 0.60, 0.450e-3, 30e-6, 0.9
        a0, b0, w0 = -math.exp(-R * T / L), (1 - math.exp(-R * T / L)) / R, 4.6 / (xi * 1e-3)
        c1 = -2 * math.exp(-xi * w0 * T) * math.cos(w0 * math.sqrt(1 - xi**2) * T)
        self.assertAlmostEqual(names["gains"].d1, (c1 - a0 + 1) / b0, delta=1e-9)

    def test_speed_loop(self):
        names, _ = self.ran(3)
        self.assertGreater(names["hall"].speed.max(), names["ideal"].speed.max() + 5)

    def test_vary_and_choose(self):
        names, _ = self.ran(4)
        settle, peak = names["settle"], names["peak"]
        self.assertLess(peak[settle == 2e-3].max(), peak[settle == 1e-3].min())
        self.assertLess(peak[settle == 1e-3].max(), peak[settle == 0.5e-3].min())

    def test_your_controller(self):
        names, _ = self.ran(5)
        self.assertGreater(names["learned"], names["first"])


if __name__ == "__main__":
    unittest.main()
