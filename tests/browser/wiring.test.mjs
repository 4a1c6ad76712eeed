// SPDX-License-Identifier: Apache-2.0
// The page of a motor's 36 wirings, in light and dark, on a large and a small screen.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {close, opened} from './page.mjs';

/** For each drawing: the texts outside of the drawing or of their card, and the texts that overlap. */
const clashes = (page) => page.evaluate(() => [...document.querySelectorAll('figure.wiring svg')].map((svg) => {
  const box = (e) => e.getBoundingClientRect(), said = (t) => t.textContent;
  const texts = [...svg.querySelectorAll('text')], whole = box(svg), slack = 1;
  const outside = (t, b) => box(t).left < b.left - slack || box(t).right > b.right + slack || box(t).top < b.top - slack || box(t).bottom > b.bottom + slack;
  const card = (t) => t.parentElement.querySelector(':scope > .w-cell');
  const over = texts.flatMap((s, n) => texts.slice(n + 1).filter((t) => {
    const a = box(s), b = box(t);
    return a.left + slack < b.right && b.left + slack < a.right && a.top + 4 < b.bottom && b.top + 4 < a.bottom;
  }).map((t) => `${said(s)} | ${said(t)}`));
  return [...texts.filter((t) => outside(t, card(t) ? box(card(t)) : whole)).map(said), ...over];
}));

test('all 36 wirings and what each kind looks like can be read, in light and dark', async () => {
  const inks = [];
  for (const theme of ['light', 'dark']) {
    const page = await opened('wirings.html', {theme});
    assert.equal(await page.locator('figure.wiring .w-theory').count(), 36);
    assert.equal(await page.locator('.verdict.pass .word').textContent(), '36 of 36');
    for (const label of await page.locator('figure.wiring svg').evaluateAll((all) => all.map((s) => s.getAttribute('aria-label'))))
      assert.ok(label.length > 20, label);
    assert.deepEqual(await clashes(page), [[], [], []]);
    inks.push(await page.locator('figure.wiring text').first().evaluate((t) => getComputedStyle(t).fill));
    // The marks distinguish the kinds of wirings without colour. The colours distinguish them without words.
    const kinds = await page.locator('figure.wiring .w-bar').evaluateAll((all) => new Set(all.map((bar) => getComputedStyle(bar).fill)).size);
    assert.equal(kinds, 4);
    await close(page);
  }
  assert.notEqual(inks[0], inks[1]);
});

test('it fits a phone without scrolling sideways', async () => {
  const page = await opened('wirings.html');
  await page.setViewportSize({width: 390, height: 800});
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await close(page);
});

test('each wiring says what it is where it is pointed at', async () => {
  const page = await opened('wirings.html');
  const titles = await page.locator('figure.wiring g > title').allTextContents();
  assert.equal(titles.length, 36);
  assert.equal(new Set(titles).size, 36);
  assert.ok(titles.includes('phases bac, Hall lines 132: BACKWARD'));
  await close(page);
});
