// SPDX-License-Identifier: Apache-2.0
// The instruments around the charts: the read-out, the units, the bridge, the rows, the spectra, and the comparison of runs.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {allEqual, close, drag, eventually, opened, scales} from './page.mjs';

test('the table reads every curve at the cursor and at two marks, with the difference and its frequency', async () => {
  const page = await opened('short.html', {hash: '#t=0.004,0.006'});
  await eventually(async () => assert.match(await page.locator('#between').textContent(), /^Point at a chart/));
  assert.ok(await page.locator('#readout').isHidden(), 'without an instant there is nothing to read');
  await page.evaluate(() => sixstep.pointAt(0.0045));
  await eventually(async () => assert.ok(await page.locator('#readout').isVisible()));
  await page.locator('#plots').press('a');
  await page.evaluate(() => sixstep.pointAt(0.005));
  await page.click('#mark-B');
  await eventually(async () => assert.match(await page.locator('#between').textContent(), /Δt = 0\.5\d* ms, 1\/Δt = 2\.000\skHz/u));
  const rows = await page.locator('#readout tbody tr').evaluateAll((all) => all.map((r) => [...r.cells].map((c) => c.textContent)));
  assert.ok(rows.length >= 15, String(rows.length));
  const number = (text) => Number(text.replace('−', '-'));
  for (const [name, cursor, a, b, difference] of rows) {
    if (!difference) continue;
    assert.equal(cursor, b, name);
    // Each value is rounded to at least four digits. The tolerance is three errors of half a unit of the last digit.
    const unit = 10 ** -Math.min(...[a, b, difference].map((v) => v.split('.')[1]?.length ?? 0));
    assert.ok(Math.abs(number(b) - number(a) - number(difference)) <= 1.5 * unit || name.startsWith('rotor'), [name, a, b, difference].join(' '));
  }
  assert.match(page.url(), /A=0\.0045.*B=0\.005/);
  const again = await opened('short.html', {hash: new URL(page.url()).hash});
  assert.equal(await again.evaluate(() => sixstep.instants.A), 0.0045);
  await page.locator('#plots').press('Escape');
  assert.equal(await page.evaluate(() => sixstep.instants.A ?? sixstep.instants.cursor), null);
  await close(again);
  await close(page);
});

test('a curve is read on its line between two rows', async () => {
  const page = await opened('short.html');
  const worst = await page.evaluate(() => {
    const u = sixstep.charts[0], [t, i] = u.data;
    let error = 0;
    for (let n = 1; n < 200; ++n) {
      if (!(t[n - 1] < t[n])) continue;
      const read = sixstep.valueAt({axis: t, raw: i}, (t[n - 1] + t[n]) / 2);
      error = Math.max(error, Math.abs(read - (i[n - 1] + i[n]) / 2));
    }
    return error;
  });
  assert.ok(worst <= 8 * Number.EPSILON * 6, String(worst));  // some rounding errors of about 6 A
  await close(page);
});

test('units are chosen once for charts, table and address', async () => {
  const page = await opened('short.html');
  const speed = () => page.evaluate(() => sixstep.charts.find((u) => u.series[1].label === 'ω').data[1].at(-1));
  const before = await speed();
  await page.selectOption('#unit-speed', 'rpm');
  assert.ok(Math.abs((await speed()) / before - 30 / Math.PI) < 1e-6);
  assert.equal(await page.locator('#chart-speed .unit').textContent(), 'rpm');
  await page.selectOption('#unit-torque', 'Nm');
  assert.match(page.url(), /speed=rpm&torque=Nm/);
  const again = await opened('short.html', {hash: '#speed=rpm'});
  assert.equal(await again.locator('#chart-speed .unit').textContent(), 'rpm');
  await close(again);
  await close(page);
});

