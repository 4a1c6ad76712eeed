// SPDX-License-Identifier: Apache-2.0
// Draws runs as points, with any two columns as axes.

/** A run that holds is a square, a run that misses is a triangle, a fault is a cross. Not every reader can distinguish the colours. */
function drawRun(ctx, x, y, size, state) {
  if (state === 0) return ctx.fillRect(x - size / 2, y - size / 2, size, size);
  if (state === 2) return ctx.fillRect(x - size, y - 1, 2 * size, 2), ctx.fillRect(x - 1, y - size, 2, 2 * size);
  ctx.beginPath();
  ctx.moveTo(x - 0.8 * size, y - 0.6 * size);
  ctx.lineTo(x + 0.8 * size, y - 0.6 * size);
  ctx.lineTo(x, y + 0.8 * size);
  ctx.fill();
}

/** Draws all selected runs. Runs that miss a requirement are drawn last, so that they are visible. */
function drawCloud(f, table, picked) {
  const {ctx} = f;
  for (const bad of [false, true]) for (const plan of table.plans) {
    const xs = f.across.of[plan.index], ys = f.up.of[plan.index];
    if (!xs || !ys) continue;
    const size = plan.runs > 20000 ? 2 : plan.runs > 1000 ? 3.5 : 6;
    ctx.globalAlpha = plan.runs > 20000 && !bad ? 0.45 : 0.8;
    ctx.fillStyle = runColour(plan.index, bad ? 1 : 0);
    for (let n = 0; n < plan.runs; ++n) {
      if ((plan.states[n] !== 0) !== bad || !picked(plan, n)) continue;
      const x = f.px(xs[n]), y = f.py(ys[n]);
      if (!(x === x && y === y)) continue;
      drawRun(ctx, x, y, size, plan.states[n]);
    }
  }
  ctx.globalAlpha = 1;
}

/** Draws a ring around the chosen run. */
function drawRing(f, chosen) {
  if (!chosen) return;
  const x = f.px(f.across.of[chosen.plan.index]?.[chosen.row] ?? NaN), y = f.py(f.up.of[chosen.plan.index]?.[chosen.row] ?? NaN);
  if (!(x === x && y === y)) return;
  f.ctx.strokeStyle = palette.ink;
  f.ctx.lineWidth = 2;
  f.ctx.beginPath();
  f.ctx.arc(x, y, 8, 0, 7);
  f.ctx.stroke();
}

/** The run nearest to a position, within the width of a finger. */
function nearestRun(f, table, picked, [x, y]) {
  let best = null, least = 22 ** 2;
  for (const plan of table.plans) {
    const xs = f.across.of[plan.index], ys = f.up.of[plan.index];
    if (!xs || !ys) continue;
    for (let n = 0; n < plan.runs; ++n) {
      const distance = (f.px(xs[n]) - x) ** 2 + (f.py(ys[n]) - y) ** 2;
      if (distance < least && picked(plan, n)) least = distance, best = {plan, row: n};
    }
  }
  return best;
}

/** Builds a cloud with its selects; `extra` draws over the cloud. Returns the function that redraws it. */
function cloud(id, page, {across, up, extra}) {
  const canvas = document.querySelector(`#${id} canvas`), said = document.getElementById(id + '-said');
  const selects = {x: document.getElementById(id + '-x'), y: document.getElementById(id + '-y')};
  fillSelect(selects.x, page.choices, across);
  fillSelect(selects.y, page.choices, up);
  const column = (axis) => page.table.columns[selects[axis].value];
  let frame = null;
  const draw = () => {
    frame = frameOf(canvas, column('x'), column('y'));
    drawAxes(frame);
    drawCloud(frame, page.table, page.picked);
    drawLimits(frame);
    extra?.(frame);
    drawRing(frame, page.chosen);
    canvas.setAttribute('aria-label', `${columnTitle(frame.up)} over ${columnTitle(frame.across)}, a point per run`);
  };
  canvas.setAttribute('role', 'img');
  const at = (event) => nearestRun(frame, page.table, page.picked, placeOf(canvas, event));
  canvas.addEventListener('pointermove', (event) => {
    const run = at(event);
    const of = (c) => valueText(c, c.of[run.plan.index]?.[run.row]);
    if (!extra) said.textContent = run ? `run ${run.plan.numberOf(run.row)}: ${of(frame.across)}, ${of(frame.up)}` : '';
  });
  canvas.addEventListener('click', (event) => page.choose(at(event)));
  for (const select of Object.values(selects)) select.addEventListener('change', draw);
  return {draw, column};
}
