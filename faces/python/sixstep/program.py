# SPDX-License-Identifier: Apache-2.0
"""Studies that the sixstep program makes: design, curve, check, wiring, compare, bode. Each result has the figures of the
program's JSON as attributes."""
from __future__ import annotations

import contextlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
from collections.abc import Collection, Iterator, Mapping
from typing import Any

from ._errors import Problem, ProgramError, ScenarioError
from .scenario import Scenario, Source, as_scenario


def program() -> str:
    """Path of the sixstep program that ships with this package.

    >>> import os, sixstep
    >>> os.access(sixstep.program(), os.X_OK)
    True
    """
    return os.environ.get("SIXSTEP_PROGRAM") or str(pathlib.Path(__file__).parent / "bin" / "sixstep")


class Study(Mapping[str, Any]):
    """Results of a study. Figures are attributes and keys, with their unit in the name: `study.settle_s`.

    >>> import sixstep
    >>> check = sixstep.check("maxon-251601")
    >>> check.consistent
    True
    """

    def __init__(self, figures: Mapping[str, Any], text: str = "", ok: bool = True) -> None:
        self._figures = dict(figures)
        self.text = text  #: the program's table
        self.ok = ok  #: whether the program found all well

    def __getitem__(self, name: str) -> Any:
        return _wrapped(self._figures[name])

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self.__dict__.get("_figures", {}):
            raise AttributeError(f"no figure {name}; the figures are {', '.join(self.__dict__.get('_figures', {}))}")
        return self[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._figures)

    def __len__(self) -> int:
        return len(self._figures)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._figures]

    def to_dict(self) -> dict[str, Any]:
        """All figures as nested dicts and lists."""
        return dict(self._figures)

    def __str__(self) -> str:
        return self.text or "\n".join(f"{name}: {_short(value)}" for name, value in self._figures.items())

    def __repr__(self) -> str:
        return f"<sixstep.Study: {', '.join(self._figures)}>"


def _short(value: Any) -> str:
    """Text of a value; a table or a long list is described by its size."""
    if isinstance(value, dict):
        return f"figures {', '.join(value)}"
    return f"{len(value)} values" if isinstance(value, list) and len(value) > 6 else f"{value:.6g}" if isinstance(value, float) else str(value)


def _wrapped(value: Any) -> Any:
    if isinstance(value, dict):
        return Study(value)
    return [_wrapped(item) for item in value] if isinstance(value, list) else value


def _asked(words: list[str], json_words: list[str], options: Mapping[str, Any]) -> Study:
    """The study's figures and its text. Exit code 1 is a finding, not an error."""
    for name, value in options.items():
        if value is None or value is False:
            continue
        option = "--" + name.replace("_", "-")
        words += [option] if value is True else [option, str(value)]
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "study.json")
        into = [file if word == "FILE" else word for word in json_words]
        made = subprocess.run([program(), *words, *into], capture_output=True, text=True, check=False)
        if made.returncode not in (0, 1):
            _raise(made.stderr)
        figures = json.loads(pathlib.Path(file).read_text() if "FILE" in json_words else made.stdout)
    return Study(figures, made.stdout if "FILE" in json_words else made.stderr, made.returncode == 0)


def _raise(message: str) -> None:
    lines = [line for line in message.strip().splitlines() if line]
    problems = [Problem("", "", limit, cure) for limit, _, cure in (line.partition("; ") for line in lines)]
    raise ScenarioError(problems) if problems else ProgramError("the program failed without a message")


@contextlib.contextmanager
def scenario_file(scenario: Scenario, but: Collection[str] = ()) -> Iterator[list[str]]:
    """The program's words for the scenario: the scenario's file with its settings except `but`, or a temporary file."""
    if scenario.path and _unchanged(scenario):
        words = [scenario.path]
        for key, value in scenario._settings.items():
            words += ["--set", f"{key}={value}"] if key not in but else []
        yield words
        return
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "scenario.toml"
        file.write_text(scenario.portable_text())
        yield [str(file)]


def _unchanged(scenario: Scenario) -> bool:
    """True if the scenario's file still contains the text that was read."""
    try:
        return pathlib.Path(str(scenario.path)).read_text(encoding="utf-8", errors="surrogateescape") == scenario._source
    except OSError:
        return False


def design(motor: str | os.PathLike[str] | Scenario, **options: Any) -> Study:
    """Gains for a motor, simulated over the sheet's tolerances. The options are the options of `sixstep design`:
    design("maxon-251601", mode="speed", settle=0.02). `ok` says whether the drive is usable.

    >>> import sixstep
    >>> sixstep.design("maxon-251601", quick=True).ok
    True
    """
    if isinstance(motor, Scenario):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "board.toml"
            file.write_text(motor.portable_text())
            return _asked(["design", "--scenario", str(file)], ["--json", "FILE"], options)
    return _asked(["design", os.fspath(motor)], ["--json", "FILE"], options)


def curve(motor: str | os.PathLike[str], **options: Any) -> Study:
    """Torque-speed curve. The options are the options of `sixstep curve`: curve("maxon-251601", voltage=18).

    >>> import sixstep
    >>> len(sixstep.curve("maxon-251601", points=5).points)
    5
    """
    return _asked(["curve", os.fspath(motor)], ["--json", "FILE"], options)


def check(motor: str | os.PathLike[str]) -> Study:
    """Compares the values of a motor's data sheet with each other. `ok` is False if they contradict each other.

    >>> import sixstep
    >>> sixstep.check("maxon-251601").ok
    True
    """
    study = _asked(["motor", "check", os.fspath(motor)], ["--json"], {})
    study.text = subprocess.run([program(), "motor", "check", os.fspath(motor)], capture_output=True, text=True, check=False).stdout
    return study


def wiring(motor: str | os.PathLike[str], **options: Any) -> Study:
    """The motor's behaviour in each of the 36 ways to connect its phases and Hall lines."""
    return _asked(["motor", "wiring", os.fspath(motor)], ["--json"], options)


def compare(motor: str | os.PathLike[str], **options: Any) -> Study:
    """All controllers on one motor. The options are the options of `sixstep compare`: compare("maxon-251601", drives=10)."""
    return _asked(["compare", os.fspath(motor)], ["--json", "FILE"], options)


def bode(scenario: Source, **options: Any) -> Study:
    """The measured and the designed frequency response of the outermost loop at the end of the scenario.

    >>> import sixstep
    >>> figures = sixstep.bode(sixstep.shipped("thesis/7.3.1-locked-exact-design"))
    >>> bool(abs(figures.measured.crossover_Hz / figures.designed.crossover_Hz - 1) < 0.03)
    True
    """
    with scenario_file(as_scenario(scenario)) as words:
        return _asked(["run", *words, "--bode"], ["--json", "FILE"], options)


def main(words: list[str] | None = None) -> int:
    """Runs the program, like `python -m sixstep`."""
    return subprocess.run([program(), *(sys.argv[1:] if words is None else words)], check=False).returncode
