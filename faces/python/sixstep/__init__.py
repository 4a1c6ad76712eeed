# SPDX-License-Identifier: Apache-2.0
"""Brushless DC motor from data sheet to verified firmware.

>>> import sixstep
>>> s = sixstep.Scenario(motor="maxon-251601", duration_s="5ms", control={"mode": "current"}, reference={"value": 2, "unit": "A"})
>>> r = sixstep.run(s)
>>> round(float(r.i_m[-1]), 1)
2.0
"""
from ._core import version as __version__
from ._errors import Interrupted, Problem, ProgramError, ScenarioError
from .controllers import Measured, compiled, include_dir
from .env import Env
from .plan import Sweep, sweep
from .program import Study, bode, check, compare, curve, design, program, wiring
from .result import Column, Result, Verdict, run
from .scenario import Key, Scenario, describe, keys, motors, scenarios, shipped
from .session import Session

__all__ = ["Column", "Env", "Interrupted", "Key", "Measured", "Problem", "ProgramError", "Result", "Scenario", "ScenarioError",
           "Session", "Study", "Sweep", "Verdict", "__version__", "bode", "check", "compare", "compiled", "curve", "describe",
           "design", "include_dir", "keys", "motors", "program", "run", "scenarios",
           "shipped", "sweep", "wiring"]
