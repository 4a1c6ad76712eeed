// SPDX-License-Identifier: Apache-2.0
// Stores a plan's runs as columns of numbers, and computes the scales of the drawings.

const STATES = ['holds', 'misses a requirement', 'stopped by a fault', 'could not run'];

/** Converts numbers from the units of files to the prefixes on the page. */
function shownValues(raw, factor) {
  if (factor !== 1) for (let n = 0; n < raw.length; ++n) raw[n] *= factor;
  return raw;
}

/** The words of both plans are in one list. */
function oneList(column, words, raw) {
  const place = words.map((word) => (column.words.includes(word) ? column.words.indexOf(word) : column.words.push(word) - 1));
  for (let n = 0; n < raw.length; ++n) raw[n] = place[raw[n]] ?? NaN;
  return raw;
}

/** {plans, columns}: columns of the plans with the same kind, name and unit are one column; `of[p]` are its values in plan p. */
function planTable(data) {
  const columns = [];
  const plans = data.plans.map((plan, p) => {
    const states = unpack(plan.states, Uint8Array), numbers = plan.numbers ? unpack(plan.numbers, Float64Array) : null;
    for (const c of plan.columns) {
      let column = columns.find((o) => o.kind === c.kind && o.name === c.name && !o.of[p]);
      if (!column) {
        column = {kind: c.kind, name: c.name, unit: c.unit, factor: c.factor, log: c.log ?? false, words: c.words ? [] : null,
          of: data.plans.map(() => null), limits: data.plans.map(() => null)};
        columns.push(column);
      }
      const raw = unpack(c.data, Float32Array), limit = (v) => (v == null ? null : v * column.factor);
      column.of[p] = column.words ? oneList(column, c.words, raw) : shownValues(raw, column.factor);
      if (c.required) column.limits[p] = {min: limit(c.min), max: limit(c.max)};
    }
    return {...plan, index: p, states, runs: states.length, numberOf: (n) => (numbers ? numbers[n] : n * plan.every),
      rowOf: (number) => (numbers ? numbers.indexOf(number) : number % plan.every ? -1 : number / plan.every)};
  });
  columns.forEach((column, n) => { column.id = String(n); });
  return {plans, columns};
}

const columnName = (column) => (column.kind === 'strayed' ? 'drive: ' : '') + column.name;
const columnTitle = (column) => columnName(column) + (column.unit ? `, ${column.unit}` : '');
const valueText = (column, v) => (v == null || Number.isNaN(v) ? '–' : column.words ? column.words[v]
  : v === Infinity ? 'never' : v === -Infinity ? '−∞' : `${figure(v)}${column.unit ? '\u00a0' + column.unit : ''}`);

/** The limits that any plan requires of a column, without repetition. */
function limitsOf(column) {
  return [...new Set(column.limits.flatMap((l) => (l ? [l.min, l.max] : [])).filter((v) => v != null))];
}

/** Least and greatest finite value, including a limit that is near the values. */
function reachOf(column) {
  let low = Infinity, high = -Infinity;
  for (const values of column.of) if (values) for (const v of values)
    if (Number.isFinite(v) && (!column.log || v > 0)) low = Math.min(low, v), high = Math.max(high, v);
  if (low > high) return [0, 1];
  const span = high - low || Math.abs(high) * 0.1 || 1;
  for (const limit of limitsOf(column)) if (limit > low - span && limit < high + span) low = Math.min(low, limit), high = Math.max(high, limit);
  return [low, high];
}

/** About `wanted` round numbers. */
function roundTicks(low, high, wanted) {
  const rough = (high - low) / wanted, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((m) => m * power >= rough * 0.999), ticks = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; ++n) ticks.push(n * step);
  const decimals = Math.max(0, Math.min(9, -Math.floor(Math.log10(step * 1.0001) + 1e-9)));
  const wide = Math.max(Math.abs(low), Math.abs(high));
  const text = (v) => (wide >= 1e6 || wide < 1e-4 ? v.toExponential(1) : v.toFixed(decimals)).replace(/-/g, '−');
  return ticks.map((v) => ({v, text: text(v)}));
}

/** Converts values to positions between 0 and 1 and back. An event that never occurred is at the upper end. */
function scaleOf(column, margin = 0.04) {
  if (column.words) {
    const count = column.words.length;
    return {at: (v) => (v + 0.5) / count, back: (s) => s * count - 0.5, ticks: () => column.words.map((text, v) => ({v, text}))};
  }
  let [low, high] = reachOf(column);
  const log = column.log && low > 0, to = log ? Math.log : (v) => v, from = log ? Math.exp : (v) => v;
  low = to(low);
  high = to(high);
  const room = high > low ? margin * (high - low) : Math.abs(high) * 0.05 || 1;
  low -= room;
  high += room;
  const at = (v) => (v === Infinity ? 0.995 : v === -Infinity ? 0.005 : (to(v) - low) / (high - low));
  const ticks = (wanted) => {
    if (!log) return roundTicks(low, high, wanted);
    const all = decades(from(low), from(high)), round = all.filter((v) => [1, 2, 5].includes(Math.round(v / 10 ** Math.floor(Math.log10(v) + 1e-9))));
    return (round.length > 3 ? round : roundTicks(from(low), from(high), wanted).map((t) => t.v)).map((v) => ({v, text: String(Number(v.toPrecision(3)))}));
  };
  return {at, back: (s) => from(low + s * (high - low)), ticks};
}
