// SPDX-License-Identifier: Apache-2.0
// The page of a plan. Every drawing shows the runs of its columns and ranges. The marked run is the best run.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {close, eventually, opened} from './page.mjs';

/** The part of a drawing's pixels that are not transparent. */
const inked = (page, id) => page.locator(`#${id} canvas`).evaluate((canvas) => {
  const copy = Object.assign(document.createElement('canvas'), {width: canvas.width, height: canvas.height});
  const ctx = copy.getContext('2d', {willReadFrequently: true});
  ctx.drawImage(canvas, 0, 0);
  const {data} = ctx.getImageData(0, 0, copy.width, copy.height);
  let lit = 0;
  for (let n = 3; n < data.length; n += 4) lit += data[n] > 0 ? 1 : 0;
  return lit / (data.length / 4);
});
const pictures = ['scatter', 'parallel', 'heat', 'front'];

test('every drawing is there, in light and dark, on paper and on a phone', async () => {
  for (const theme of ['light', 'dark']) {
    const page = await opened('plan.html', {theme});
    for (const id of pictures) assert.ok((await inked(page, id)) > 0.01, id);
    for (const label of await page.locator('canvas').evaluateAll((all) => all.map((c) => c.getAttribute('aria-label')))) assert.ok(label.length > 20, label);
    await page.setViewportSize({width: 390, height: 800});
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    await eventually(async () => assert.ok((await page.locator('#scatter canvas').evaluate((c) => c.width / devicePixelRatio)) <= 390));
    await page.emulateMedia({media: 'print'});
    for (const id of pictures) assert.ok((await inked(page, id)) > 0.01, id);
    await close(page);
  }
});

test('the front is what comparing every run with every other finds', async () => {
  const page = await opened('plan.html');
  const wrong = await page.evaluate(() => {
    const {paretoFront} = sixstep, wrong = [];
    let seed = 1;
    const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
    for (let round = 0; round < 200; ++round) {
      const size = Math.floor(random() * 60), coarse = 1 + Math.floor(random() * 12);  // if coarse is small, many values are equal
      const draw = () => Array.from({length: size}, () => (random() < 0.05 ? NaN : random() < 0.05 ? Infinity : Math.floor(random() * coarse)));
      const xs = draw(), ys = draw();
      for (const signs of [[1, 1], [1, -1], [-1, 1], [-1, -1]]) {
        const better = (a, b) => signs[0] * xs[a] >= signs[0] * xs[b] && signs[1] * ys[a] >= signs[1] * ys[b] && (xs[a] !== xs[b] || ys[a] !== ys[b]);
        const rows = xs.map((_, n) => n).filter((n) => !Number.isNaN(xs[n]) && !Number.isNaN(ys[n]));
        const truth = rows.filter((n) => !rows.some((m) => better(m, n)));
        const found = paretoFront(xs, ys, signs);
        if (JSON.stringify([...found].sort((a, b) => a - b)) !== JSON.stringify(truth)) wrong.push({xs, ys, signs, found, truth});
        if (found.some((n, at) => at > 0 && signs[0] * xs[n] > signs[0] * xs[found[at - 1]])) wrong.push('not in order');
      }
    }
    return wrong;
  });
  assert.deepEqual(wrong, []);
  const listed = await page.locator('#front-list tbody tr').count();
  assert.equal(await page.locator('#front-said').textContent(), `${listed} runs`);
  await page.selectOption('#front-x-best', '1');
  assert.notEqual(await page.locator('#front-list tbody tr').count(), listed);
  await close(page);
});

test('cells have every run once, and their means', async () => {
  const page = await opened('plan.html');
  const off = await page.evaluate(() => {
    const {table, heatCells} = sixstep, plan = table.plans[0], [settle, supply, word, figure] = table.columns;
    const whole = [...figure.of[0]].filter(Number.isFinite), off = [];
    for (const [x, y, count] of [[settle, supply, 63], [settle, word, 18], [figure, supply, null]]) {
      const cells = heatCells(plan, x, y, figure);
      const runs = cells.counts.reduce((a, b) => a + b, 0), sum = cells.sums.reduce((a, b) => a + b, 0);
      if (runs !== whole.length || Math.abs(sum / whole.reduce((a, b) => a + b, 0) - 1) > 1e-6) off.push([runs, sum]);
      if (count && cells.counts.length !== count) off.push(cells.counts.length);
    }
    return off;
  });
  assert.deepEqual(off, []);
  const before = await inked(page, 'heat');
  await page.selectOption('#heat-y', {label: 'pwm.chopping'});
  assert.ok(before > 0.3 && (await inked(page, 'heat')) > 0.3);
  await page.hover('#heat canvas', {position: {x: 200, y: 200}});
  await eventually(async () => assert.match(await page.locator('#heat-said').textContent(), /ms/));
  await close(page);
});

