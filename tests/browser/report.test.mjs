// SPDX-License-Identifier: Apache-2.0
// The report, opened as by a reader: from a file, in Chromium, without a network.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {inflateSync} from 'node:zlib';
import {allEqual, close, drag, eventually, opened, plotArea, scales} from './page.mjs';

test('opens quickly, with verdict and all charts', async () => {
  const page = await opened('short.html');
  // A busy machine may delay a single opening. Thus the shortest of several times is tested, and the limit has a margin.
  let best = Infinity;
  for (let n = 0; n < 4; ++n) {
    await page.reload();
    best = Math.min(best, await page.evaluate(() => sixstep.ready_ms));
  }
  assert.ok(best < 1000, `${best} ms`);
  assert.equal(await page.locator('.verdict .word').textContent(), 'PASS');
  const ids = await page.locator('#charts .chart').evaluateAll((all) => all.map((c) => c.id));
  assert.deepEqual(ids, ['currents', 'logic', 'line-voltages', 'back-emf', 'speed', 'torque', 'duty'].map((n) => 'chart-' + n));
  assert.ok(await page.evaluate(() => [...document.querySelectorAll('#charts canvas')].every((c) => c.width > 500 && c.height > 50)));
  assert.equal(await page.locator('script:text("alert")').count(), 0);
  await close(page);
});

test('the first screen answers, and is one screen', async () => {
  const page = await opened('short.html');
  for (const question of ['What limits the drive', 'Gains', 'Current in its step', 'Costs']) {
    const box = await page.locator('.glance h2', {hasText: question}).boundingBox();
    assert.ok(box.y + box.height < 900, question);
  }
  assert.ok((await page.locator('.glance').boundingBox()).y < 300);
  await close(page);
});

test('dragging zooms every chart, double-click shows the whole run again', async () => {
  const page = await opened('short.html');
  await drag(page, 'currents', 0.25, 0.5);
  const zoomed = await eventually(async () => {
    const shown = await scales(page);
    assert.ok(allEqual(shown), JSON.stringify(shown));
    assert.ok(Math.abs(shown[0][0] - 0.005) < 2e-4 && Math.abs(shown[0][1] - 0.01) < 2e-4, JSON.stringify(shown[0]));
    return shown;
  });
  assert.match(page.url(), /#t=/);
  const box = await plotArea(page, 'duty');
  await page.mouse.dblclick(box.x + 200, box.y + 30);
  await eventually(async () => assert.deepEqual(await scales(page), zoomed.map(() => [0, 0.02])));
  await close(page);
});

test('the cursor is read out in every chart', async () => {
  const page = await opened('short.html');
  const box = await plotArea(page, 'currents');
  await page.mouse.move(box.x + box.width / 8, box.y + 40);
  const reads = (place, pattern) =>
    eventually(async () => assert.match(await page.locator(place).first().textContent(), pattern, place));
  await reads('#cursor', /t = 2\.(4[6-9]|5[0-3])\d* ms/);  // a pixel is about 0.03 ms
  for (const id of ['currents', 'line-voltages', 'speed', 'torque']) await reads(`#chart-${id} .value`, /^−?\d/);
  await reads('#chart-speed .value', /rpm/);
  await reads('#chart-logic .value', /^[01]$/);
  await close(page);
});

test('every chart says in words what it shows, and colours can be told from their ground', async () => {
  const page = await opened('short.html');
  const told = await page.locator('#charts .uplot').evaluateAll((all) => all.map((n) => n.getAttribute('aria-label')));
  assert.match(told[0], /^Currents over time\. i m from −\d.* A to \d.* A, at the end .*; i a from −\d.* A to \d.* A, at the end/);
  assert.match(told[1], /9 logic levels: T1/);
  for (const theme of ['light', 'dark']) {
    await page.emulateMedia({colorScheme: theme});
    const ratios = await page.evaluate(() => {
      const probe = document.body.appendChild(document.createElement('i'));
      const rgb = (name) => {  // the canvas accepts every notation of a colour
        probe.style.color = `var(--${name})`;
        const ctx = document.createElement('canvas').getContext('2d');
        ctx.fillStyle = getComputedStyle(probe).color;
        ctx.fillRect(0, 0, 1, 1);
        return [...ctx.getImageData(0, 0, 1, 1).data].slice(0, 3);
      };
      // WCAG 2: relative luminance, (L1 + 0.05)/(L2 + 0.05)
      const luminance = (name) => rgb(name).map((v) => v / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4))
        .reduce((sum, v, n) => sum + v * [0.2126, 0.7152, 0.0722][n], 0);
      const ratio = (a, b) => (Math.max(luminance(a), luminance(b)) + 0.05) / (Math.min(luminance(a), luminance(b)) + 0.05);
      const text = [['ink', 'paper'], ['ink', 'page'], ['quiet', 'paper'], ['quiet', 'page'], ['accent', 'paper'], ['pass', 'pass-soft'], ['fail', 'fail-soft']];
      const lines = ['a', 'b', 'c', 'main', 'reference'].map((name) => [name, 'paper']);
      return {text: text.map((pair) => [pair.join(' on '), ratio(...pair)]), lines: lines.map((pair) => [pair.join(' on '), ratio(...pair)])};
    });
    for (const [pair, ratio] of ratios.text) assert.ok(ratio >= 4.5, `${theme}: ${pair} ${ratio}`);
    for (const [pair, ratio] of ratios.lines) assert.ok(ratio >= 3, `${theme}: ${pair} ${ratio}`);
  }
  await close(page);
});

