#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bench_readings.py READINGS.toml: parameters of a motor from readings of meter and scope, each with its 95 % uncertainty.

A reading has a limit: percent of the reading and digits of its last place (meter, as its manual states), percent (scope, shunt), or a 95 %
half width that `sixstep motor emf` printed. A parameter's uncertainty is 2 sqrt(sum of D^2/3 + sum of (H/2)^2): D is the parameter's
change when one reading moves by its limit, H when it moves by its half width. Readings that one instrument took share its percent.
docs/howto/measure-a-motor.md explains each recording.
"""
import decimal
import math
import pathlib
import sys
import tomllib

COPPER = 0.00393  # part of the resistance per kelvin
SLOPE = 60**0.5   # of evenly spaced phases over a time T, standard errors of slope and frequency: sqrt(60)/T


class Refused(ValueError):
    """A message for the user."""


class Readings:
    """Numbers of the file by their places, as "no_load.0.supply_V"; `moved` holds {error: by which part of its limit}."""

    def __init__(self, text, moved=None):
        self.data, self.moved = tomllib.loads(text, parse_float=decimal.Decimal), moved or {}
        self.errors = {}  # name: True for a half width, False for a limit

    def printed(self, place):
        at = self.data
        for part in place.split("."):
            try:
                at = at[int(part)] if isinstance(at, list) else at[part]
            except (KeyError, IndexError, TypeError, ValueError) as lacking:
                raise Refused(f"{place} is missing; give it, or leave out the whole recording") from lacking
        number = isinstance(at, (int, decimal.Decimal)) and not isinstance(at, bool) and math.isfinite(at)
        if not number or abs(at) >= 10**9 or (at < 0 and place != "coast.Hz_s"):
            raise Refused(f"{place} = {at} must be a number, at least 0 and below 1e9")
        return decimal.Decimal(at)

    def raw(self, place):
        return float(self.printed(place))

    def error(self, name, size, normal=False):
        self.errors[name] = normal
        return self.moved.get(name, 0.0) * size

    def meter(self, place):
        """A voltage of the meter: its percent is one error of the instrument, its digits are one of the reading."""
        printed = self.printed(place)
        digit = 10.0 ** printed.as_tuple().exponent * self.raw("meter.digits")
        return float(printed) * (1 + self.error("meter, percent", self.raw("meter.percent")) / 100) + self.error(f"meter, digits of {place}", digit)

    def shunt(self):
        return self.raw("shunt.ohm") * (1 + self.error("shunt", self.raw("shunt.percent")) / 100)


def resistance(r):
    warm = r.error("temperature of the winding", COPPER * r.raw("resistance.kelvin"))
    return r.meter("resistance.terminals_V") / r.meter("resistance.shunt_V") * r.shunt() * (1 + warm)


def speed(r, place):
    hertz = r.raw(place) * (1 + r.error("scope, time", r.raw("scope.time_percent")) / 100)
    return 2 * math.pi * hertz / r.raw("pole_pairs")


def no_load(r):
    """[(speed, torque)] of the no-load points by their power; two or more."""
    given, points = r.data.get("no_load"), []
    for n in range(max(2, len(given)) if isinstance(given, list) else 2):
        amperes, w = r.meter(f"no_load.{n}.shunt_V") / r.shunt(), speed(r, f"no_load.{n}.frequency_Hz")
        points.append((w, (r.meter(f"no_load.{n}.supply_V") * amperes - resistance(r) * amperes**2) / w))
    if len({w for w, _ in points}) == 1:
        raise Refused(f"no_load.{len(points) - 1}.frequency_Hz = {r.raw('no_load.0.frequency_Hz'):g}: all points have one speed; record another one at half of the voltage")
    return points


def friction(r):
    """(B, T_c): the line of least squares through the no-load points."""
    points = no_load(r)
    w_mean, T_mean = (math.fsum(column) / len(points) for column in zip(*points))
    B = math.fsum((w - w_mean) * (T - T_mean) for w, T in points) / math.fsum((w - w_mean) ** 2 for w, _ in points)
    return B, T_mean - B * w_mean


def beside_the_line(r):
    """Torque of each no-load point less that of the line, mNm."""
    B, T_c = friction(r)
    return [1e3 * (T - B * w - T_c) for w, T in no_load(r)]


def inertia(r):
    B, T_c = friction(r)
    w = speed(r, "coast.frequency_Hz")
    width = SLOPE * r.raw("coast.half_width_Hz") / r.raw("coast.seconds")
    slope = abs(r.raw("coast.Hz_s")) + r.error("bounds of the coast-down", width, True)
    return (B * w + T_c) / (2 * math.pi * slope / r.raw("pole_pairs"))


def parameters(r):
    """{key of the motor file: (value, unit)} of the recordings that the file has."""
    found = {}
    if "resistance" in r.data:
        found["resistance_ohm"] = resistance(r), "ohm"
    if "emf" in r.data:
        gain = (1 + r.error("scope, gain", r.raw("scope.gain_percent")) / 100) / (1 + r.error("scope, time", r.raw("scope.time_percent")) / 100)
        flux = r.raw("emf.flux_linkage_mWb") + r.error("bounds of motor emf", r.raw("emf.half_width_mWb"), True)
        found["flux_linkage_mWb"] = flux * gain, "mWb"
    if "pulse" in r.data:
        tau = r.raw("pulse.tau_us") + r.error("time of the pulse", r.raw("pulse.limit_us"))
        found["inductance_mH"] = (resistance(r) + r.shunt()) * tau * 1e-3, "mH"
    if "no_load" in r.data:
        B, T_c = friction(r)
        found["viscous_friction_Nm_s"] = B, "N m s"
        found["coulomb_friction_mNm"] = 1e3 * T_c, "mNm"
    if "coast" in r.data:
        found["inertia_gcm2"] = 1e7 * inertia(r), "g cm2"
    return found


def uncertain(text):
    """{key: (value, unit, 95 % half width, {error: variance})}."""
    plain = Readings(text)
    found = parameters(plain)
    parts = {key: {} for key in found}
    for name, normal in plain.errors.items():
        moved = parameters(Readings(text, {name: 1.0}))
        for key in found:
            parts[key][name] = (moved[key][0] - found[key][0]) ** 2 / (4 if normal else 3)
    return {key: (x, unit, 2 * math.sqrt(sum(parts[key].values())), parts[key]) for key, (x, unit) in found.items()}


def check_line(text):
    """Refuses points further from the line than the limits of all readings together allow."""
    plain = Readings(text)
    beside = beside_the_line(plain)
    moved = [beside_the_line(Readings(text, {name: 1.0})) for name in plain.errors]
    allowed = [sum(abs(other[n] - x) for other in moved) for n, x in enumerate(beside)]
    n = max(range(len(beside)), key=lambda n: abs(beside[n]))
    if len(beside) > 2 and abs(beside[n]) > allowed[n]:
        raise Refused(f"no_load.{n}: its friction lies {beside[n]:+.2g} mNm beside the line through all points, and the limits of the readings allow {allowed[n]:.2g} mNm. "
                      "One of the points is wrong, or the friction is not B w + T_c; read all points again, or give the two that enclose the speeds of use")


def check_sign(text, key, x, unit, half, parts):
    """Refuses a parameter that no motor has. A friction may come out negative by its uncertainty."""
    if not (math.isfinite(x) and 0 < half < math.inf):
        raise Refused(f"{key} = {x:.3g} {unit} has an uncertainty of {half:.3g} {unit}, because every limit of its readings is 0 or a reading is out of proportion; give the limits of the instruments")
    if "friction" not in key:
        if x <= 0:
            raise Refused(f"{key} = {x:.3g} {unit} must be above 0; read its recording again, and those of resistance and no load that it uses")
    elif x < -half:
        place = max((name for name in parts if "no_load" in name), key=lambda name: parts[name], default="no_load.1.shunt_V").split()[-1]
        way = "rises too steeply" if "coulomb" in key else "falls"
        raise Refused(f"{key} = {x:.3g} {unit} is negative by more than its uncertainty of {half:.2g} {unit}: the torque without load {way} with the speed, so that a reading is wrong. "
                      f"Read the points of no_load again after two minutes of running, first {place} = {Readings(text).printed(place)}")


def checked(text):
    """As uncertain(); refuses what no motor and no bench can show."""
    rows = uncertain(text)
    if "viscous_friction_Nm_s" in rows:
        check_line(text)
    for key, row in rows.items():
        check_sign(text, key, *row)
    return rows


def written(x, half):
    """With two digits of the uncertainty."""
    digits = max(0, 1 - math.floor(math.log10(half)))
    return f"{x:.2e}" if 0 < abs(x) < 1e-3 else f"{x:.{digits}f}"


def main(words):
    if len(words) != 1:
        sys.exit(__doc__)
    try:
        rows = checked(pathlib.Path(words[0]).read_text(encoding="utf-8"))
    except (ZeroDivisionError, OverflowError):
        print(f"{words[0]}: a reading that divides is 0 or out of proportion; see docs/howto/measure-a-motor.md", file=sys.stderr)
        return 2
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError, Refused) as problem:
        print(f"{words[0]}: {problem}; docs/howto/measure-a-motor.md shows a complete file", file=sys.stderr)
        return 2
    for key, (x, unit, half, parts) in rows.items():
        most = max(parts, key=parts.get)
        percent = f"{100 * half / abs(x):.1f} %" if x and half < abs(x) else ""
        print(f"{key:<22}{written(x, half):>10} +- {written(half, half):>8} {unit:<6} {percent:>6}  {100 * parts[most] / sum(parts.values()):.0f} % of the variance: {most}")
    print()
    for key, (x, _, half, _) in rows.items():
        frame = ', frame = "terminal"' if key in ("resistance_ohm", "inductance_mH") else ""
        low, high = max(0.0, x - half), x + half
        print(f'{key} = {{ value = {written(max(x, 0.0), half)}{frame}, source = "bench", kind = "measured", range = [{written(low, half)}, {written(high, half)}] }}')
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
