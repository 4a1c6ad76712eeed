#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the tests detect errors of the engine. Marks in the sources state a typical mistake for a line; with the mistake, a
law or an analytic test must fail. It takes minutes; `ctest --preset long` runs it too:

    tools/mutants.py              all marks; exits non-zero if a mistake is not detected
    tools/mutants.py 7 12         only these marks
    tools/mutants.py --list       the marks with their lines

A mark is above the line that it changes, and replaces the first match after the mark:

    // mutant: OLD => NEW             an expression, or one statement with its semicolon
    // mutant: BEFORE «OLD» => NEW    where OLD alone would be found too early
    // mutant: OLD => nothing         a statement is removed

All mutants are built at once in a copy under build/mutants. An environment variable switches each mutant on, and the tree does
not change. Digests and reference cases do not run, because a golden value detects every change but does not explain it.

Some lines have no marks, because another line gives the same result:
  - the length that useful_length() proposes: the series' end decides;
  - near_root(): it is only a guess;
  - the order in which settle() tries motions and sources: only one combination is consistent;
  - the check of the comparators in act() after every segment: a guard below zero is an event at once.
"""
import collections
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

root = Path(__file__).resolve().parent.parent
work = root / "build" / "mutants"
programs = ("series", "sim", "plant", "rig", "study", "fuzz")
limit_s = 60  # the whole of a program takes seconds; a mutant may well run for ever
Mutant = collections.namedtuple("Mutant", "file line begin end old new")

switch = """#pragma once
#include <cstdlib>
#include <type_traits>
inline const int sixstep_mutant = std::getenv("SIXSTEP_MUTANT") ? std::atoi(std::getenv("SIXSTEP_MUTANT")) : 0;
constexpr bool mutant_is(int n) { return !std::is_constant_evaluated() && sixstep_mutant == n; }
"""


def mutants_of(file):
    """The marks of a source, each with the position of the text that it replaces."""
    text = (root / file).read_text(encoding="utf-8")
    for mark in re.finditer(r"(?m)^ *// mutant: (.*) => (.*)\n", text):
        before, old = re.fullmatch(r"(?:(.*)«)?(.*?)»?", mark[1]).groups(default="")
        pattern = r"\s+".join(re.escape(word) for word in (before + old).split())
        found = re.compile(pattern).search(text, mark.end())
        line = text.count("\n", 0, mark.start()) + 1
        if not found or text.count("\n", mark.end(), found.start()) > 12:
            sys.exit(f"{file}:{line}: what the mark breaks does not follow it: {mark[1]}")
        begin = found.end() - len(re.search(r"\s+".join(re.escape(w) for w in old.split()) + r"\Z", found[0])[0])
        yield Mutant(file, line, begin, found.end(), old, "" if mark[2] == "nothing" else mark[2])


def all_mutants():
    files = sorted(f.relative_to(root).as_posix() for f in (root / "sixstep").glob("**/*.[ch]pp"))
    return [mutant for file in files for mutant in mutants_of(file)]


def broken(file, mutants):
    """The file's text with all its mutants behind switches. Several mutants may have the same position."""
    text = (root / file).read_text(encoding="utf-8")
    places = collections.defaultdict(list)
    for number, mutant in enumerate(mutants, 1):
        if mutant.file == file:
            places[mutant.begin, mutant.end].append((number, mutant.new))
    for (begin, end), here in sorted(places.items(), reverse=True):
        part = text[begin:end]
        for number, new in here:
            part = (f"if (mutant_is({number})) {{ {new} }} else {{ {part} }}" if part.endswith(";") else
                    f"(mutant_is({number}) ? ({new}) : ({part}))")
        text = text[:begin] + part + text[end:]
    return text


def build(mutants):
    source = work / "source"
    files = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=root, check=True, capture_output=True, text=True)
    copied = {file: (root / file).read_bytes() for file in files.stdout.split() if (root / file).is_file()}
    copied |= {file: broken(file, mutants).encode() for file in {m.file for m in mutants}} | {"switch.hpp": switch.encode()}
    for file, text in copied.items():
        copy = source / file
        if not copy.exists() or copy.read_bytes() != text:  # else nothing to compile anew
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(text)
    for folder, _, names in os.walk(source):  # files that the tree no longer has must not be built
        for file in (Path(folder) / name for name in names):
            if str(file.relative_to(source)) not in copied:
                file.unlink()
    if not (source / "node_modules").exists():  # the report's chart library, which the build needs
        (source / "node_modules").symlink_to(root / "node_modules")
    subprocess.run(["cmake", "-S", source, "-B", work / "build", "-G", "Ninja", "-DSIXSTEP_BENCHMARKS=OFF", "-DCMAKE_BUILD_TYPE=None",
                    f"-DCMAKE_CXX_FLAGS=-std=c++20 -O1 -w -include {source / 'switch.hpp'}"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", work / "build", "--target", *(f"{p}_tests" for p in programs)], check=True)


def failing(number):
    """The tests that fail with this mutant. A test that crashes or does not end counts as failed."""
    tests = []
    for program in programs:
        command = [work / "build" / "tests" / f"{program}_tests", "--gtest_color=no"]
        try:
            done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=limit_s,
                                  env={**os.environ, "SIXSTEP_MUTANT": str(number)})
            out, why = done.stdout, "" if done.returncode in (0, 1) else " (crashes)"
        except subprocess.TimeoutExpired as stopped:
            out, why = (stopped.stdout or b"").decode(errors="replace"), " (does not end)"
        tests += [f"{program}.{name}" for name in dict.fromkeys(re.findall(r"^\[  FAILED  \] ([\w/]+\.[\w/]+)", out, re.M))]
        if why:
            begun = re.findall(r"^\[ RUN      \] ([\w/.]+)", out, re.M)
            tests.append(f"{program}.{begun[-1] if begun else '?'}{why}")
            break  # the other programs will hardly end either
    return tests


def main():
    mutants = all_mutants()
    lines = [f"{n:3} {m.file}:{m.line}  {m.old}  =>  {m.new or 'nothing'}" for n, m in enumerate(mutants, 1)]
    if sys.argv[1:] == ["--list"]:
        return print("\n".join(lines))
    build(mutants)
    if failing(0):
        sys.exit(f"without any mutant these fail: {' '.join(failing(0))}")
    chosen = [int(a) for a in sys.argv[1:]] or range(1, len(mutants) + 1)
    survivors = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for number, tests in zip(chosen, pool.map(failing, chosen)):
            survivors += not tests
            told = f"{len(tests)} fail: {', '.join(tests[:6])}" if tests else "SURVIVES"
            print(f"{lines[number - 1]}\n      {told}", flush=True)
    sys.exit(f"{survivors} survive" if survivors else 0)


main()