test('close-ups, keys and address choose what is shown', async () => {
  const page = await opened('short.html');
  await page.click('#view-periods');
  let shown = await scales(page);
  assert.ok(allEqual(shown));
  assert.ok(Math.abs(shown[0][1] - shown[0][0] - 90e-6) < 1e-9);
  assert.equal(await page.getAttribute('#view-periods', 'aria-pressed'), 'true');
  await page.click('#view-commutation');
  shown = await scales(page);
  assert.ok(shown[0][1] - shown[0][0] < 2e-3);
  await page.keyboard.press('0');
  assert.deepEqual((await scales(page))[0], [0, 0.02]);
  await page.keyboard.press('+');
  assert.deepEqual((await scales(page))[0], [0.005, 0.015]);
  await close(page);
  const linked = await opened('short.html', {hash: '#t=0.004,0.006'});
  assert.deepEqual((await scales(linked))[0], [0.004, 0.006]);
  await close(linked);
});

test('labels switch curves off and on', async () => {
  const page = await opened('short.html');
  const label = page.locator('#chart-currents button').first();
  const visible = () => page.evaluate(() => sixstep.charts[0].series[1].show);
  assert.equal(await visible(), true);
  await label.click();
  assert.equal(await visible(), false);
  assert.equal(await label.getAttribute('aria-pressed'), 'false');
  await label.click();
  assert.equal(await visible(), true);
  await close(page);
});

/** The number of pages of a PDF, and the fill colours of its areas and letters. */
function inside(pdf) {
  const text = pdf.toString('latin1');
  const fills = new Map();
  for (const stream of text.matchAll(/stream\r?\n([^]*?)endstream/g)) {
    let drawn = '';
    try {
      drawn = inflateSync(Buffer.from(stream[1], 'latin1')).toString('latin1');
    } catch { /* this stream is not compressed */ }
    for (const [, r, g, b] of drawn.matchAll(/([\d.]+) ([\d.]+) ([\d.]+) rg/g)) {
      const colour = `rgb(${[r, g, b].map((x) => Math.round(255 * x)).join(', ')})`;
      fills.set(colour, (fills.get(colour) ?? 0) + 1);
    }
  }
  return {pages: text.match(/\/Type\s*\/Page\b/g)?.length ?? 0, fills};
}

test('follows the theme, and is printed with dark ink on white paper', async () => {
  const page = await opened('short.html', {theme: 'dark'});
  const brightness = () => page.evaluate(() =>
    getComputedStyle(document.documentElement).backgroundColor.match(/\d+/g).slice(0, 3).reduce((a, b) => a + +b, 0));
  await page.evaluate(() => { window.main = sixstep.entries.find((e) => e.chart.id === 'speed').plot.series[1]; });
  const stroke = () => page.evaluate(() => main.stroke());
  assert.ok(await brightness() < 150);
  const inDark = await stroke();
  await page.emulateMedia({colorScheme: 'light'});
  assert.ok(await brightness() > 600);
  await eventually(async () => assert.notEqual(await stroke(), inDark));
  await page.emulateMedia({colorScheme: 'dark'});
  await eventually(async () => assert.equal(await stroke(), inDark));
  await page.evaluate(() => {
    window.heard = [];
    for (const event of ['beforeprint', 'afterprint'])
      addEventListener(event, () => heard.push([event, main.stroke(), sixstep.charts[0].width]));
  });
  const colours = await page.evaluate(() =>
    [getComputedStyle(document.documentElement).backgroundColor, getComputedStyle(document.body).color]);
  const printed = inside(await page.pdf());
  const [before, after] = await page.evaluate(() => heard);
  assert.deepEqual([before[0], before[2]], ['beforeprint', 680], 'charts are as wide as paper');
  assert.deepEqual(after.slice(0, 2), ['afterprint', inDark]);
  assert.ok(printed.pages >= 3 && printed.pages <= 15, `${printed.pages} pages`);
  assert.ok(printed.fills.get(before[1]) > 50, 'dark ink: ' + [...printed.fills.keys()].join(' '));
  assert.ok(printed.fills.get('rgb(255, 255, 255)') > 0);
  for (const dark of colours) assert.equal(printed.fills.get(dark), undefined, `${dark} is the screen's`);
  await close(page);
});

