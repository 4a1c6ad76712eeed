// SPDX-License-Identifier: Apache-2.0
// Unpacks curves, reads their values at an instant, puts them on a common axis, and prints them.

/** Unpacks little-endian numbers. Every machine with a browser is little-endian. */
function unpack(text, Type) {
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  for (let n = 0; n < letters.length; ++n) bytes[n] = letters.charCodeAt(n);
  return new Type(bytes.buffer);
}

/** uPlot requires null for a missing value. */
function curveValues(text) {
  const values = unpack(text, Float32Array);
  return values.some(Number.isNaN) ? Array.from(values, (v) => (Number.isNaN(v) ? null : v)) : values;
}

/** The common axis of all curves, and each curve on this axis: null at instants at which the curve has no row. */
function joined(curves) {
  const rows = curves.flatMap(({axis}, c) => Array.from(axis, (t, n) => [t, c, n])).sort((a, b) => a[0] - b[0]);
  const columns = curves.map(() => new Array(rows.length).fill(null));
  rows.forEach(([, c, n], row) => { columns[c][row] = curves[c].raw[n]; });
  return [Float64Array.from(rows, (r) => r[0]), columns];
}

/** The last row at or before t; at a jump, the row after the jump. -1 before the first row. */
function rowAt(axis, t) {
  let low = 0, high = axis.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (axis[middle] <= t) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** The value of a curve at an instant, on the straight line between its rows as drawn. A logic level is constant between rows. */
function valueAt({axis, raw, held}, t) {
  const n = rowAt(axis, t);
  if (n < 0) return null;
  const before = raw[n], after = raw[n + 1];
  if (held || n + 1 >= axis.length || before == null || after == null) return n + 1 >= axis.length && t > axis[n] ? null : before;
  return before + ((after - before) * (t - axis[n])) / (axis[n + 1] - axis[n]);
}

/** Lowest, highest and last value of each curve in words, for screen readers. */
function summaryOf(chart, curves, x) {
  const told = curves.map(({raw}, i) => {
    let low = Infinity, high = -Infinity, last = null;
    for (const v of raw) if (v != null) low = Math.min(low, v), high = Math.max(high, v), last = v;
    const of = (v) => `${figure(v * chart.factor)}${chart.unit ? ' ' + chart.unit : ''}`;
    return last == null ? '' : `${chart.curves[i].label.replace('_', ' ')} from ${of(low)} to ${of(high)}, at the end ${of(last)}`;
  });
  const strips = `${chart.curves.length} logic levels: ${chart.curves.map((c) => c.label).join(', ')}`;
  return `${chart.title} over ${x.name ?? 'time'}. ${chart.logic ? strips : told.filter(Boolean).join('; ')}.`;
}
