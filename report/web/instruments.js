// SPDX-License-Identifier: Apache-2.0
// Builds the parts beside a run's charts: the bridge, the currents' locus, the table of all curves, the units.

/** The rotor's angle, which increases with every turn and is shown within one turn. It has no chart, but its value is shown like a curve's. */
function rotorEntry(axisOf) {
  if (!data.angle) return null;
  const chart = {quantity: 'angle', curves: [{label: 'rotor'}], rotor: true};
  return {chart, curves: [{axis: axisOf(data.angle), raw: curveValues(data.angle.data)}]};
}

function wearRotorUnit(entry) {
  const unit = unitOf('angle', units.angle, data.pole_pairs);
  Object.assign(entry.chart, {unit: unit.unit, factor: unit.factor, turn: unit.turn});
}

/** The time between the marks, and the frequency with this period. */
function describeMarks() {
  const {A, B} = instants, dt = B - A, step = (view[1] - view[0]) / 1000;
  element('between').textContent = A == null || B == null ? `${instants.cursor == null ? 'Point at a chart to read all curves here. ' : ''}Marks A and B: keys a, b.`
    : `Δt = ${time.text(dt, Math.min(step, Math.abs(dt) / 1000 || step))} ${time.unit}, 1/Δt = ${frequencyText(dt)}`;
}

function makeInstruments(axisOf) {
  const currents = charts.find((c) => c.chart.id === 'currents');
  const places = ['i_a', 'i_b', 'i_c'].map((label) => currents?.chart.curves.findIndex((curve) => curve.label === label) ?? -1);
  const phases = places.includes(-1) ? null : places.map((place) => currents.curves[place]);
  const rotor = rotorEntry(axisOf);
  if (rotor) wearRotorUnit(rotor);
  const logic = charts.filter((c) => c.chart.logic), others = charts.filter((c) => !c.chart.logic);
  const fill = readout(element('readout'), [...others, ...(rotor ? [rotor] : []), ...logic], data.compared);
  const drawBridge = data.conduction && phases ? bridgeDrawing(element('bridge'), element('conducts'), data.legs) : null;
  // In a long run, the rows contain the conduction codes.
  let conduction = drawBridge && data.conduction.time ? {time: unpack(data.conduction.time, Float64Array), code: unpack(data.conduction.code, Uint8Array)} : null;
  const drawPlane = phases ? currentPlane(element('plane'), currents, phases) : null;
  element('bridge').closest('figure').hidden = !drawBridge;
  element('plane').closest('figure').hidden = !drawPlane;
  const used = new Set([...charts.map((c) => c.chart.quantity), rotor && 'angle']);
  unitSelects(element('units'), Object.keys(UNITS).filter((q) => used.has(q)), units, changeUnits);
  const instant = () => {
    const t = instants.cursor;
    fill([t, instants.A, instants.B]);
    if (drawBridge) {
      // While the pointer is over no chart, the middle of the shown time is used.
      const at = t ?? (view[0] + view[1]) / 2, factor = currents.chart.factor ?? 1;
      const now = phases.map((c) => (valueAt(c.full ?? c, at) ?? 0) * factor);
      drawBridge(conductionAt(conduction, data.conduction.end, at), now, currents.chart.unit, t == null ? at : null);
    }
    if (drawPlane) drawPlane(...view, t);
    describeMarks();
  };
  const conducts = (rows) => { conduction = rows; showInstant(); };
  return {instant, view: showInstant, conducts, units: () => { if (rotor) wearRotorUnit(rotor); }};
}
