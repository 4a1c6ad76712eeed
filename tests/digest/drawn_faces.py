#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""All interfaces give the same digest. 30 random scenarios run in the program, the C library, units of FMI 2.0 and
3.0, and WebAssembly. The steps are 1 ms, 37 us, 10 us and random.
   drawn_faces.py PROGRAM SOURCE C_LIBRARY FOLDER [COMMAND that reads scenarios in WebAssembly]
A scenario is a shipped scenario with random values of keys that every scenario has. SIXSTEP_SEED=.. selects others."""
import json
import os
import pathlib
import random
import subprocess
import sys

PROGRAM, SOURCE, C_LIBRARY, FOLDER = (pathlib.Path(word).resolve() for word in sys.argv[1:5])
IN_WASM = sys.argv[5:]
sys.path[:0] = [str(SOURCE / "tests" / part) for part in ("c", "fmu")]
import c_library
import fmi2_importer
import fmi3_importer

SEED = int(os.environ.get("SIXSTEP_SEED", "39"))
DRAW = random.Random(SEED)
SHIPPED = sorted([*(SOURCE / "data/scenarios/thesis").glob("*.toml"), *(SOURCE / "data/scenarios/gallery").glob("*.toml")])
STEPS = (1e-3, 37e-6, 10e-6, lambda: DRAW.uniform(1e-7, 3e-4))


def drawn_text(file):
    values = {"duration_s": DRAW.uniform(1e-3, 5e-3), "supply.voltage_V": DRAW.uniform(18.0, 30.0), "sensors.seed": DRAW.randrange(1, 1000),
              "pwm.period_s": DRAW.choice((25e-6, 30e-6, 40e-6, 50e-6)), "motor_override.inertia_gcm2": DRAW.uniform(50.0, 500.0)}
    taken = {key: value for key, value in values.items() if key == "duration_s" or DRAW.random() < 0.5}
    return f'extends = "{os.path.relpath(file, FOLDER)}"\n' + "".join(f"{key} = {value!r}\n" for key, value in taken.items()), taken["duration_s"]


def in_program(file):
    """The digest of the program's run; None if the program refuses the scenario."""
    done = subprocess.run([PROGRAM, "run", file, "--json", "-", "--quiet"], capture_output=True, text=True, timeout=120)
    return json.loads(done.stdout)["digest"] if done.returncode in (0, 1, 3) else None


def in_c(library, file, step):
    session, at = c_library.Session.open(library, file), 0.0
    while session.advance(at) == c_library.OK:
        at += step() if callable(step) else step
    session.finish()
    return f"{session.digest():016x}"


def exported(file, version):
    out = FOLDER / f"{file.stem}-{version}.fmu"
    subprocess.run([PROGRAM, "export", "fmu", file, "--fmi", version, "--out", out, "--force"], check=True, timeout=60, capture_output=True)
    return out


def in_fmi2(unit, step, end):
    instance = fmi2_importer.Instance(unit).begin()
    instance.run(step, end)
    return instance.digest()


def in_fmi3(unit, step, end):
    return fmi3_importer.Instance(unit).begin().run(step, end).digest()


def digests(library, file, end):
    """(interface and kind of step, digest) for each interface and step."""
    fmi2, fmi3 = fmi2_importer.Unit(exported(file, "2")), fmi3_importer.Unit(exported(file, "3"))
    for step in STEPS:
        words = "drawn steps" if callable(step) else f"steps of {step:g} s"
        yield f"C library, {words}", in_c(library, file, step)
        yield f"FMI 2.0, {words}", in_fmi2(fmi2, step, end)
        yield f"FMI 3.0, {words}", in_fmi3(fmi3, step, end)


def in_wasm(files):
    """{file: digest}. The reader runs each file in one advance and in the same kinds of steps. It fails if two
    digests of a file differ."""
    done = subprocess.run([*IN_WASM, "--in-steps", *(os.path.relpath(file) for file in files)], capture_output=True, text=True, timeout=600)
    if done.returncode != 0:
        sys.exit(f"WebAssembly: {done.stderr or done.stdout}")
    return {pathlib.Path(line.split()[0]).stem: line.split()[1] for line in done.stdout.splitlines()}


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    library, told, wrong = c_library.load(C_LIBRARY), {}, 0
    for n in range(400):
        if len(told) == 30:
            break
        shipped, file = DRAW.choice(SHIPPED), FOLDER / f"drawn-{n}.toml"
        text, end = drawn_text(shipped)
        file.write_text(text)
        expected = in_program(file)
        if expected is None:
            continue  # a window or a change is after the end of this short run, or the board does not support it
        told[file] = expected
        for name, digest in digests(library, file, end):
            if digest != expected:
                wrong += 1
                print(f"SIXSTEP_SEED={SEED}: {file}: {shipped.stem}: the program's digest is {expected}; {name}: {digest}")
    if len(told) < 30:
        sys.exit(f"of 400 drawn scenarios {len(told)} can be run")
    for stem, digest in (in_wasm(told) if IN_WASM else {}).items():
        expected = told[FOLDER / f"{stem}.toml"]
        if digest != expected:
            wrong += 1
            print(f"SIXSTEP_SEED={SEED}: {stem}: the program's digest is {expected}; WebAssembly: {digest}")
    if wrong:
        sys.exit(f"{wrong} digests differ")
    print(f"30 drawn scenarios have one digest by program, C library, FMI 2.0, FMI 3.0{', WebAssembly' if IN_WASM else ''}; seed {SEED}")


main()
