# SPDX-License-Identifier: Apache-2.0
"""Charts with matplotlib, in the colours of the report."""
from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from .result import without_unit

if TYPE_CHECKING:
    from .program import Study
    from .result import Result

COLOURS = ("#1f6feb", "#d1242f", "#1a7f37", "#8250df", "#bc4c00", "#57606a")
USUAL = (("speed_rad_s", "speed_ref_rad_s"), ("speed_m_s", "speed_ref_m_s"), ("i_a_A", "i_b_A", "i_c_A"), ("torque_Nm",), ("force_N",), ("duty",))


def _pyplot() -> Any:
    try:
        import matplotlib.pyplot as pyplot
    except ImportError:
        raise ImportError("charts need matplotlib; install python3-matplotlib, or use the columns of the result") from None
    return pyplot


def _styled(axes: Any, label: str) -> None:
    axes.set_ylabel(label)
    axes.grid(True, linewidth=0.4, alpha=0.5)
    axes.spines[["top", "right"]].set_visible(False)


def run_chart(result: Result, *names: str, from_s: float | None = None, to_s: float | None = None) -> Any:
    """A chart over time for each of `names`. Default: the usual signals that were recorded. Returns the figure.

    >>> import matplotlib; matplotlib.use("Agg")
    >>> import sixstep, sixstep.plots
    >>> r = sixstep.run(sixstep.Scenario(motor="maxon-251601", duration_s=5e-3, control={"mode": "current"}, reference={"value": 2, "unit": "A"}))
    >>> len(sixstep.plots.run_chart(r, "speed", "i_a").axes)
    2
    """
    wanted: list[tuple[str, ...]] = [(name,) for name in names]
    groups = wanted or [found for group in USUAL if (found := tuple(n for n in group if n in result.units))]
    figure, all_axes = _pyplot().subplots(len(groups), 1, sharex=True, squeeze=False, figsize=(9, 1.2 + 1.9 * len(groups)), layout="constrained")
    t = result.time
    if not len(t):
        raise ValueError(f"the run recorded no row: {result.fault or 'it ended at once'}")
    part = (t >= (t[0] if from_s is None else from_s)) & (t <= (t[-1] if to_s is None else to_s))
    for axes, group in zip(all_axes[:, 0], groups):
        for colour, name in zip(COLOURS, group):
            axes.plot(1e3 * t[part], result[name][part], color=colour, linewidth=1, label=name)
        column = result.columns[result._name(group[0])]
        _styled(axes, f"{without_unit(column.name)}, {column.unit}")
        if len(group) > 1:
            axes.legend(frameon=False, fontsize=8, ncols=len(group))
    all_axes[-1, 0].set_xlabel("time, ms")
    figure.suptitle(str(result.summary["title"]))
    return figure


def empty_charts(names: list[tuple[str, str]]) -> tuple[Any, list[Any]]:
    """A figure with an empty chart over time for each (name, unit), and the charts' lines."""
    pyplot = _pyplot()
    figure, all_axes = pyplot.subplots(len(names), 1, sharex=True, squeeze=False, figsize=(9, 1.2 + 1.9 * len(names)), layout="constrained")
    lines = []
    for colour, axes, (name, unit) in zip(COLOURS * len(names), all_axes[:, 0], names):
        lines += axes.plot([], [], color=colour, linewidth=1)
        _styled(axes, f"{name}, {unit}" if unit else name)
    all_axes[-1, 0].set_xlabel("time, ms")
    return figure, lines


def closed(figure: Any) -> None:
    """Releases a figure that the notebook has shown, so that the notebook does not show it again."""
    _pyplot().close(figure)


def spectrum(result: Result, name: str = "i_a_A", *, up_to_Hz: float | None = None) -> Any:
    """Amplitudes of a recorded column over frequency, with a Hann window. The rows must lie on a grid (record.grid_s).

    >>> import matplotlib; matplotlib.use("Agg")
    >>> import sixstep, sixstep.plots
    >>> r = sixstep.run(sixstep.Scenario(motor="maxon-251601", duration_s=5e-3, control={"mode": "current"}, reference={"value": 2, "unit": "A"}))
    >>> sixstep.plots.spectrum(r, "i_a_A").axes[0].get_xlabel()
    'frequency, Hz'
    """
    t, x = result.time, result[name]
    steps = np.diff(t)
    if len(t) < 16 or np.ptp(steps) > 1e-6 * steps.mean():
        raise ValueError("a spectrum needs rows on a grid; set record.grid_s")
    window = np.hanning(len(x))
    amplitude = 2.0 * np.abs(np.fft.rfft((x - x.mean()) * window)) / window.sum()
    frequency = np.fft.rfftfreq(len(x), steps.mean())
    part = frequency <= (up_to_Hz or frequency[-1])
    figure, axes = _pyplot().subplots(figsize=(9, 3.2), layout="constrained")
    axes.plot(frequency[part], amplitude[part], color=COLOURS[0], linewidth=1)
    _styled(axes, f"amplitude of {name}, {result.units[name] if name in result.units else ''}")
    axes.set_xlabel("frequency, Hz")
    return figure


