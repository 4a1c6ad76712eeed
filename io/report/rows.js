// SPDX-License-Identifier: Apache-2.0
// Every row of the run, for close looks: unpacked after the page stands, drawn where few enough are in view.

const ROWS_IN_VIEW = 12000;

async function inflated(text) {
  const stream = new Blob([unpack(text, Uint8Array)]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Differences, byte by byte of equal weight, summed up again: what each row counts, modulo 2^(8 planes). */
function counted(bytes, offset, rows, planes, row) {
  const modulus = 256 ** planes;
  let count = 0;
  for (let n = 0; n < rows; ++n) {
    let difference = 0;
    for (let p = planes - 1; p >= 0; --p) difference = difference * 256 + bytes[offset + p * rows + n];
    count = row(n, difference, count, modulus);
  }
}

/** Gives each curve of the charts all its rows as `full`. */
async function unpackRows(packed, charts) {
  const bytes = await inflated(packed.data), {rows} = packed, axis = new Float64Array(rows);
  counted(bytes, 0, rows, 4, (n, difference, count) => {
    axis[n] = packed.start + packed.tick * (count + difference);
    return count + difference;  // times only grow: not modulo
  });
  let offset = 4 * rows, column = 0;
  for (const {curves} of charts) {
    for (const curve of curves) {
      const {low, step} = packed.columns[column++], raw = new Array(rows);
      counted(bytes, offset, rows, 2, (n, difference, count, modulus) => {
        const now = (count + difference) % modulus;
        raw[n] = now === 65535 ? null : curve.held ? Math.round(low + step * now) : low + step * now;
        return now;
      });
      curve.full = {axis, raw, held: curve.held};
      offset += 2 * rows;
    }
  }
}

/** The curves of a chart as they are drawn over [from, to]: all rows where few enough are in view, else as embedded. */
function curvesInView(curves, from, to) {
  const full = curves[0].full;
  if (!full) return null;
  const first = Math.max(0, rowAt(full.axis, from) - 1), last = Math.min(full.axis.length, rowAt(full.axis, to) + 2);
  if (last - first > ROWS_IN_VIEW) return null;
  const axis = full.axis.subarray(first, last);
  return curves.map((c) => ({axis, raw: c.full.raw.slice(first, last), held: c.held}));
}
