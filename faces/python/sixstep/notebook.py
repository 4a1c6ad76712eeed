# SPDX-License-Identifier: Apache-2.0
"""How results look in a notebook: the verdict as a table, and a chart as SVG that needs no script from a network."""
from __future__ import annotations

import html
import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from .result import Result

WIDTH, HEIGHT, MOST_POINTS = 720, 150, 1200


def result_html(result: Result) -> str:
    """Verdict and charts of the run."""
    word = "passed" if result.passed else "FAILED" if result.complete else "incomplete"
    rows = "".join(
        f"<tr><td>{'✓ ok' if v.ok else '✗ FAIL'}</td><td style='text-align:left'>{html.escape(v.figure)}</td>"
        f"<td>{'never' if v.measured == math.inf else f'{v.measured:.5g}'} {html.escape(v.unit)}</td><td>{_limits(v.min, v.max)}</td></tr>"
        for v in result.verdicts)
    table = f"<table><tr><th></th><th>requirement</th><th>measured</th><th>allowed</th></tr>{rows}</table>" if rows else ""
    charts = "".join(_chart(result, name) for name in ("speed_rad_s", "i_a_A", "torque_Nm") if name in result.units)
    return f"<div><b>{html.escape(str(result.summary['title']))}: {word}</b>, {result.simulated_s:g} s simulated{table}{charts}</div>"


def _limits(low: float | None, high: float | None) -> str:
    return " ".join(f"{sign} {x:.5g}" for sign, x in (("≥", low), ("≤", high)) if x is not None)


def _chart(result: Result, name: str) -> str:
    t, x = result.time, result[name]
    keep = np.linspace(0, len(t) - 1, min(len(t), MOST_POINTS)).astype(int)
    t, x = t[keep], x[keep]
    low, high = float(np.nanmin(x)), float(np.nanmax(x))
    span, duration = (high - low) or 1.0, float(t[-1] - t[0]) or 1.0
    points = " ".join(f"{(a - t[0]) / duration * WIDTH:.1f},{HEIGHT - (b - low) / span * HEIGHT:.1f}" for a, b in zip(t, x) if b == b)
    return (f"<div style='margin-top:6px'>{name} [{result.units[name]}]: {low:.4g} .. {high:.4g}, over {1e3 * duration:.4g} ms<br>"
            f"<svg viewBox='-4 -4 {WIDTH + 8} {HEIGHT + 8}' width='{WIDTH}' role='img' aria-label='{name} over time'>"
            f"<polyline points='{points}' fill='none' stroke='#1f6feb' stroke-width='1'/></svg></div>")
