// SPDX-License-Identifier: Apache-2.0
// Draws all columns at once: one axis per column, one line per run, and ranges that select runs for the whole page.

const PARALLEL = {top: 40, bottom: 12, side: 56, grain: 3, shades: 5};

/** Lines between two axes that start and end at the same few pixels are drawn as one line, which is darker for more runs. So the
 *  drawing time does not increase with the number of runs. */
function bundled(left, right, plan, wanted, height) {
  const steps = Math.ceil(height / PARALLEL.grain) + 1, counts = new Map();
  for (let n = 0; n < plan.runs; ++n) {
    if (!wanted(n)) continue;
    const a = left(n), b = right(n);
    if (!(a === a && b === b)) continue;
    const key = Math.round((a * height) / PARALLEL.grain) * steps + Math.round((b * height) / PARALLEL.grain);
    counts.set(key, (counts.get(key) ?? 0) + 1);
  }
  return {counts, steps};
}

function drawBundle(ctx, {counts, steps}, [x1, x2], top, strength) {
  let most = 1;
  for (const count of counts.values()) most = Math.max(most, count);
  const crowd = Math.min(1, 20 / Math.sqrt(counts.size));  // many lines are transparent
  for (let shade = 1; shade <= PARALLEL.shades; ++shade) {
    ctx.globalAlpha = strength * crowd * (most > 1 ? (shade / PARALLEL.shades) ** 1.5 : 1);
    ctx.beginPath();
    for (const [key, count] of counts) {
      if (Math.ceil((PARALLEL.shades * Math.log1p(count)) / Math.log1p(most)) !== shade) continue;
      ctx.moveTo(x1, top + Math.floor(key / steps) * PARALLEL.grain);
      ctx.lineTo(x2, top + (key % steps) * PARALLEL.grain);
    }
    ctx.stroke();
  }
  ctx.globalAlpha = 1;
}

function drawAxis(ctx, axis, x, top, height, room, brush) {
  ctx.strokeStyle = palette.ink;
  ctx.lineWidth = 1;
  line(ctx, x, top, x, top + height);
  ctx.fillStyle = palette.quiet;
  ctx.textAlign = 'right';
  for (const {v, text} of axis.scale.ticks(6)) {
    const y = top + (1 - axis.scale.at(v)) * height;
    line(ctx, x - 3, y, x, y);
    // Numbers need a background over the lines' colours.
    const shown = fitted(ctx, text, room - 12), wide = ctx.measureText(shown).width;
    ctx.fillStyle = translucent(palette.paper, 0.75);
    ctx.fillRect(x - 7 - wide, y - 7, wide + 4, 14);
    ctx.fillStyle = palette.quiet;
    ctx.fillText(shown, x - 5, y + 4);
  }
  ctx.strokeStyle = palette.ink;
  ctx.setLineDash([3, 2]);
  for (const v of limitsOf(axis.column)) {
    const y = top + (1 - axis.scale.at(v)) * height;
    if (y >= top && y <= top + height) line(ctx, x - 8, y, x + 8, y);
  }
  ctx.setLineDash([]);
  if (!brush) return;
  const from = top + (1 - brush[1]) * height, tall = (brush[1] - brush[0]) * height;
  ctx.fillStyle = translucent(palette.accent, 0.3);
  ctx.strokeStyle = palette.accent;
  ctx.fillRect(x - 8, from, 16, tall);
  ctx.strokeRect(x - 8, from, 16, tall);
}

/** Writes the axes' names alternately in two rows. Each name may be as wide as the distance to the axis after the next. */
function drawNames(ctx, axes, places, gap) {
  ctx.fillStyle = palette.ink;
  axes.forEach(({column}, n) => {
    ctx.textAlign = n === 0 ? 'left' : n === axes.length - 1 ? 'right' : 'center';
    const x = n === 0 ? 4 : n === axes.length - 1 ? places[n] + PARALLEL.side - 4 : places[n];
    ctx.fillText(fitted(ctx, columnTitle(column), 1.8 * gap), x, n % 2 ? 30 : 14);
  });
}

