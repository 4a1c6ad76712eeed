# SPDX-License-Identifier: Apache-2.0
"""Shows results in a notebook: the verdict as a table, and charts with values at the pointer and zoom. No script comes from a network."""
from __future__ import annotations

import html
import json
import math
import pathlib
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from .plan import Sweep
    from .result import Result

WIDTH, HEIGHT, BINS = 720, 150, 300
SHOWN_RUNS = 20  # largest number of a sweep's runs that are shown
USUAL = ("speed_rad_s", "speed_m_s", "i_a_A", "torque_Nm", "force_N")


def result_html(result: Result) -> str:
    """Verdict and charts of the run."""
    word = "passed" if result.passed else "FAILED" if result.complete else "incomplete"
    rows = "".join(
        f"<tr><td>{'✓ ok' if v.ok else '✗ FAIL'}</td><td style='text-align:left'>{html.escape(v.figure)}</td>"
        f"<td>{'never' if v.measured == math.inf else f'{v.measured:.5g}'} {html.escape(v.unit)}</td><td>{_limits(v.min, v.max)}</td></tr>"
        for v in result.verdicts)
    table = f"<table><tr><th></th><th>requirement</th><th>measured</th><th>allowed</th></tr>{rows}</table>" if rows else ""
    told = [f"fault: {result.fault}"] * (result.fault is not None) + [f"note: {remark}" for remark in result.remarks]
    notes = "".join(f"<div>{html.escape(line)}</div>" for line in told)
    return (f"<div><b>{html.escape(str(result.summary['title']))}: {word}</b>, {result.simulated_s:g} s simulated{table}{notes}"
            f"{_charts(result) if len(result.time) else ''}</div>")


def sweep_html(sweep: Sweep) -> str:
    """The first runs of a sweep as a table, with units."""
    def cell(value: Any) -> str:
        return html.escape(f"{value:.5g}" if isinstance(value, (float, np.floating)) else str(value))

    heads = "".join(f"<th>{html.escape(name)}{f' [{html.escape(unit)}]' if (unit := sweep.units.get(name)) and not name.endswith(f'_{unit}') else ''}</th>" for name in sweep)
    shown = min(len(sweep), SHOWN_RUNS)
    rows = "".join("<tr>" + "".join(f"<td>{cell(sweep[name][n])}</td>" for name in sweep) + "</tr>" for n in range(shown))
    rest = f"<div>{len(sweep) - shown} more runs: sweep.frame() has all</div>" if shown < len(sweep) else ""
    return f"<div><b>{len(sweep)} runs, {sweep.passed} hold every requirement</b><table><tr>{heads}</tr>{rows}</table>{rest}</div>"


def _limits(low: float | None, high: float | None) -> str:
    return " ".join(f"{sign} {x:.5g}" for sign, x in (("≥", low), ("≤", high)) if x is not None)


def _charts(result: Result) -> str:
    """All charts of the same rows, and the script that shows the values at the pointer."""
    names = [name for name in USUAL if name in result.units]
    t = result.time
    keep = _kept([result[name] for name in names], len(t))
    columns = [{"label": f"{name} [{result.units[name]}]", "unit": result.units[name], "values": _numbers(result[name][keep])} for name in names]
    data = {"time_ms": _numbers(1e3 * t[keep]), "width": WIDTH, "height": HEIGHT, "columns": columns}
    drawn = "".join(_chart(1e3 * t[keep], result[name][keep], f"{name} [{result.units[name]}]") for name in names)
    script = pathlib.Path(__file__).with_name("chart.js").read_text(encoding="utf-8")
    kept = json.dumps(data, separators=(",", ":")).replace("<", "\\u003c")
    return f"<div>{drawn}<script type='application/json'>{kept}</script><script>{script}</script></div>"


def _kept(columns: list[Any], rows: int) -> Any:
    """A few rows with the least and the greatest value of each column in each part of the run."""
    if rows <= 6 * BINS:
        return np.arange(rows)
    kept = {0, rows - 1}
    for part in np.array_split(np.arange(rows), BINS):
        for column in columns:
            known = part[~np.isnan(column[part])]
            if len(known):
                kept |= {int(known[column[known].argmin()]), int(known[column[known].argmax()])}
    return np.array(sorted(kept))


def _numbers(column: Any) -> list[float | None]:
    return [float(f"{x:.7g}") if math.isfinite(x) else None for x in column.tolist()]


def _chart(t_ms: Any, x: Any, label: str) -> str:
    low, high = float(np.nanmin(x)), float(np.nanmax(x))
    span, duration = (high - low) or 1.0, float(t_ms[-1] - t_ms[0]) or 1.0
    points = " ".join(f"{(a - t_ms[0]) / duration * WIDTH:.1f},{HEIGHT - (b - low) / span * HEIGHT:.1f}" for a, b in zip(t_ms, x) if b == b)
    return (f"<div style='margin-top:6px'>{label}: {low:.4g} .. {high:.4g}, from {t_ms[0]:.4g} to {t_ms[-1]:.4g} ms</div>"
            f"<svg viewBox='0 -4 {WIDTH} {HEIGHT + 8}' width='{WIDTH}' height='{HEIGHT + 8}' role='img' aria-label='{label} over time'>"
            f"<polyline points='{points}' fill='none' stroke='#1f6feb' stroke-width='1'/>"
            f"<line y1='-4' y2='{HEIGHT + 4}' stroke='#57606a' stroke-dasharray='3 3' style='display:none'/></svg>"
            "<div style='min-height:1.3em;font-variant-numeric:tabular-nums'></div>")
