#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sheet_points_test.py PROGRAM: what docs/explanation/sheets-against-the-model.md says of the printed points, each by a law."""
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from page import REPOSITORY

sys.dont_write_bytecode = True
sys.path.insert(0, str(REPOSITORY / "tools"))
import sheet_points as tool  # noqa: E402
from sheet_model import RPM, Model, Sheet, half, solved  # noqa: E402

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else REPOSITORY / "build/dev/sixstep"
PAGE = (REPOSITORY / "docs/explanation/sheets-against-the-model.md").read_text(encoding="utf-8")
FOLDER = tempfile.TemporaryDirectory()
MODEL = Model(PROGRAM, FOLDER.name)
COMPARED, LEFT_OUT = tool.sheets()
NOMINAL = tool.nominal(COMPARED)
WITH_SPEED = [s for s in NOMINAL if s.value("nominal_speed_rpm")]


def constants(sheet):
    """Pole pairs, R and L between terminals, K_t, U, I_0 in SI."""
    return (float(sheet.keys["pole_pairs"]), sheet.value("resistance_ohm"), sheet.value("inductance_mH") * 1e-3,
            sheet.value("torque_constant_mNm_A") * 1e-3, sheet.value("nominal_voltage_V"), sheet.value("no_load_current_mA") * 1e-3)


class Points(unittest.TestCase):
    def test_no_motor_is_missing(self):
        files = sorted(f.stem for f in (REPOSITORY / "data/motors").glob("*.toml"))
        self.assertEqual(files, sorted([s.name for s in COMPARED] + list(LEFT_OUT)))
        self.assertIn(f"{len(COMPARED)} of the {len(files)} motor files".replace("9 of", "Nine of"), PAGE)
        for name, why in LEFT_OUT.items():
            named = re.search(rf"\*\*{name}\*\*", PAGE)
            self.assertTrue(named or why == "prints none of these points", name)
        self.assertIn(f"**{sum(why == 'prints none of these points' for why in LEFT_OUT.values())} files print none", PAGE)

    def test_every_printed_point_is_compared(self):
        for sheet in COMPARED:
            kinds = {re.sub(r"^(line_\d+_)?(.*)_\w+$", r"\2", key) for key in sheet.keys
                     if re.search(r"(no_load|nominal|stall)_(speed|current|torque)_", key)}
            shown = {point.rsplit("_", 1)[0] for point in tool.deviations(MODEL, sheet)}
            # Without a printed nominal speed or torque there is no point of the model to compare the other with.
            if not sheet.value("nominal_speed_rpm"):
                kinds.discard("nominal_torque")
            self.assertEqual(kinds, shown, sheet.name)

    def test_sheets_print_three_significant_digits(self):
        for sheet in COMPARED:
            for key, entry in sheet.keys.items():
                if isinstance(entry, dict) and entry.get("kind") == "sheet":
                    self.assertLessEqual(len(str(entry["value"]).replace(".", "").strip("0")), 3, f"{sheet.name}: {key}")

    def test_half_of_a_digit(self):
        for printed, expected in ((6710, 5), (10, 0.5), ("36.0", 0.05), ("0.572", 0.0005), (185, 0.5), (24, 0.5), ("2.08", 0.005)):
            self.assertAlmostEqual(expected, half(printed), 12, printed)

    def test_each_deviation_has_a_reason_and_each_reason_a_deviation(self):
        for sheet in COMPARED:
            for point, (_, _, deviation, rounding) in tool.deviations(MODEL, sheet).items():
                letter, right = tool.verdict(sheet.name, point, deviation, rounding)
                self.assertTrue(right, f"{sheet.name}, {point}: off by {deviation:.2%}, rounding {rounding:.2%}, reason {letter or 'missing'}")
                self.assertTrue(not letter or letter in tool.REASONS)
        self.assertEqual(set(tool.REASONS), {letter for letters in tool.EXPLAINED.values() for letter in letters.values()})

    def test_a_wrong_value_is_noticed(self):
        """A printed value that is 3 % off parts from the model without a reason; where it has a reason, another value loses its own."""
        sheet = next(s for s in COMPARED if s.name == "maxon-651614")
        for point in ("stall_torque_mNm", "stall_current_A"):
            wrong = tool.deviations(MODEL, sheet.scaled(point, 1.03))[point]
            self.assertEqual(("", False), tool.verdict(sheet.name, point, *wrong[2:]), point)
        wrong = tool.deviations(MODEL, sheet.scaled("resistance_ohm", 0.5))
        self.assertFalse(all(tool.verdict(sheet.name, point, *row[2:])[1] for point, row in wrong.items()))


