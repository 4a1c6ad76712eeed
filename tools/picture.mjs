// SPDX-License-Identifier: Apache-2.0
// node tools/picture.mjs [PROGRAM]: photographs the top of the pages that the documents show, as a reader sees them, into
// docs/images: report.png, of the README's scenario, curve.png, the torque-speed curve, and bench.png, a measured back-EMF. Needs what
// tools/install.sh test installs (playwright-core and Chromium).
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';
import playwright from 'playwright-core';

const root = path.dirname(path.dirname(fileURLToPath(import.meta.url)));
const program = path.resolve(process.argv[2] ?? path.join(root, 'build/release/sixstep'));
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'sixstep-picture-'));
const browser = await playwright.chromium.launch({
  executablePath: process.env.SIXSTEP_CHROMIUM ?? '/usr/bin/chromium',
  args: ['--headless', '--no-sandbox', '--disable-gpu', '--disable-background-networking', '--disable-dev-shm-usage'],
});

/** What `words` makes with --html, down to the element `last`; what stands below is cut off. Charts may be drawn already. */
async function photograph(name, last, words) {
  const file = path.join(folder, `${name}.html`);
  execFileSync(program, [...words, '--html', file, '--quiet'], {cwd: root});
  const page = await browser.newPage({viewport: {width: 1200, height: 1400}, colorScheme: 'light', deviceScaleFactor: 1.15});
  await page.goto(pathToFileURL(file).href);
  if (last.startsWith('#chart')) await page.waitForFunction(() => globalThis.sixstep?.charts?.length > 0);
  await page.waitForTimeout(300); // the charts are drawn with the next frames
  await page.evaluate(() => globalThis.sixstep?.pointAt?.(0.0031));
  await page.waitForTimeout(200);
  const box = await page.locator(last).boundingBox();
  const picture = path.join(root, `docs/images/${name}.png`);
  await page.screenshot({path: picture, clip: {x: 0, y: 0, width: 1200, height: Math.ceil(box.y + box.height + 16)}});
  execFileSync('pngquant', ['--strip', '--force', '64', '--output', picture, picture]); // 64 colours: a quarter of the size
  await page.close();
}

await photograph('report', '#chart-logic', ['run', 'data/scenarios/current-square.toml']);
await photograph('curve', '#chart-efficiency', ['curve', 'maxon-251601']);
await photograph('bench', '.columns.wide',
  ['motor', 'emf', 'data/recordings/trampa6340-emf.csv', '--between', 'lines', '--speed', '1000']);
await browser.close();
fs.rmSync(folder, {recursive: true});
