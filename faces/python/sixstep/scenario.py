# SPDX-License-Identifier: Apache-2.0
"""Scenarios. Keys, units and checks are the same as in a scenario file."""
from __future__ import annotations

import difflib
import functools
import os
import pathlib
import re
import tomllib
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from . import _core, _toml


class Key(NamedTuple):
    """Description of one key of a scenario.

    >>> import sixstep
    >>> sixstep.describe("pwm.period_s").unit
    's'
    """

    path: str  #: "pwm.period_s"
    meaning: str  #: one sentence
    unit: str  #: "s"; empty for words and counts
    default: str  #: as TOML; empty if there is none
    choices: tuple[tuple[str, str], ...]  #: allowed words with their meanings
    help: str  #: meaning, unit, range and default in a few lines

    def __str__(self) -> str:
        return self.help


@functools.cache
def _keys() -> dict[str, Key]:
    return {k["path"]: Key(k["path"], k["meaning"], k["unit"], k["default"], tuple((word, meaning) for word, meaning in k["choices"]), k["help"])
            for k in _core.scenario_keys() if not k["table"]}


def describe(key: str) -> Key:
    """Meaning, unit, range and default of one key; `help` states the range.

    >>> import sixstep
    >>> print(sixstep.describe("supply.voltage_V").meaning)
    voltage of the source
    """
    try:
        return _keys()[key]
    except KeyError:
        raise KeyError(f"{key} is not a key of a scenario; sixstep.keys() lists them") from None


def keys() -> list[str]:
    """All keys of a scenario, in the order of the reference pages.

    >>> import sixstep
    >>> "pwm.period_s" in sixstep.keys()
    True
    """
    return list(_keys())


def motors() -> list[str]:
    """Names of the motors that the package contains.

    >>> import sixstep
    >>> "maxon-251601" in sixstep.motors()
    True
    """
    return list(_core.motors())


class Scenario:
    """A checked scenario.

    `source` is the path of a scenario file, its text, or a dict; keyword arguments are keys of its top level or whole
    tables. Names inside a file are relative to that file, names inside a text or dict to the working directory.

    Raises `ScenarioError` with all problems if the scenario is not valid.

    >>> import sixstep
    >>> s = sixstep.Scenario(motor="maxon-251601", duration_s="20ms", control={"mode": "current"}, reference={"value": 2, "unit": "A"})
    >>> s["pwm.period_s"] = "40us"
    >>> s["pwm.period_s"]
    4e-05
    """

    def __init__(self, source: str | os.PathLike[str] | Mapping[str, Any] | None = None, /, *,
                 data_dir: str | os.PathLike[str] = "", **tables: Any) -> None:
        self._name, self._source = _read(source, tables if not isinstance(source, Mapping) else {})
        settings = {} if source is None else {key: _toml.setting_text(value) for key, value in _flat(tables)}
        if isinstance(source, Mapping):
            self._source = _toml.file_text({**source, **tables})
            settings = {}
        self._settings: dict[str, str] = settings
        self._data_dir = os.fspath(data_dir)
        self._core = self._checked(self._settings)

    def _checked(self, settings: Mapping[str, str], controller: Any = None, more: str = "") -> Any:
        return _core.read(self._name, self._source + more, list(settings.items()), self._data_dir, controller)

    @property
    def path(self) -> str | None:
        """Absolute path of the scenario's file; None if it was made from a text, a dict or keywords."""
        return None if os.path.basename(self._name) == _TEXT else self._name

    def portable_text(self) -> str:
        """The scenario as a file that can be in any folder: it names the motor's file by its absolute path."""
        file = os.path.join(os.path.dirname(self._name), self.motor)
        found = next((path for path in (file, f"{file}.toml") if os.path.isfile(path)), None)
        return self.to_toml() if found is None else re.sub(r"(?m)^motor = .*$", lambda _: f"motor = {_toml.value_text(found)}", self.to_toml(), count=1)

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_"):
            raise AttributeError(f'a scenario has no attribute {name} to set; its values are set by key: s["{name}..."] = value')
        super().__setattr__(name, value)

    @property
    def motor(self) -> str:
        """Name or file of the motor."""
        return str(self._core.motor)

    @property
    def duration_s(self) -> float:
        """Simulated time, s."""
        return float(self._core.duration_s)

    def __getitem__(self, key: str) -> Any:
        values = self._values()
        if key in values:
            return values[key]
        table = {name.removeprefix(key + "."): value for name, value in values.items() if name.startswith((key + ".", key + "["))}
        if table:
            return table
        describe(key)
        return None

    def get(self, key: str, default: Any = None) -> Any:
        """The value of a key, or `default` if the key has no value. An unknown key raises KeyError, as `s[key]` does."""
        value = self[key]
        return default if value is None else value

    def __setitem__(self, key: str, value: Any) -> None:
        self.update({key: value})

    def update(self, values: Mapping[str, Any]) -> None:
        """Sets several keys at once, for values that are valid only together."""
        settings = {**self._settings, **{key: _toml.setting_text(value) for key, value in values.items()}}
        self._core = self._checked(settings)  # raises before anything has changed
        self._settings = settings

    def __delitem__(self, key: str) -> None:
        settings = {name: text for name, text in self._settings.items() if name != key}
        if len(settings) == len(self._settings):
            describe(key)
            raise KeyError(f"{key} was not set by s[...]; del removes only such values. A value of the scenario's file or text is replaced: s[{key!r}] = ...")
        self._core = self._checked(settings)
        self._settings = settings

    def _values(self) -> dict[str, Any]:
        return {path: tomllib.loads(f"x = {text}")["x"] for path, text, _ in self._core.values()}

    def __iter__(self) -> Iterator[str]:
        return iter(self._values())

    def keys(self) -> list[str]:
        """Keys that have a value, given or by default."""
        return list(self._values())

    def _ipython_key_completions_(self) -> list[str]:
        return keys()

    def to_dict(self) -> dict[str, Any]:
        """The values that differ from the defaults, as nested dicts."""
        return tomllib.loads(self.to_toml())

    def to_toml(self) -> str:
        """A scenario file with the values that differ from the defaults. It reads back as the same scenario."""
        return str(self._core.text())

    def copy(self, **settings: Any) -> Scenario:
        """A copy; `settings` are keys with dots written as two underscores: copy(pwm__period_s="40us")."""
        new = object.__new__(Scenario)
        new.__dict__.update(self.__dict__)
        new._settings = dict(self._settings)
        for key, value in settings.items():
            new._settings[key.replace("__", ".")] = _toml.setting_text(value)
        if settings:
            new._core = new._checked(new._settings)
        return new

    __copy__ = copy

    def __deepcopy__(self, memo: Any) -> Scenario:
        return self.copy()

    def __reduce__(self) -> Any:
        return _restored, (self._name, self._source, self._settings, self._data_dir)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scenario) and self.to_toml() == other.to_toml()

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"<sixstep.Scenario {os.path.basename(self._name)}: {self.motor}, {self.duration_s:g} s>"

    def __str__(self) -> str:
        return self.to_toml()


