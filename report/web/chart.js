// SPDX-License-Identifier: Apache-2.0
// Draws one chart with its caption from its data, with uPlot. Charts share only the cursor.

const GUTTER = {left: 62, right: 56};  // the same for all charts, so that an instant has the same x position in each

// The colours are only in the style sheet; they are read once per theme.
let palette = {};
function readPalette() {
  const style = getComputedStyle(document.documentElement);
  const names = ['ink', 'quiet', 'grid', 'line', 'paper', 'a', 'b', 'c', 'a-soft', 'b-soft', 'c-soft', 'main', 'beneath', 'reference', 'accent'];
  // A canvas does not support color-mix(), so the browser computes the colour.
  const probe = document.body.appendChild(document.createElement('i'));
  palette = Object.fromEntries(names.map((name) => {
    probe.style.color = `var(--${name})`;
    return [name, getComputedStyle(probe).color];
  }));
  probe.remove();
  return style;
}
const translucent = (color, share) => {
  const [r, g, b] = color.match(/[\d.]+/g).map(Number);
  return color.startsWith('color(') ? `rgb(${r * 255} ${g * 255} ${b * 255} / ${share})` : `rgb(${r} ${g} ${b} / ${share})`;
};

/** Number of decimals that distinguish multiples of a step: one more for 2.5 than for 2. */
function decimalsOf(step) {
  const fewest = Math.max(0, Math.min(9, -Math.floor(Math.log10(step * 1.0001) + 1e-9)));
  const whole = (decimals) => Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) < 1e-6;
  return !whole(fewest) && fewest < 9 && whole(fewest + 1) ? fewest + 1 : fewest;
}

/** Time in the unit that fits the length of the run, with the decimals that the step requires. */
function timeFormat(duration) {
  const [factor, unit] = duration < 2e-3 ? [1e6, 'µs'] : duration < 2 ? [1e3, 'ms'] : [1, 's'];
  return {
    unit,
    text(t, step) {
      return (t * factor).toFixed(decimalsOf(step * factor)).replace('-', '−');
    },
  };
}

/** Text with four significant digits and at most six decimals. */
function figure(value) {
  if (value == null) return '–';
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e6)) return value.toExponential(2).replace(/-/g, '−');
  const decimals = size === 0 ? 3 : Math.max(0, Math.min(6, 3 - Math.floor(Math.log10(size))));
  return value.toFixed(decimals).replace('-', '−');
}

/** "i_ref" -> i with ref as subscript. */
function labelNode(label) {
  const span = document.createElement('span');
  const [main, sub] = label.split('_');
  span.append(main);
  if (sub) span.appendChild(document.createElement('sub')).textContent = sub;
  return span;
}

const STRIP = 0.66;  // height of a logic one, relative to its strip

/** Strips are one below the other, the first at the top. */
function stripped(values, index, count) {
  const base = count - 1 - index;
  return Array.from(values, (v) => (v == null ? null : base + v * STRIP));
}

/** Largest round number (1, 2, 5 times a power of ten) that is not above the value. */
function roundBelow(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [5, 2, 1].find((m) => m * power <= value * 1.000001);
}

/** Lanes are one below the other, each with its own zero line. All have the same height and scale. */
function inLanes(chart, raw) {
  let size = 0;
  for (const values of raw) for (const v of values) if (Math.abs(v) > size) size = Math.abs(v);
  const tick = size > 0 ? roundBelow(size) : 1, height = 2.5 * (size || 1);
  const zeros = raw.map((_, i) => (raw.length - 1 - i) * height);
  chart.axis = {
    range: [-height / 2, zeros[0] + height / 2],
    splits: zeros.flatMap((zero) => [zero - tick, zero, zero + tick]).sort((a, b) => a - b),
    labels: zeros.flatMap(() => [-tick, 0, tick]).map((v) => String(v).replace('-', '−')),
  };
  return raw.map((values, i) => Array.from(values, (v) => (v == null ? null : v + zeros[i])));
}

function curveOptions(curve, index, chart, count) {
  const color = () => palette[curve.style];
  // A pale band is drawn below curves that coincide with it in parts, so that both are visible.
  const width = {beneath: 5, main: 1.8}[curve.style] ?? 1.3;
  const options = {label: curve.label, stroke: color, width, points: {show: false}, spanGaps: chart.joined};
  if (curve.style === 'reference') Object.assign(options, {dash: [6, 4], width: 1.6});
  // The area below the curve, without a line.
  if (curve.region) Object.assign(options, {stroke: 'transparent', width: 0, fill: () => translucent(color(), 0.16), fillTo: () => 0});
  // Single points: nothing is drawn between them.
  if (curve.points) Object.assign(options, {paths: () => null, points: {show: true, size: 11, width: 2, stroke: color, fill: () => palette.paper}});
  if (chart.logic) {
    const base = count - 1 - index;
    // Draws steps, so that a thinned strip has no slope between two rows.
    Object.assign(options, {paths: uPlot.paths.stepped({align: 1})});
    Object.assign(options, {width: 1, fill: () => translucent(color(), 0.3), fillTo: () => base});
  }
  return options;
}

