// SPDX-License-Identifier: Apache-2.0
// Handles curves as numbers: unpacks them, reads them at an instant, puts them on one axis, prints them.

/** Little-endian numbers; every machine with a browser keeps them that way. */
function unpack(text, Type) {
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  for (let n = 0; n < letters.length; ++n) bytes[n] = letters.charCodeAt(n);
  return new Type(bytes.buffer);
}

/** uPlot takes null for "no value here". */
function curveValues(text) {
  const values = unpack(text, Float32Array);
  return values.some(Number.isNaN) ? Array.from(values, (v) => (Number.isNaN(v) ? null : v)) : values;
}

/** The axis of all curves together, and each curve on it: null where it has no row of its own. */
function joined(curves) {
  const rows = curves.flatMap(({axis}, c) => Array.from(axis, (t, n) => [t, c, n])).sort((a, b) => a[0] - b[0]);
  const columns = curves.map(() => new Array(rows.length).fill(null));
  rows.forEach(([, c, n], row) => { columns[c][row] = curves[c].raw[n]; });
  return [Float64Array.from(rows, (r) => r[0]), columns];
}

/** The row at or before t, from the right of a jump; -1 before the first. */
function rowAt(axis, t) {
  let low = 0, high = axis.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (axis[middle] <= t) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** A curve at an instant: on the line between its rows, as drawn; a logic level is held. */
function valueAt({axis, raw, held}, t) {
  const n = rowAt(axis, t);
  if (n < 0) return null;
  const before = raw[n], after = raw[n + 1];
  if (held || n + 1 >= axis.length || before == null || after == null) return n + 1 >= axis.length && t > axis[n] ? null : before;
  return before + ((after - before) * (t - axis[n])) / (axis[n + 1] - axis[n]);
}

/** Lowest, highest and last value of each curve in words, for whoever cannot see it. */
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