class SteadyState(unittest.TestCase):
    def test_no_load_speed_is_the_ideal_line_less_commutation(self):
        """w_0 = (U - R I)/K_t lowered by 1.2 to 1.4 times 3 p (L/2) I/(pi K_t) of it, I = friction over K_t."""
        for sheet in NOMINAL:
            p, R, L, K_t, U, I_0 = constants(sheet)
            w = MODEL.curve(sheet)["no_load"]["speed_rad_s"]
            I = I_0 * w * RPM / sheet.value("no_load_speed_rpm")  # viscous
            line = (U - R * I) / K_t
            self.assertTrue(1.15 < (1 - w / line) / (3 * p * L / 2 * I / (math.pi * K_t)) < 1.45, sheet.name)
            free = MODEL.points(tool.ALTERNATIVES["no inductance"][0](sheet))["no_load_speed_rpm"]
            self.assertLess(abs(free / RPM / line - 1), 4e-4, sheet.name)

    def test_stall_is_that_of_resistance_and_torque_constant(self):
        for sheet in NOMINAL:
            _, R, _, K_t, U, _ = constants(sheet)
            found = MODEL.points(sheet)
            self.assertAlmostEqual(1, found["stall_current_A"] * R / U, 9)
            self.assertAlmostEqual(1, found["stall_torque_mNm"] * 1e-3 * R / U / K_t, 9)

    def test_nominal_point_closes_its_power(self):
        """U I of the supply is output, friction of the sheet's no-load point, and 3 R_s rms^2."""
        for sheet in NOMINAL:
            _, R, _, K_t, U, I_0 = constants(sheet)
            at = MODEL.curve(sheet)["nominal"]["curve_at_torque"]
            w, w_0 = at["speed_rad_s"], sheet.value("no_load_speed_rpm") / RPM
            out = sheet.value("nominal_torque_mNm") * 1e-3 * w + K_t * I_0 / w_0 * w**2 + 1.5 * R * at["phase_rms_A"]**2
            self.assertLess(abs(out / (U * at["bus_current_A"]) - 1), 1e-6, sheet.name)