test('the bridge lights what conducts at the cursor, and the keys step through the rows', async () => {
  const page = await opened('short.html', {hash: '#t=0.004,0.0042'});
  await page.locator('#plots').focus();
  const seen = new Set();
  let last = await page.evaluate(() => { sixstep.pointAt(0.004); return sixstep.instants.cursor; });
  for (let n = 0; n < 12; ++n) {
    await page.keyboard.press(']');
    const at = await page.evaluate(() => sixstep.instants.cursor);
    assert.ok(at > last, `${at} after ${last}`);
    last = at;
    const state = await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done({
      lit: [...document.querySelectorAll('#bridge .switch.lit text')].map((t) => t.textContent),
      diodes: document.querySelectorAll('#bridge .diode.lit').length,
      gates: ['T1', 'T2', 'T3', 'T4', 'T5', 'T6'].filter((name) => [...document.querySelectorAll('#chart-logic .chip')]
        .some((chip) => chip.textContent.startsWith(name) && chip.querySelector('.value').textContent === '1')),
      words: document.getElementById('conducts').textContent})))));
    assert.deepEqual(state.lit, state.gates);
    assert.ok(state.lit.length + state.diodes <= 3);
    seen.add(state.lit.join());
    assert.match(state.words, /^a .*, b .*, c /);
  }
  assert.ok(seen.size >= 2, [...seen].join(' | '));  // the bridge changes its state by chopping
  await close(page);
});

test('before anybody points at a chart the bridge shows the middle of what the charts show, and says so', async () => {
  const page = await opened('short.html', {hash: '#t=0.004,0.0042'});
  const bridge = () => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done({
    lit: [...document.querySelectorAll('#bridge .switch.lit text')].map((t) => t.textContent),
    words: document.getElementById('conducts').textContent})))));
  const {lit, words} = await bridge();
  assert.match(words, /^In the middle of the charts, at 4\.1\d* ms; point at them for another instant: a .*, b .*, c /);
  assert.ok(lit.length >= 1 && lit.length <= 3, lit.join());
  await page.evaluate(() => sixstep.pointAt(0.0041));
  const there = await bridge();
  assert.deepEqual(there.lit, lit);
  assert.equal(there.words, words.replace(/^In the middle .*? instant: /, ''));
  await close(page);
});

test('i_m lies beneath the phases, of which it always is one', async () => {
  const page = await opened('short.html');
  const drawn = await page.evaluate(() => {
    const {chart, plot} = sixstep.entries.find((e) => e.chart.id === 'currents');
    return {labels: chart.curves.map((c) => c.label), widths: plot.series.slice(1).map((s) => s.width)};
  });
  assert.deepEqual(drawn.labels, ['i_m', 'i_a', 'i_b', 'i_c', 'i_ref']);
  assert.ok(drawn.widths[0] > 2 * Math.max(...drawn.widths.slice(1, 4)), String(drawn.widths));
  await close(page);
});

