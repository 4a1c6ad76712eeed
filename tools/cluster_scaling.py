#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cluster_scaling.py [PROGRAM] [--runs N] [--ranks N ..]: measures how the rate of runs depends on the number of
processes that mpirun starts.

Strong scaling: the same number of runs on more ranks. Weak scaling: the same number of runs per rank. The output has the wall time,
and the processor time of all ranks per run, which hardly depends on other programs. The drives are in
data/scenarios/current-square-series.toml. The program must be built with MPI."""
import argparse
import os
import pathlib
import re
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
SERIES = ROOT / "data/scenarios/current-square-series.toml"
# mpirun does not count the time of its processes, so a shell around each process does.
COUNTED = '"$0" "$@"; times >cpu.$OMPI_COMM_WORLD_RANK'


def measure(program, ranks, runs):
    """Wall time, and processor time of each rank, in s. A single rank runs without mpirun."""
    environment = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_COMM_WORLD_RANK": "0"}
    with tempfile.TemporaryDirectory() as folder:
        words = ["bash", "-c", COUNTED, program, "run", str(SERIES), "--runs", str(runs), "--jobs", "1", "--store", "s.sqlite", "--quiet"]
        launched = [] if ranks == 1 else ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(ranks)]
        begin = time.monotonic()
        subprocess.run(launched + words, cwd=folder, env=environment, check=True)
        wall_s = time.monotonic() - begin
        told = [pathlib.Path(folder, f"cpu.{rank}").read_text() for rank in range(ranks)]
    return wall_s, [sum(60 * float(m) + float(s) for m, s in re.findall(r"(\d+)m([\d.]+)s", text)) for text in told]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=ROOT / "build/mpi/sixstep")
    parser.add_argument("--runs", type=int, default=5000)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    arguments = parser.parse_args()
    print(f"load of the machine before: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    print(f"{'':8}{'ranks':>6}{'runs':>8}{'wall s':>8}{'runs/s':>8}{'CPU us a run':>14}  CPU s of each rank")
    for kind in ("strong", "weak"):
        for ranks in arguments.ranks:
            runs = arguments.runs * (ranks if kind == "weak" else 1)
            wall_s, cpu_s = measure(str(arguments.program), ranks, runs)
            print(f"{kind:8}{ranks:6}{runs:8}{wall_s:8.2f}{runs / wall_s:8.0f}{1e6 * sum(cpu_s) / runs:14.0f}  "
                  + " ".join(f"{x:.2f}" for x in cpu_s), flush=True)


if __name__ == "__main__":
    main()
