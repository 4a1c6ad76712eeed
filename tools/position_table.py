#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""position_table.py [PROGRAM]: results of each method of rotor sensing on the maxon 251601, as Markdown.

  --renew          also writes the table between its markers in docs/howto/choose-a-rotor-sensor.md
  --check          fails if the page's table differs in rows or columns
  --costs          needs no PROGRAM and measures nothing: only the costs on a chip are computed again from data/cores/
  --keep FOLDER    keeps the scenarios in this folder

In the first test a dynamometer turns the motor at a constant speed while its drive controls 1 A. It measures the angle at which the
pairs change, and the ripple of the torque. In the second test the drive starts the motor from rest to 100 rad/s against a tenth of
the nominal torque. Each test is a scenario of `sixstep run` with a fixed seed, so that the table is the same on every machine. The
costs on a chip were counted on emulated cores (tools/check_target.sh).
"""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import core_tables  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/howto/choose-a-rotor-sensor.md"
BLOCK = re.compile(r"(<!-- position: table -->\n)(.*?)(<!-- end -->)", re.S)
SPEEDS = (1, 10, 30, 60, 100, 300, 700)
PAIRS, K_T = 8, 33.5e-3
LEARNED = 9 * 6 * PAIRS  # sectors: edges are learned from eight even turns

BOARD = """
[pwm]
alignment = "centre"
sample = "middle"
{pwm}
[control]
drive = "{drive}"
mode = "{mode}"
{control}
[control.current]
settle_s = 1e-3
damping = 0.9

