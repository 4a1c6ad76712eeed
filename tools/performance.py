#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""performance.py: builds the benchmarks, runs them (three minutes), prints the tables of speed as Markdown.

  --renew   also writes them between their markers in README.md and docs/explanation/performance.md
  --check   runs nothing; checks that the tables in the pages have the rows and columns of the benchmarks.
            Figures differ between machines and are not compared.
  --programs FOLDER   folder with the built benchmarks

Times are CPU times. The fastest of fifteen repetitions in random order counts, because other programs can only increase a time.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
BUILD = ROOT / "build/dev"
YARDSTICKS = ("textbook 1 us", "textbook 0.1 us", "tuned 1 us", "tuned 0.1 us")
KERNELS = ("lean", "general")
LONG = ("1 s", "10 s")
USERS = "study of 10 s"  # digest, audit and the scenario's figures
AS_USER = ", as a user runs it, 10 s"
PLACES = {"speed": "docs/explanation/performance.md", "short": "README.md", "growth": "docs/explanation/performance.md", "observers": "docs/explanation/performance.md"}


def said_by(*words, **more):
    return subprocess.run([str(word) for word in words], check=True, text=True, stdout=subprocess.PIPE, **more).stdout


def built():
    said_by(ROOT / "tools/configure.sh", "dev")
    said_by("cmake", "--build", BUILD, "--target", "engine_benchmark", "observer_benchmark")
    return BUILD / "benchmarks"


def names_of(program):
    return dict.fromkeys(said_by(program, "--benchmark_list_tests").splitlines(), {})


def measured(program):
    """{name: {counter: value}} of the fastest repetition."""
    report = json.loads(said_by(program, "--benchmark_format=json", "--benchmark_repetitions=15", "--benchmark_min_time=0.1",
                                "--benchmark_enable_random_interleaving=true", stderr=subprocess.DEVNULL))
    best = names_of(program)
    for run in report["benchmarks"]:
        if run.get("error_occurred"):
            raise SystemExit(f"performance: {run['name']}: {run['error_message']}")
        name = run["run_name"]
        if run["run_type"] == "iteration" and run["per_period"] < best[name].get("per_period", float("inf")):
            best[name] = run
    return best


def ns(run):
    return 1e9 * run["per_period"] if run else 0.0


def solvers_of(runs):
    """{case: {solver or observer: run}}, in the order of the program."""
    cases = {}
    for name, run in runs.items():
        case, _, solver = name.partition("/")
        cases.setdefault(case, {})[solver] = run
    return cases


def share(error):
    return "" if error is None else f"{100 * error:.2g} %" if error > 1e-6 else f"{error:.0e}"


def speed_table(engine, users):
    """A row for each case and kernel that runs it; after the scenario's own kernel, a row of a user's run."""
    rows = [["case", "kernel", "ns per 30 us", "simulated s per s", "error of the current", *(f"RK4 {y}" for y in YARDSTICKS)]]
    for kernel in KERNELS:
        for case, runs in solvers_of(engine).items():
            if kernel not in runs:
                continue
            own = runs[kernel]
            cells = [case, kernel, f"{ns(own):.0f}", f"{30e3 / (ns(own) or 1):.0f}", share(own.get("error"))]
            for yardstick in YARDSTICKS:
                error = share(runs[yardstick].get("error")) if yardstick in runs else ""
                there = f"{ns(runs[yardstick]) / (ns(own) or 1):.1f}x" if yardstick in runs else ""
                cells.append(there + (f", {error}" if error else ""))
            rows.append(cells)
            if case in users and kernel == next(k for k in KERNELS if k in runs):
                own = users[case]
                rows.append([case + AS_USER, kernel, f"{ns(own):.0f}", f"{30e3 / (ns(own) or 1):.0f}",
                             *[""] * (1 + len(YARDSTICKS))])
    return rows


