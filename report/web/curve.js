// SPDX-License-Identifier: Apache-2.0
// Draws the curve's charts over one speed axis, with one zoom and one cursor; follows theme and printer.

const data = JSON.parse(document.getElementById('data').textContent);
const axis = unpack(data.axis, Float64Array);
const speed = {
  name: 'speed', unit: data.speed ?? 'rpm',
  text(n, step) { return n.toFixed(Math.max(0, -Math.floor(Math.log10(step * 1.0001)))).replace('-', '−'); },
};
const whole = [axis[0], axis[axis.length - 1]];
const charts = [];
let linking = true;  // true while this script itself changes a chart's scale

function show(from, to) {
  linking = true;
  for (const {plot} of charts) plot.batch(() => plot.setScale('x', {min: Math.max(from, whole[0]), max: Math.min(to, whole[1])}));
  linking = false;
}

function pointed(at) {
  for (const chart of charts) chart.show(at);
  document.getElementById('cursor').textContent = at == null ? '' : `${speed.text(at, data.speed ? 0.001 : 1)} ${speed.unit}`;
}

/** Shows the motor's usual range of torque, or the range up to standstill. */
function showUpTo(stall) {
  for (const [id, on] of [['usable', !stall], ['stall', stall]]) document.getElementById(id).setAttribute('aria-pressed', String(on));
  linking = true;
  for (const chart of charts) {
    chart.chart.whole = stall;
    chart.rescale();
  }
  linking = false;
}

function start() {
  document.getElementById('plots').hidden = false;
  readPalette();
  const hooks = {
    sync: 'speed', zoomed: (from, to) => { if (!linking) show(from, to); }, pointed,
    whole: () => { show(...whole); return null; },
  };
  for (const chart of data.charts) charts.push(buildChart(document.getElementById('charts'), chart, () => axis, speed, hooks));
  show(...whole);
  if (data.charts.some((c) => c.corner)) {
    document.getElementById('ranges').hidden = false;
    document.getElementById('usable').addEventListener('click', () => showUpTo(false));
    document.getElementById('stall').addEventListener('click', () => showUpTo(true));
  }
  watchPage(charts, () => {});
  globalThis.sixstep = {charts: charts.map((c) => c.plot), show};  // for scripts and tests
}

start();