[sensors]
capture_Hz = 16e6
{sensors}
"""
TURNED = """
motor = "maxon-251601"
duration_s = {duration}
supply.voltage_V = 36  # so that the current is held at 700 rad/s, too
load.dynamometer_times_s = [0]
load.dynamometer_rad_s = [{speed}]
reference.value = 1
"""
STARTED = """
motor = "maxon-251601"
duration_s = 2.5
supply.voltage_V = 24
load.coulomb_Nm = 0.0067
reference.value = 100
initial.angle_rad = 0.3
"""
SPEED_LOOP = "speed = { settle_s = 0.1, damping = 0.9 }"
MISPLACED = "hall_edges_deg = [3, -4, 2, -3, 4, -2]"
AT_SAMPLES = 'commutation = "sample"'

# name: (drive, keys of [pwm], keys of [sensors] with their tables, keys of [control])
SOURCES = {
    "ideal": ("lean", "", "", ""),
    "Hall, probes in their places": ("lean", "", 'rotor = "hall"', ""),
    "Hall, edges up to 4 deg beside theirs": ("lean", "", f'rotor = "hall"\n{MISPLACED}', ""),
    "the same, angle between the edges": ("lean", AT_SAMPLES, f'rotor = "hall"\nhall_angle = "interpolated"\n{MISPLACED}', ""),
    "the same, edges learned": ("lean", AT_SAMPLES, f'rotor = "hall"\nhall_angle = "calibrated"\n{MISPLACED}', ""),
    "encoder, 1024 lines": ("lean", AT_SAMPLES, 'rotor = "encoder"\n[sensors.encoder]\nlines = 1024', ""),
    "absolute encoder, 14 bits": ("lean", AT_SAMPLES, 'rotor = "absolute"\n[sensors.absolute]\nbits = 14\nlatency_s = 10e-6', ""),
    "resolver, windings 0.5 % unlike": ("lean", AT_SAMPLES, 'rotor = "resolver"\n[sensors.resolver]\nimbalance = 0.005\n'
                                        "excitation_Hz = 8333.333333333333\nnoise_V = 2e-3", ""),
    "zero crossing": ("sensorless", "", "bus_noise_V = 0.01", ""),
    "comparators at the terminals": ("sensorless", "", "bus_noise_V = 0.01\n[sensors.comparators]\nbandwidth_Hz = 20e3",
                                     'sensorless.follows = "comparators"'),
    "Luenberger observer": ("sensorless", "", "bus_noise_V = 0.01", 'sensorless.follows = "luenberger"'),
    "sliding-mode observer": ("sensorless", "", "bus_noise_V = 0.01", 'sensorless.follows = "sliding-mode"'),
    "flux linkage": ("sensorless", "", "bus_noise_V = 0.01", 'sensorless.follows = "flux-linkage"'),
}

# Functions that the chip calls for each method, as in rig/sensors.hpp, hall_interpolator.hpp, rotor_decoder.hpp and control/sensorless/
# sensorless_drive.hpp, in a period with an edge, a line or a commutation: blocks and functions of
# data/cores/blocks.txt. A timer counts the encoder's lines. The cost of learning edges is left out, because it ends.
COSTS_ON = (("Cortex-M0", "q15"), ("Cortex-M4F", "float"))
HALL_EDGE = (("hall", "hall_step"), ("hall_speed", "sector_time+hall_speed_edge+hall_position_edge"))
HALL = (*HALL_EDGE, ("hall_speed", "hall_speed"), ("hall_speed", "sector_fraction+hall_position"))
BETWEEN_EDGES = (*HALL_EDGE, ("sensing/hall_angle", "hall_angle_edge"), ("sensing/hall_angle", "hall_angle"))
CROSSING = (("sensorless/sensorless", "sensorless_step"), ("sensorless/sensorless", "sensorless_commutate"),
            ("sensorless/sensorless", "sensorless_answer+sensorless_speed+sensorless_position"))
DECODERS = {
    "ideal": (),
    "Hall, probes in their places": HALL,
    "Hall, edges up to 4 deg beside theirs": HALL,
    "the same, angle between the edges": BETWEEN_EDGES,
    "the same, edges learned": BETWEEN_EDGES,
    "encoder, 1024 lines": (("sensing/quadrature", "quadrature_moved+quadrature_index"), ("sensing/pulse_speed", "pulse_edge"),
                            ("sensing/pulse_speed", "pulse_speed"), ("sensing/quadrature", "quadrature_angle")),
    "absolute encoder, 14 bits": (("sensing/gray", "gray_step"),),
    "resolver, windings 0.5 % unlike": (("sensing/resolver", "resolver_step"), ("sensing/resolver", "tracked_speed")),
    "zero crossing": CROSSING,
    "comparators at the terminals": (("sensorless/captured_crossing", "capture_lines"),
                                     ("sensorless/captured_crossing", "captured_crossing_step"), *CROSSING),
    "Luenberger observer": (("sensorless/observer", "observer_step(luenberger)"), *CROSSING),
    "sliding-mode observer": (("sensorless/observer", "observer_step(sliding_mode)"), *CROSSING),
    "flux linkage": (("sensorless/observer", "observer_step(flux)"), *CROSSING),
}


def cost_of(source, counted):
    """Instructions on each core: the sum of the worst calls of a period."""
    def worst(core, scalar, block, function):
        row = counted.get((core, block, scalar, function)) or counted.get((core, block, "whole", function))
        if not row:
            sys.exit(f"data/cores/blocks.txt has no {function} of {block} in {scalar} on {core}")
        return int(row[3])
    sums = [sum(worst(*place, *call) for call in DECODERS[source]) for place in COSTS_ON]
    return ", ".join(map(str, sums)) if DECODERS[source] else "-"


def scenario_of(source, mode, head, requirements):
    drive, pwm, sensors, control = SOURCES[source]
    loop = SPEED_LOOP if mode == "speed" else ""
    return head + BOARD.format(drive=drive, pwm=pwm, mode=mode, control=f"{loop}\n{control}", sensors=sensors) + requirements


def figure(metric, window, signal=None, **more):
    words = [f'metric = "{metric}"', f"from_s = {window[0]!r}", f"to_s = {window[1]!r}"]
    words += [f'signal = "{signal}"'] if signal else []
    words += [f"{key} = {value}" for key, value in more.items()]
    return "[[compare]]\n" + "\n".join(words) + '\nvalue = 1\nsource = "-"\n'


class Bench:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def figures(self, name, text):
        """The requested figures, None for a missing one; empty if the drive tripped."""
        file = self.folder / (re.sub(r"[^a-z0-9]+", "-", name.lower()) + ".toml")
        file.write_text(text, encoding="utf-8")
        done = subprocess.run([self.program, "run", str(file), "--json", str(file.with_suffix(".json")), "--quiet", "--force"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode == 2:
            raise SystemExit(f"{file}: {done.stdout}")
        experiment = json.loads(file.with_suffix(".json").read_text(encoding="utf-8"))
        lost = bool(experiment.get("fault")) or any("lost the rotor" in note for note in experiment.get("notes", []))
        return None if lost else [row["measured"] for row in experiment["compare"]]

    def turned(self, source, speed):
        """(worst, rms of the commutation's angle in deg, mean torque, ripple of it) over 18 sectors at a steady speed."""
        sector = math.pi / 3 / PAIRS / speed
        begin = max(0.05, (LEARNED if "calibrated" in SOURCES[source][2] else 12) * sector)
        end = begin + 18 * sector
        window = (begin, end)
        wanted = (figure("commutation_error_deg", window) + figure("commutation_error_rms_deg", window) +
                  figure("mean", window, "torque") + figure("ripple_rms", window, "torque"))
        return self.figures(f"{source} {speed}", scenario_of(source, "current", TURNED.format(duration=end, speed=speed), wanted))

    def started(self, source):
        wanted = figure("reach_time_s", (0, 2.5), "speed", fraction=0.95, level=100)
        return self.figures(f"{source} start", scenario_of(source, "speed", STARTED, wanted))


def drives(turned):
    """Whether the drive runs to the end with the torque of its current."""
    return turned is not None and turned[2] is not None and turned[2] > 0.9 * K_T


def rows_of(bench):
    def row(source):
        at = {speed: bench.turned(source, speed) for speed in SPEEDS}
        cells = [source]
        for speed in SPEEDS:
            cells.append(f"{at[speed][1]:.2g}, {at[speed][0]:.2g}" if drives(at[speed]) else "-")
        lowest = min((speed for speed in SPEEDS if drives(at[speed])), default=None)
        cells.append("-" if lowest is None else "rest" if lowest == SPEEDS[0] else f"{lowest}")
        cells.append(f"{100 * at[100][3] / at[100][2]:.1f} %" if drives(at[100]) else "-")
        begun = bench.started(source)
        cells.append(f"{1e3 * begun[0]:.0f} ms" if begun and begun[0] is not None else "-")
        return cells

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(row, SOURCES))


