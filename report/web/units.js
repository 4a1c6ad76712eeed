// SPDX-License-Identifier: Apache-2.0
// Converts quantities to an engineer's units: shown = data times factor, and times the pole pairs if electrical.

const UNITS = {
  speed: [{id: 'rad_s', unit: 'rad/s', factor: 1}, {id: 'rpm', unit: 'rpm', factor: 30 / Math.PI}],
  angle: [{id: 'deg', unit: '°', factor: 1, turn: 360}, {id: 'deg_el', unit: '° el', factor: 1, electrical: true, turn: 360},
    {id: 'rad', unit: 'rad', factor: Math.PI / 180, turn: 2 * Math.PI},
    {id: 'rad_el', unit: 'rad el', factor: Math.PI / 180, electrical: true, turn: 2 * Math.PI},
    {id: 'turns', unit: 'turns', factor: 1 / 360, turn: 1}],
  torque: [{id: 'mNm', unit: 'mNm', factor: 1e3}, {id: 'Nm', unit: 'Nm', factor: 1}],
  current: [{id: 'A', unit: 'A', factor: 1}, {id: 'mA', unit: 'mA', factor: 1e3}],
};
const QUANTITIES = {speed: 'Speed', angle: 'Angle', torque: 'Torque', current: 'Current'};

/** The unit in which each quantity is shown: the unit in the address, else the usual unit. */
function unitChoices(address, usual) {
  return Object.fromEntries(Object.entries(UNITS).map(([quantity, list]) => {
    const asked = list.find((u) => u.id === address.get(quantity));
    return [quantity, (asked ?? list.find((u) => u.id === usual[quantity]) ?? list[0]).id];
  }));
}

/** The unit of a quantity by its id: {unit, factor, turn}; null for quantities with one unit only. */
function unitOf(quantity, id, polePairs) {
  const found = UNITS[quantity]?.find((u) => u.id === id);
  return found ? {...found, factor: found.factor * (found.electrical ? polePairs : 1)} : null;
}

/** Sets a chart's unit, and a second unit for the right axis if two units are common. */
function wearUnit(chart, chosen, polePairs) {
  const main = unitOf(chart.quantity, chosen[chart.quantity], polePairs);
  if (!main) return;
  const second = {speed: main.id === 'rpm' ? 'rad_s' : 'rpm', angle: main.id === 'turns' ? 'deg' : 'turns'}[chart.quantity];
  const other = unitOf(chart.quantity, second, polePairs);
  Object.assign(chart, {unit: main.unit, factor: main.factor});
  chart.other = other ? {unit: other.unit, factor: other.factor / main.factor} : undefined;
}

/** Builds one select per quantity of the charts. A choice updates `chosen` and then calls `changed`. */
function unitSelects(parent, quantities, chosen, changed) {
  for (const quantity of quantities) {
    const label = parent.appendChild(document.createElement('label'));
    label.append(QUANTITIES[quantity] + ' ');
    const select = label.appendChild(document.createElement('select'));
    select.id = 'unit-' + quantity;
    for (const {id, unit} of UNITS[quantity]) select.append(new Option(unit, id, false, id === chosen[quantity]));
    select.addEventListener('change', () => {
      chosen[quantity] = select.value;
      changed();
    });
  }
}