test('a long run opens as an envelope and says so', async () => {
  const page = await opened('long.html');
  assert.equal(await page.locator('.verdict .word').textContent(), 'FAIL');
  assert.match(await page.locator('#envelope').textContent(), /envelope/);
  assert.equal(await page.locator('#charts .chart').first().getAttribute('id'), 'chart-speed');
  await close(page);
});

test('fits a narrow window without scrolling sideways', async () => {
  const page = await opened('short.html');
  await page.setViewportSize({width: 420, height: 800});
  await page.waitForFunction(() => sixstep.charts.every((u) => u.width < 420));
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await close(page);
});

test('on a phone no figure is cut off at the side', async () => {
  for (const name of ['compare.html', 'index.html']) {
    const page = await opened(name);
    await page.setViewportSize({width: 390, height: 800});
    const cut = await page.evaluate(() => [...document.querySelectorAll('table.compared, table.comparisons, table.verdicts, table.overview')]
      .filter((t) => t.scrollWidth > t.clientWidth || [...t.rows].some((r) => r.offsetWidth && r.offsetWidth < 0.95 * t.clientWidth)).map((t) => t.className));
    assert.deepEqual(cut, [], name);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), name);
    await close(page);
  }
});

test('where the energy went is drawn so that it can be read, in light and dark, and heard', async () => {
  const inks = [];
  for (const theme of ['light', 'dark']) {
    const page = await opened('short.html', {theme});
    const drawing = page.locator('.sankey svg[role=img]');
    assert.match(await drawing.getAttribute('aria-label'), /Sources: Supplied by the bus [\d.]+ J\. Sinks: .*Copper/);
    const {texts, overlaps, ink, paper} = await drawing.evaluate((svg) => {
      const boxes = [...svg.querySelectorAll('text')].map((t) => t.getBoundingClientRect());
      const whole = svg.getBoundingClientRect();
      const outside = boxes.filter((b) => b.left < whole.left || b.right > whole.right || b.top < whole.top || b.bottom > whole.bottom);
      const met = boxes.flatMap((a, n) => boxes.slice(n + 1).filter((b) => a.left < b.right && b.left < a.right && a.top + 2 < b.bottom && b.top + 2 < a.bottom));
      const style = (e, name) => getComputedStyle(e)[name];
      return {texts: boxes.length, overlaps: outside.length + met.length, ink: style(svg.querySelector('text'), 'fill'),
        paper: style(svg.parentElement, 'backgroundColor')};
    });
    assert.ok(texts >= 8, `${texts}`);
    assert.equal(overlaps, 0);
    assert.notEqual(ink, paper);
    inks.push(ink);
    await close(page);
  }
  assert.notEqual(inks[0], inks[1]);
});

test('the index links to every report', async () => {
  const page = await opened('index.html');
  assert.equal(await page.locator('.verdict .line').textContent(), '1 of 2 experiments pass');
  await page.click('h2 >> text=A longer run');
  await page.waitForURL(/long\.html/);
  await close(page);
});

test('a torque-speed curve opens with its charts, the nominal point and one zoom', async () => {
  const page = await opened('curve.html');
  const ids = await page.locator('#charts .chart').evaluateAll((all) => all.map((c) => c.id));
  assert.deepEqual(ids, ['torque', 'current', 'efficiency', 'power', 'ripple'].map((n) => 'chart-' + n));
  assert.equal(await page.locator('#chart-torque .chip').count(), 8);
  const nominal = await page.evaluate(() => {
    const u = sixstep.charts[0], values = u.data[u.data.length - 1];
    return Array.from(u.data[0]).flatMap((rpm, n) => (values[n] == null ? [] : [[Math.round(rpm), Math.round(10 * values[n])]]));
  });
  assert.deepEqual(nominal, [[5240, 834]]);
  // The page first shows the usable corner, the stall point after a click, and the corner after another click.
  const highest = () => page.evaluate(() => sixstep.charts.map((u) => u.scales.y.max));
  const corner = await highest();
  assert.ok(corner[0] > 200 && corner[0] < 300, `${corner[0]} mNm`);
  assert.ok(corner[1] < 12, `${corner[1]} A`);
  await page.click('#stall');
  await eventually(async () => assert.ok((await highest())[0] > 780 && (await highest())[1] > 23));
  assert.equal(await page.locator('#usable').getAttribute('aria-pressed'), 'false');
  await page.click('#usable');
  await eventually(async () => assert.deepEqual(await highest(), corner));
  const before = await scales(page);
  assert.ok(allEqual(before));
  await drag(page, 'current', 0.5, 0.75);
  await eventually(async () => {
    const after = await scales(page);
    assert.ok(allEqual(after));
    assert.ok(after[0][1] - after[0][0] < 0.3 * (before[0][1] - before[0][0]));
  });
  await close(page);
});
