// SPDX-License-Identifier: Apache-2.0
// The charts' common time axis: one zoom, one cursor, the close-ups, the theme, the printer.

const data = JSON.parse(document.getElementById('data').textContent);
const [runStart, runEnd] = data.run.length ? data.run : [0, 0];
const time = timeFormat(runEnd - runStart);
const charts = [];
let view = [runStart, runEnd];
let linking = true;  // while true, a chart's change of scale is our own doing

const element = (id) => document.getElementById(id);
const close = (a, b) => Math.abs(a - b) <= 1e-9 * (runEnd - runStart);
const isWhole = ([from, to]) => close(from, runStart) && close(to, runEnd);

/** Shows [from, to] in all charts; keeps inside the run and above a nanosecond. */
function show(from, to) {
  const span = Math.min(Math.max(to - from, 1e-9), runEnd - runStart);
  const start = Math.min(Math.max(from, runStart), runEnd - span);
  view = [start, start + span];
  linking = true;
  for (const {plot} of charts) plot.batch(() => plot.setScale('x', {min: view[0], max: view[1]}));
  linking = false;
  describeView();
}

function zoomed(from, to) {
  if (linking || (close(from, view[0]) && close(to, view[1]))) return;
  show(from, to);
}

function describeView() {
  const [from, to] = view, span = to - from, run = runEnd - runStart;
  const part = element('map').firstElementChild;
  part.style.left = `${(100 * (from - runStart)) / run}%`;
  part.style.width = `${(100 * span) / run}%`;
  element('range').textContent = `${time.text(from, span / 100)} … ${time.text(to, span / 100)} ${time.unit}`;
  for (const button of element('views').children)
    button.setAttribute('aria-pressed', String(close(button.from, from) && close(button.to, to)));
  // The address remembers the close-up, so that a link can point at it.
  const hash = isWhole(view) ? '' : `#t=${from.toPrecision(9)},${to.toPrecision(9)}`;
  try { history.replaceState(null, '', location.pathname + location.search + hash); } catch { /* some viewers forbid it */ }
}

function describeCursor(u) {
  const inside = u.cursor.left >= 0 && u.cursor.idx != null;
  const t = inside ? u.posToVal(u.cursor.left, 'x') : 0;
  element('cursor').textContent = inside ? `t = ${time.text(t, (view[1] - view[0]) / 1000)} ${time.unit}` : '';
}

function addViews() {
  for (const w of [{label: 'Whole run', from: runStart, to: runEnd, id: 'whole'}, ...data.windows]) {
    const button = element('views').appendChild(document.createElement('button'));
    Object.assign(button, {type: 'button', textContent: w.label, from: w.from, to: w.to, id: 'view-' + w.id});
    button.addEventListener('click', () => show(w.from, w.to));
  }
}

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const [from, to] = view, span = to - from, middle = (from + to) / 2;
  const steps = {
    ArrowLeft: [from - span / 4, to - span / 4], ArrowRight: [from + span / 4, to + span / 4],
    '+': [middle - span / 4, middle + span / 4], '=': [middle - span / 4, middle + span / 4],
    '-': [middle - span, middle + span], 0: [runStart, runEnd],
  };
  const next = steps[event.key];
  if (!next) return;
  event.preventDefault();
  show(...next);
}

function resize() {
  for (const {plot, box} of charts) if (box.clientWidth) plot.setSize({width: box.clientWidth, height: plot.height});
}

function repaint() {
  readPalette();
  for (const {plot} of charts) plot.redraw();
}

/** Paper is white whatever the screen's theme, and narrower than most screens. */
function watchPrinter() {
  addEventListener('beforeprint', () => {
    document.documentElement.classList.add('printing');
    readPalette();
    for (const {plot} of charts) plot.setSize({width: 680, height: plot.height});
    repaint();
  });
  addEventListener('afterprint', () => {
    document.documentElement.classList.remove('printing');
    repaint();
    resize();
  });
}

function noteEnvelope() {
  const thin = data.charts.filter((c) => !c.complete);
  if (!thin.length) return;
  element('envelope').textContent =
    `The run has ${thin[0].recorded.toLocaleString('en').replace(/,/g, '\u202f')} recorded rows: here an envelope stands ` +
    'for them that keeps every peak; the close-ups hold every row.';
}

function viewFromAddress() {
  const found = /^#t=([^,]+),(.+)$/.exec(location.hash);
  const [from, to] = found ? found.slice(1).map(Number) : [];
  return from < to ? [from, to] : [runStart, runEnd];
}

function start() {
  if (!data.charts.length) return;
  const wanted = viewFromAddress();
  element('plots').hidden = false;
  readPalette();
  addViews();
  const axes = data.axes.map((text) => unpack(text, Float64Array));
  const hooks = {zoomed, cursor: describeCursor, whole: () => { show(runStart, runEnd); return null; }};
  for (const chart of data.charts) charts.push(buildChart(element('charts'), chart, axes[chart.axis], time, hooks));
  noteEnvelope();
  show(...wanted);
  element('plots').addEventListener('keydown', onKey);
  new ResizeObserver(resize).observe(element('charts'));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', repaint);
  watchPrinter();
  globalThis.sixstep = {charts: charts.map((c) => c.plot), show, ready_ms: performance.now()};  // for scripts and tests
}

start();