def short_table(speed):
    """Excerpt of the table of speed: one row per case, on the kernel of its scenario, with the textbook solver for comparison."""
    rows = [["case", "simulated s per s, engine alone", "simulated s per s, as a user runs it", speed[0][4], *speed[0][5:7]]]
    for alone, user in zip(speed, speed[1:]):
        if user[0] == alone[0] + AS_USER:
            rows.append([alone[0], alone[3], user[3], *alone[4:7]])
    return rows


def growth_table(engine):
    rows = [["case", *(f"ns per 30 us over {length}" for length in LONG), "cost of ten times the time"]]
    for case, runs in solvers_of(engine).items():
        if LONG[0] in runs:
            short, long = (ns(runs[length]) for length in LONG)
            rows.append([case, f"{short:.0f}", f"{long:.0f}", f"{10 * long / (short or 1):.2f}x"])
    return rows


def observer_table(cases):
    rows = [["observer"] + [f"{case}{what}" for case in cases for what in (", ns per 30 us", ", more")]]
    for observer in next(iter(cases.values())):
        cells = [observer]
        for runs in cases.values():
            none, with_it = ns(runs["none"]), ns(runs[observer])
            cells += [f"{with_it:.0f}", "" if observer == "none" else f"{100 * (with_it / (none or 1) - 1):.0f} %"]
        rows.append(cells)
    return rows


def tables_of(engine, observers):
    users, cases = {}, {}
    for case, runs in solvers_of(observers).items():
        users |= {case: run for name, run in runs.items() if name == USERS}
        if "none" in runs:
            cases[case] = {name: run for name, run in runs.items() if name != USERS}
    speed = speed_table(engine, users)
    return {"speed": speed, "short": short_table(speed), "growth": growth_table(engine), "observers": observer_table(cases)}


def markdown(rows):
    head, *rest = rows
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rest]
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def shape(rows):
    """Cells that must be the same on every machine: the first row and the first column."""
    return [rows[0], [row[0] for row in rows]]


def block(name):
    return re.compile(rf"(<!-- performance: {name} -->\n)(.*?)(<!-- end -->)", re.S)


def written_rows(text, name):
    found = block(name).search(text)
    lines = [line for line in found[2].splitlines() if line.startswith("|")] if found else []
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return rows[:1] + rows[2:]


def differences(tables, text_of):
    return [f"{place}: the table \"{name}\" has other rows or columns than the benchmarks" for name, place in PLACES.items()
            if not (written := written_rows(text_of(place), name)) or shape(written) != shape(tables[name])]


def machine():
    cpu = re.search(r"^model name\s*:\s*(.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.M)
    compiler = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", (BUILD / "CMakeCache.txt").read_text(), re.M)
    version = said_by(compiler[1], "--version").splitlines()[0] if compiler else "unknown compiler"
    return f"Measured on one core of: {cpu[1] if cpu else 'unknown processor'}; {version}.\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--renew", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--programs", type=pathlib.Path)
    words = parser.parse_args()
    folder = words.programs or built()
    look = names_of if words.check else measured
    tables = tables_of(look(folder / "engine_benchmark"), look(folder / "observer_benchmark"))
    if words.check:
        wrong = differences(tables, lambda place: (ROOT / place).read_text(encoding="utf-8"))
        print("\n".join(wrong + ["write them anew: tools/performance.py --renew"] if wrong else ["the tables have the rows and columns of the benchmarks"]))
        return 1 if wrong else 0
    on = machine()
    for name, rows in tables.items():
        text = f"{on}\n{markdown(rows)}"
        print(f"{name}\n\n{text}")
        file = ROOT / PLACES[name]
        if words.renew:
            old = file.read_text(encoding="utf-8")
            new, count = block(name).subn(lambda found: found[1] + text + found[3], old)
            if count != 1:
                raise SystemExit(f"performance: {PLACES[name]} has no markers <!-- performance: {name} --> .. <!-- end -->")
            file.write_text(new, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
