// SPDX-License-Identifier: Apache-2.0
// node tools/picture.mjs [PROGRAM]: writes screenshots of pages into docs/images: report.png (the README's scenario), curve.png (the
// torque-speed curve), bench.png (a measured back-EMF), plan.png (the middle of
// a plan's page), and recording.png (a real recording over its simulation). Requires the programs that
// tools/install.sh test installs (playwright-core and Chromium).
import {execFileSync, spawnSync} from 'node:child_process';
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

/** Takes a screenshot of the page that `words` writes with --html, from the element `first` or the top down to `last`. */
async function photograph(name, last, words, first) {
  const file = path.join(folder, `${name}.html`);
  const {status, stderr} = spawnSync(program, [...words, '--html', file, '--quiet'], {cwd: root, encoding: 'utf8'});
  if (status !== 0 && status !== 1) throw new Error(stderr); // 1: a requirement is missed, which is expected for a plan's page
  const page = await browser.newPage({viewport: {width: 1200, height: 1400}, colorScheme: 'light', deviceScaleFactor: 1.15});
  await page.goto(pathToFileURL(file).href);
  if (last.startsWith('#chart')) await page.waitForFunction(() => globalThis.sixstep?.charts?.length > 0);
  await page.waitForTimeout(300); // the charts are drawn with the next frames
  await page.evaluate(() => globalThis.sixstep?.pointAt?.(0.0031));
  await page.waitForTimeout(200);
  const box = await page.locator(last).boundingBox();
  const top = first ? Math.floor((await page.locator(first).boundingBox()).y) - 16 : 0;
  const picture = path.join(root, `docs/images/${name}.png`);
  const height = Math.ceil(box.y + box.height + 16) - top;
  await page.screenshot({path: picture, fullPage: true, clip: {x: 0, y: top, width: 1200, height}});
  execFileSync('pngquant', ['--strip', '--force', '48', '--output', picture, picture]); // 48 colours: a quarter of the size
  await page.close();
}

await photograph('report', '#chart-logic', ['run', 'data/scenarios/current-square.toml']);
await photograph('curve', '#chart-efficiency', ['curve', 'maxon-251601']);
await photograph('bench', '.columns.wide',
  ['motor', 'emf', 'data/recordings/trampa6340-emf.csv', '--between', 'lines', '--speed', '1000']);
await photograph('plan', '#front', ['run', 'data/plans/which-pwm.toml'], 'h2:has(+ #heat)');
await photograph('recording', '#recordings figure:nth-of-type(2)', ['run', 'data/measured/bly172s-3135rpm.toml'],
  '#recordings figure:nth-of-type(1)');
await browser.close();
fs.rmSync(folder, {recursive: true});
