// SPDX-License-Identifier: Apache-2.0
// Connects the charts by their common time axis: one zoom, one cursor, two marks, the close-ups, the units, the address.

const data = JSON.parse(document.getElementById('data').textContent);
const [runStart, runEnd] = data.run.length ? data.run : [0, 0];
const time = {...timeFormat(runEnd - runStart), name: 'time'};
const address = new URLSearchParams(location.hash.slice(1));
const usualUnits = {speed: 'rad_s', angle: data.charts.some((c) => c.id === 'position') ? 'deg' : 'deg_el', torque: 'mNm', current: 'A'};
const units = unitChoices(address, usualUnits);
const charts = [];    // charts over time, as returned by buildChart
const spectra = [];   // charts over frequency
const instants = {cursor: null, A: null, B: null};
let instruments = {view() {}, instant() {}};
let view = [runStart, runEnd];
let linking = true;   // true while this script itself changes a chart's scale

const element = (id) => document.getElementById(id);
const close = (a, b) => Math.abs(a - b) <= 1e-9 * (runEnd - runStart);
const isWhole = ([from, to]) => close(from, runStart) && close(to, runEnd);
const inRun = (t) => t != null && t >= runStart && t <= runEnd;

/** Shows [from, to] in all charts, limited to the run and to at least a nanosecond. */
function show(from, to) {
  const span = Math.min(Math.max(to - from, 1e-9), runEnd - runStart);
  const start = Math.min(Math.max(from, runStart), runEnd - span);
  view = [start, start + span];
  linking = true;
  for (const chart of charts) chart.frame(...view);
  linking = false;
  describeView();
  instruments.view();
}

function zoomed(from, to) {
  if (linking || (close(from, view[0]) && close(to, view[1]))) return;
  show(from, to);
}

/** Writes close-up, marks and units into the address, so that a link contains them. */
function remember() {
  const parts = isWhole(view) ? [] : [`t=${view[0].toPrecision(9)},${view[1].toPrecision(9)}`];
  for (const name of ['A', 'B']) if (instants[name] != null) parts.push(`${name}=${instants[name].toPrecision(9)}`);
  for (const [quantity, id] of Object.entries(units)) if (id !== usualUnits[quantity]) parts.push(`${quantity}=${id}`);
  const hash = parts.length ? '#' + parts.join('&') : '';
  try { history.replaceState(null, '', location.pathname + location.search + hash); } catch { /* some viewers forbid it */ }
}

function describeView() {
  const [from, to] = view, span = to - from, run = runEnd - runStart;
  const part = element('map').firstElementChild;
  part.style.left = `${(100 * (from - runStart)) / run}%`;
  part.style.width = `${(100 * span) / run}%`;
  element('range').textContent = `${time.text(from, span / 100)} … ${time.text(to, span / 100)} ${time.unit}`;
  for (const button of element('views').children)
    button.setAttribute('aria-pressed', String(close(button.from, from) && close(button.to, to)));
  remember();
}

/** Moves the common cursor to t, or removes it. */
function pointAt(t) {
  instants.cursor = inRun(t) ? t : null;
  for (const {plot} of charts)
    plot.setCursor(instants.cursor == null ? {left: -10, top: -10} : {left: plot.valToPos(t, 'x'), top: 10});
  showInstant();
}

/** Called when the mouse moves. uPlot itself moves the lines. */
function pointed(t) {
  if (t == null) return pointAt(instants.cursor);  // the mouse has left the chart: the instant does not change, so that its values can be read
  instants.cursor = inRun(t) ? t : null;
  showInstant();
}

let asked = false;  // true: an update is scheduled with the next frame
function showInstant() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => {
    asked = false;
    for (const chart of charts) chart.show(instants.cursor);
    const t = instants.cursor, step = (view[1] - view[0]) / 1000;
    element('cursor').textContent = t == null ? '' : `t = ${time.text(t, step)} ${time.unit}`;
    instruments.instant();
  });
}

function mark(name, t) {
  instants[name] = inRun(t) ? t : null;
  for (const {plot} of charts) plot.redraw(false);
  element('mark-' + name).setAttribute('aria-pressed', String(instants[name] != null));
  remember();
  showInstant();
}

/** The position of a mark that a button sets: at the cursor, else in the view. */
const markPlace = (name) => instants.cursor ?? view[0] + (view[1] - view[0]) * (name === 'A' ? 0.3 : 0.7);

