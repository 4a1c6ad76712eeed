# SPDX-License-Identifier: Apache-2.0
"""Progress of a run, on a terminal or in a notebook."""
from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator


@contextlib.contextmanager
def shown(progress: bool | Callable[[float], None], duration_s: float) -> Iterator[Callable[[float], None] | None]:
    """What the run calls with its simulated time in s: nothing, the given function, or one that draws a bar."""
    if not isinstance(progress, bool):
        yield progress
        return
    if not progress:
        yield None
        return
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
