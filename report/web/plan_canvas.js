// SPDX-License-Identifier: Apache-2.0
// Common code of a plan's drawings: a canvas in the screen's resolution, axes, colours of runs.

const FRAME = {left: 64, right: 16, top: 12, bottom: 42};

/** First plan: blue for runs that hold, orange for runs that miss. Second plan: green and purple. */
const runColour = (plan, state) => palette[state === 0 ? ['a', 'c'][plan] : ['b', 'reference'][plan]];

/** Returns an empty canvas with the size at which it is shown. */
function cleared(canvas) {
  const ratio = devicePixelRatio, width = canvas.clientWidth, height = canvas.clientHeight, ctx = canvas.getContext('2d');
  Object.assign(canvas, {width: Math.round(width * ratio), height: Math.round(height * ratio)});
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.clearRect(0, 0, width, height);
  ctx.font = '12px system-ui, sans-serif';
  return {ctx, width, height};
}

/** The text, shortened to the available width. */
function fitted(ctx, text, room) {
  if (ctx.measureText(text).width <= room) return text;
  let length = text.length;
  while (length > 1 && ctx.measureText(text.slice(0, length) + '…').width > room) --length;
  return text.slice(0, length) + '…';
}

/** The left edge of a drawing. Long words at the left move it to the right, by at most a third of the width. */
const leftBeside = (ctx, texts, width) => Math.min(width / 3, Math.max(FRAME.left, ...texts.map((text) => ctx.measureText(text).width + 24)));

/** Writes numbers or words along the left side. */
const ticksUp = (scale, h) => scale.ticks(Math.max(2, h / 60));

/** Positions of two columns' values on a canvas. */
function frameOf(canvas, across, up) {
  const {ctx, width, height} = cleared(canvas);
  const h = height - FRAME.top - FRAME.bottom, x = scaleOf(across), y = scaleOf(up);
  const left = leftBeside(ctx, ticksUp(y, h).map((t) => t.text), width), w = width - left - FRAME.right;
  return {ctx, width, height, left, w, h, x, y, across, up, px: (v) => left + x.at(v) * w, py: (v) => FRAME.top + (1 - y.at(v)) * h};
}

function line(ctx, x1, y1, x2, y2) {
  ctx.beginPath();
  ctx.moveTo(x1, y1);
  ctx.lineTo(x2, y2);
  ctx.stroke();
}

/** Draws grid, numbers and names. `bands`: the ticks are the middles of cells and have no grid lines. */
function drawAxes(f, bands = {}) {
  const {ctx, left, w, h} = f, bottom = FRAME.top + h;
  ctx.lineWidth = 1;
  ctx.strokeStyle = palette.grid;
  ctx.fillStyle = palette.quiet;
  ctx.textAlign = 'center';
  let free = -Infinity;  // overlapping texts are omitted
  for (const {at, text} of bands.x ?? f.x.ticks(Math.max(2, w / 110)).map((t) => ({at: f.px(t.v), text: t.text}))) {
    if (!bands.x) line(ctx, at, FRAME.top, at, bottom);
    const half = ctx.measureText(text).width / 2;
    if (at - half < free) continue;
    ctx.fillText(text, at, bottom + 16);
    free = at + half + 8;
  }
  ctx.textAlign = 'right';
  free = Infinity;
  for (const {at, text} of bands.y ?? ticksUp(f.y, h).map((t) => ({at: f.py(t.v), text: t.text}))) {
    if (!bands.y) line(ctx, left, at, left + w, at);
    if (at + 7 > free) continue;
    ctx.fillText(fitted(ctx, text, left - 24), left - 6, at + 4);
    free = at - 7;
  }
  ctx.fillStyle = palette.ink;
  ctx.textAlign = 'center';
  ctx.fillText(fitted(ctx, columnTitle(f.across), w), left + w / 2, bottom + 35);
  ctx.save();
  ctx.translate(13, FRAME.top + h / 2);
  ctx.rotate(-Math.PI / 2);
  ctx.fillText(fitted(ctx, columnTitle(f.up), h), 0, 0);
  ctx.restore();
}

/** Draws requirements as dashed lines with their names. */
function drawLimits(f) {
  const {ctx, left, w, h} = f, inside = (s) => s >= 0 && s <= 1;
  ctx.save();
  ctx.strokeStyle = palette.ink;
  ctx.setLineDash([5, 4]);
  for (const v of limitsOf(f.across)) if (inside(f.x.at(v))) line(ctx, f.px(v), FRAME.top, f.px(v), FRAME.top + h);
  for (const v of limitsOf(f.up)) if (inside(f.y.at(v))) line(ctx, left, f.py(v), left + w, f.py(v));
  ctx.restore();
}

/** The position of an event on a canvas. */
function placeOf(canvas, event) {
  const box = canvas.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

/** Sets the options of a select. The chosen option stays chosen if it still exists. */
function fillSelect(select, columns, chosen) {
  select.replaceChildren(...columns.map((c) => new Option(columnName(c), c.id, false, c === chosen)));
}
