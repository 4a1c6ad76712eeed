# SPDX-License-Identifier: Apache-2.0
"""One run and its results."""
from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._errors import Interrupted
from ._progress import shown
from .controllers import as_controller
from .scenario import Scenario, Source, as_scenario


class Column(NamedTuple):
    """A recorded signal: its name with the unit's suffix, its unit, its frame and its meaning.

    >>> import sixstep
    >>> sixstep.Session.signals()[1]
    Column(name='i_a_A', unit='A', frame='phase, into the motor', meaning='current of phase a')
    """

    name: str
    unit: str
    frame: str
    meaning: str


class Verdict(NamedTuple):
    """One requirement of the scenario and the measured value; `measured` is infinite for "never".

    >>> import sixstep
    >>> s = sixstep.Scenario(motor="maxon-251601", duration_s=2e-3, control={"mode": "current"}, reference={"value": 2, "unit": "A"},
    ...                      require=[{"metric": "max", "signal": "i_m_A", "max": 3, "label": "peak"}])
    >>> verdict = sixstep.run(s).verdicts[0]
    >>> verdict.figure, verdict.max, verdict.ok
    ('peak', 3.0, True)
    """

    figure: str
    measured: float
    unit: str
    min: float | None
    max: float | None
    ok: bool


class Result:
    """Results of a run. Recorded columns are read-only numpy arrays: `r.speed`, `r["speed_rad_s"]`.

    >>> import sixstep
    >>> r = sixstep.run(sixstep.Scenario(motor="maxon-251601", duration_s=2e-3, control={"mode": "current"},
    ...                                  reference={"value": 2, "unit": "A"}))
    >>> r.units["i_a_A"]
    'A'
    >>> bool(abs(r.i_a + r.i_b + r.i_c).max() < 1e-9)
    True
    """

    def __init__(self, core: Any, scenario: Scenario, ended_early: bool = False) -> None:
        self._outcome = core
        self.scenario = scenario
        self.columns = [Column(*c) for c in core.columns]
        self._index = {c.name: n for n, c in enumerate(self.columns)}
        self._ended_early = ended_early
        self.units = {c.name: c.unit for c in self.columns}
        self.summary: dict[str, Any] = json.loads(core.summary)

    @property
    def passed(self) -> bool:
        """True if the run reached its end and every requirement holds."""
        return bool(self._outcome.passed) and self.complete

    @property
    def complete(self) -> bool:
        """False if a fault, Ctrl-C, an exception or Session.close() ended the run before its time."""
        return not self._ended_early and bool(self._outcome.complete) and self._outcome.stopped_by is None and (self.fault is None or bool(self.summary["trip"]))

    @property
    def fault(self) -> str | None:
        """Fault that stopped the run or the drive, in words; None without a fault."""
        told = self.summary["fault"]
        return None if told is None else told if isinstance(told, str) else " ".join(str(part) for part in told.values() if part)

    @property
    def digest(self) -> str:
        """Digest of every bit of the trajectory, in hexadecimal as the program prints it."""
        return f"{self._outcome.digest:016x}"

    @property
    def simulated_s(self) -> float:
        """Simulated time, s."""
        return float(self._outcome.simulated_s)

    @property
    def verdicts(self) -> list[Verdict]:
        """The scenario's requirements with the measured values."""
        return [Verdict(v["figure"], _number(v["measured"]), v["unit"], v["min"], v["max"], v["ok"]) for v in self.summary["require"]]

    @property
    def figures(self) -> dict[str, float]:
        """Measured figures of requirements and comparisons, by name. The second figure of the same name has " (2)" after its name."""
        rows = [*self.summary["require"], *self.summary["compare"]]
        return dict(zip(distinct(row["figure"] for row in rows), (_number(row["measured"]) for row in rows)))

    @property
    def remarks(self) -> list[str]:
        """Remarks of the program, for example on a key without effect."""
        return [*self.summary.get("remarks", []), *self.summary.get("notes", [])]

    @property
    def energy(self) -> Mapping[str, float]:
        """Energies of the run in J, and the residuals of their balance; empty with books=False."""
        return dict(self.summary.get("energy") or {})

    def _name(self, name: str) -> int:
        if name in self._index:
            return self._index[name]
        found = [n for full, n in self._index.items() if without_unit(full) == name]
        if len(found) == 1:
            return found[0]
        raise KeyError(f"{name} is not recorded; the recorded columns are {', '.join(self._index)}")

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """A column, with or without its unit's suffix."""
        return self._outcome.column(self._name(name))  # type: ignore[no-any-return]

    def __getattr__(self, name: str) -> NDArray[np.float64]:
        if name.startswith("_") or "_index" not in self.__dict__:
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(error.args[0]) from None

    def __reduce__(self) -> Any:
        raise TypeError("a result refers to the run's memory and cannot be pickled; send result.summary or result.frame()")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._index]

    def keys(self) -> list[str]:
        """Names of the recorded columns."""
        return list(self._index)

    def __iter__(self) -> Iterator[str]:
        return iter(self._index)

    def __contains__(self, name: object) -> bool:
        try:
            return isinstance(name, str) and self._name(name) >= 0
        except KeyError:
            return False

    def _ipython_key_completions_(self) -> list[str]:
        return list(self._index)

    @property
    def time(self) -> NDArray[np.float64]:
        """Instants of the recorded rows, s."""
        return self["t_s"]

    @property
    def events(self) -> dict[str, NDArray[np.float64]]:
        """All columns at every event, with the values before and after each jump. Only with run(..., events=True)."""
        names = [Column(*c).name for c in self._outcome.event_columns]
        return {name: self._outcome.event_column(n) for n, name in enumerate(names)}

    def frame(self) -> Any:
        """A pandas DataFrame of the recorded columns; `attrs["units"]` contains the units."""
        import pandas  # only here: the rest works without

        frame = pandas.DataFrame({c.name: self[c.name] for c in self.columns})
        frame.attrs["units"] = dict(self.units)
        return frame

    def plot(self, *names: str, **options: Any) -> Any:
        """A matplotlib figure: one chart for each of `names`; see `sixstep.plots.run_chart`."""
        from .plots import run_chart

        return run_chart(self, *names, **options)

    def to_dict(self) -> dict[str, Any]:
        """All results except the recorded columns."""
        return dict(self.summary)

    def __repr__(self) -> str:
        word = "passed" if self.passed else "FAILED" if self.complete or self.fault else "incomplete"
        return f"<sixstep.Result {self.summary['title']}: {word}, {self.simulated_s:g} s, {len(self.time)} rows, digest {self.digest}>"

    def __str__(self) -> str:
        lines = [repr(self)[1:-1]]
        if self.fault is not None:
            lines.append(f"  fault: {self.fault}")
        for v in self.verdicts:
            limit = " ".join(f"{sign} {_short(x)}" for sign, x in ((">=", v.min), ("<=", v.max)) if x is not None)
            lines.append(f"  {'ok  ' if v.ok else 'FAIL'} {v.figure}: {_with_unit(v.measured, v.unit)} ({limit} {v.unit})".rstrip())
        lines += [f"  note: {remark}" for remark in self.remarks]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        from .notebook import result_html

        return result_html(self)


