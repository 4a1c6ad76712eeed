#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""hot_code.py [CASE] [--top N]: measures how much code a run of the engine executes repeatedly, with callgrind (Debian's valgrind).

CASE selects rows of engine_benchmark by a regular expression; the default is R3 on the lean kernel. The output has the number of
64-byte cache lines of code with 90 and 99 per cent of the executed instructions, and their functions. A first-level instruction
cache has 32 KiB; a second thread on the same core may use half of it.
"""
import argparse
import collections
import pathlib
import re
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
BENCHMARK = ROOT / "build/dev/benchmarks/engine_benchmark"
LINE = 64


def counted(case):
    """Callgrind's output for the code that the benchmark repeats; with 20 seconds of it, the setup of a run is negligible."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "callgrind"
        subprocess.run(["valgrind", "--tool=callgrind", "--dump-instr=yes", f"--callgrind-out-file={out}",
                        "--toggle-collect=*::run_lean(*", BENCHMARK, f"--benchmark_filter={case}", "--benchmark_min_time=20"], check=True, capture_output=True)
        return out.read_text()


def instructions(text):
    """{address: (times executed, function)}; the costs of a call belong to the called function and follow a line "calls="."""
    names, costs, function, address, of_call = {}, {}, "", 0, False
    for line in text.splitlines():
        named = re.match(r"c?fn=\((\d+)\)(?: (.*))?", line)
        if named:
            names.setdefault(named[1], named[2])
            if line.startswith("fn="):
                function = named[1]
        elif line.startswith("calls="):
            of_call = True
        elif re.match(r"[0-9+*-]", line):
            position, *_, times = line.split()
            if position != "*":
                address = int(position, 16) + (address if position[0] in "+-" else 0)
            if not of_call:
                before = costs.get(address, (0, ""))[0]
                costs[address] = before + int(times), function
            of_call = False
    return {a: (times, names[function]) for a, (times, function) in costs.items()}


def hottest(costs, share):
    """[(instructions, function)] of the fewest lines with this share of all instructions."""
    lines, functions = collections.Counter(), {}
    for address, (times, function) in costs.items():
        lines[address // LINE] += times
        functions.setdefault(address // LINE, function)
    enough, found = share * sum(lines.values()), []
    for line, times in lines.most_common():
        found.append((times, functions[line]))
        enough -= times
        if enough <= 0:
            break
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", nargs="?", default="R3.*lean")
    parser.add_argument("--top", type=int, default=12)
    a = parser.parse_args()
    costs = instructions(counted(a.case))
    for share in (0.9, 0.99):
        print(f"{100 * share:.0f} % of the instructions in {LINE * len(hottest(costs, share)) / 1024:.1f} KiB")
    bytes_, times = collections.Counter(), collections.Counter()
    for n, function in hottest(costs, 0.99):
        bytes_[function] += LINE
        times[function] += n
    whole = sum(n for n, _ in costs.values())
    print("  bytes      %  function")
    for function, n in bytes_.most_common(a.top):
        print(f"{n:7}  {100 * times[function] / whole:5.1f}  {function[:120]}")


if __name__ == "__main__":
    main()