class Reasons(unittest.TestCase):
    def test_A_the_no_load_speed_confirms_what_the_nominal_point_asks_for(self):
        factors = []
        for sheet in NOMINAL:
            L, dry, over, found = tool.fitted(MODEL, sheet)
            factors.append(L)
            self.assertTrue(0 < dry < 1 and 1 < over < 1.02, f"{sheet.name}: {dry}, {over}")
            for point in {"no_load_current_mA", "nominal_speed_rpm", "nominal_current_A"} & set(sheet.points()):
                self.assertLess(abs(found[point] / sheet.value(point) - 1), 1e-4, f"{sheet.name}, {point}")
            rounding = tool.deviations(MODEL, sheet)["no_load_speed_rpm"][3]
            self.assertLess(abs(found["no_load_speed_rpm"] / sheet.value("no_load_speed_rpm") - 1), rounding, sheet.name)
        low, high = map(int, re.search(r"\*\*at a\s+commutation (\d+) to (\d+) % of the printed", PAGE).groups())
        self.assertEqual((low, high), (round(100 * min(factors)), round(100 * max(factors))))

    def test_A_early_edges_are_no_other_explanation(self):
        misses = []
        for sheet in WITH_SPEED:
            angle, torque = tool.early(MODEL, sheet)
            self.assertTrue(0 < angle < 10, sheet.name)
            misses.append(1e3 * torque / sheet.value("nominal_torque_mNm") - 1)
            before = tool.deviations(MODEL, sheet)["nominal_torque_mNm"][2]
            self.assertLess(misses[-1], 0.7 * before, f"{sheet.name}: most of the deviation stays")
        self.assertIn(f"{-100 * max(misses):.0f} to {-100 * min(misses):.0f} % too low", PAGE)

    def test_A_no_other_change_alone_brings_all_three_columns_near(self):
        names = ("no_load_speed_rpm", "nominal_speed_rpm", "nominal_current_A")
        worst = {}
        for words, (change, options) in tool.ALTERNATIVES.items():
            rows = [(s, MODEL.points(change(s), *options)) for s in WITH_SPEED]
            worst[words] = max(abs(found[name] / s.value(name) - 1) for s, found in rows for name in names)
        near = {words for words, x in worst.items() if x < 0.014}
        self.assertEqual({"inductance x 0.8", "also friction half dry"}, near)
        self.assertLess(worst["also friction half dry"], 0.01)

    def test_A_sizes_that_the_page_tells(self):
        def changes(words, point):
            change, options = tool.ALTERNATIVES[words]
            return [MODEL.points(change(s), *options)[point] / MODEL.points(s)[point] - 1 for s in WITH_SPEED]
        for words in ("sine", "trapezoid, 170 deg flat"):
            for point in ("no_load_speed_rpm", "nominal_speed_rpm"):
                self.assertLess(max(map(abs, changes(words, point))), 0.004, words)
        warm = changes("winding at 100 degC", "nominal_speed_rpm")
        self.assertEqual((-8, -3), (round(100 * min(warm)), round(100 * max(warm))))
        self.assertTrue(all(0.037 < x < 0.045 for x in changes("magnets at 60 degC", "no_load_speed_rpm")))

    def test_A_the_loop_of_a_delta_brakes(self):
        for sheet in NOMINAL:
            speed, loss = sheet.value("no_load_speed_rpm") / RPM, 1e-6 * sheet.value("torque_constant_mNm_A") * sheet.value("no_load_current_mA")
            star, delta = (MODEL.offset_point(sheet.with_values(connection=word), speed, 0.0)[0] for word in ("star", "delta"))
            self.assertTrue(0.085 < (star - delta) / loss < 0.245, sheet.name)

    def test_the_nominal_current_is_the_supplys(self):
        """As a winding's current it does not make the printed torque; as the supply's its power closes with a cold winding."""
        for sheet in WITH_SPEED:
            drawn, delivered, viscous, dry, cold, warm = tool.power(MODEL, sheet)
            rounding = drawn * sheet.half("nominal_current_A") / sheet.value("nominal_current_A") + delivered * (
                sheet.half("nominal_torque_mNm") / sheet.value("nominal_torque_mNm") + sheet.half("nominal_speed_rpm") / sheet.value("nominal_speed_rpm"))
            left = drawn - delivered - dry - rounding, drawn - delivered - viscous + rounding
            self.assertTrue(left[0] <= cold <= left[1], f"{sheet.name}: {left} and {cold} W")
            self.assertGreater(warm, left[1], sheet.name)
            self.assertGreater(warm, 1.17 * (drawn - delivered - viscous), sheet.name)
            asked = (sheet.value("nominal_torque_mNm") * 1e-3 + tool.friction_torque(sheet)) / (sheet.value("torque_constant_mNm_A") * 1e-3)
            self.assertGreater(asked / sheet.value("nominal_current_A"), 1.08, sheet.name)

    def test_B_with_its_own_friction_the_251601_parts_as_its_sisters_do(self):
        sheet = next(s for s in NOMINAL if s.name == "maxon-251601")
        off = tool.deviations(MODEL, sheet)["no_load_current_mA"][2]
        others = [tool.deviations(MODEL, s)["no_load_current_mA"][2] for s in NOMINAL if s is not sheet]
        self.assertTrue(1.1 * min(others) < off < max(others), (off, others))

    def test_C_those_print_less_torque_per_ampere(self):
        lacking = set()
        for sheet in NOMINAL:
            torque, current = sheet.value("stall_torque_mNm"), sheet.value("stall_current_A")
            room = sheet.half("stall_torque_mNm") / torque + sheet.half("stall_current_A") / current
            if torque / current < sheet.value("torque_constant_mNm_A") * (1 - room):
                lacking.add(sheet.name)
        self.assertEqual(lacking, {name for name, letters in tool.EXPLAINED.items() if letters.get("stall_torque_mNm") == "C"})

    def test_D_and_E_and_the_values_that_contradict_each_other(self):
        sheet = next(s for s in NOMINAL if s.name == "maxon-651609")
        self.assertEqual(25.5, sheet.value("stall_torque_mNm") / sheet.value("torque_constant_mNm_A"))
        gimbal = next(s for s in COMPARED if s.name == "ipower-gm5208-12")
        six_step = 2 * gimbal.value("nominal_voltage_V") / math.pi / (7 * gimbal.value("flux_linkage_mWb") * 1e-3) * RPM
        self.assertIn(f"gives {six_step:.0f} rpm", PAGE)
        other = Sheet(REPOSITORY / "data/motors/faulhaber-2264w024bp4.toml")
        R, K_t = other.value("resistance_ohm"), other.value("torque_constant_mNm_A") * 1e-3
        speed, amperes, torque = (other.value(name) for name in ("no_load_speed_rpm", "no_load_current_mA", "stall_torque_mNm"))
        no_load, stall = K_t * speed / RPM + R * amperes * 1e-3, torque * 1e-3 * R / K_t
        most = stall * (1 + sum(other.half(n) / other.value(n) for n in ("resistance_ohm", "torque_constant_mNm_A", "stall_torque_mNm")))
        self.assertLess(most, no_load * (1 - other.half("torque_constant_mNm_A") / (K_t * 1e3)))
        for volts in (no_load, stall, most):
            self.assertIn(f"{volts:.1f} V", PAGE)


class Tool(unittest.TestCase):
    def test_solves(self):
        self.assertAlmostEqual(math.sqrt(2), solved(lambda x: x * x, 2.0, 1.0, 2.0, 8), 9)
        self.assertAlmostEqual(-math.sqrt(2), solved(lambda x: -x**3, 2 ** 1.5, -2.0, -1.0, 12), 9)

    def test_an_unknown_table_is_refused(self):
        done = subprocess.run([REPOSITORY / "tools/sheet_points.py", "pionts"], capture_output=True, text=True, check=False)
        self.assertEqual((1, ""), (done.returncode, done.stdout))
        self.assertIn("alternatives", done.stderr)


if __name__ == "__main__":
    unittest.main()