GATES = (("gate_T1", "gate_T2"), ("gate_T3", "gate_T4"), ("gate_T5", "gate_T6"))


def conducting(upper: float, lower: float, current_A: float) -> str:
    """The device that carries the current of a leg into the motor: "upper switch", "lower switch", "upper diode", "lower diode" or "none".

    >>> import sixstep.plots
    >>> sixstep.plots.conducting(upper=0, lower=0, current_A=1.5)
    'lower diode'
    """
    if upper > 0.5:
        return "upper switch"
    if lower > 0.5:
        return "lower switch"
    return "none" if current_A == 0 else "lower diode" if current_A > 0 else "upper diode"


def bridge(result: Result, at_s: float) -> Any:
    """The bridge at an instant of the run: gates that are on, devices that conduct, and the current of each phase. Returns the figure.

    >>> import matplotlib; matplotlib.use("Agg")
    >>> import sixstep, sixstep.plots
    >>> r = sixstep.run(sixstep.Scenario(motor="maxon-251601", duration_s=5e-3, control={"mode": "current"}, reference={"value": 2, "unit": "A"}))
    >>> sixstep.plots.bridge(r, at_s=2e-3).axes[0].get_title()[-20:]
    'at 1.98 ms, bus 24 V'
    """
    if not isinstance(at_s, (int, float)):
        raise TypeError("at_s must be a number, in s")
    n = int(np.searchsorted(result.time, at_s, side="right")) - 1
    if not math.isfinite(at_s) or not 0 <= n < len(result.time) or at_s > result.time[-1]:
        raise ValueError(f"at_s = {at_s:g} must lie within the run, {result.time[0]:g} .. {result.time[-1]:g} s")
    figure, axes = _pyplot().subplots(figsize=(7, 4.2), layout="constrained")
    axes.plot([0, 6.6], [4, 4], color="black", linewidth=2)
    axes.plot([0, 6.6], [0, 0], color="black", linewidth=2)
    for k, (phase, gates) in enumerate(zip("abc", GATES)):
        x, current = 1.2 + 2 * k, float(result[f"i_{phase}_A"][n])
        on = [float(result[gate][n]) for gate in gates]
        way = conducting(on[0], on[1], current)
        for y, gate, is_on, side in ((3, gates[0], on[0], "upper"), (1, gates[1], on[1], "lower")):
            lit = way.startswith(side) and abs(current) > 0
            axes.plot([x, x], [y - 1, y + 1], color=COLOURS[1] if lit else "0.7", linewidth=3 if lit else 1)
            axes.text(x, y, f"{gate[-2:]} {'on' if is_on > 0.5 else 'diode' if lit else 'off'}", ha="center", va="center", fontsize=9,
                      bbox={"boxstyle": "round", "facecolor": "#ffd8d3" if lit else "white", "edgecolor": "black" if is_on > 0.5 else "0.7"})
        axes.annotate("", xy=(x + 0.75 if current >= 0 else x, 2), xytext=(x if current >= 0 else x + 0.75, 2),
                      arrowprops={"arrowstyle": "->" if current else "-", "color": COLOURS[1] if current else "0.7"})
        axes.text(x + 0.42, 2.12, f"{phase}: {current:.3g} A", ha="center", fontsize=9)
    axes.set_title(f"{result.summary['title']}: bridge at {1e3 * result.time[n]:.4g} ms, bus {float(result['bus_V'][n]):.4g} V")
    axes.set_axis_off()
    return figure


def torque_speed(curve: Study) -> Any:
    """The torque-speed curve of `sixstep.curve`.

    >>> import matplotlib; matplotlib.use("Agg")
    >>> import sixstep, sixstep.plots
    >>> sixstep.plots.torque_speed(sixstep.curve("maxon-251601", points=5)).axes[0].get_xlabel()
    'speed_rad_s'
    """
    points = curve.to_dict()["points"]
    keys = list(points[0])
    speed = next(k for k in keys if k.startswith("speed"))
    figure, axes = _pyplot().subplots(figsize=(9, 3.6), layout="constrained")
    torque = next(k for k in keys if k.startswith(("torque", "force")))
    axes.plot([p[speed] for p in points], [p[torque] for p in points], color=COLOURS[0], linewidth=1.4)
    _styled(axes, torque)
    axes.set_xlabel(speed)
    return figure
