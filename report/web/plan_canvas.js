// SPDX-License-Identifier: Apache-2.0
// Shared by the drawings of a plan: a canvas in the screen's resolution, axes, colours of runs.

const FRAME = {left: 64, right: 16, top: 12, bottom: 42};

/** Blue and green hold, orange and purple miss: of the first plan and of the second. */
const runColour = (plan, state) => palette[state === 0 ? ['a', 'c'][plan] : ['b', 'reference'][plan]];

/** A canvas as large as it is shown, cleared. */
function cleared(canvas) {
  const ratio = devicePixelRatio, width = canvas.clientWidth, height = canvas.clientHeight, ctx = canvas.getContext('2d');
  Object.assign(canvas, {width: Math.round(width * ratio), height: Math.round(height * ratio)});
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.clearRect(0, 0, width, height);
  ctx.font = '12px system-ui, sans-serif';
  return {ctx, width, height};
}

/** Text that has no more room than that. */
function fitted(ctx, text, room) {
  if (ctx.measureText(text).width <= room) return text;
  let length = text.length;
  while (length > 1 && ctx.measureText(text.slice(0, length) + '…').width > room) --length;
  return text.slice(0, length) + '…';
}

/** Where a drawing begins, that its texts at the left stand whole: of long words so much further in, up to a third. */
const leftBeside = (ctx, texts, width) => Math.min(width / 3, Math.max(FRAME.left, ...texts.map((text) => ctx.measureText(text).width + 24)));

/** Numbers or words up the left side. */
const ticksUp = (scale, h) => scale.ticks(Math.max(2, h / 60));

/** Places of two columns on a canvas. */
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

/** Grid, numbers and names. `bands`: ticks that cells stand on instead, with no line through them. */
function drawAxes(f, bands = {}) {
  const {ctx, left, w, h} = f, bottom = FRAME.top + h;
  ctx.lineWidth = 1;
  ctx.strokeStyle = palette.grid;
  ctx.fillStyle = palette.quiet;
  ctx.textAlign = 'center';
  let free = -Infinity;  // texts that would lie over each other are left out
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

/** Requirements as dashed lines, each named where it stands. */
function drawLimits(f) {
  const {ctx, left, w, h} = f, inside = (s) => s >= 0 && s <= 1;
  ctx.save();
  ctx.strokeStyle = palette.ink;
  ctx.setLineDash([5, 4]);
  for (const v of limitsOf(f.across)) if (inside(f.x.at(v))) line(ctx, f.px(v), FRAME.top, f.px(v), FRAME.top + h);
  for (const v of limitsOf(f.up)) if (inside(f.y.at(v))) line(ctx, left, f.py(v), left + w, f.py(v));
  ctx.restore();
}

/** Where on a canvas an event happened. */
function placeOf(canvas, event) {
  const box = canvas.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

/** Options of a select; what was chosen stays chosen where it can. */
function fillSelect(select, columns, chosen) {
  select.replaceChildren(...columns.map((c) => new Option(columnName(c), c.id, false, c === chosen)));
}
