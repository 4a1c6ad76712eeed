# SPDX-License-Identifier: Apache-2.0
"""Points that a data sheet prints, and the same points of the model: `sixstep curve` on the motor file or on a variant of it."""
import decimal
import functools
import json
import math
import pathlib
import re
import subprocess
import tomllib

RPM = 30 / math.pi
POINTS = ("no_load_speed_rpm", "no_load_current_mA", "nominal_speed_rpm", "nominal_current_A", "nominal_torque_mNm", "stall_torque_mNm",
          "stall_current_A")
SPELLED = {"nominal_torque_mNm": ("nominal_torque_Nm", 1000), "stall_torque_mNm": ("stall_torque_Nm", 1000)}
LINEAR = ("no_load_speed_m_s", "nominal_force_N", "stall_force_N")
INPUTS = ("resistance_ohm", "inductance_mH", "torque_constant_mNm_A", "no_load_current_mA", "nominal_torque_mNm", "nominal_speed_rpm")


def half(printed):
    """Half of the last printed digit, or of the third significant one where that is larger: 6710 rpm is rounded to 10."""
    x = decimal.Decimal(printed)
    return 0.5 * 10.0 ** max(x.as_tuple().exponent, x.adjusted() - 2)


def written(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {written(x)}" for key, x in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(written(x) for x in value) + "]"
    return str(value) if isinstance(value, decimal.Decimal) else json.dumps(value)


class Sheet:
    """A motor file. Keys are named without the number of their line and without `terminal_`."""

    def __init__(self, file, keys=None):
        self.file = pathlib.Path(file)
        self.name = self.file.stem
        self.keys = keys or tomllib.loads(self.file.read_text(encoding="utf-8"), parse_float=decimal.Decimal)

    def key(self, name):
        spelled = re.compile(rf"(line_\d+_)?(terminal_)?{name}")
        return next((key for key in self.keys if spelled.fullmatch(key)), None)

    def literal(self, name):
        """(printed, factor to the unit of `name`), or None."""
        for spelling, factor in ((name, 1), SPELLED.get(name, (name, 1))):
            if key := self.key(spelling):
                value = self.keys[key]
                return (value["value"] if isinstance(value, dict) else value), factor
        return None

    def value(self, name):
        found = self.literal(name)
        return None if found is None else float(found[0]) * found[1]

    def half(self, name):
        """Half of the last digit, or of the file's range where sources differ."""
        printed, factor = self.literal(name)
        entry = self.keys[self.key(name) or self.key(SPELLED[name][0])]
        low, high = entry.get("range", (0, 0)) if isinstance(entry, dict) else (0, 0)
        return max(half(printed), float(high - low) / 2) * factor

    def points(self):
        return [name for name in POINTS if self.literal(name) is not None]

    def with_values(self, drop=(), **values):
        """The sheet with other values, in the units of the names; a range and keys in `drop` are left out."""
        keys = {key: value for key, value in self.keys.items() if key not in drop}
        for name, x in values.items():
            if self.literal(name) is None:
                keys[name] = x
                continue
            key = self.key(name) or self.key(SPELLED[name][0])
            old, new = keys[key], x if isinstance(x, str) else x / self.literal(name)[1]
            keys[key] = ({k: v for k, v in old.items() if k != "range"} | {"value": new}) if isinstance(old, dict) else new
        return Sheet(self.file, keys)

    def scaled(self, name, factor):
        return self.with_values(**{name: self.value(name) * factor})

    def text(self):
        return "".join(f"{key} = {written(value)}\n" for key, value in self.keys.items())

    def friction_of_the_sheet(self):
        """Without friction that was measured on another motor: all of it from the printed no-load point."""
        return self.with_values(drop=("viscous_friction_Nm_s",))

    def in_the_model(self):
        """Why this file's points cannot be compared, or None."""
        if self.keys.get("kind") == "linear":
            return "its values are those of another motor in N and m"
        if not self.points():
            return "prints none of these points"
        missing = [name for name in ("pole_pairs", "nominal_voltage_V") if self.key(name) is None]
        if missing:
            return f"its points cannot be simulated without {' and '.join(missing)}"
        if self.key("no_load_speed_rpm") is None:
            return "prints no no-load point"
        return None


