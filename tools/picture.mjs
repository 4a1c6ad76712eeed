// SPDX-License-Identifier: Apache-2.0
// node tools/picture.mjs [PROGRAM]: runs the README's scenario and photographs the top of its report, as a reader sees
// it, into docs/images/report.png. Needs what tools/install.sh test installs (playwright-core and Chromium).
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';
import playwright from 'playwright-core';

const root = path.dirname(path.dirname(fileURLToPath(import.meta.url)));
const program = path.resolve(process.argv[2] ?? path.join(root, 'build/release/sixstep'));
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'sixstep-picture-'));
const report = path.join(folder, 'report.html');
execFileSync(program, ['run', 'data/scenarios/current-square.toml', '--html', report, '--quiet'], {cwd: root});

const browser = await playwright.chromium.launch({
  executablePath: process.env.SIXSTEP_CHROMIUM ?? '/usr/bin/chromium',
  args: ['--headless', '--no-sandbox', '--disable-gpu', '--disable-background-networking', '--disable-dev-shm-usage'],
});
const page = await browser.newPage({viewport: {width: 1200, height: 1400}, colorScheme: 'light', deviceScaleFactor: 1.25});
await page.goto(pathToFileURL(report).href);
await page.waitForFunction(() => globalThis.sixstep?.charts?.length > 0);
await page.waitForTimeout(300); // the charts are drawn with the next frames
const last = await page.locator('#chart-logic').boundingBox(); // what stands below is cut off
await page.screenshot({path: path.join(root, 'docs/images/report.png'),
  clip: {x: 0, y: 0, width: 1200, height: Math.ceil(last.y + last.height + 16)}});
await browser.close();
fs.rmSync(folder, {recursive: true});
