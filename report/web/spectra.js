// SPDX-License-Identifier: Apache-2.0
// Draws the spectra: charts over frequency, both axes logarithmic, with a zoom and a cursor of their own.

function buildSpectra(axisOf) {
  const frequency = {name: 'frequency', unit: 'Hz'};
  const built = [];
  for (const chart of data.spectra ?? []) {
    wearUnit(chart, units, data.pole_pairs);
    const axis = axisOf(chart.curves[0]);
    const whole = () => { built.forEach((b) => b.plot.setScale('x', {min: axis[0], max: axis[axis.length - 1]})); return null; };
    const pointed = (f) => {
      for (const b of built) {
        b.show(f);
        b.where.textContent = f == null ? '' : frequencyText(1 / f);
      }
    };
    const entry = buildChart(element('spectra'), chart, axisOf, frequency, {sync: 'frequency', zoomed() {}, pointed, whole});
    entry.where = entry.box.querySelector('figcaption').appendChild(document.createElement('output'));
    built.push(entry);
  }
  if (built.length) watchPage(built, () => {}, element('spectra'));
  return built;
}
