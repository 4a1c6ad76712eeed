#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bench_readings_test.py PROGRAM: tools/bench_readings.py finds the parameters of drawn and of simulated benches within its bounds."""
import contextlib
import csv
import io
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


def shown_values():
    """{TABLE_KEY: number} of the page's file."""
    data = tool.tomllib.loads(SHOWN)
    points = {f"no_load{n}": point for n, point in enumerate(data.pop("no_load"))}
    return {f"{table}_{key}": x for table, keys in (data | points).items() if isinstance(keys, dict) for key, x in keys.items()}


SHOWN_VALUES = shown_values()


def called(text):
    """(exit code, output, messages) of the tool for a file with this text."""
    out, err = io.StringIO(), io.StringIO()
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        file = pathlib.Path(folder, "r.toml")
        file.write_text(text, encoding="utf-8")
        return tool.main([str(file)]), out.getvalue(), err.getvalue()


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

    def test_friction_of_three_points(self):
        """Least squares by the normal equations; the true viscous friction stays within the bounds."""
        two = tool.Readings(SHOWN)
        B, T_c = tool.friction(two)
        for volts, amperes, hertz in (("18.00", "0.0113", "672.4"), ("6.00", "0.0041", "223.0")):
            more = f"{SHOWN}\n[[no_load]]\nsupply_V = {volts}\nshunt_V = {amperes}\nfrequency_Hz = {hertz}\n"
            points = tool.no_load(tool.Readings(more))
            n, x, y = 3, sum(w for w, _ in points), sum(T for _, T in points)
            xx, xy = sum(w * w for w, _ in points), sum(w * T for w, T in points)
            slope = (n * xy - x * y) / (n * xx - x * x)
            found = tool.checked(more)
            self.assertAlmostEqual(found["viscous_friction_Nm_s"][0] / slope, 1, 9)
            self.assertAlmostEqual(found["coulomb_friction_mNm"][0], 1e3 * (y - slope * x) / n, 9)
            self.assertLess(abs(found["viscous_friction_Nm_s"][0] - TRUTH["viscous_friction_Nm_s"]), found["viscous_friction_Nm_s"][2])
            self.assertNotEqual((B, T_c), tool.friction(tool.Readings(more)), "the third point is used")

    def test_no_range_is_inverted(self):
        """Whatever is read: 0 <= low <= value <= high, or a refusal that prints no line."""
        draw, counts = random.Random(20270114), {0: 0, 2: 0}
        for n in range(600):
            factors = {place: draw.uniform(0.85, 1.15) if n % 2 else 10 ** draw.uniform(-1, 1) for place in (
                "no_load0_shunt_V", "no_load1_shunt_V", "no_load0_supply_V", "no_load1_frequency_Hz", "coast_frequency_Hz", "resistance_shunt_V")}
            text = replaced(SHOWN, **{place: f"{x * SHOWN_VALUES[place]:.4f}" for place, x in factors.items() if draw.random() < 0.5})
            code, out, err = called(text)
            counts[code] += 1
            self.assertEqual(code == 2, out == "" and err.count("\n") == 1, err)
            lines = re.findall(r"value = (\S+?),.*range = \[(\S+), (\S+)\]", out)
            self.assertEqual(len(lines), 6 if code == 0 else 0)
            for value, low, high in lines:
                self.assertTrue(0 <= float(low) <= float(value) <= float(high), out)
        self.assertGreater(min(counts.values()), 50, "both ways are tried")

    def test_negative_friction_within_its_uncertainty(self):
        """The file's value is 0 and the range ends at the upper bound; T_c moves with the reading as the line says."""
        text = replaced(SHOWN, no_load1_shunt_V="0.0075")
        x, _, half, _ = tool.checked(text)["coulomb_friction_mNm"]
        self.assertTrue(-half < x < 0, (x, half))
        self.assertIn(f"coulomb_friction_mNm = {{ value = 0.00, source = \"bench\", kind = \"measured\", range = [0.00, {x + half:.2f}] }}", called(text)[1])

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

    def test_negative_friction(self):
        """A reading that makes a friction negative beyond its uncertainty is named, with its value."""
        for wrong, key, place in (({"no_load1_shunt_V": "0.0068"}, "coulomb_friction_mNm = -0.5", "no_load.1.shunt_V = 0.0068"),
                                  ({"no_load1_shunt_V": "0.0180"}, "viscous_friction_Nm_s = -", "no_load."),
                                  ({"no_load0_shunt_V": "0.0200"}, "coulomb_friction_mNm = -", "no_load.")):
            message = self.refusal(replaced(SHOWN, **wrong))
            for words in (key, place, "negative by more than its uncertainty of", "Read the points of no_load again"):
                self.assertIn(words, message)

    def test_a_third_point_beside_the_line(self):
        """A wrong point is refused by name. A point of the true line, read with errors inside the limits, never is."""
        point = "\n[[no_load]]\nsupply_V = 18.00\nshunt_V = {}\nfrequency_Hz = 672.4\n"
        self.assertIn("no_load.2: its friction lies +", self.refusal(SHOWN + point.format("0.0200")))
        self.assertIn("beside the line", self.refusal(SHOWN + point.format("0.5")))
        self.assertIn("no_load.2.shunt_V is missing", self.refusal(SHOWN + "\n[[no_load]]\nsupply_V = 18.00\n"))
        draw = random.Random(3)
        for _ in range(100):
            volts = draw.uniform(4, 22)
            w, current = volts * 29.2, 0.0
            for _ in range(30):
                current = ((7.24e-6 * w + 3e-5) * w + 1.03 * current**2) / volts
            reading = SHUNT * current + draw.uniform(-1.5e-4, 1.5e-4)
            tool.checked(f"{SHOWN}\n[[no_load]]\nsupply_V = {volts:.2f}\nshunt_V = {reading:.4f}\nfrequency_Hz = {8 * w / 2 / math.pi:.1f}\n")

    def test_no_limits(self):
        text = re.sub(r"(percent|digits|kelvin|limit_us|half_width_\w+) = [0-9.]+", r"\1 = 0", SHOWN)
        self.assertIn("give the limits of the instruments", self.refusal(text))
        self.assertIn("out of proportion", self.refusal(replaced(SHOWN, no_load0_supply_V="0e400")))

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
