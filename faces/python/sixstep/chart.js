// SPDX-License-Identifier: Apache-2.0
// Charts of a run in a notebook: the pointer reads all of them at its instant, a drag zooms, a double click shows the whole run.
// Without scripts the drawn curves stay.
(root => {
  const data = JSON.parse(root.querySelector('script[type="application/json"]').textContent);
  const charts = [...root.querySelectorAll('svg')], t = data.time_ms;
  let shown = [0, t.length - 1], from = null;
  const x = n => (t[n] - t[shown[0]]) / (t[shown[1]] - t[shown[0]] || 1) * data.width;
  const nearest = (svg, event) => {
    const box = svg.getBoundingClientRect(), part = (event.clientX - box.left) / box.width;
    const wanted = t[shown[0]] + Math.min(1, Math.max(0, part)) * (t[shown[1]] - t[shown[0]]);
    let n = shown[0];
    while (n < shown[1] && t[n + 1] <= wanted) ++n;
    return n < shown[1] && t[n + 1] - wanted < wanted - t[n] ? n + 1 : n;
  };
  const draw = () => charts.forEach((svg, k) => {
    const values = data.columns[k].values.slice(shown[0], shown[1] + 1), known = values.filter(v => v !== null);
    const low = Math.min(...known), span = Math.max(...known) - low || 1;
    svg.querySelector('polyline').setAttribute('points', values.map((v, n) => v === null ? '' :
      x(shown[0] + n).toFixed(1) + ',' + (data.height - (v - low) / span * data.height).toFixed(1)).join(' '));
    svg.previousElementSibling.textContent = data.columns[k].label + ': ' + low.toPrecision(4) + ' .. ' + (low + span).toPrecision(4) +
      ', from ' + t[shown[0]].toPrecision(4) + ' to ' + t[shown[1]].toPrecision(4) + ' ms';
  });
  const read = n => charts.forEach((svg, k) => {
    const line = svg.querySelector('line'), v = data.columns[k].values[n];
    line.setAttribute('x1', x(n)); line.setAttribute('x2', x(n)); line.style.display = '';
    svg.nextElementSibling.textContent = t[n].toPrecision(6) + ' ms: ' + (v === null ? 'no value' : v.toPrecision(6)) + ' ' + data.columns[k].unit;
  });
  charts.forEach(svg => {
    svg.style.touchAction = 'pan-y';
    svg.addEventListener('pointermove', event => read(nearest(svg, event)));
    svg.addEventListener('pointerdown', event => { from = nearest(svg, event); });
    svg.addEventListener('pointerup', event => {
      const to = nearest(svg, event), ends = [Math.min(from ?? to, to), Math.max(from ?? to, to)];
      from = null;
      if (ends[1] - ends[0] > 3) { shown = ends; draw(); }
    });
    svg.addEventListener('dblclick', () => { shown = [0, t.length - 1]; draw(); });
  });
})(document.currentScript.parentElement);
