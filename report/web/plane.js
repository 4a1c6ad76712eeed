// SPDX-License-Identifier: Apache-2.0
// Draws the alpha-beta locus of the currents: alpha = (2 a - b - c)/3 against beta = (b - c)/sqrt 3, both axes in one scale.

const clarke = (a, b, c) => [(2 * a - b - c) / 3, (b - c) / Math.sqrt(3)];

/** `entry` and `phases`: the chart of the phase currents and its three curves. Returns the function that draws view and instant. */
function currentPlane(canvas, entry, phases) {
  const point = ([a, b, c], n) => clarke(a.raw[n], b.raw[n], c.raw[n]);
  return (from, to, t) => {
    const shown = curvesInView(phases, from, to) ?? phases, {axis} = shown[0], first = Math.max(0, rowAt(axis, from));
    let reach = 0;  // largest current in view, for both axes
    for (let n = first; n < axis.length && axis[n] <= to; ++n) reach = Math.max(reach, Math.hypot(...point(shown, n)));
    reach ||= 1;
    const ratio = devicePixelRatio, width = canvas.clientWidth, height = canvas.clientHeight, ctx = canvas.getContext('2d');
    Object.assign(canvas, {width: width * ratio, height: height * ratio});
    ctx.setTransform(ratio, 0, 0, ratio, width * ratio / 2, height * ratio / 2);
    const scale = (0.44 * Math.min(width, height)) / reach, place = ([x, y]) => [x * scale, -y * scale];
    drawPlaneGrid(ctx, width, height, roundBelow(reach), scale, entry.chart);
    ctx.strokeStyle = ctx.fillStyle = palette.main;
    ctx.lineWidth = 1;
    ctx.globalAlpha = 0.75;
    ctx.beginPath();
    for (let n = first; n < axis.length && axis[n] <= to; ++n) ctx.lineTo(...place(point(shown, n)));
    ctx.stroke();
    ctx.globalAlpha = 1;
    if (t == null) return;
    const now = phases.map((curve) => valueAt(curve.full ?? curve, t));
    if (now.includes(null)) return;
    ctx.fillStyle = palette.accent;
    ctx.beginPath();
    ctx.arc(...place(clarke(...now)), 4.5, 0, 7);
    ctx.fill();
  };
}

/** Draws the axes of the phases, and a circle with a round number of amperes. */
function drawPlaneGrid(ctx, width, height, round, scale, chart) {
  ctx.clearRect(-width, -height, 2 * width, 2 * height);
  const long = Math.min(width, height) / 2;
  ctx.font = '11.5px system-ui, sans-serif';
  ctx.textAlign = 'center';
  for (const [name, degrees] of [['a', 0], ['b', 120], ['c', 240]]) {
    const x = Math.cos(degrees * Math.PI / 180), y = -Math.sin(degrees * Math.PI / 180);
    ctx.strokeStyle = palette.grid;
    ctx.beginPath();
    ctx.moveTo(-long * x, -long * y);
    ctx.lineTo(long * x, long * y);
    ctx.stroke();
    ctx.fillStyle = palette[name];
    ctx.fillText(name, (long - 7) * x, (long - 7) * y + (y ? 0 : -5));
  }
  ctx.strokeStyle = palette.line;
  ctx.beginPath();
  ctx.arc(0, 0, round * scale, 0, 7);
  ctx.stroke();
  ctx.fillStyle = palette.quiet;
  ctx.fillText(`${Number((round * (chart.factor ?? 1)).toPrecision(2))} ${chart.unit}`, 0, round * scale - 4);
}
