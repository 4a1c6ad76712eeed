#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""build_times.py [--target T] [--top N] [--jobs J] [--write] [BUILD]: the compile time of each object of a configured build, longest first.

Each object is compiled without output, and once more with -fsyntax-only. The second time is the front end (reading headers and
instantiating templates), the rest is the back end (optimising, assembling). Times are CPU seconds, because other programs hardly
change these. Without --target, all objects are compiled, which takes half an hour of one core; ./run builds the target sixstep.
--write also writes the tables into docs/contributing.md.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/contributing.md"
PLACE = re.compile(r"(?<=<!-- build times -->\n).*?(?=<!-- end -->)", re.S)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", default="build/release", type=pathlib.Path)
    parser.add_argument("--target", default="")
    parser.add_argument("--top", type=int, default=40)
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--write", action="store_true")
    return parser.parse_args()


def entries(build, target):
    """All objects of the build, or the objects that ninja would compile for a target."""
    commands = json.loads((build / "compile_commands.json").read_text())
    if not target:
        return commands
    asked = subprocess.run(["ninja", "-C", build, "-t", "commands", target], check=True, text=True, stdout=subprocess.PIPE).stdout
    objects = set(re.findall(r" -o (\S+\.o) ", asked))
    return [entry for entry in commands if re.search(r" -o (\S+) ", entry["command"]).group(1) in objects]


def compiler_words(command):
    words = shlex.split(command)
    return words[1:] if pathlib.Path(words[0]).name == "ccache" else words


def cpu_seconds(words, folder):
    """CPU time of one compiler and its child processes. wait4 counts this child alone, also if others run."""
    child = subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    said = child.stderr.read()
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit(said.decode(errors="replace"))
    return used.ru_utime + used.ru_stime


def cost(entry):
    words = compiler_words(entry["command"])
    words[words.index("-o") + 1] = os.devnull
    whole = cpu_seconds(words, entry["directory"])
    front = cpu_seconds([*words, "-fsyntax-only"], entry["directory"])
    return unit_of(entry), min(front, whole), whole


def unit_of(entry):
    """Name of a batch: its first and last source."""
    file = pathlib.Path(entry["file"])
    if file.parent.name != "Unity":
        return str(file.relative_to(ROOT)) if file.is_relative_to(ROOT) else file.name
    sources = [pathlib.Path(s).relative_to(ROOT) for s in re.findall(r'^#include "(.*\.cpp)"', file.read_text(), re.M)]
    return f"{sources[0]} .. {sources[-1].name} ({len(sources)})"


def room_of(unit):
    parts = unit.split("/")
    return "/".join(parts[:2]) if parts[0] in ("sixstep", "tests", "faces") and len(parts) > 2 else parts[0]


def tables(costs, top):
    costs = sorted(costs, key=lambda c: -c[2])
    total, front = sum(c[2] for c in costs), sum(c[1] for c in costs)
    lines = [f"{len(costs)} objects, {total:.0f} s of one core: {front:.0f} s front end, {total - front:.0f} s back end.", "",
             "| room | objects | front end, s | back end, s |", "|---|---|---|---|"]
    rooms = collections.defaultdict(lambda: [0, 0.0, 0.0])
    for unit, fore, whole in costs:
        row = rooms[room_of(unit)]
        row[0], row[1], row[2] = row[0] + 1, row[1] + fore, row[2] + whole - fore
    for room, (count, fore, back) in sorted(rooms.items(), key=lambda r: -(r[1][1] + r[1][2])):
        lines.append(f"| {room} | {count} | {fore:.1f} | {back:.1f} |")
    lines += ["", "| unit | front end, s | back end, s |", "|---|---|---|"]
    lines += [f"| {unit} | {fore:.1f} | {whole - fore:.1f} |" for unit, fore, whole in costs[:top]]
    return "\n".join(lines)


def main():
    a = arguments()
    build = (ROOT / a.build) if not a.build.is_absolute() else a.build
    chosen = [e for e in entries(build, a.target) if e["file"].endswith((".cpp", ".cxx", ".c"))]
    with concurrent.futures.ThreadPoolExecutor(a.jobs) as pool:
        costs = list(pool.map(cost, chosen))
    text = tables(costs, a.top)
    print(text)
    if a.write:
        page = PAGE.read_text(encoding="utf-8")
        PAGE.write_text(PLACE.sub(lambda _: f"{text}\n", page, count=1), encoding="utf-8")


if __name__ == "__main__":
    main()
