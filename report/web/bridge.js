// SPDX-License-Identifier: Apache-2.0
// Draws the bridge: conducting devices have their phase's colour, an arrow shows the direction of the current.

const LEG_STATES = ['floating', 'upper switch', 'lower switch', 'upper diode', 'lower diode'];

function svgNode(name, attributes, parent) {
  const node = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  return parent.appendChild(node);
}

/** Draws one switch with its antiparallel diode; `up` is 1 for the upper switch. */
function halfLeg(parent, x, top, name) {
  const middle = top + 30;
  const wire = (d, css) => svgNode('path', {d, class: css}, parent);
  const group = (css) => svgNode('g', {class: css}, parent);
  const device = group('switch'), diode = group('diode');
  svgNode('path', {d: `M${x} ${top}V${middle - 10}M${x} ${middle + 10}V${top + 60}M${x - 9} ${middle - 10}H${x + 3}M${x - 9} ${middle + 10}H${x + 3}`}, device);
  svgNode('rect', {x: x - 6, y: middle - 10, width: 7, height: 20, rx: 1}, device);
  svgNode('text', {x: x - 13, y: middle + 4, 'text-anchor': 'end'}, device).textContent = name;
  svgNode('path', {d: `M${x} ${top + 8}H${x + 19}V${middle - 6}M${x + 19} ${middle + 6}V${top + 52}H${x}`}, diode);
  svgNode('path', {d: `M${x + 13} ${middle - 6}H${x + 25}M${x + 13} ${middle + 6}H${x + 25}L${x + 19} ${middle - 6}Z`, class: 'body'}, diode);
  return {device, diode, wire};
}

/** Draws the bridge into the SVG, each leg with its connected phase. Returns the function that shows the bridge at an instant.
 * `middle` is the instant in the middle of the charts, used while the pointer is at no other instant. */
function bridgeDrawing(svg, say, phaseAt = [0, 1, 2]) {
  const names = phaseAt.map((n) => 'abc'[n]);
  const legs = names.map((phase, k) => {
    const x = 46 + 96 * k, group = svgNode('g', {style: `--leg: var(--${phase})`}, svg);
    const upper = halfLeg(group, x, 14, `T${2 * k + 1}`), lower = halfLeg(group, x, 94, `T${2 * k + 2}`);
    svgNode('path', {d: `M${x} 74V94M${x} 84H${x + 26}`, class: 'terminal'}, group);
    const arrow = svgNode('path', {d: '', class: 'arrow'}, group);
    svgNode('text', {x: x + 31, y: 80, class: 'phase'}, group).textContent = phase;
    const value = svgNode('text', {x: x + 31, y: 95, class: 'value'}, group);
    return {x, group, upper, lower, arrow, value};
  });
  svgNode('path', {d: 'M14 14H306M14 154H306', class: 'rail'}, svg);
  svgNode('text', {x: 4, y: 18}, svg).textContent = '+';
  svgNode('text', {x: 4, y: 158}, svg).textContent = '−';
  return (states, currents, unit, middle) => {
    legs.forEach((leg, k) => {
      const state = states?.[k] ?? 0, i = currents?.[phaseAt[k]] ?? 0;
      leg.upper.device.classList.toggle('lit', state === 1);
      leg.lower.device.classList.toggle('lit', state === 2);
      leg.upper.diode.classList.toggle('lit', state === 3);
      leg.lower.diode.classList.toggle('lit', state === 4);
      leg.group.classList.toggle('floating', states != null && state === 0);
      const tip = i > 0 ? leg.x + 26 : leg.x + 12, back = i > 0 ? -7 : 7;
      leg.arrow.setAttribute('d', states && state && i ? `M${tip} 84l${back} -4.5v9z` : '');
      leg.value.textContent = !states ? '' : state ? figure(i) : 'floating';
    });
    const when = middle == null ? '' : `In the middle of the charts, at ${time.text(middle, (view[1] - view[0]) / 1000)} ${time.unit}; point at them for another instant: `;
    say.textContent = !states ? 'Point at a chart: what conducts then is lit.'
      : when + names.map((phase, k) => `${phase} ${states[k] ? `${figure(currents[phaseAt[k]])} ${unit} through its ${LEG_STATES[states[k]]}` : 'floating'}`).join(', ');
  };
}

/** The states of the legs at an instant. The code has one base-five digit per leg and is constant from row to row. */
function conductionAt(conduction, end, t) {
  const n = conduction ? rowAt(conduction.time, t) : -1;
  if (n < 0 || !(t <= end)) return null;
  const code = conduction.code[n];
  return [code % 5, Math.floor(code / 5) % 5, Math.floor(code / 25)];
}
