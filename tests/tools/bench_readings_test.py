#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bench_readings_test.py PROGRAM: tools/bench_readings.py finds the parameters of drawn and of simulated benches within its bounds."""
import csv
import math
import pathlib
import random
import re
import statistics
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools"))
import bench_readings as tool  # noqa: E402

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else ROOT / "build/dev/sixstep"
PAGE = (ROOT / "docs/howto/measure-a-motor.md").read_text(encoding="utf-8")
SHOWN = re.search(r"<!-- test: write readings\.toml -->\n```toml\n(.*?)```", PAGE, re.S)[1]
TRUTH = {"resistance_ohm": 1.03, "flux_linkage_mWb": 0.0335 / 2 / 8 * 12 / math.pi**2 * 1e3, "inductance_mH": 0.572,
         "viscous_friction_Nm_s": 7.3e-6, "coulomb_friction_mNm": 0.0, "inertia_gcm2": 135.0}
DRAWN = dict(TRUTH, coulomb_friction_mNm=1.0)  # of the drawn benches
SHUNT = 0.1


def replaced(text, **values):
    """The file with other readings, named TABLE_KEY; no_load0_ and no_load1_ for the two points."""
    lines, at, points = [], "", -1
    for line in text.splitlines():
        if heading := re.match(r"\[+(\w+)\]", line):
            at = heading[1]
            points += at == "no_load"
        key = line.split(" = ")[0]
        place = f"{at}{points if at == 'no_load' else ''}_{key}"
        lines.append(f"{key} = {values[place]}" if place in values else line)
    return "\n".join(lines)


def drawn_bench(draw):
    """Readings of a motor whose parameters are DRAWN, by instruments with errors inside their limits."""
    def limit(x):
        return draw.uniform(-x, x)
    R, psi, L, B, T_c, J = (x * y for x, y in zip(DRAWN.values(), (1, 1e-3, 1e-3, 1, 1e-3, 1e-7)))
    gain, shunt = 1 + limit(0.005), SHUNT * (1 + limit(0.01))
    time = 1 + limit(1e-4)

    def meter(volts, places):
        return f"{volts * gain + limit(1.5 * 10.0**-places):.{places}f}"  # half of the last digit is rounding
    amperes = 1.05
    hot = R * (1 + tool.COPPER * limit(3))
    values = {"resistance_terminals_V": meter(hot * amperes, 3), "resistance_shunt_V": meter(shunt * amperes, 4),
              "emf_flux_linkage_mWb": f"{1e3 * psi / (1 + limit(0.007)) * time + draw.gauss(0, 0.0004):.5f}",
              "pulse_tau_us": f"{1e6 * L / (R + shunt) + limit(14):.1f}"}
    for n, (volts, w) in enumerate(((24.0, 700.0), (12.0, 352.0))):
        power, current = (B * w + T_c) * w, 0.0
        for _ in range(30):
            current = (power + R * current**2) / volts
        values |= {f"no_load{n}_supply_V": meter(volts, 2), f"no_load{n}_shunt_V": meter(shunt * current, 4),
                   f"no_load{n}_frequency_Hz": f"{8 * w / 2 / math.pi / time:.4f}"}
    hertz, w = 8 * 584 / 2 / math.pi, 584
    slope = (B * w + T_c) / J * 8 / 2 / math.pi
    values |= {"coast_frequency_Hz": f"{hertz / time:.4f}", "coast_Hz_s": f"{-slope + draw.gauss(0, tool.SLOPE * 0.00225 / 0.1):.3f}"}
    return replaced(SHOWN, **values)


class Readings(unittest.TestCase):
    def test_the_bench_of_the_page_finds_the_motor(self):
        found = tool.uncertain(SHOWN)
        self.assertEqual(list(TRUTH), list(found))
        for key, (x, _, half, _) in found.items():
            self.assertLessEqual(abs(x - TRUTH[key]), half, key)

    def test_resistance_by_hand(self):
        x, _, half, _ = tool.uncertain(SHOWN)["resistance_ohm"]
        self.assertAlmostEqual(x, 1.082 / 0.1050 * SHUNT, 12)
        parts = (0.01, 3 * 0.00393, 2 * 0.001 / 1.082, 2 * 0.0001 / 0.1050)  # the meter's percent cancels
        self.assertAlmostEqual(half / x, 2 * math.sqrt(sum(p * p for p in parts) / 3), 4)

    def test_drawn_benches(self):
        """The truth lies within 95 % bounds in 95 or more of 100, and the bounds are at most 3 times as wide as the errors' rms needs."""
        draw = random.Random(20261130)
        errors = {key: [] for key in TRUTH}
        for _ in range(300):
            for key, (x, _, half, _) in tool.uncertain(drawn_bench(draw)).items():
                errors[key].append((x - DRAWN[key]) / half)
        for key, parts in errors.items():
            inside = sum(abs(e) <= 1 for e in parts) / len(parts)
            self.assertGreaterEqual(inside, 0.95, f"{key}: {inside}")
            self.assertLess(abs(statistics.mean(parts)), 0.12, key)
            self.assertGreater(math.sqrt(statistics.mean(e * e for e in parts)), 1 / 3, key)

    def test_slope_of_a_frequency(self):
        """Phases of a line over T: the standard error of the slope is sqrt(60)/T times that of the frequency in the middle."""
        draw, count, span = random.Random(7), 400, 0.1
        times = [span * (n + 0.5) / count - span / 2 for n in range(count)]
        found = []
        for _ in range(300):  # least squares of a + b t + c t^2 by orthogonal polynomials
            phases = [draw.gauss(0, 1) for _ in times]
            line = sum(p * t for p, t in zip(phases, times)) / sum(t * t for t in times)
            bow = [t * t - span**2 / 12 for t in times]
            found.append((line, sum(p * b for p, b in zip(phases, bow)) / sum(b * b for b in bow)))
        by_rms = math.sqrt(sum(c * c for _, c in found) / sum(b * b for b, _ in found)) * 2  # phase 2 pi (f t + s t^2/2)
        self.assertLess(abs(by_rms * span / tool.SLOPE - 1), 0.1)


