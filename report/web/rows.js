// SPDX-License-Identifier: Apache-2.0
// Unpacks every row of the run after the page is shown, and draws the rows if few enough are in view.

const ROWS_IN_VIEW = 12000;

async function inflated(text) {
  const stream = new Blob([unpack(text, Uint8Array)]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Adds up the differences, which are stored in planes of bytes of equal weight. The result is each row's count modulo 2^(8 planes). */
function counted(bytes, offset, rows, planes, row) {
  const modulus = 256 ** planes;
  let count = 0;
  for (let n = 0; n < rows; ++n) {
    let difference = 0;
    for (let p = planes - 1; p >= 0; --p) difference = difference * 256 + bytes[offset + p * rows + n];
    count = row(n, difference, count, modulus);
  }
}

/** Sets `full`, all rows, for each curve of a block. Returns the conduction codes of the rows, if the block contains them. */
async function unpackRows(packed, charts) {
  const bytes = await inflated(packed.data), {rows} = packed, axis = new Float64Array(rows);
  counted(bytes, 0, rows, 4, (n, difference, count) => {
    axis[n] = packed.start + packed.tick * (count + difference);
    return count + difference;  // times only increase, so no modulo is needed
  });
  let conduction = null;
  packed.columns.forEach(({low, step, chart, curve: place}, column) => {
    const curve = charts[chart]?.curves[place], raw = new Array(rows), whole = !curve || curve.held;
    counted(bytes, (4 + 2 * column) * rows, rows, 2, (n, difference, count, modulus) => {
      const now = (count + difference) % modulus;
      raw[n] = now === 65535 ? null : whole ? Math.round(low + step * now) : low + step * now;
      return now;
    });
    if (curve) curve.full = {axis, raw, held: curve.held};
    else conduction = {time: axis, code: raw};
  });
  return conduction;
}

/** The curves of a chart as drawn over [from, to]: all rows if few enough are in view, else null. A curve without `full`
 *  already contains all its rows. */
function curvesInView(curves, from, to) {
  if (!curves.some((c) => c.full)) return null;
  const parts = new Map();  // curves on a common axis keep a common axis
  for (const {axis} of curves.map((c) => c.full ?? c)) {
    if (parts.has(axis)) continue;
    const first = Math.max(0, rowAt(axis, from) - 1), last = Math.min(axis.length, rowAt(axis, to) + 2);
    if (last - first > ROWS_IN_VIEW) return null;
    parts.set(axis, {first, last, axis: axis.subarray(first, last)});
  }
  return curves.map((c) => {
    const {raw, axis} = c.full ?? c, part = parts.get(axis);
    return {axis: part.axis, raw: raw.slice(part.first, part.last), held: c.held};
  });
}
