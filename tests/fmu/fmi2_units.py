# SPDX-License-Identifier: Apache-2.0
"""The program, a folder and the units exported into it, for the tests of FMI 2.0. Each test is called as TEST.py
PROGRAM SOURCE LIBRARY [--long]."""
import functools
import json
import pathlib
import subprocess
import sys
import tempfile

import fmi2_importer as fmi

LONG = "--long" in sys.argv and not sys.argv.remove("--long")
PROGRAM, SOURCE, LIBRARY = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(3))

FILES = sorted([*(SOURCE / "data/scenarios/thesis").glob("*.toml"), *(SOURCE / "data/scenarios/gallery").glob("*.toml")])
CURRENT = SOURCE / "data/scenarios/thesis/8b-exact-design.toml"
SPEED = SOURCE / "data/scenarios/thesis/7.5-position.toml"
WORK = tempfile.TemporaryDirectory()
FOLDER = pathlib.Path(WORK.name)
PLAIN = FOLDER / "plain.toml"
PLAIN.write_text('motor = "maxon-251601"\nduration_s = 0.01\npwm.period_s = 50e-6\ncontrol.mode = "current"\n'
                 'control.current = { settle_s = 0.001, damping = 0.9 }\nreference.value = 1.0\n')


def sixstep(*words, code=0):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=120)
    assert code is None or done.returncode == code, done.stderr
    return done


@functools.lru_cache(None)
def ran(file, *words):
    done = sixstep("run", file, "--json", "-", *words, code=None)
    return json.loads(done.stdout) if done.returncode in (0, 1, 3) else None


@functools.lru_cache(None)
def exported(file, *words, name=None):
    out = FOLDER / f"{name or file.stem}.fmu"
    sixstep("export", "fmu", file, "--out", out, "--force", *words)
    return fmi.Unit(out)
