// SPDX-License-Identifier: Apache-2.0
// Draws a figure over two columns. The cells are the points of a grid or equal parts of a range, each in the colour of its mean.

const MOST_CELLS = 60;

/** Number of equal parts of a range: about four runs per cell, and no more cells than can be distinguished. */
const cutsFor = (runs) => Math.min(32, Math.max(4, Math.round(Math.sqrt(runs / 4))));

/** Colours from dark blue to yellow (viridis). A higher value is brighter, so that the colours are readable in grey and with every colour vision. */
const HEAT = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
function heatColour(part) {
  const at = Math.min(Math.max(part, 0), 1) * (HEAT.length - 1), n = Math.min(Math.floor(at), HEAT.length - 2);
  return `rgb(${HEAT[n].map((c, i) => Math.round(c + (at - n) * (HEAT[n + 1][i] - c))).join(' ')})`;
}

/** Text of a number without trailing zeros and without the rounding error of a float. */
const shortest = (v) => String(Number(v.toPrecision(5))).replace('-', '−');

/** The cells along a column: its values if they are few, as in a grid; else equal parts of its range. */
function cellsAlong(column, plan) {
  const values = column.of[plan.index];
  if (column.words) return {count: column.words.length, of: (v) => v, ticks: column.words.map((text, n) => [n + 0.5, text])};
  const distinct = new Set();
  for (const v of values) {
    if (Number.isFinite(v)) distinct.add(v);
    if (distinct.size > MOST_CELLS) break;
  }
  if (distinct.size <= MOST_CELLS) {
    const sorted = [...distinct].sort((a, b) => a - b), place = new Map(sorted.map((v, n) => [v, n]));
    return {count: sorted.length, of: (v) => place.get(v) ?? -1, ticks: sorted.map((v, n) => [n + 0.5, shortest(v)])};
  }
  const scale = scaleOf({...column, limits: [], of: [values]}, 0), count = cutsFor(plan.runs);
  return {count, of: (v) => (Number.isFinite(v) ? Math.min(count - 1, Math.max(0, Math.floor(scale.at(v) * count))) : -1),
    ticks: scale.ticks(6).map((t) => [scale.at(t.v) * count, t.text])};
}

/** Means over the runs of each cell: {across, up, sums, counts, misses}. Runs without a value are in no cell. */
function heatCells(plan, across, up, figure, picked = () => true) {
  const x = cellsAlong(across, plan), y = cellsAlong(up, plan), size = x.count * y.count;
  const sums = new Float64Array(size), counts = new Uint32Array(size), misses = new Uint32Array(size);
  const xs = across.of[plan.index], ys = up.of[plan.index], zs = figure.of[plan.index], limit = figure.limits[plan.index];
  for (let n = 0; n < plan.runs; ++n) {
    const i = x.of(xs[n]), j = y.of(ys[n]), z = zs[n];
    if (!(i >= 0 && j >= 0) || !Number.isFinite(z) || !picked(plan, n)) continue;
    const cell = j * x.count + i;
    sums[cell] += z;
    ++counts[cell];
    if (limit && ((limit.min != null && z < limit.min) || (limit.max != null && z > limit.max))) ++misses[cell];
  }
  return {x, y, sums, counts, misses};
}

function drawBar(f, low, high, column) {
  const {ctx, w} = f, left = f.left + w + 14;
  for (let n = 0; n < 100; ++n) {
    ctx.fillStyle = heatColour(n / 99);
    ctx.fillRect(left, FRAME.top + f.h * (1 - (n + 1) / 100), 14, f.h / 100 + 1);
  }
  ctx.fillStyle = palette.quiet;
  ctx.textAlign = 'left';
  ctx.fillText(figure(high), left + 20, FRAME.top + 10);
  ctx.fillText(figure(low), left + 20, FRAME.top + f.h);
  if (column.unit) ctx.fillText(column.unit, left + 20, FRAME.top + f.h / 2);
}