/** 1, 2 .. 9 times the powers of ten between two frequencies. */
function decades(min, max) {
  const splits = [];
  for (let power = 10 ** Math.floor(Math.log10(min)); power <= max; power *= 10)
    for (let n = 1; n < 10; ++n) if (n * power >= min && n * power <= max) splits.push(n * power);
  return splits;
}

/** A logarithmic axis has labels only at powers of ten, written as powers. */
function powerText(v, unit) {
  if (v == null) return '';
  const power = Math.round(Math.log10(v));
  if (Math.abs(Math.log10(v) - power) > 1e-9) return '';
  const name = power >= -2 && power <= 2 ? String(Number((10 ** power).toPrecision(1)))
    : '10' + String(power).replace(/./g, (c) => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(c)]);
  return unit ? `${name}\u202f${unit}` : name;
}

/** The left axis. If the chart has a second unit, the right axis shows the same values in this unit. */
function valueAxes(chart) {
  const font = '12px system-ui, sans-serif';
  const common = {scale: 'y', stroke: () => palette.quiet, font, ticks: {show: false}, grid: {stroke: () => palette.grid, width: 1}};
  const written = (factor) => (u, splits) => {
    const f = factor();
    const step = Math.abs((splits[1] - splits[0]) * f) || 1;
    const decimals = decimalsOf(step);
    return splits.map((v) => (v * f).toFixed(decimals).replace('-', '−'));
  };
  const left = {...common, size: GUTTER.left, gap: 6, space: 28, values: written(() => 1)};
  if (chart.log) left.values = (u, splits) => splits.map((v) => powerText(v));
  if (chart.logic) {
    const count = chart.curves.length;
    left.splits = () => chart.curves.map((_, i) => count - 1 - i + STRIP / 2);
    left.values = () => chart.curves.map((c) => c.label);
    left.grid = {show: false};
  }
  if (chart.lanes) {
    left.splits = () => chart.axis.splits;
    left.values = () => chart.axis.labels;
  }
  const right = {...common, side: 1, size: GUTTER.right, gap: 6, space: 28, grid: {show: false}};
  if (chart.other) {
    // Round numbers of the other unit, at the positions of these numbers.
    right.splits = (u, axis, min, max, incr) => {
      const f = chart.other.factor, span = (max - min) * f, rough = span / Math.max(2, (max - min) / incr);
      const power = 10 ** Math.floor(Math.log10(rough));
      const step = power * [1, 2, 5, 10].find((m) => m * power >= rough * 0.999);
      const splits = [];
      for (let n = Math.ceil((min * f) / step); n * step <= max * f * (1 + 1e-12); ++n) splits.push((n * step) / f);
      return splits;
    };
    right.values = written(() => chart.other.factor);
  } else {
    right.values = (u, splits) => splits.map(() => '');
  }
  return [left, right];
}

function chartOptions(chart, width, time, hooks) {
  const count = chart.curves.length;
  const x = {
    stroke: () => palette.quiet, font: '12px system-ui, sans-serif', size: 26, gap: 4, space: 90, ticks: {show: false},
    grid: {stroke: () => palette.grid, width: 1},
    values: (u, splits, axis, space, incr) => splits.map((t) => (chart.log ? powerText(t, time.unit) : time.text(t, incr) + '\u202f' + time.unit)),
  };
  if (chart.log) Object.assign(x, {splits: (u, axis, min, max) => decades(min, max), filter: (u, splits) => splits});
  // Otherwise the rounding noise of a constant curve would fill the chart.
  const range = (u, min, max) => {
    if (min == null) return [0, 1];
    if (chart.corner && !chart.whole) max = Math.min(max, chart.corner);
    if (chart.log) return [10 ** Math.floor(Math.log10(max) - 4), 10 ** Math.ceil(Math.log10(max))];
    const size = Math.max(Math.abs(min), Math.abs(max));
    const room = max - min > 1e-6 * size ? (max - min) * 0.07 : size > 0 ? size * 0.05 : 1;
    return [min - room, max + room];
  };
  return {
    width, height: chart.height, legend: {show: false}, padding: [6, 0, 0, 0],
    scales: {x: chart.log ? {time: false, distr: 3, range: (u, min, max) => [min, max]} : {time: false}, y: chart.logic ? {range: () => [-0.12, count - 0.1]} : chart.lanes ? {range: () => chart.axis.range} : {range, distr: chart.log ? 3 : 1}},
    axes: [x, ...valueAxes(chart)],
    series: [{}, ...chart.curves.map((c, i) => curveOptions(c, i, chart, count))],
    // The larger of two regions is filled only down to the smaller region, so that the colours do not mix.
    bands: chart.curves.flatMap((c, i) => (c.region && chart.curves[i + 1]?.region ? [{series: [i + 1, i + 2]}] : [])),
    cursor: {
      y: false, points: {show: !chart.logic && !chart.joined, size: 6, width: 0, fill: (u, i) => palette[chart.curves[i - 1].style]},
      drag: {x: true, y: false, dist: 4}, sync: {key: hooks.sync, scales: ['x', null]},
      bind: {dblclick: () => hooks.whole},
    },
    hooks: {
      setScale: [(u, key) => key === 'x' && hooks.zoomed(u.scales.x.min, u.scales.x.max)],
      draw: [(u) => hooks.drawn?.(u)],
    },
  };
}

