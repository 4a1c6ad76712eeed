# SPDX-License-Identifier: Apache-2.0
"""Functions for the tests of the Python package: scenarios, and the program with which the results are compared."""
import json
import pathlib
import subprocess

import sixstep

SOURCE = pathlib.Path(__file__).resolve().parents[2]
DATA = SOURCE / "data" / "scenarios"


def current(**more):
    """A short run of the current loop."""
    return sixstep.Scenario({"motor": "maxon-251601", "duration_s": 5e-3, "control": {"mode": "current"},
                             "reference": {"value": 2, "unit": "A"}, **more})


def program_summary(file, *words):
    """The summary that `sixstep run` writes for the scenario."""
    made = subprocess.run([sixstep.program(), "run", str(file), *words, "--quiet", "--json", "-"], capture_output=True, text=True, check=False)
    assert made.returncode in (0, 1, 3), made.stderr
    return json.loads(made.stdout)