class Simulated(unittest.TestCase):
    """A bench of sixstep's motor: every recording is a run."""

    def run_scenario(self, name, text, grid_s, *columns):
        with tempfile.TemporaryDirectory() as folder:
            file, trace = pathlib.Path(folder, f"{name}.toml"), pathlib.Path(folder, "t.csv")
            file.write_text(f'motor = "maxon-251601"\nrecord.grid_s = {grid_s}\nrecord.columns = ["t_s", {", ".join(columns)}]\n{text}', encoding="utf-8")
            subprocess.run([PROGRAM, "run", file, "--csv", trace, "--quiet"], check=True, timeout=60)
            with open(trace, encoding="utf-8") as lines:
                return [[float(x) for x in row] for row in list(csv.reader(line for line in lines if line[0] != "#"))[1:]]

    def test_locked_pulse(self):
        """Two switches of 0.05 ohm are the shunt. The time to 63.2 % gives the inductance of the file."""
        rows = self.run_scenario("pulse", 'duration_s = 5e-3\nsupply.voltage_V = 2.4\ncontrol.mode = "duty"\nreference = { value = 1, unit = "1" }\n'
                                 "load.locked = true\nbridge.on_resistance_ohm = 0.05\n", 1e-6, '"i_m_A"')
        tau = next(t for t, i in rows if i >= (1 - math.exp(-1)) * rows[-1][1])
        self.assertLess(abs(1e6 * tau - 506), 2)
        x, _, half, _ = tool.uncertain(replaced(SHOWN, pulse_tau_us=f"{1e6 * tau:.0f}"))["inductance_mH"]
        self.assertLess(abs(x / TRUTH["inductance_mH"] - 1), 5e-3)

    def test_no_load_at_two_voltages(self):
        values = {}
        for n, volts in enumerate((24, 12)):
            rows = self.run_scenario("no-load", f'duration_s = 0.5\nsupply.voltage_V = {volts}\ncontrol.mode = "duty"\nreference = {{ value = 1, unit = "1" }}\n'
                                     f"initial.speed_rad_s = {702.6 if n == 0 else 353.6}\n", 5e-6, '"bus_A"', '"speed_rad_s"')
            amperes, speed = (statistics.mean(row[at] for row in rows if row[0] > 0.4) for at in (1, 2))
            values |= {f"no_load{n}_shunt_V": f"{SHUNT * amperes:.4f}", f"no_load{n}_frequency_Hz": f"{8 * speed / 2 / math.pi:.1f}"}
        self.assertEqual(values, {"no_load0_shunt_V": "0.0151", "no_load0_frequency_Hz": "894.6", "no_load1_shunt_V": "0.0077", "no_load1_frequency_Hz": "450.2"},
                         "the readings on the page")


class Refused(unittest.TestCase):
    def refusal(self, text):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "r.toml")
            file.write_text(text, encoding="utf-8")
            done = subprocess.run([ROOT / "tools/bench_readings.py", file], capture_output=True, text=True, check=False)
        self.assertEqual((2, ""), (done.returncode, done.stdout), done.stderr)
        self.assertEqual(1, done.stderr.count("\n"), done.stderr)
        return done.stderr

    def test_bad_files(self):
        for wrong, words in (({"shunt_ohm": '"0.1"'}, "shunt.ohm = 0.1 must be a number"), ({"resistance_shunt_V": "-0.1"}, "must be a number, at least 0"),
                             ({"pulse_tau_us": "nan"}, "must be a number"), ({"resistance_shunt_V": "0"}, "divides is 0"),
                             ({"no_load1_frequency_Hz": "894.6"}, "one speed"), ({"emf_flux_linkage_mWb": "inf"}, "below 1e9")):
            self.assertIn(words, self.refusal(replaced(SHOWN, **wrong)), wrong)
        self.assertIn("scope.time_percent is missing", self.refusal(SHOWN.replace("time_percent = 0.01", "")))
        self.assertIn("resistance.kelvin is missing", self.refusal(SHOWN.replace("[resistance]", "[other]")))
        self.assertIn("no_load.1.shunt_V is missing", self.refusal(SHOWN.replace("[[no_load]]", "[[more]]", 2).replace("[[more]]", "[[no_load]]", 1)))
        self.assertIn("line", self.refusal("a = = 1"))
        for cut in range(0, len(SHOWN), 37):  # a file cut off anywhere is refused, or gives what it has
            try:
                self.assertLess(len(tool.uncertain(SHOWN[:cut])), 7)
            except (tool.Refused, tool.tomllib.TOMLDecodeError, ZeroDivisionError):
                pass


if __name__ == "__main__":
    unittest.main()
