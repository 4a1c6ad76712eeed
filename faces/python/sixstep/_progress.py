# SPDX-License-Identifier: Apache-2.0
"""Progress of a run, on a terminal or in a notebook."""
from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator
from typing import Any


def notebook_display() -> Any:
    """IPython's display module inside a notebook, else None."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    if shell is None or not hasattr(shell, "kernel"):
        return None
    from IPython import display

    return display


@contextlib.contextmanager
def shown(progress: bool | Callable[[float], None], duration_s: float) -> Iterator[Callable[[float], None] | None]:
    """The function that the run calls with its simulated time in s: None, the given function, or a function that draws a bar."""
    if not isinstance(progress, bool):
        yield progress
    elif not progress:
        yield None
    else:
        display = notebook_display()
        with _terminal_bar(duration_s) if display is None else _notebook_bar(display, duration_s) as draw:
            yield draw


@contextlib.contextmanager
def _terminal_bar(duration_s: float) -> Iterator[Callable[[float], None]]:
    drawn = False

    def draw(t_s: float) -> None:
        nonlocal drawn
        drawn = True
        part = min(1.0, t_s / duration_s)
        sys.stderr.write(f"\r{'#' * round(30 * part):<30} {100 * part:3.0f} % of {duration_s:g} s")
        sys.stderr.flush()

    try:
        yield draw
    finally:
        if drawn:
            sys.stderr.write("\r" + " " * 60 + "\r")
            sys.stderr.flush()


@contextlib.contextmanager
def _notebook_bar(display: Any, duration_s: float) -> Iterator[Callable[[float], None]]:
    handle: Any = None

    def bar(t_s: float) -> Any:
        part = min(1.0, t_s / duration_s)
        return display.HTML(f"<progress max='1' value='{part:.3f}'></progress> {100 * part:.0f} % of {duration_s:g} s")

    def draw(t_s: float) -> None:
        nonlocal handle
        if handle is None:
            handle = display.display(bar(t_s), display_id=True)
        else:
            handle.update(bar(t_s))

    try:
        yield draw
    finally:
        if handle is not None:
            handle.update(display.HTML(""))