test('long words stand whole beside a drawing, on a phone too', async () => {
  for (const width of [1280, 390]) {
    const page = await opened('plan.html');
    await page.setViewportSize({width, height: 900});
    await page.evaluate(() => {
      sixstep.table.columns[2].words[1] = 'complementary';
      const write = CanvasRenderingContext2D.prototype.fillText;
      globalThis.written = {heat: [], scatter: []};
      CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
        if (this.textAlign === 'right') written[this.canvas.closest('figure').id]?.push([text, x - this.measureText(text).width]);
        write.call(this, text, x, y);
      };
    });
    for (const drawing of ['heat', 'scatter']) {
      await page.selectOption(`#${drawing}-y`, {label: 'pwm.chopping'});
      // The point is to the right of the axis's name. The name is vertical, in the first 16 pixels.
      await eventually(async () => assert.ok(await page.evaluate((of) => written[of].some(([text, x]) => text === 'complementary' && x >= 16), drawing), drawing));
    }
    await close(page);
  }
});

test('a run that is clicked or typed tells all of itself, and how to make its report', async () => {
  const page = await opened('plan.html');
  await page.fill('#number', '100');
  await page.press('#number', 'Enter');
  assert.match(await page.locator('#run .state').textContent(), /^Run 100 /);
  assert.equal(await page.locator('#run pre').textContent(), 'sixstep run plan.toml --only 100 --html run-100.html');
  assert.equal(await page.locator('#run tr').count(), 6);
  await page.fill('#number', '1000');
  await page.press('#number', 'Enter');
  assert.match(await page.locator('#run').textContent(), /no such run/);
  const [x, y] = await page.evaluate(() => {  // the position of run 40
    const {table, scaleOf} = sixstep, box = document.querySelector('#scatter canvas').getBoundingClientRect();
    const [settle, , , figure] = table.columns;
    return [64 + scaleOf(settle).at(settle.of[0][40]) * (box.width - 80), 12 + (1 - scaleOf(figure).at(figure.of[0][40])) * (box.height - 54)];
  });
  await page.click('#scatter canvas', {position: {x, y}});
  await eventually(async () => assert.match(await page.locator('#run .state').textContent(), /^Run 40 /));
  await close(page);
});

test('a range dragged on an axis picks runs for every drawing, and a click lets them go', async () => {
  const page = await opened('plan.html');
  const [all, front] = [await inked(page, 'scatter'), await page.locator('#front-list').textContent()];
  await page.locator('#parallel canvas').scrollIntoViewIfNeeded();
  const box = await page.locator('#parallel canvas').boundingBox(), x = box.x + 56;
  await page.mouse.move(x, box.y + 60);
  await page.mouse.down();
  await page.mouse.move(x, box.y + 150, {steps: 4});
  await page.mouse.up();
  const some = await eventually(async () => {
    const [, picked, of] = (await page.locator('#parallel-said').textContent()).match(/^(\d+) of (\d+) runs$/);
    assert.equal(of, '126');
    return Number(picked);
  });
  assert.equal(some % 14, 0, 'whole columns of the grid');
  assert.ok(some > 0 && some < 126);
  await eventually(async () => {
    assert.ok((await inked(page, 'scatter')) < all);
    assert.notEqual(await page.locator('#front-list').textContent(), front);
  });
  await page.click('#all');
  await eventually(async () => assert.equal(await page.locator('#parallel-said').textContent(), '126 runs'));
  await eventually(async () => assert.equal(await page.locator('#front-list').textContent(), front));
  await close(page);
});

test('two plans stand over each other in their own colours', async () => {
  const page = await opened('plans.html');
  assert.equal(await page.locator('.verdict').count(), 2);
  assert.equal(await page.locator('#legend span').count(), 4);
  assert.equal(await page.evaluate(() => sixstep.table.columns.length), 6, 'the same names are the same columns');
  assert.equal(await page.locator('#heat-plan option').count(), 2);
  await page.selectOption('#heat-plan', {label: 'later'});
  assert.ok((await inked(page, 'heat')) > 0.2);
  await close(page);
});

test('bars say which key a figure hangs on', async () => {
  const page = await opened('plan-indices.html');
  const widths = await page.locator('.indices').first().locator('td.index i').evaluateAll((all) => all.map((i) => i.getBoundingClientRect().width));
  assert.equal(widths.length, 4);
  assert.ok(widths[0] > 5 * widths[2], 'the settling time hangs on what was asked for');
  await close(page);
});

test('a hundred thousand runs can be looked at', {skip: !process.env.SIXSTEP_ALL_CASES}, async () => {
  const page = await opened('plan-many.html');
  let best = Infinity;
  for (let n = 0; n < 3; ++n) {
    await page.reload();
    best = Math.min(best, await page.evaluate(() => sixstep.ready_ms));
  }
  assert.ok(best < 5000, `${best} ms`);  // limit for a busy machine without a graphics card
  const redrawn = await page.evaluate(() => {
    const select = document.getElementById('scatter-y'), begin = performance.now();
    select.value = select.options[select.options.length - 1].value;
    select.dispatchEvent(new Event('change'));
    return performance.now() - begin;
  });
  assert.ok(redrawn < 2000, `${redrawn} ms`);
  await close(page);
});
