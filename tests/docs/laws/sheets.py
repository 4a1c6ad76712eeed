# SPDX-License-Identifier: Apache-2.0
"""Laws of the tables of tools/sheet_points.py: a deviation is that of its two values, a power is that of its volts and amperes."""
import re
import sys

from page import REPOSITORY

sys.path.insert(0, str(REPOSITORY / "tools"))
from sheet_model import RPM, Sheet  # noqa: E402

NUMBER = r"([-+]?\d+(?:\.\d+)?)"


def sheet_of(name):
    return Sheet(REPOSITORY / f"data/motors/{name}.toml")


def rows(spot, pattern, fewest):
    found = re.findall(rf"(?m)^(\S+) +{pattern}$", spot.text)
    if len(found) < fewest:
        raise AssertionError(f"{spot}: {len(found)} rows instead of {fewest}")
    return found


def points(test, spot):
    """Printed values are the file's; a reason stands where the deviation exceeds the rounding."""
    found = re.findall(rf"(?m)^(\S*) +([a-z -]+?) +{NUMBER} +{NUMBER} (rpm|mA|A|mNm) +{NUMBER} % +{NUMBER} %(?:  ([A-E]))?$", spot.text)
    test.assertGreater(len(found), 50)
    name = ""
    for first, words, printed, model, unit, told, rounding, reason in found:
        name = first or name
        test.assertEqual(float(printed), sheet_of(name).value(f"{words.replace(' ', '_')}_{unit}"), f"{spot}: {name} {words}")
        digits = 0.5 * 10.0 ** -len(model.partition(".")[2])
        off = 100 * (float(model) / float(printed) - 1)
        test.assertLess(abs(off - float(told)), 100 * digits / float(printed) + 0.006, f"{spot}: {name} {words}")
        test.assertEqual(bool(reason), abs(float(told)) > float(rounding), f"{spot}: {name} {words}")
    left_out = sum(int(n) for n in re.findall(r"(?m)^(\d+) not compared", spot.text))
    motors = len(list((REPOSITORY / "data/motors").glob("*.toml")))
    test.assertEqual(motors, left_out + len({row[0] for row in found if row[0]}), str(spot))


def currents(test, spot):
    """rms < supply < motor < winding of one point, and the current that the torque needs is near the winding's."""
    for name, printed, winding, motor, supply, rms, asked, told in rows(
            spot, rf"{NUMBER} A +{NUMBER} % +{NUMBER} % +{NUMBER} % +{NUMBER} % +{NUMBER} A +{NUMBER} %", 8):
        test.assertTrue(float(rms) < float(supply) < 0 < float(motor) < float(winding), f"{spot}: {name}")
        test.assertLess(abs(100 * (float(asked) / float(printed) - 1) - float(told)), 0.12, f"{spot}: {name}")
        sheet = sheet_of(name)
        least = sheet.value("nominal_torque_mNm") / sheet.value("torque_constant_mNm_A")
        friction = 1e-3 * sheet.value("no_load_current_mA")
        test.assertLess(abs(float(asked) / (least + friction) - 1), 0.004, f"{spot}: {name}")
        # The friction of the no-load point is more than that at the lower speed, by less than a third where all of it is viscous.
        test.assertTrue(-0.1 < float(told) - float(winding) < 33 * friction / float(printed), f"{spot}: {name}")


def power(test, spot):
    for name, drawn, delivered, low, high, least, most, cold, warm in rows(
            spot, rf"{NUMBER} +{NUMBER} +{NUMBER} \.\. *{NUMBER} +{NUMBER} \.\. *{NUMBER} +{NUMBER} +{NUMBER}", 7):
        sheet = sheet_of(name)
        value = {key: sheet.value(key) for key in sheet.points()}
        speed = value["nominal_speed_rpm"] / RPM
        test.assertLess(abs(float(drawn) - sheet.value("nominal_voltage_V") * value["nominal_current_A"]), 0.006, f"{spot}: {name}")
        test.assertLess(abs(float(delivered) - 1e-3 * value["nominal_torque_mNm"] * speed), 0.006, f"{spot}: {name}")
        test.assertLess(abs(float(low) / float(high) - value["nominal_speed_rpm"] / value["no_load_speed_rpm"]), 0.01, f"{spot}: {name}")
        rest = float(drawn) - float(delivered)
        test.assertLess(abs(rest - float(high) - float(least)) + abs(rest - float(low) - float(most)), 0.05, f"{spot}: {name}")
        test.assertTrue(1.25 < float(warm) / float(cold) < 1.31, f"{spot}: {name}: copper at 100 degC has 1.295 of its resistance, less current flows")


def fit(test, spot):
    for name, L, dry, friction, printed, model, told, rounding in rows(
            spot, rf"x {NUMBER} +(\S+|0.5 set) +x {NUMBER} +{NUMBER} +{NUMBER} +{NUMBER} % +{NUMBER} %", 8):
        test.assertTrue(0.7 < float(L) < 0.9 and 0 < float(dry.split()[0]) < 1 and 1 < float(friction) < 1.02, f"{spot}: {name}")
        test.assertLess(abs(100 * (float(model) / float(printed) - 1) - float(told)), 0.02, f"{spot}: {name}")
        test.assertLess(abs(float(told)), float(rounding), f"{spot}: {name}")


def offset(test, spot):
    for name, angle, printed, model, told in rows(spot, rf"{NUMBER} deg +{NUMBER} +{NUMBER} +{NUMBER} %", 7):
        test.assertTrue(0 < float(angle) < 10, f"{spot}: {name}")
        test.assertEqual(float(printed), sheet_of(name).value("nominal_torque_mNm"), f"{spot}: {name}")
        test.assertLess(abs(100 * (float(model) / float(printed) - 1) - float(told)), 0.15, f"{spot}: {name}")


def alternatives(test, spot):
    """Ranges; the sheet's own lie among the deviations of the table of points; no inductance is faster than any."""
    found = {words: [float(x) for x in numbers] for words, *numbers in re.findall(
        rf"(?m)^([a-z][\w ,.]*?) +{NUMBER} \.\. *{NUMBER} +{NUMBER} \.\. *{NUMBER} +{NUMBER} \.\. *{NUMBER}$", spot.text)}
    test.assertGreater(len(found), 9)
    for words, numbers in found.items():
        for low, high in zip(numbers[::2], numbers[1::2]):
            test.assertTrue(-20 < low <= high < 20, f"{spot}: {words}")
        if words not in ("no inductance", "also magnets at 60 degC", "magnets at 60 degC"):
            test.assertLess(max(numbers[:2]), 0, f"{spot}: {words}")
        test.assertLessEqual(max(numbers[2:4]), max(found["no inductance"][2:4]), f"{spot}: {words}")


def stall(test, spot):
    for name, part, rounding, K_t, ratio in rows(spot, rf"{NUMBER} +{NUMBER} % +{NUMBER} +{NUMBER}", 8):
        sheet = sheet_of(name)
        current = sheet.value("stall_current_A")
        test.assertLess(abs(float(part) - sheet.value("stall_torque_mNm") / current), 0.006, f"{spot}: {name}")
        test.assertEqual(float(K_t), sheet.value("torque_constant_mNm_A"), f"{spot}: {name}")
        test.assertLess(abs(float(ratio) - current / sheet.value("nominal_current_A")), 0.06, f"{spot}: {name}")
        test.assertTrue(0 < float(rounding) < 6, f"{spot}: {name}")
