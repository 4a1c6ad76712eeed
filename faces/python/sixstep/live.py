# SPDX-License-Identifier: Apache-2.0
"""A chart that is updated while a session advances."""
from __future__ import annotations

from typing import Any

from . import plots
from ._progress import notebook_display
from .result import without_unit
from .session import Session, place_of


def watch(session: Session, *names: str, to_s: float, step_s: float, window_s: float | None = None) -> Any:
    """Advances the session to the instant `to_s` and draws the named signals after each `step_s`. A notebook updates the chart, a script
    draws it in matplotlib's window. After Ctrl-C the session can be continued. Returns the figure.

    window_s  duration of the shown signals before the present instant. Default: all

    >>> import matplotlib; matplotlib.use("Agg")
    >>> import sixstep, sixstep.live
    >>> s = sixstep.Scenario(motor="maxon-251601", duration_s=4e-3, control={"mode": "current"}, reference={"value": 2, "unit": "A"})
    >>> figure = sixstep.live.watch(sixstep.Session(s), "i_a_A", "speed_rad_s", to_s=4e-3, step_s=1e-4)
    >>> len(figure.axes[0].lines[0].get_xdata())
    41
    """
    if not names:
        raise ValueError("name at least one signal, as \"speed_rad_s\"")
    if not step_s > 0:
        raise ValueError(f"step_s = {step_s} must be above 0")
    columns = [Session.signals()[place_of(name)] for name in names]
    figure, lines = plots.empty_charts([(without_unit(c.name), c.unit) for c in columns])
    times: list[float] = [session.time]
    values: list[list[float]] = [[session[name]] for name in names]
    display = notebook_display()
    handle = display.display(figure, display_id=True) if display is not None else None
    begin, k = session.time, 0
    try:
        while session.time < to_s and not session.over:
            k += 1
            session.advance(min(begin + k * step_s, to_s))
            times.append(session.time)
            for name, column in zip(names, values):
                column.append(session[name])
            _draw(lines, times, values, window_s)
            _show(figure, handle)
    except KeyboardInterrupt:
        pass
    if handle is not None:
        plots.closed(figure)
    return figure


def _draw(lines: list[Any], times: list[float], values: list[list[float]], window_s: float | None) -> None:
    for line, column in zip(lines, values):
        line.set_data([1e3 * t for t in times], column)
        line.axes.relim()
        line.axes.autoscale_view()
        if window_s is not None:
            line.axes.set_xlim(1e3 * max(times[0], times[-1] - window_s), 1e3 * max(times[-1], times[0] + window_s))


def _show(figure: Any, handle: Any) -> None:
    if handle is not None:
        handle.update(figure)
    else:
        figure.canvas.draw_idle()
        figure.canvas.flush_events()
