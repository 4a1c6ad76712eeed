// SPDX-License-Identifier: Apache-2.0
// Pages in Chromium, opened from a file without a network. Any error, warning or network request of a page fails the test.
import assert from 'node:assert/strict';
import {after, before} from 'node:test';
import path from 'node:path';
import {pathToFileURL} from 'node:url';
import playwright from 'playwright-core';

const pages = process.env.SIXSTEP_PAGES;
const address = (name) => pathToFileURL(path.join(pages, name)).href;
let browser;

before(async () => {
  browser = await playwright.chromium.launch({
    executablePath: process.env.SIXSTEP_CHROMIUM ?? '/usr/bin/chromium',
    args: ['--headless', '--no-sandbox', '--disable-gpu', '--disable-background-networking', '--disable-component-update',
      '--disable-sync', '--disable-dev-shm-usage', '--no-first-run'],
  });
});
after(() => browser?.close());

/** Opens a page; close() fails on its errors, warnings and network requests. */
export async function opened(name, {theme = 'light', hash = ''} = {}) {
  const page = await browser.newPage({viewport: {width: 1280, height: 900}, colorScheme: theme});
  // A busy machine delays frames. This page always has such a delay. Thus a test that does not wait for a frame fails on any machine.
  await page.addInitScript(() => {
    const soon = requestAnimationFrame;
    globalThis.requestAnimationFrame = (draw) => setTimeout(() => soon(draw), 60);
  });
  page.complaints = [];
  page.on('console', (m) => ['error', 'warning'].includes(m.type()) && page.complaints.push(m.text()));
  page.on('pageerror', (e) => page.complaints.push(e.message));
  page.on('request', (r) => /^(file|data):/.test(r.url()) || page.complaints.push('asked for ' + r.url()));
  await page.goto(address(name) + hash);
  return page;
}

export async function close(page) {
  assert.deepEqual(page.complaints, []);
  await page.close();
}

export const scales = (page) => page.evaluate(() => sixstep.charts.map((u) => [u.scales.x.min, u.scales.x.max]));
export const allEqual = (list) => list.every((x) => JSON.stringify(x) === JSON.stringify(list[0]));

/** Repeats the check until it passes, for at most 5 s. A page applies cursor, theme and size only in its next frames. */
export async function eventually(check) {
  for (const begin = performance.now(); ; await new Promise((done) => setTimeout(done, 20))) {
    try {
      return await check();
    } catch (error) {
      if (performance.now() - begin > 5000) throw error;
    }
  }
}

export async function plotArea(page, id) {
  const over = page.locator(`#chart-${id} .u-over`);
  await over.scrollIntoViewIfNeeded();
  return over.boundingBox();
}

export async function drag(page, id, from, to) {
  const box = await plotArea(page, id);
  await page.mouse.move(box.x + box.width * from, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * to, box.y + box.height / 2, {steps: 5});
  await page.mouse.up();
}

