# SPDX-License-Identifier: Apache-2.0
"""Writes the headers of drives from their scenarios, builds programs for a core, and runs them."""
import concurrent.futures
import os
import pathlib
import re
import subprocess

from cores import HERE, OUT, REPOSITORY

PROGRAM = REPOSITORY / "build" / "dev" / "sixstep"
SCALARS = ("q15", "q14", "q31", "q30", "float")
DRIVES = ("duty", "current", "hysteresis", "speed", "position", "product", "guarded", "one_shunt", "field")
JOBS = int(os.environ.get("SIXSTEP_JOBS", "2"))


class Failed(Exception):
    """An error with a message for the terminal."""


def told(command, limit_s=600, cwd=REPOSITORY):
    """The output of a command. If the command fails, the error has its last lines."""
    try:
        done = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=limit_s, cwd=cwd, check=False)
    except subprocess.TimeoutExpired:
        raise Failed(f"{command[0]} took more than {limit_s} s") from None
    if done.returncode != 0:
        raise Failed("\n".join((done.stdout + done.stderr).strip().splitlines()[-20:]) or f"{command[0]} returned {done.returncode}")
    return done.stdout


def side_by_side(function, items):
    """Calls the function for each item, with as many parallel jobs as JOBS. The results are in the order of the
    items. An item that fails has its Failed as result."""
    def one(item):
        try:
            return function(item)
        except Failed as failed:
            return failed
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        return list(pool.map(one, items))


def scenario(drive):
    return HERE / "scenarios" / f"{drive}.toml"


def has_header(drive, scalar):
    """For the field-oriented drive no fixed-point scaling has been proved, so it has only a header in float."""
    return drive != "field" or scalar == "float"


def export_headers():
    """Writes build/target/headers/SCALAR/DRIVE.hpp. The constants are raw bits, so that they are the same with every
    compiler."""
    def export(pair):
        scalar, drive = pair
        folder = OUT / "headers" / scalar
        folder.mkdir(parents=True, exist_ok=True)
        told([PROGRAM, "export", "header", scenario(drive), "--arithmetic", scalar, "--set", f"control.arithmetic={scalar}",
              "--namespace", drive, "--despite", "measured on emulated cores, never flashed", "--out", folder / f"{drive}.hpp"])
    for answer in side_by_side(export, [(s, d) for s in SCALARS for d in DRIVES if has_header(d, s)]):
        if isinstance(answer, Failed):
            raise answer


def file_name(words):
    return re.sub(r"[^A-Za-z0-9+_]", "-", words)


def build(core, name, sources, scalar, defines=()):
    """Builds the program and returns its file. The AVR has a separate linker, so its sources are first compiled to
    objects."""
    folder = OUT / file_name(core.name)
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / f"{name}.elf"
    sources = [pathlib.Path(s) for s in (*sources, *(HERE / "platform" / p for p in core.platform))]
    flags = [*core.flags(), *defines, f"-DTARGET_SCALAR_{scalar}", f"-I{OUT}/headers/{scalar}"]
    if not core.link:
        told([*flags, *sources, "-o", file, *core.libraries])
        return file
    objects = []
    for source in sources:
        objects.append(folder / f"{name}-{source.stem}.o")
        told([*flags, "-c", source, "-o", objects[-1]])
    told([*core.link, *objects, "-o", file, *core.libraries])
    return file


def run(core, file, *arguments, limit_s=300):
    program = [*core.run, *(["-kernel"] if core.run and "qemu-system" in core.run[0] else []), file]
    return told([*program, *arguments], limit_s)


def build_board():
    told(["g++", "-std=c++20", "-O2", "-Wall", "-Wextra", "-Werror", f"-I{REPOSITORY}",
          HERE / "platform/avr_board.cpp", "-o", OUT / "avr_board", "-lsimavr", "-lelf"])