MEASURED = ["known by"] + [f"{speed}" for speed in SPEEDS] + ["lowest", "ripple", "start"]


def kept_rows(table):
    """The measured rows of the page: each method once, in the order of this file."""
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()]
    if rows[0][:len(MEASURED)] != MEASURED or [row[0] for row in rows[2:]] != list(SOURCES):
        sys.exit("docs/howto/choose-a-rotor-sensor.md has other rows or columns: tools/position_table.py PROGRAM --renew measures them")
    return [row[:len(MEASURED)] for row in rows[2:]]


def markdown(rows):
    """The measured cells, followed by the costs on a chip."""
    counted = core_tables.keyed(core_tables.CORES / "blocks.txt", 4)
    head, rows = [*MEASURED, "chip"], [[*cells, cost_of(cells[0], counted)] for cells in rows]
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rows]
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", nargs="?")
    parser.add_argument("--renew", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--costs", action="store_true")
    parser.add_argument("--keep", type=pathlib.Path)
    options = parser.parse_args()
    if bool(options.program) == options.costs:
        parser.error("either PROGRAM, which measures, or --costs, which does not")
    text = PAGE.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        if options.keep:
            options.keep.mkdir(parents=True, exist_ok=True)
        table = markdown(kept_rows(BLOCK.search(text)[2]) if options.costs else
                         rows_of(Bench(os.path.abspath(options.program), options.keep or pathlib.Path(folder))))
    print(table, end="")
    if not (options.renew or options.check):
        return
    if options.renew:
        PAGE.write_text(BLOCK.sub(lambda m: m[1] + table + m[3], text), encoding="utf-8")
    elif BLOCK.search(text)[2] != table:
        by = "--costs" if options.costs else "PROGRAM"
        sys.exit(f"docs/howto/choose-a-rotor-sensor.md has another table: tools/position_table.py {by} --renew")


if __name__ == "__main__":
    main()
