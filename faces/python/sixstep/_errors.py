# SPDX-License-Identifier: Apache-2.0
"""Errors of the package."""
from __future__ import annotations

from typing import Any, NamedTuple


class Problem(NamedTuple):
    """One error in an input: its place, the broken rule, and the correction.

    >>> import sixstep
    >>> try:
    ...     sixstep.Scenario(motor="maxon-251601", duration_s=-1)
    ... except sixstep.ScenarioError as error:
    ...     print(error.problems[0].value, "|", error.problems[0].limit)
    -1 | must be above 0 and at most 9000000
    """

    where: str  #: key or place, as "file:line:column: supply.voltage_V"
    value: str  #: the wrong value as written; empty if none was given
    limit: str  #: the broken rule, as "must be above 0"
    cure: str  #: what to write instead

    def __str__(self) -> str:
        text = self.where + (f" = {self.value}" if self.value else "")
        text += (" " if text else "") + self.limit if self.limit else ""
        return text + (f"; {self.cure}" if self.cure else "")


class ScenarioError(ValueError):
    """An input was refused. `problems` contains all errors of the input as `Problem` objects.

    >>> import sixstep
    >>> try:
    ...     sixstep.Scenario(motor="maxon-251601", duration_s=-1)
    ... except sixstep.ScenarioError as error:
    ...     len(error.problems)
    1
    """

    def __init__(self, problems: Any) -> None:
        self.problems: list[Problem] = list(problems)
        super().__init__("\n".join(str(p) for p in self.problems))

    def __reduce__(self) -> Any:
        return ScenarioError, (self.problems,)


class ProgramError(RuntimeError):
    """The sixstep program that ships with the package refused its input or failed; the text is the program's message."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a run or a sweep early. `result` contains the finished part; None if nothing was finished."""

    def __init__(self, result: Any, message: str = "") -> None:
        super().__init__(message or f"interrupted at {result.simulated_s:.6g} s; .result has the finished part")
        self.result = result