test('close looks into a long run draw every row, as exact as the envelope', async () => {
  const page = await opened('long.html');
  await page.waitForFunction(() => sixstep.complete_ms > 0);
  assert.ok((await page.evaluate(() => sixstep.drawnRows())).every((n) => n === 0));
  const worst = await page.evaluate(() => {
    const place = sixstep.entries.findIndex((e) => e.chart.id === 'currents'), {curves} = sixstep.entries[place];
    const phase = sixstep.entries[place].chart.curves.findIndex((curve) => curve.label === 'i_a');
    const {low, step} = sixstep.packed[0].columns.find((c) => c.chart === place && c.curve === phase);
    const {axis, raw, full} = curves[phase];
    let error = 0, compared = 0, zeros = 0;
    for (let n = 1; n + 1 < axis.length; ++n) {
      if (axis[n - 1] === axis[n] || axis[n] === axis[n + 1] || raw[n] == null) continue;  // a jump: two rows at one time
      error = Math.max(error, Math.abs(sixstep.valueAt(full, axis[n]) - raw[n]) / step);
      zeros += full.raw.includes(0);
      if (++compared > 500) break;
    }
    return {error, compared, zeros, high: Math.max(...raw) - Math.max(...full.raw), low, step};
  });
  assert.ok(worst.compared > 100);
  // The tolerance is half a step. A small part of a step is added, because the envelope has 32 bits and the times are whole picoseconds.
  assert.ok(worst.error <= 0.55, JSON.stringify(worst));
  assert.ok(Math.abs(worst.high) <= 0.55 * worst.step, JSON.stringify(worst));
  assert.ok(worst.zeros > 0, 'a current that has gone out is zero');
  await page.evaluate(() => sixstep.show(0.3, 0.301));
  const rows = await page.evaluate(() => sixstep.drawnRows());
  assert.ok(rows.every((n) => n > 33 && n === rows[0]), String(rows));  // at least one row per PWM period
  // The rows contain the conducting devices. In the middle between two rows, exactly the conducting devices are highlighted.
  const lit = await page.evaluate(async () => {
    const {axis} = sixstep.entries.find((e) => e.chart.logic).curves[0].full, seen = [];
    for (let n = axis.findIndex((t) => t >= 0.3); seen.length < 20; ++n) {
      if (axis[n + 1] - axis[n] < 1e-9) continue;
      sixstep.pointAt((axis[n] + axis[n + 1]) / 2);
      await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      seen.push({lit: [...document.querySelectorAll('#bridge .switch.lit text')].map((t) => t.textContent),
        gates: ['T1', 'T2', 'T3', 'T4', 'T5', 'T6'].filter((name) => [...document.querySelectorAll('#chart-logic .chip')]
          .some((chip) => chip.textContent.startsWith(name) && chip.querySelector('.value').textContent === '1'))});
    }
    return seen;
  });
  for (const {lit: on, gates} of lit) assert.deepEqual(on, gates);
  assert.ok(new Set(lit.map(({lit: on}) => on.join())).size >= 2, JSON.stringify(lit));
  await close(page);
});

test('compared runs lie over each other, each on its own rows, with their difference below', async () => {
  const page = await opened('compare.html');
  const ids = await page.locator('#charts .chart').evaluateAll((all) => all.map((c) => c.id));
  assert.deepEqual(ids.slice(0, 2), ['chart-speed', 'chart-speed-difference']);
  await page.evaluate(() => sixstep.pointAt(0.0101));
  const read = async (id) => (await page.locator(`#${id} .value`).allTextContents()).map((v) => Number(v.split(' ')[0].replace('−', '-')));
  await eventually(async () => {
    const [one, two] = await read('chart-speed'), [less] = await read('chart-speed-difference');
    assert.ok(two < one, `${two} ${one}`);
    // A row of the synthetic grid is valid for 30 us. In this time the torque 5 A · 33.5 mNm/A at 135 gcm2 changes each speed by 0.37 rad/s.
    assert.ok(Math.abs(two - one - less) < 0.4, `${two} - ${one} against ${less}`);
  });
  assert.equal(await page.locator('#bridge').isVisible(), false);
  assert.ok(await page.locator('#readout .group').count() >= 6);
  await drag(page, 'speed', 0.25, 0.5);
  await eventually(async () => {
    const shown = await scales(page);
    assert.ok(allEqual(shown) && shown[0][1] - shown[0][0] < 0.006);
  });
  await close(page);
});

test('spectra stand over their own axis, with units as chosen', async () => {
  const page = await opened('short.html');
  const ids = await page.locator('#spectra .chart').evaluateAll((all) => all.map((c) => c.id));
  assert.deepEqual(ids, ['chart-current-spectrum', 'chart-torque-spectrum']);
  const [from, to] = await page.evaluate(() => [sixstep.spectra[0].scales.x.min, sixstep.spectra[0].scales.x.max]);
  assert.ok(from > 0 && to > 1 / 30e-6, `${from} ${to}`);
  const highest = () => page.evaluate(() => Math.max(...sixstep.spectra[1].data[1]));
  const before = await highest();
  await page.selectOption('#unit-torque', 'Nm');
  assert.ok(Math.abs((await highest()) / before - 1e-3) < 1e-9);
  await close(page);
});
