# SPDX-License-Identifier: Apache-2.0
"""A run that is advanced in steps: advance, read, change, copy, save."""
from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from typing import Any

from . import _core, _toml
from .controllers import as_controller
from .result import Column, Result, without_unit
from .scenario import Scenario, Source, as_scenario

_SIGNALS = [Column(*c) for c in _core.signals]
_PLACE = {c.name: n for n, c in enumerate(_SIGNALS)}


def place_of(name: str) -> int:
    """Index of a signal by its name, with or without the unit's suffix."""
    if name in _PLACE:
        return _PLACE[name]
    found = [n for n, c in enumerate(_SIGNALS) if without_unit(c.name) == name]
    if len(found) != 1:
        raise KeyError(f"{name} is not a signal; Session.signals() lists them")
    return found[0]


class Session:
    """A run that is advanced step by step. Steps and reads do not change a bit of the run.

    >>> import sixstep
    >>> s = sixstep.Scenario(motor="maxon-251601", duration_s=4e-3, control={"mode": "current"}, reference={"value": 2, "unit": "A"})
    >>> session = sixstep.Session(s)
    >>> session.advance(2e-3)
    True
    >>> t = session.change({"supply": {"voltage_V": 20}})
    >>> session.advance(4e-3)
    False
    >>> session.close().complete
    True
    """

    def __init__(self, scenario: Source, controller: Any = None) -> None:
        scenario = as_scenario(scenario)
        self._scenario = scenario
        self._controller = None if controller is None else as_controller(controller)
        settings = dict(scenario._settings)
        if self._controller is not None:
            settings |= {"control.drive": "own", "control.own.controller": "python"}
        self._core: Any = _core.Session(scenario._checked(settings, self._controller))
        self._settings = settings
        self._changes: list[tuple[float, str]] = []

    def advance(self, to_s: float) -> bool:
        """Simulates up to the instant `to_s`, in s from the start of the run. False if the run is over."""
        if not math.isfinite(to_s):
            raise ValueError(f"to_s = {to_s} must be an instant in s")
        return bool(self._core.advance(float(to_s)))

    def steps(self, step_s: float) -> Iterator[Session]:
        """Advances by `step_s` at a time until the run is over: `for now in session.steps(1e-3): print(now["speed_rad_s"])`."""
        if not (math.isfinite(step_s) and step_s > 0):
            raise ValueError(f"step_s = {step_s} must be above 0")
        k, begin = 0, self.time
        goes_on = True
        while goes_on:
            k += 1
            goes_on = self.advance(begin + k * step_s)
            yield self

    @property
    def time(self) -> float:
        """The instant at which values are read, s."""
        return float(self._core.present_s)

    @property
    def over(self) -> bool:
        """Whether the run has ended."""
        return bool(self._core.over)

    def __getitem__(self, name: str) -> float:
        """The present value of a signal. `name` is the column's name with its unit ("i_a_A") or without."""
        return float(self._core.signals()[place_of(name)])

    @staticmethod
    def signals() -> list[Column]:
        """All signals that can be read."""
        return list(_SIGNALS)

    def look(self) -> dict[str, float]:
        """All signals at the present instant."""
        return dict(zip(_PLACE, self._core.signals().tolist()))

    def change(self, change: Mapping[str, Any] | str) -> float:
        """Changes values at the next control tick, as an [[at]] table of a scenario does. Returns the instant of this tick in s.

        `change` is a dict, as {"reference": {"value": 3}}, or the lines of such a table. Raises `ScenarioError`
        if it is not valid, and then nothing has changed.
        """
        text = change if isinstance(change, str) else "".join(f"{k} = {_toml.value_text(v)}\n" for k, v in change.items())
        with_it = self._scenario._checked(self._settings, self._controller, f"\n[[at]]\ntime_s = {self.time!r}\n{text}\n")
        at = float(self._core.change(with_it))
        self._changes.append((self.time, text))
        return at

    def copy(self) -> Session:
        """An independent copy in the same state."""
        new = object.__new__(Session)
        new.__dict__.update(self.__dict__)
        new._core = self._core.copy()
        new._changes = list(self._changes)
        return new

    __copy__ = copy

    def save(self) -> bytes:
        """The session as bytes: the scenario, its changes and the instant, from which `restore` simulates it again."""
        if self._controller is not None:
            raise ValueError("a session with a controller in Python cannot be saved: the controller's state is not in the session")
        s = self._scenario
        return json.dumps({"sixstep": _core.version, "scenario": [s._name, s._source, s._settings, s._data_dir],
                           "changes": self._changes, "time_s": self.time}).encode()

    @staticmethod
    def restore(saved: bytes) -> Session:
        """Restores the session that `save` wrote, to the bit, also in another process."""
        from .scenario import _restored

        try:
            told = json.loads(saved)
            version, scenario, changes, time_s = told["sixstep"], told["scenario"], told["changes"], float(told["time_s"])
        except (ValueError, KeyError, TypeError):
            raise ValueError("these bytes are not a session that save() wrote") from None
        if version != _core.version:
            raise ValueError(f"the session was saved by sixstep {version}; this is {_core.version}")
        session = Session(_restored(*scenario))
        for at_s, text in changes:
            session.advance(at_s)
            session.change(text)
        session.advance(time_s)
        return session

    @property
    def scenario_text(self) -> str:
        """The scenario with all changes so far. A run of this scenario has the same bits as this session."""
        return str(self._core.text())

    def close(self) -> Result:
        """Ends the session at the next control tick and returns its results. The results are incomplete if the run was not over."""
        early = not self.over
        return Result(self._core.close(), self._scenario, ended_early=early)

    def __enter__(self) -> Session:
        return self

    def __exit__(self, *_: object) -> None:
        """Does nothing. The session is freed with its last reference, and close() returns the results."""

    def __deepcopy__(self, _: Any) -> Session:
        return self.copy()