_SUFFIXES = ("rad_s", "m_s", "degC", "rad", "deg", "Nm", "mm", "A", "V", "W", "N", "s")  # the longest first


def without_unit(name: str) -> str:
    """A column's name without its unit: "speed" of "speed_rad_s"."""
    return next((name[:-len(suffix) - 1] for suffix in _SUFFIXES if name.endswith("_" + suffix)), name)


def distinct(names: Iterable[str], taken: Iterable[str] = ()) -> list[str]:
    """The names, made unique: the second of two equal names gets " (2)" at its end."""
    seen, out = {name: 1 for name in taken}, []
    for name in names:
        seen[name] = seen.get(name, 0) + 1
        out.append(name if seen[name] == 1 else f"{name} ({seen[name]})")
    return out


def _number(value: Any) -> float:
    return math.inf if value == "never" else math.nan if value is None else float(value)


def _with_unit(x: float, unit: str) -> str:
    return _short(x) if x == math.inf else f"{_short(x)} {unit}".rstrip()


def _short(x: float) -> str:
    return "never" if x == math.inf else f"{x:.5g}"


def run(scenario: Source, controller: Any = None, *, books: bool = True, events: bool = False,
        progress: bool | Callable[[float], None] = False) -> Result:
    """Simulates the scenario. Other Python threads can run at the same time.

    controller  a function f(m, setpoint) or an object with step(m, setpoint), which replaces the drive
                (`sixstep.Measured` lists what m has); its exception stops the run and is raised here
    books       True: checks the energy balance and the physical laws; the run takes about a third longer
    events      True: `result.events` contains all columns at every event
    progress    True: a bar on the terminal or in the notebook; or a function of the simulated time in s, called now and then and
                at the end

    Raises `Interrupted` on Ctrl-C, with the finished part in `.result`.

    >>> import sixstep
    >>> s = sixstep.Scenario(motor="maxon-251601", duration_s=2e-3, control={"mode": "duty"}, reference={"value": 0.5})
    >>> sixstep.run(s, lambda m, setpoint: setpoint).complete
    True
    """
    scenario = as_scenario(scenario)
    core = scenario._core
    if controller is not None:
        core = scenario._checked({**scenario._settings, "control.drive": "own", "control.own.controller": "python"},
                                 as_controller(controller))
    if not isinstance(books, bool) or not isinstance(events, bool):
        raise TypeError("books and events must be True or False")
    if not isinstance(progress, bool) and not callable(progress):
        raise TypeError("progress must be True, False or a function of the simulated time in s")
    with shown(progress, scenario.duration_s) as told:
        result = Result(_core.run(core, books, events, told), scenario)
        if told is not None and result._outcome.stopped_by is None:
            told(result.simulated_s)
    stopped_by = result._outcome.stopped_by
    if isinstance(stopped_by, KeyboardInterrupt):
        raise Interrupted(result)
    if stopped_by is not None:
        raise stopped_by
    return result
