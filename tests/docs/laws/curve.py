# SPDX-License-Identifier: Apache-2.0
"""Laws of a torque-speed curve. Each column follows from the other columns, the motor's sheet and model.md."""
import re
from math import pi, sqrt

from gallery_sheet import B, K_T, R, STALL, U

COLUMNS = ("rpm", "torque", "ideal", "ripple", "current", "rms", "peak", "supply", "in", "copper", "friction", "out", "eff", "cont")


def points(text):
    """(name, row) for each row of the table, in SI. A row without a name has its speed as name."""
    for line in text.splitlines():
        m = re.match(r"^(locked|just turning|no load|best efficiency|nominal torque|)\s+(-?\d[\d.]*)\s+(.*)$", line)
        if not m or len(m.group(3).split()) < 14:
            continue
        cells = [m.group(2)] + m.group(3).split()
        numbers = [None if c == "-" else float(c) for c in cells[:14]]
        yield m.group(1), dict(zip(COLUMNS, numbers)), " ".join(cells[14:])


def same(test, spot, name, x, y, part, least=0.0):
    test.assertLessEqual(abs(x - y), part * max(abs(x), abs(y)) + least, f"{spot}: {name}: {x} and {y}")


def point(test, spot, name, p, duty):
    w = p["rpm"] * pi / 30
    same(test, spot, f"{name}: out = T w", p["out"], 1e-3 * p["torque"] * w, 1e-3, 6e-3)
    same(test, spot, f"{name}: friction = B w^2", p["friction"], B * w * w, 6e-3, 6e-4)
    same(test, spot, f"{name}: copper = 3 R_s rms^2", p["copper"], 1.5 * R * p["rms"]**2, 2e-3, 1e-3) if name != "locked" else None
    same(test, spot, f"{name}: in is the sum", p["in"], p["copper"] + p["friction"] + p["out"], 2e-3, 1e-2)
    same(test, spot, f"{name}: in = U supply", p["in"], U * p["supply"], 2e-3, 2e-3)
    line = max(0.0, 1e3 * (K_T * (duty * U - K_T * w) / R))
    same(test, spot, f"{name}: ideal line", p["ideal"], line, 2e-3, 0.1)
    if p["eff"] is not None and p["out"] > 0:
        same(test, spot, f"{name}: efficiency", p["eff"], 100 * p["out"] / p["in"], 2e-3, 0.06)
        test.assertLess(p["eff"], 100)
    test.assertLessEqual(p["peak"], STALL * 1.001, f"{spot}: {name}")
    test.assertLessEqual(p["rms"], p["peak"] * 1.001, f"{spot}: {name}")
    test.assertLessEqual(p["supply"], p["current"] * 1.001, f"{spot}: {name}: a chopped drive takes less than flows in the motor")


# The thermal data of the 251601 in K/W and s: first winding to housing, then housing to air.
THERMAL = {"thermal_resistance_winding_housing_K_W": 4.5, "thermal_resistance_housing_ambient_K_W": 4.25,
           "thermal_time_constant_winding_s": 17.7, "thermal_time_constant_motor_s": 212.0}


def winding_after(lines, current, seconds, ambient=25.0, steps=4000):
    """Integrates the temperatures of winding and housing step by step. The winding is heated by P = I^2 R (1 + a (T_w
    - 25)), with the temperature coefficient a and winding temperature T_w. At standstill the housing has no losses of
    its own."""
    r_wh, r_ha, tau_w, tau_m = lines.values()
    winding = housing = ambient
    for _ in range(steps):
        across = (winding - housing) / r_wh
        warm = R * current**2 * (1 + 0.00393 * (winding - 25)) - across
        winding, housing = (winding + seconds / steps * warm * r_wh / tau_w,
                            housing + seconds / steps * (across - (housing - ambient) / r_ha) * r_ha / tau_m)
    return winding


def stands(test, spot):
    """The printed current heats the winding to its limit, with the plain values and with the worse ends of the
    thermal ranges."""
    told = re.findall(r"(?:ranges \(([^)]*)\) )?the winding stays below ([\d.]+) degC with ([\d.]+) A \([^)]*\) for ever, ([\d.]+) A for 60 s, ([\d.]+) A for 10 s", spot.text)
    for ends, limit, *amperes in told:
        lines = THERMAL | {k: float(v) for k, v in re.findall(r"(\w+) = ([\d.]+)", ends) if k in THERMAL}
        for current, seconds in zip(map(float, amperes), (4000.0, 60.0, 10.0), strict=True):
            rise = winding_after(lines, current, seconds) - 25
            same(test, spot, f"{current} A for {seconds} s", rise, float(limit) - 25, 0.03 if seconds > 1000 else 0.015)


def judge(test, spot):
    stands(test, spot)
    if "ripple  current     rms" not in spot.text:
        return short(test, spot)
    duty = float(re.search(r"duty ([\d.]+)", spot.text.splitlines()[0]).group(1)) if "duty" in spot.text.splitlines()[0] else 1.0
    rows = {}
    for name, p, held in points(spot.text):
        point(test, spot, name or p["rpm"], p, duty)
        rows[name or p["rpm"]] = p, held
    if not rows:  # a table with other columns
        return short(test, spot)
    test.assertGreaterEqual(len(rows), 6)
    same(test, spot, "stall torque K_t d U/R", rows["locked"][0]["torque"], 1e3 * K_T * duty * STALL, 2e-3)
    same(test, spot, "just turning: sqrt(2/3)", rows["just turning"][0]["rms"], sqrt(2 / 3) * rows["locked"][0]["rms"], 1e-3)
    best = max(p["eff"] or 0 for p, _ in rows.values())
    test.assertEqual(best, rows["best efficiency"][0]["eff"])
    test.assertLess(abs(rows["no load"][0]["torque"]), 0.02)
    speeds = [p["rpm"] for name, (p, _) in rows.items() if name not in ("best efficiency", "nominal torque")]
    test.assertEqual(speeds, sorted(speeds))
    torques = [p["torque"] for name, (p, _) in rows.items() if name not in ("best efficiency", "nominal torque")]
    test.assertEqual(torques, sorted(torques, reverse=True), "more speed, less torque")


def short(test, spot):
    """The first columns of a table, as excerpt on a page. The torque is at or below the ideal line, and at standstill
    it is on the line."""
    rows = re.findall(r"^(?:locked|just turning|no load)?\s+(\d+)\s+([\d.]+)\s+([\d.]+)", spot.text, re.M)
    test.assertGreaterEqual(len(rows), 1, str(spot))
    duty = 0.5 if "duty 0.5" in spot.text else 1.0
    for rpm, torque, ideal in rows:
        w = float(rpm) * pi / 30
        same(test, spot, "ideal line", float(ideal), 1e3 * K_T * (duty * U - K_T * w) / R, 2e-3, 0.1)
        test.assertLessEqual(float(torque), float(ideal) * 1.001, f"{spot}: {rpm} rpm")