_SHIPPED = pathlib.Path(__file__).parent / "data" / "scenarios"


def scenarios() -> list[str]:
    """Names of the scenarios that ship with sixstep, for `shipped`.

    >>> import sixstep
    >>> "thesis/7.4-speed-thesis-gains" in sixstep.scenarios()
    True
    """
    return sorted(os.path.relpath(file, _SHIPPED)[:-len(".toml")] for file in _SHIPPED.rglob("*.toml"))


def shipped(name: str) -> Scenario:
    """A scenario that ships with sixstep. Raises `ValueError` with similar names if sixstep does not contain the scenario.

    >>> import sixstep
    >>> sixstep.shipped("current-square").motor
    'maxon-251601'
    """
    names = scenarios()
    if name not in names:
        near = difflib.get_close_matches(name, names, 3) or [other for other in names if name in other][:3]
        raise ValueError(f"{name} does not ship with sixstep; {'take ' + ', '.join(near) if near else 'sixstep.scenarios() lists the scenarios'}")
    return Scenario(_SHIPPED / f"{name}.toml")


_TEXT = "<text>"
Source = Scenario | str | os.PathLike[str] | Mapping[str, Any]


def as_scenario(source: Source) -> Scenario:
    """The scenario itself, or a scenario made from a path, a text or a dict."""
    return source if isinstance(source, Scenario) else Scenario(source)


def _restored(name: str, source: str, settings: dict[str, str], data_dir: str) -> Scenario:
    new = object.__new__(Scenario)
    new._name, new._source, new._settings, new._data_dir = name, source, settings, data_dir
    new._core = new._checked(settings)
    return new


def _read(source: Any, tables: Mapping[str, Any]) -> tuple[str, str]:
    """The scenario's name in messages, and its text."""
    here = os.path.join(os.getcwd(), _TEXT)  # names in a text are relative to the folder in which it was read
    if source is None:
        return here, _toml.file_text(tables)
    if isinstance(source, Mapping):
        return here, ""
    if isinstance(source, str) and ("\n" in source or "=" in source or not source):
        return here, source
    if not isinstance(source, (str, os.PathLike)):
        raise TypeError("a scenario needs a path, a text, a dict or keywords")
    return os.path.abspath(source), pathlib.Path(source).read_text(encoding="utf-8", errors="surrogateescape")


def _flat(tables: Mapping[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    for key, value in tables.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{before}{key}.")
        else:
            yield before + key, value
