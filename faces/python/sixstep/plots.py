# SPDX-License-Identifier: Apache-2.0
"""Charts with matplotlib, in the colours of the report."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from .program import Study
    from .result import Result

COLOURS = ("#1f6feb", "#d1242f", "#1a7f37", "#8250df", "#bc4c00", "#57606a")
USUAL = (("speed_rad_s", "speed_ref_rad_s"), ("i_a_A", "i_b_A", "i_c_A"), ("torque_Nm",), ("duty",))


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
    """A chart over time for each of `names`; without names the usual ones that were recorded. Returns the figure."""
    wanted: list[tuple[str, ...]] = [(name,) for name in names]
    groups = wanted or [found for group in USUAL if (found := tuple(n for n in group if n in result.units))]
    figure, all_axes = _pyplot().subplots(len(groups), 1, sharex=True, squeeze=False, figsize=(9, 1.2 + 1.9 * len(groups)), layout="constrained")
    t = result.time
    part = (t >= (t[0] if from_s is None else from_s)) & (t <= (t[-1] if to_s is None else to_s))
    for axes, group in zip(all_axes[:, 0], groups):
        for colour, name in zip(COLOURS, group):
            axes.plot(1e3 * t[part], result[name][part], color=colour, linewidth=1, label=name)
        unit = result.units.get(group[0], "")
        _styled(axes, f"{group[0].rsplit('_', 1)[0] if unit else group[0]}" + (f", {unit}" if unit else ""))
        if len(group) > 1:
            axes.legend(frameon=False, fontsize=8, ncols=len(group))
    all_axes[-1, 0].set_xlabel("time, ms")
    figure.suptitle(str(result.summary["title"]))
    return figure


def spectrum(result: Result, name: str = "i_a_A", *, up_to_Hz: float | None = None) -> Any:
    """Amplitudes of a recorded column over frequency, with a Hann window. The rows must lie on a grid (record.grid_s)."""
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


def torque_speed(curve: Study) -> Any:
    """The torque-speed curve of `sixstep.curve`, with the motor's current."""
    points = curve.to_dict()["points"]
    keys = list(points[0])
    speed = next(k for k in keys if k.startswith("speed"))
    figure, axes = _pyplot().subplots(figsize=(9, 3.6), layout="constrained")
    torque = next(k for k in keys if k.startswith(("torque", "force")))
    axes.plot([p[speed] for p in points], [p[torque] for p in points], color=COLOURS[0], linewidth=1.4)
    _styled(axes, torque)
    axes.set_xlabel(speed)
    return figure