class Model:
    """Runs the program on motor files that it writes into a folder."""

    def __init__(self, program, folder):
        self.program, self.folder = str(program), pathlib.Path(folder)

    def _file(self, sheet):
        text = sheet.text()
        file = self.folder / f"{sheet.name}-{abs(hash(text)):x}.toml"
        file.write_text(text, encoding="utf-8")
        return file

    @functools.lru_cache(maxsize=None)
    def _curve(self, file, options):
        done = subprocess.run([self.program, "curve", file, "--points", "3", "--jobs", "1", "--json", "-", *options],
                              capture_output=True, text=True, check=False)
        if done.returncode:
            raise SystemExit(f"{file}: {done.stdout}{done.stderr}")
        return json.loads(done.stdout)

    def curve(self, sheet, *options):
        if sheet.keys.get("simulatable") is False:  # a steady state does not depend on the inertia
            sheet = sheet.with_values(drop=("simulatable", "not_simulatable_because"), inertia_gcm2=100.0)
        return self._curve(str(self._file(sheet)), options)

    def points(self, sheet, *options):
        """The points of POINTS, where the model has them. Currents are the supply's; the nominal point is at the printed torque, the
        nominal torque at the printed speed."""
        curve = self.curve(sheet, *options)
        found = {"no_load_speed_rpm": curve["no_load"]["speed_rad_s"] * RPM, "no_load_current_mA": 1e3 * curve["no_load"]["bus_current_A"],
                 "stall_torque_mNm": 1e3 * curve["ideal"]["stall_torque_Nm"], "stall_current_A": curve["locked"]["current_A"]}
        nominal = curve["nominal"] or {}
        if at := nominal.get("curve_at_torque"):
            found |= {"nominal_speed_rpm": at["speed_rad_s"] * RPM, "nominal_current_A": at["bus_current_A"]}
        if at := nominal.get("curve_at_speed"):
            found["nominal_torque_mNm"] = 1e3 * at["torque_Nm"]
        return found

    def rounding(self, sheet, found):
        """Greatest part by which each of the model's points and its printed value can differ because every value is rounded."""
        moved = {name: 0.0 for name in found}
        for name in INPUTS:
            if sheet.literal(name) is None or (name == "no_load_current_mA" and sheet.key("viscous_friction_Nm_s")):
                continue
            other = self.points(sheet.with_values(**{name: sheet.value(name) + sheet.half(name)}))
            for point in found:
                moved[point] += abs(other[point] / found[point] - 1)
        own = {point: sheet.half(point) / sheet.value(point) for point in sheet.points()}
        return {point: moved[point] + own[point] for point in found if point in own}

    def offset_point(self, sheet, speed, offset_deg):
        """(torque of the air gap, supply current) at a held speed, full voltage, Hall edges that come late by an angle."""
        sector = math.pi / 3 / sheet.value("pole_pairs") / speed
        begin = math.ceil(15 * sheet.value("inductance_mH") * 1e-3 / sheet.value("resistance_ohm") / sector) * sector
        scenario = self.folder / f"{sheet.name}-{speed:.6f}-{offset_deg:.9f}.toml"
        text = (f'motor = "{self._file(sheet)}"\nduration_s = {begin + 6 * sector!r}\nsupply.voltage_V = {sheet.value("nominal_voltage_V")}\n'
                f'load.dynamometer_times_s = [0]\nload.dynamometer_rad_s = [{speed!r}]\nreference.value = 1\nreference.unit = "1"\n'
                f'control.mode = "duty"\nsensors.rotor = "hall"\nsensors.hall_offset_deg = {offset_deg!r}\n')
        for signal in ("torque", "bus_current"):
            text += (f'[[compare]]\nmetric = "mean"\nsignal = "{signal}"\nfrom_s = {begin!r}\nto_s = {begin + 6 * sector!r}\n'
                     'value = 1\nsource = "-"\n')
        scenario.write_text(text, encoding="utf-8")
        out = scenario.with_suffix(".json")
        done = subprocess.run([self.program, "run", scenario, "--json", out, "--quiet", "--force"], capture_output=True, text=True, check=False)
        if done.returncode:
            raise SystemExit(f"{scenario}: {done.stdout}{done.stderr}")
        return tuple(row["measured"] for row in json.loads(out.read_text(encoding="utf-8"))["compare"])


def solved(function, target, low, high, steps=6):
    """x with function(x) = target, for a smooth monotone function: Illinois rule."""
    y_low, y_high = function(low) - target, function(high) - target
    x, last = low, 0
    for _ in range(steps):
        x = high - y_high * (high - low) / (y_high - y_low)
        y = function(x) - target
        if y * y_high > 0:
            high, y_high, y_low, last = x, y, y_low * (0.5 if last > 0 else 1), 1
        else:
            low, y_low, y_high, last = x, y, y_high * (0.5 if last < 0 else 1), -1
    return x