/** The caption contains the legend, the switches of the curves, and the values at the cursor. */
function captionOf(chart, onToggle) {
  const caption = document.createElement('figcaption');
  const add = (css, text) => Object.assign(caption.appendChild(document.createElement('span')), {className: css, textContent: text});
  add('name', chart.title);
  const unit = add('unit', chart.unit);
  const values = chart.curves.map((curve, i) => {
    const chip = caption.appendChild(document.createElement('button'));
    chip.type = 'button';
    chip.className = 'chip curve';
    chip.title = curve.meaning;
    chip.setAttribute('aria-pressed', 'true');
    const swatch = chip.appendChild(document.createElement('span'));
    swatch.className = curve.points ? 'swatch point' : curve.region ? 'swatch region' : curve.style === 'reference' ? 'swatch dashed' : 'swatch';
    swatch.style.borderColor = `var(--${curve.style})`;
    if (curve.region) swatch.style.background = `var(--${curve.style}-soft)`;
    chip.append(labelNode(curve.label));
    const value = chip.appendChild(document.createElement('span'));
    value.className = 'value';
    chip.addEventListener('click', () => {
      const show = chip.getAttribute('aria-pressed') !== 'true';
      chip.setAttribute('aria-pressed', String(show));
      onToggle(i, show);
    });
    return value;
  });
  return {caption, values, unit};
}

/** The curves for uPlot, in the chart's unit. */
function drawnData(chart, curves) {
  const same = curves.every((c) => c.axis === curves[0].axis);
  chart.joined = !same;
  const [axis, columns] = same ? [curves[0].axis, curves.map((c) => c.raw)] : joined(curves);
  const scaled = chart.factor === 1 ? columns
    : columns.map((values) => Array.from(values, (v) => (v == null ? null : v * chart.factor)));
  if (chart.logic) return [axis, ...scaled.map((v, i) => stripped(v, i, scaled.length))];
  return [axis, ...(chart.lanes ? inLanes(chart, scaled) : scaled)];
}

/** Builds one chart in the parent. Returns the functions with which the page controls the chart. `axisOf(curve)` is the x axis of a curve. */
function buildChart(parent, chart, axisOf, x, hooks) {
  const box = parent.appendChild(document.createElement('figure'));
  box.className = chart.logic ? 'chart logic' : 'chart';
  box.id = 'chart-' + chart.id;
  chart.factor ??= 1;
  const curves = chart.curves.map((c) => ({axis: axisOf(c), raw: curveValues(c.data), held: chart.logic, shown: true}));
  const {caption, values, unit} = captionOf(chart, (i, show) => {
    curves[i].shown = show;
    plot.setSeries(i + 1, {show});
  });
  box.append(caption);
  const show = (t) => values.forEach((node, i) => {
    const v = t == null ? undefined : valueAt(curves[i].full ?? curves[i], t);
    const shown = v == null ? v : v * chart.factor;
    const text = v === undefined ? '' : chart.logic ? String(v ?? '–') : figure(shown);
    node.textContent = text && chart.other ? `${text} · ${figure(v == null ? v : shown * chart.other.factor)} ${chart.other.unit}` : text;
  });
  const data = drawnData(chart, curves);
  const plot = new uPlot(chartOptions(chart, box.clientWidth, x, hooks), data, box);
  plot.root.setAttribute('role', 'img');
  const describe = () => {
    unit.textContent = chart.unit;
    plot.root.setAttribute('aria-label', summaryOf(chart, curves, x));
  };
  describe();
  const over = plot.over;
  over.addEventListener('mousemove', (e) => hooks.pointed(plot.posToVal(e.clientX - over.getBoundingClientRect().left, 'x')));
  over.addEventListener('mouseleave', () => hooks.pointed(null));
  let close = null;  // the rows drawn instead of the envelope
  const frame = (min, max) => plot.batch(() => {
    const rows = curvesInView(curves, min, max);
    if (rows || close) plot.setData(drawnData(chart, rows ?? curves), false);
    close = rows;
    plot.setScale('x', {min, max});
  });
  const rescale = () => {
    const {min, max} = plot.scales.x;
    plot.setData(drawnData(chart, close ?? curves), false);
    plot.setScale('x', {min, max});
    describe();
  };
  return {plot, box, chart, curves, show, frame, rescale, rowsDrawn: () => close?.[0].axis.length ?? 0};
}
