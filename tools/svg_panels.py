# SPDX-License-Identifier: Apache-2.0
"""Charts over time for a printed page, one below the other on one time axis, as an SVG file that refers to no other file.

The same columns give the same bytes, so that a test can compare the manual's pictures with the program's results.
"""
import math
from xml.sax.saxutils import escape

WIDTH, HEIGHT, LEFT, RIGHT, HEAD, GAP, FOOT = 720, 132, 58, 14, 30, 12, 40
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#555555")  # colours that colour-blind readers can distinguish
DASHED = "#888888"


def ticks(low, high):
    """Round numbers, four to nine of them."""
    rough = (high - low) / 5
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(power * m for m in (1, 2, 5, 10) if power * m >= rough)
    return [n * step for n in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


def thinned(points):
    """At most the first, least, largest and last row of each pixel of the time axis, so that no peak is lost."""
    out, bundle = [], []
    for point in points + [None]:
        if bundle and (point is None or round(point[0]) != round(bundle[0][0])):
            corners = (bundle[0], min(bundle, key=lambda p: p[1]), max(bundle, key=lambda p: p[1]), bundle[-1])
            out += [p for p in bundle if p in corners] if len(bundle) > 4 else bundle
            bundle = []
        bundle.append(point)
    return out


def path(curve, at, colour, dashed):
    places = [(f"{x:.1f}", f"{y:.1f}") for x, y in thinned([at(x, y) for x, y in curve])]
    corners = [here for n, here in enumerate(places)  # points within a level line are not needed
               if not 0 < n < len(places) - 1 or not here[1] == places[n - 1][1] == places[n + 1][1]]
    words = [f"{x} {y}" for n, (x, y) in enumerate(corners) if n == 0 or (x, y) != corners[n - 1]]
    dash = ' stroke-dasharray="5 4"' if dashed else ""
    return f'<path fill="none" stroke="{colour}" stroke-width="1.4" stroke-linejoin="round"{dash} d="M{"L".join(words)}"/>'


def heading(title, curves, top):
    out, x = [f'<text x="{LEFT}" y="{top - 8}" class="t">{escape(title)}</text>'], WIDTH - RIGHT
    for label, colour, dashed in reversed(curves):
        dash = ' stroke-dasharray="5 4"' if dashed else ""
        x -= 6.6 * len(label)
        out.append(f'<text x="{x:.0f}" y="{top - 8}">{escape(label)}</text>')
        out.append(f'<path stroke="{colour}" stroke-width="2"{dash} d="M{x - 26:.0f} {top - 12}h20"/>')
        x -= 40
    return out


def panel(spec, top, span, bottom_axis):
    """One chart. spec: title, curves [(label, [(t, y)..], dashed)]; span: range of the time axis."""
    values = [y for _, curve, _ in spec["curves"] for _, y in curve]
    low, high = min(values), max(values)
    room = 0.06 * (high - low) or max(abs(high) * 0.05, 1e-9)
    low, high = low - room, high + room

    def at(x, y):
        return (LEFT + (x - span[0]) / (span[1] - span[0]) * (WIDTH - LEFT - RIGHT), top + (high - y) / (high - low) * HEIGHT)

    out, legend, colour = [], [], 0
    for value in ticks(low, high):
        y = at(span[0], value)[1]
        out.append(f'<path class="g" d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}"/>')
        out.append(f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{value:.6g}</text>')
    for value in ticks(*span):
        x = at(value, low)[0]
        out.append(f'<path class="g" d="M{x:.1f} {top}V{top + HEIGHT}"/>')
        if bottom_axis:
            out.append(f'<text x="{x:.1f}" y="{top + HEIGHT + 16}" text-anchor="middle">{value:.6g}</text>')
    for label, curve, dashed in spec["curves"]:
        shade = DASHED if dashed else COLOURS[colour]
        colour += not dashed
        legend.append((label, shade, dashed))
        out.append(path(curve, at, shade, dashed))
    return out + heading(spec["title"], legend, top)


def drawing(title, panels, span, time_label):
    height = len(panels) * (HEAD + HEIGHT) + (len(panels) - 1) * GAP + FOOT
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}" '
           f'role="img" font-family="system-ui, sans-serif" font-size="12" fill="#444444">',
           f"<title>{escape(title)}</title>", "<style>.g{stroke:#e2e2e2}.t{font-weight:600;fill:#222222}</style>",
           f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>']
    for n, spec in enumerate(panels):
        out += panel(spec, HEAD + n * (HEAD + HEIGHT + GAP), span, n + 1 == len(panels))
    out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2:.0f}" y="{height - 8}" text-anchor="middle">{escape(time_label)}</text>')
    return "\n".join(out) + "\n</svg>\n"
