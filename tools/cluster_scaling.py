#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cluster_scaling.py [PROGRAM] [--runs N] [--ranks N ..]: how a plan's runs grow with the processes that mpirun starts.

Strong: the same runs on more ranks. Weak: as many runs more as there are ranks more. Shown are the wall clock, and the processor
time that all ranks took for a run: that does not hang on what else the machine does. The drives are those of
data/scenarios/current-square-series.toml, the program is built with MPI."""
import argparse
import os
import pathlib
import re
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
SERIES = ROOT / "data/scenarios/current-square-series.toml"
# mpirun does not count the time of its processes: a shell around each of them does.
COUNTED = '"$0" "$@"; times >cpu.$OMPI_COMM_WORLD_RANK'


def measure(program, ranks, runs):
    """Seconds of the clock, and of the processor for each rank; without mpirun where there is one rank."""
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