/** Checkboxes that show or hide columns. At first, ten columns are shown. */
function columnBoxes(columns, changed) {
  const parent = document.getElementById('parallel-columns');
  return columns.map((column, n) => {
    const label = parent.appendChild(document.createElement('label')), box = label.appendChild(document.createElement('input'));
    Object.assign(box, {type: 'checkbox', checked: n < 10});
    label.append(' ' + columnName(column));
    box.addEventListener('change', changed);
    return {column, box};
  });
}

function parallelView(page) {
  const canvas = document.querySelector('#parallel canvas'), {table} = page, said = document.getElementById('parallel-said');
  const brushes = new Map();  // column -> [from, to] on its axis
  let view = {axes: [], places: [], height: 1}, gap = 1;
  const boxes = columnBoxes(page.choices, () => {
    for (const {column, box} of boxes) if (!box.checked) brushes.delete(column);
    page.pick(brushes);
  });
  const draw = () => {
    const {ctx, width, height: tall} = cleared(canvas), height = tall - PARALLEL.top - PARALLEL.bottom;
    const axes = boxes.filter((b) => b.box.checked).map(({column}) => ({column, scale: scaleOf(column)}));
    gap = (width - 2 * PARALLEL.side) / Math.max(1, axes.length - 1);
    const places = axes.map((_, n) => PARALLEL.side + n * gap);
    view = {axes, places, height};
    ctx.lineWidth = 1;
    const down = (axis, plan) => (n) => 1 - axis.scale.at(axis.column.of[plan.index]?.[n] ?? NaN);
    const layers = [[0, 0], [0, 1], [1, 0], [1, 1]].filter(([on]) => on || brushes.size);  // runs that are not selected are drawn first
    for (const [on, bad] of layers) for (const plan of table.plans) for (let k = 0; k + 1 < axes.length; ++k) {
      const wanted = (n) => (plan.states[n] !== 0) === Boolean(bad) && page.picked(plan, n) === Boolean(on);
      ctx.strokeStyle = on ? runColour(plan.index, bad) : palette.line;
      ctx.setLineDash(on && bad ? [7, 3] : []);
      drawBundle(ctx, bundled(down(axes[k], plan), down(axes[k + 1], plan), plan, wanted, height), [places[k], places[k + 1]], PARALLEL.top, on ? 0.8 : 0.5);
    }
    ctx.setLineDash([]);
    axes.forEach((axis, k) => drawAxis(ctx, axis, places[k], PARALLEL.top, height, Math.min(gap, PARALLEL.side), brushes.get(axis.column)));
    drawNames(ctx, axes, places, gap);
    tell();
  };
  const tell = () => {
    const all = table.plans.reduce((sum, p) => sum + p.runs, 0);
    let some = 0;
    for (const plan of table.plans) for (let n = 0; n < plan.runs; ++n) some += page.picked(plan, n) ? 1 : 0;
    said.textContent = brushes.size ? `${some} of ${all} runs` : `${all} runs`;
    document.getElementById('all').hidden = brushes.size === 0;
  };
  let from = null;  // {axis, s}: start of a drag
  const part = ([, y]) => Math.min(1, Math.max(0, 1 - (y - PARALLEL.top) / view.height));
  const brushed = (event) => {
    const s = part(placeOf(canvas, event));
    if (Math.abs(s - from.s) * view.height < 4) brushes.delete(from.axis.column);
    else brushes.set(from.axis.column, [Math.min(s, from.s), Math.max(s, from.s)]);
  };
  canvas.addEventListener('pointerdown', (event) => {
    const place = placeOf(canvas, event), k = view.places.findIndex((x) => Math.abs(x - place[0]) < Math.min(24, gap / 2));
    if (k < 0) return;
    canvas.setPointerCapture(event.pointerId);
    from = {axis: view.axes[k], s: part(place)};
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!from) return;
    brushed(event);
    page.mark(brushes);  // the other drawings are updated when the drag ends
    page.soon(draw);
  });
  canvas.addEventListener('pointerup', (event) => {
    if (!from) return;
    brushed(event);
    from = null;
    page.pick(brushes);
  });
  canvas.addEventListener('pointercancel', () => { from = null; });
  document.getElementById('all').addEventListener('click', () => {
    brushes.clear();
    page.pick(brushes);
  });
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', 'All columns side by side, a line per run');
  return {draw};
}
