# SPDX-License-Identifier: Apache-2.0
"""Many runs of one scenario: the program's plan, on all cores."""
from __future__ import annotations

import json
import math
import os
import pathlib
import re
import signal
import subprocess
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _toml
from ._errors import Interrupted
from .program import _raise, program, scenario_file
from .result import distinct
from .scenario import Source, as_scenario


class Sweep:
    """Results of many runs, one row per run. `s["run"]` and `s["settling time of motor current"]` are numpy arrays.

    >>> import sixstep
    >>> s = sixstep.Scenario(motor="maxon-251601", duration_s=2e-3, control={"mode": "duty"}, reference={"value": 0.2},
    ...                      require=[{"metric": "max", "signal": "speed", "max": 500, "label": "peak"}])
    >>> table = sixstep.sweep(s, {"supply.voltage_V": [12, 24]})
    >>> table.units["peak"], bool(table["peak"][1] > table["peak"][0])
    ('rad/s', True)
    """

    def __init__(self, told: Mapping[str, Any]) -> None:
        self.summary = dict(told)
        self.columns: list[str] = []
        self.units: dict[str, str] = {}
        self._values: dict[str, NDArray[Any]] = {}
        pairs = [_name_and_unit(heading) for heading in told["columns"]]
        for n, (name, (_, unit)) in enumerate(zip(distinct(name for name, _ in pairs), pairs)):
            self.columns.append(name)
            self.units[name] = unit
            self._values[name] = _array([row[n] for row in told["rows"]])

    @property
    def passed(self) -> int:
        """Number of runs in which every requirement holds."""
        return int(self.summary["passed"])

    @property
    def complete(self) -> bool:
        """False if the plan was interrupted."""
        return bool(self.summary["complete"])

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name not in self._values:
            raise KeyError(f"{name} is not a column; the columns are {', '.join(self.columns)}")
        return self._values[name]

    def keys(self) -> list[str]:
        """Names of the columns."""
        return list(self.columns)

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __contains__(self, name: object) -> bool:
        return name in self._values

    def __len__(self) -> int:
        return len(self._values["run"])

    def frame(self) -> Any:
        """A pandas DataFrame; `attrs["units"]` contains the units."""
        import pandas

        frame = pandas.DataFrame(self._values).set_index("run")
        frame.attrs["units"] = dict(self.units)
        return frame

    def __repr__(self) -> str:
        return f"<sixstep.Sweep: {len(self)} runs, {self.passed} hold every requirement>"

    def _repr_html_(self) -> str:
        from .notebook import sweep_html

        return sweep_html(self)


def sweep(scenario: Source, vary: Mapping[str, Any] | None = None, *, drives: int = 0, seed: int = 1, sampling: str = "grid",
          points: int | None = None, store: str | os.PathLike[str] | None = None, resume: bool = False, jobs: int | None = None,
          tolerances: bool = False) -> Sweep:
    """Runs the scenario at each point of `vary`. At each point it runs `drives` drives of the scenario's [[spread]].

    vary    {"control.current.settle_s": [1e-3, 2e-3]}: any list of values, as np.linspace(1e-3, 5e-3, 9); or the text "1e-3:5e-3:9", nine
            values from 1e-3 to 5e-3
    drives  number of drives of the scenario's [[spread]] at each point. All drives have the gains of the nominal motor
    seed    seed of the drives and of drawn points
    sampling  "grid": each combination; "latin-hypercube", "sobol", "monte-carlo", "saltelli": `points` points in the ranges of vary
    tolerances  True: drives also differ within the data sheet's tolerances and in the positions of Hall edges
    store   SQLite file for the finished runs. With resume=True only the missing runs are made
    jobs    number of runs in parallel. Default: one per core

    If the scenario's checks refuse a point, the column "problem" has the message, and the point has no figures. Ctrl-C raises
    `Interrupted`, whose `.result` contains the finished runs.

    >>> import sixstep
    >>> s = sixstep.Scenario(motor="maxon-251601", duration_s=2e-3, control={"mode": "duty"}, reference={"value": 0.2},
    ...                      require=[{"metric": "max", "signal": "speed", "max": 500}])
    >>> len(sixstep.sweep(s, {"supply.voltage_V": [12, 24]}))
    2
    """
    if not vary and not drives:
        raise ValueError("nothing varies: give vary, drives or both")
    if points is not None and sampling == "grid":
        raise ValueError('points needs sampling = "latin-hypercube", "sobol", "monte-carlo" or "saltelli"; a grid has the points of vary')
    scenario = as_scenario(scenario)
    words = ["--sampling", sampling] if sampling != "grid" else []
    for key, values in (vary or {}).items():
        words += ["--vary", f"{key}={_values_text(values)}"]
    for option, given in (("--runs", drives or None), ("--points", points), ("--jobs", jobs)):
        words += [] if given is None else [option, str(given)]
    words += [] if store is None else ["--store", os.fspath(store)]
    words += ["--seed", str(seed)] if drives or sampling != "grid" else []
    words += ["--tolerances"] if tolerances else []
    words += ["--resume"] if resume else []
    with scenario_file(scenario, but=set(vary or {})) as file, tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "plan.json"
        told = _ended([program(), "run", *file, *words, "--quiet", "--json", str(out)])
        partial = out.with_name("plan.partial.json")
        if told is None:
            kept = f"; the finished runs are in {os.fspath(store)}; call again with resume=True to continue" if store is not None else ""
            raise Interrupted(Sweep(json.loads(partial.read_text())) if partial.exists() else None, f"interrupted{kept}")
        if not out.exists():
            _raise(told)
        return Sweep(json.loads(out.read_text()))


def _ended(words: list[str]) -> str | None:
    """Messages of the program; None after Ctrl-C, which also ends the program."""
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as made:
        try:
            return made.communicate()[1]
        except KeyboardInterrupt:
            try:
                made.wait(0.5)  # on a terminal, Ctrl-C also reaches the program
            except subprocess.TimeoutExpired:
                made.send_signal(signal.SIGINT)  # a notebook's stop reaches only this process
            made.communicate()
            return None


def _values_text(values: Any) -> str:
    if isinstance(values, str):
        return values
    if not hasattr(values, "__iter__"):
        raise TypeError(f"vary needs a list of values for each key, not {values!r}")
    items: Sequence[Any] = values.tolist() if hasattr(values, "tolist") else list(values)
    return ",".join(_toml.setting_text(v) for v in items)


def _name_and_unit(heading: str) -> tuple[str, str]:
    found = re.fullmatch(r"(.*) \[(.*)\]", heading)
    return (found[1], found[2]) if found else (heading, "")


def _array(values: list[Any]) -> NDArray[Any]:
    """Numbers: "never" becomes infinity, a missing number NaN. Texts are unchanged."""
    if all(v is None or isinstance(v, (int, float)) or v == "never" for v in values):
        if values and all(isinstance(v, bool) for v in values):
            return np.array(values)
        if values and all(isinstance(v, int) for v in values):
            return np.array(values)
        return np.array([math.inf if v == "never" else math.nan if v is None else float(v) for v in values])
    return np.array(values, dtype=object)
