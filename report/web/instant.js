// SPDX-License-Identifier: Apache-2.0
// Shows the values of all curves at the cursor and at two marks, and the differences between the marks.

/** Draws the marks in a chart: a line with the mark's letter at the top. */
function drawMarks(u, marks) {
  const {ctx, bbox} = u, ratio = devicePixelRatio;
  ctx.save();
  ctx.font = `600 ${12 * ratio}px system-ui, sans-serif`;
  ctx.textAlign = 'center';
  for (const name of ['A', 'B']) {
    if (marks[name] == null) continue;
    const x = Math.round(u.valToPos(marks[name], 'x', true));
    if (x < bbox.left || x > bbox.left + bbox.width) continue;
    ctx.strokeStyle = palette.accent;
    ctx.lineWidth = 1.5 * ratio;
    ctx.setLineDash(name === 'A' ? [] : [5 * ratio, 3 * ratio]);
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.fillStyle = palette.accent;
    ctx.fillRect(x - 8 * ratio, bbox.top, 16 * ratio, 15 * ratio);
    ctx.fillStyle = palette.paper;
    ctx.fillText(name, x, bbox.top + 12 * ratio);
  }
  ctx.restore();
}

/** The frequency with the period dt: "1.25 kHz". */
function frequencyText(dt) {
  const f = 1 / Math.abs(dt);
  if (!Number.isFinite(f)) return '–';
  const [factor, unit] = f >= 1e6 ? [1e-6, 'MHz'] : f >= 1e3 ? [1e-3, 'kHz'] : [1, 'Hz'];
  return `${figure(f * factor)}\u00a0${unit}`;
}

/** A table of all curves: at the cursor, at A, at B, and B − A. Builds the rows once and returns the function that fills them. With
 *  `named`, each chart's name is above its curves, because the curves have the same names in all charts. */
function readout(table, entries, named) {
  const cell = (row, tag, text = '') => Object.assign(row.appendChild(document.createElement(tag)), {textContent: text});
  const body = table.tBodies[0];
  const title = (entry) => {
    const name = cell(body.insertRow(), 'th', entry.chart.title);
    name.colSpan = 5;
    name.className = 'group';
  };
  const rows = entries.flatMap((entry) => entry.curves.map((curve, i) => {
    if (named && i === 0) title(entry);
    const row = body.insertRow(), name = cell(row, 'th');
    name.scope = 'row';
    name.append(labelNode(entry.chart.curves[i].label));
    name.title = entry.chart.curves[i].meaning ?? '';
    const unit = name.appendChild(document.createElement('small'));
    return {entry, curve, unit, cells: [0, 1, 2, 3].map(() => cell(row, 'td'))};
  }));
  const text = (entry, v) => {
    if (v == null) return '';
    const {factor = 1, logic, turn} = entry.chart;
    return logic ? String(v) : figure(turn ? v * factor - turn * Math.floor((v * factor) / turn) : v * factor);
  };
  return (instants) => {
    table.hidden = instants.every((t) => t == null);  // neither cursor nor mark: nothing to show
    for (const {entry, curve, unit, cells} of rows) {
      const values = instants.map((t) => (t == null ? null : valueAt(curve.full ?? curve, t)));
      values.forEach((v, n) => { cells[n].textContent = text(entry, v); });
      const [, a, b] = values;
      cells[3].textContent = a == null || b == null || entry.chart.logic ? '' : figure((b - a) * (entry.chart.factor ?? 1));
      unit.textContent = entry.chart.unit ? ' ' + entry.chart.unit : '';
    }
  };
}