function drawHeat(canvas, plan, across, up, column, picked) {
  const {ctx, width, height} = cleared(canvas), cells = heatCells(plan, across, up, column, picked);
  const left = leftBeside(ctx, cells.y.ticks.map(([, text]) => text), width);
  const w = width - left - 92, h = height - FRAME.top - FRAME.bottom, cw = w / cells.x.count, ch = h / cells.y.count;
  const f = {ctx, width, height, left, w, h, across, up, cells, cw, ch};
  let low = Infinity, high = -Infinity;
  cells.counts.forEach((count, n) => {
    if (count) low = Math.min(low, cells.sums[n] / count), high = Math.max(high, cells.sums[n] / count);
  });
  cells.counts.forEach((count, n) => {
    if (!count) return;
    const i = n % cells.x.count, j = Math.floor(n / cells.x.count), x = left + i * cw, y = FRAME.top + h - (j + 1) * ch;
    ctx.fillStyle = heatColour(high > low ? (cells.sums[n] / count - low) / (high - low) : 0.5);
    ctx.fillRect(x, y, cw + 0.5, ch + 0.5);
    if (!cells.misses[n] || Math.min(cw, ch) < 7) return;
    const r = Math.min(4, Math.min(cw, ch) / 4);
    for (const [colour, size] of [['#fff', r + 1.2], ['#a81e16', r]]) {
      ctx.fillStyle = colour;
      ctx.beginPath();
      ctx.arc(x + cw / 2, y + ch / 2, size, 0, 7);
      ctx.fill();
    }
  });
  drawAxes(f, {x: cells.x.ticks.map(([at, text]) => ({at: left + at * cw, text})),
    y: cells.y.ticks.map(([at, text]) => ({at: FRAME.top + h - at * ch, text}))});
  if (low <= high) drawBar(f, low, high, column);
  return f;
}

/** The contents of a cell in words. */
function cellText(f, column, [x, y]) {
  const {cells} = f, i = Math.floor((x - f.left) / f.cw), j = Math.floor((FRAME.top + f.h - y) / f.ch), n = j * cells.x.count + i;
  if (i < 0 || j < 0 || i >= cells.x.count || j >= cells.y.count || !cells.counts[n]) return '';
  const count = cells.counts[n], mean = valueText(column, cells.sums[n] / count);
  return (count > 1 ? `mean of ${count} runs ${mean}` : mean) + (cells.misses[n] ? `; ${cells.misses[n]} beyond the limit` : '');
}

function heatView(page) {
  const {table} = page, element = (name) => document.getElementById('heat-' + name), canvas = document.querySelector('#heat canvas');
  const figures = page.choices.filter((c) => c.kind === 'figure'), places = page.choices.filter((c) => c.kind !== 'figure');
  const over = places.length > 1 ? places : page.choices;
  fillSelect(element('x'), over, over[0]);
  fillSelect(element('y'), over, over[1] ?? over[0]);
  // A computed figure that is no column of the runs; designers look for it first.
  const held = {id: String(table.columns.length), kind: 'figure', name: 'runs that hold', unit: '%', limits: table.plans.map(() => null),
    of: table.plans.map((plan) => Float32Array.from(plan.states, (s) => (s === 3 ? NaN : s === 0 ? 100 : 0)))};
  const judged = table.columns.some((c) => c.limits.some((l) => l));
  fillSelect(element('z'), [...(figures.length ? figures : page.choices), ...(judged ? [held] : [])], figures[0]);
  element('plan').append(...table.plans.map((p) => new Option(p.name, String(p.index))));
  element('plan').parentElement.hidden = table.plans.length < 2;
  const all = [...table.columns, held], column = (name) => all[element(name).value], said = element('said');
  let frame = null;
  const draw = () => {
    const plan = table.plans[element('plan').value || 0], [x, y, z] = ['x', 'y', 'z'].map(column);
    const whole = [x, y, z].every((c) => c.of[plan.index]);
    frame = whole ? drawHeat(canvas, plan, x, y, z, page.picked) : null;
    if (!whole) cleared(canvas);
    said.textContent = whole ? (frame.cells.misses.some((m) => m) ? 'A dot: runs beyond the limit.' : '') : 'This plan does not have all three.';
    canvas.setAttribute('aria-label', `${columnTitle(z)} over ${columnTitle(x)} and ${columnTitle(y)}`);
  };
  canvas.setAttribute('role', 'img');
  canvas.addEventListener('pointermove', (event) => { said.textContent = frame ? cellText(frame, column('z'), placeOf(canvas, event)) : ''; });
  for (const name of ['x', 'y', 'z', 'plan']) element(name).addEventListener('change', draw);
  return {draw};
}
