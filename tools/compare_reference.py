#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""compare_reference.py [PROGRAM]: runs the reference cases and compares them with float128 trajectories.

The trajectories in tests/reference were computed by an independent brute-force solver in float128 arithmetic. The output
has per case the largest difference of a column, divided by the column's largest value; columns of zeros have the absolute difference.
Fails above 1e-10 for currents and bus voltage and above 1e-12 for speed and angle.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
COLUMNS = {"i_a": "i_a_A", "i_b": "i_b_A", "i_c": "i_c_A", "w_m": "speed_rad_s", "theta_m": "angle_rad", "U_s": "bus_V",
           "i_src": "source_A", "j_sum": "loop_A", "w_2": "load_speed_rad_s", "theta_2": "load_angle_rad"}
LIMITS = {"currents": 1e-10, "speed": 1e-12, "angle": 1e-12, "bus": 1e-10}
GROUPS = {"currents": ("i_a", "i_b", "i_c", "i_src", "j_sum"), "speed": ("w_m", "w_2"), "angle": ("theta_m", "theta_2"), "bus": ("U_s",)}


def columns_of(file):
    with open(file, newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def error(ours, theirs):
    if len(ours) != len(theirs):
        raise SystemExit(f"compare_reference: {len(ours)} rows instead of {len(theirs)}; were the files changed?")
    return max(abs(x - y) for x, y in zip(ours, theirs)) / (max(map(abs, theirs)) or 1.0)


def case_errors(program, scenario, folder):
    """Largest error per group of columns, without groups that the trajectory lacks."""
    trace = pathlib.Path(folder) / (scenario.stem + ".csv")
    subprocess.run([program, "run", scenario, "--csv", trace, "--quiet"], check=True)
    ours, theirs = columns_of(trace), columns_of(ROOT / "tests" / "reference" / trace.name)
    present = {group: [name for name in names if name in theirs] for group, names in GROUPS.items()}
    errors = {group: max(error(ours[COLUMNS[name]], theirs[name]) for name in names)
              for group, names in present.items() if names}
    return len(theirs["t"]), errors


def main(words):
    program = pathlib.Path(words[0] if words else ROOT / "build/release/sixstep").resolve()
    # R: cases of the lean kernel; G: cases of the general kernel.
    cases = sorted((ROOT / "data/scenarios/reference").glob("[RG]*.toml"),
                   key=lambda p: (p.stem[0] == "G", int("".join(filter(str.isdigit, p.stem))), p.stem))
    print(f"{'case':<31}{'rows':>5}  {'currents':>9}  {'speed':>9}  {'angle':>9}  {'bus':>9}")
    missed = []
    with tempfile.TemporaryDirectory() as folder:
        for scenario in cases:
            title = next(line for line in scenario.read_text().splitlines() if line.startswith("title")).split('"')[1]
            rows, errors = case_errors(program, scenario, folder)
            cells = [f"{errors[group]:.0e}" if errors.get(group) else "0" if group in errors else "" for group in GROUPS]
            print((f"{title:<31}{rows:>5}" + "".join(f"  {cell:>9}" for cell in cells)).rstrip())
            missed += [f"{title}: {group} {e:.0e} > {LIMITS[group]:.0e}" for group, e in errors.items() if not e <= LIMITS[group]]
    if missed or not cases:
        raise SystemExit("compare_reference: " + ("; ".join(missed) or "no cases found"))
    print(f"{len(cases)} of {len(cases)} cases match")


if __name__ == "__main__":
    main(sys.argv[1:])
