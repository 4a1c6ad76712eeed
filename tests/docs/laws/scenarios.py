# SPDX-License-Identifier: Apache-2.0
"""The upper bounds of a scenario's motor and supply. They are read from the files by a second implementation."""
import functools
import re
import tomllib
from math import pi, sqrt

from page import REPOSITORY


def merged(base, over):
    out = dict(base)
    for key, value in over.items():
        out[key] = merged(out[key], value) if isinstance(value, dict) and isinstance(out.get(key), dict) else value
    return out


def read(file):
    own = tomllib.loads(file.read_text(encoding="utf-8"))
    if "extends" in own:
        own = merged(read((file.parent / own["extends"]).resolve()), own)
    return own


def value(entry):
    return entry["value"] if isinstance(entry, dict) else entry


@functools.lru_cache(maxsize=None)
def motor(name):
    file = REPOSITORY / "data/motors" / f"{name}.toml"
    return tomllib.loads(file.read_text(encoding="utf-8")) if file.exists() else None


def terminal_ohm(sheet):
    """The resistance between two terminals, from a sheet with a terminal or a phase value."""
    entry = sheet["resistance_ohm"]
    frame = entry.get("frame", "terminal") if isinstance(entry, dict) else "terminal"
    return value(entry) * (2 if frame == "phase" else 1)


class Most:
    """The largest current and line voltage of a scenario. Assumption: both ends of a winding are at the bus, and a
    back-EMF of twice the no-load speed adds to it, as after a reversal at speed."""

    def __init__(self, scenario, settings=()):
        for key, text in settings:
            *tables, last = key.split(".")
            table = scenario
            for name in tables:
                table = table.setdefault(name, {})
            table[last] = float(text) if re.fullmatch(r"[-+.\de]+", text) else text
        sheet = merged(motor(scenario.get("motor", "")) or {}, scenario.get("motor_override", {}))
        self.known = "resistance_ohm" in sheet and isinstance(scenario.get("motor"), str)
        if not self.known:
            return
        self.R = terminal_ohm(sheet)
        supply = scenario.get("supply", {})
        self.U = max([float(supply.get("voltage_V", value(sheet.get("nominal_voltage_V", 24)))), sqrt(2) * supply.get("mains_rms_V", 0)])
        self.period_s = float(scenario.get("pwm", {}).get("period_s", 30e-6))
        self.duration_s = float(scenario["duration_s"]) if not isinstance(scenario["duration_s"], str) else None
        self.current_A = 3 * self.U / self.R
        self.voltage_V = 4 * self.U
        self.power_W = self.current_A * self.voltage_V
        self.speed_rad_s = 2e5 * pi / 30

    def bound(self, dimension):
        return {"A": self.current_A, "V": self.voltage_V, "W": self.power_W, "rad/s": self.speed_rad_s}.get(dimension)


COMMAND = re.compile(r"(?:\./run|sixstep) run (.*)")


def most_of_command(command, written):
    """The bounds of the first scenario that a command line runs. `written`: the files that the page has written, by
    name."""
    m = COMMAND.search(command)
    if not m:
        return None
    words = m.group(1).split()
    files = [w for w in words if w.endswith(".toml") and "*" not in w]
    sets = [tuple(words[n + 1].split("=", 1)) for n, w in enumerate(words[:-1]) if w == "--set" and "=" in words[n + 1]]
    if len(files) != 1:
        return None
    if files[0] in written:
        scenario = tomllib.loads(written[files[0]])
        if "extends" in scenario:
            base = written.get(scenario["extends"])
            if base is None:
                return None
            scenario = merged(tomllib.loads(base), scenario)
    elif (REPOSITORY / files[0]).exists():
        scenario = read(REPOSITORY / files[0])
    else:
        return None
    most = Most(scenario, sets)
    return most if most.known else None