function addViews() {
  for (const w of [{label: 'Whole run', from: runStart, to: runEnd, id: 'whole'}, ...data.windows]) {
    const button = element('views').appendChild(document.createElement('button'));
    Object.assign(button, {type: 'button', textContent: w.label, from: w.from, to: w.to, id: 'view-' + w.id});
    button.addEventListener('click', () => show(w.from, w.to));
  }
  for (const name of ['A', 'B'])
    element('mark-' + name).addEventListener('click', () => mark(name, instants[name] == null ? markPlace(name) : null));
}

/** The next row of the trace after t in the given direction. */
function nextRow(t, direction) {
  let best = null;
  for (const {axis} of charts.map((c) => c.curves[0].full ?? c.curves[0])) {
    let n = rowAt(axis, t);
    if (direction > 0) n += 1;
    else while (n >= 0 && axis[n] >= t) --n;
    const at = axis[n];
    if (at !== undefined && (best == null || (at - best) * direction < 0)) best = at;
  }
  return best ?? t;
}

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target instanceof HTMLSelectElement) return;
  const [from, to] = view, span = to - from, middle = (from + to) / 2, at = instants.cursor ?? middle;
  const stepTo = (t) => {
    if (t < from || t > to) show(t - span / 2, t + span / 2);
    pointAt(Math.min(Math.max(t, runStart), runEnd));
  };
  const shift = event.shiftKey;
  const actions = {
    ArrowLeft: () => (shift ? stepTo(at - span / 200) : show(from - span / 4, to - span / 4)),
    ArrowRight: () => (shift ? stepTo(at + span / 200) : show(from + span / 4, to + span / 4)),
    '+': () => show(middle - span / 4, middle + span / 4), '=': () => show(middle - span / 4, middle + span / 4),
    '-': () => show(middle - span, middle + span), 0: () => show(runStart, runEnd),
    '[': () => stepTo(nextRow(at, -1)), ']': () => stepTo(nextRow(at, 1)),
    a: () => mark('A', at), b: () => mark('B', at),
    Escape: () => { mark('A', null); mark('B', null); pointAt(null); },
  };
  const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (!action) return;
  event.preventDefault();
  action();
}

function changeUnits() {
  for (const chart of [...charts, ...spectra]) {
    wearUnit(chart.chart, units, data.pole_pairs);
    linking = true;
    chart.rescale();
    linking = false;
  }
  remember();
  showInstant();
  instruments.units();
}

const grouped = (count) => count.toLocaleString('en').replace(/,/g, '\u202f');

function noteEnvelope() {
  const thin = data.charts.filter((c) => !c.complete);
  if (!thin.length) return;
  element('envelope').textContent =
    `The run has ${grouped(thin[0].recorded)} recorded rows. Here an envelope that keeps every ` +
    `peak replaces them; ${data.rows?.length ? `where fewer than ${grouped(ROWS_IN_VIEW)} are in view, all are drawn.` : 'the close-ups hold every row.'}`;
}

/** Draws the envelope first. Every row is unpacked after the page is shown. */
async function addRows() {
  for (const block of data.rows ?? []) {
    const conduction = await unpackRows(block, charts);
    if (conduction) instruments.conducts(conduction);
  }
  if (data.rows?.length) show(...view);
  globalThis.sixstep.complete_ms = performance.now();
}

function viewFromAddress() {
  const [from, to] = (address.get('t') ?? '').split(',').map(Number);
  return from < to ? [from, to] : [runStart, runEnd];
}

function start() {
  if (!data.charts.length) return;
  const wanted = viewFromAddress();
  element('plots').hidden = false;
  readPalette();
  addViews();
  const axes = data.axes.map((text) => unpack(text, Float64Array));
  const axisOf = (curve) => axes[curve.axis];
  const hooks = {sync: 'time', zoomed, pointed, drawn: (u) => drawMarks(u, instants), whole: () => { show(runStart, runEnd); return null; }};
  for (const chart of data.charts) {
    wearUnit(chart, units, data.pole_pairs);
    charts.push(buildChart(element('charts'), chart, axisOf, time, hooks));
  }
  instruments = makeInstruments(axisOf);
  spectra.push(...buildSpectra(axisOf));
  noteEnvelope();
  show(...wanted);
  for (const name of ['A', 'B']) if (address.has(name)) mark(name, Number(address.get(name)));
  element('plots').addEventListener('keydown', onKey);
  watchPage(charts, () => instruments.view());
  globalThis.sixstep = {  // for scripts and tests
    charts: charts.map((c) => c.plot), spectra: spectra.map((c) => c.plot), entries: charts, packed: data.rows,
    drawnRows: () => charts.map((c) => c.rowsDrawn()), show, pointAt, valueAt, instants, ready_ms: performance.now(),
  };
  addRows();
}

start();
