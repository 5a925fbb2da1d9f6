// Reports: the page that the dashboard saves, and that of contactsim. Both are alone with themselves when they are looked at.

import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {after, before, test} from 'node:test';
import {fileURLToPath, pathToFileURL} from 'node:url';

import {BINARY, CHAIN, openBrowser, openPage, Server, until} from './harness.mjs';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
let server;
let browser;
let chain;
before(async () => {
  [server, browser] = await Promise.all([new Server('--workers=2').start(), openBrowser()]);
  chain = await server.submit({...CHAIN, title: 'Chain <b>&</b>'});
  await server.ended(chain);
});
after(async () => { await browser?.close(); await server?.close(); });

/** Opens a file, whose page must ask for nothing. */
async function openFile(path) {
  const page = await browser.newPage({viewport: {width: 1280, height: 900}});
  page.faults = [];
  page.on('pageerror', (error) => page.faults.push(error.message));
  page.on('console', (message) => page.faults.push(message.text()));
  page.on('request', (request) => { if (!/^(file|data):/.test(request.url())) page.faults.push(request.url()); });
  await page.goto(pathToFileURL(path).href);
  return page;
}

/** Zooms the force by mouse and comes back; gives what its point tells and the numbers at its axes, before and while it is zoomed. */
async function zoomed(page, figure) {
  await figure.scrollIntoViewIfNeeded();
  const field = figure.getByRole('application').first();
  const box = await field.boundingBox();
  const to = (x, y) => page.mouse.move(box.x + x * box.width, box.y + y * box.height, {steps: 4});
  const path = figure.locator('[data-name="B1-B2"] path, path[data-name="B1-B2"]').first();
  const width = async () => (await path.boundingBox()).width;
  const before = await width();
  await to(0.2, 0.9);
  await page.mouse.down();
  await to(0.6, 0.1);
  await page.mouse.up();
  const grown = await width() / before;
  const words = [];
  for (let i = 0; i < 20; ++i) {   // Where its curve is at that height, there is a point.
    await to(0.02 + 0.05 * i, 0.5);
    words.push(await figure.locator('text[paint-order]').first().textContent());
  }
  assert.ok(await figure.locator('.tick:not(path)').first().isHidden());
  await page.mouse.dblclick(box.x + box.width / 2, box.y + box.height / 2);
  assert.ok(await figure.locator('.tick:not(path)').first().isVisible());
  assert.equal(await width(), before);
  await field.press('+');
  const byKeys = await width() / before;
  await field.press('0');
  return {grown, byKeys, words: words.filter(Boolean)};
}

async function check(path) {
  assert.ok(readFileSync(path).length < 300_000, `it has ${readFileSync(path).length} bytes`);
  const page = await openFile(path);
  const figure = page.locator('[data-axes]').filter({hasText: /Contact force|^\s*.*force \[N\]/}).first();
  const {grown, byKeys, words} = await zoomed(page, figure);
  assert.ok(Math.abs(grown - 2.5) < 0.2, `a stretch of 0.4 is ${grown} times as wide`);
  assert.ok(Math.abs(byKeys - 2) < 0.05, `a key makes it ${byKeys} times as wide`);
  assert.ok(words.some((text) => /^B\d-B\d.*: time [\d.]+ ms, force [\d.]+ N$/.test(text)), words.join('; '));
  assert.deepEqual(page.faults, []);
  return page;
}

test('a run is saved from its page as a report that zooms and tells values without a server', async () => {
  const page = await openPage(browser, server);
  await page.goto(`${server.origin}/runs/${chain}`);
  await until(async () => Number(await page.locator('[data-plot="force"]').getAttribute('data-points')) > 100, 'samples');
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', {name: 'Save report'}).click()]);
  assert.equal(download.suggestedFilename(), `jobs-${chain}.html`);
  const path = join(server.folder, 'report.html');
  await download.saveAs(path);
  assert.deepEqual(page.faults, []);
  const report = await check(path);
  assert.equal(await report.locator('svg[data-axes]').count(), await page.locator('.plot').count());
  const text = await report.locator('body').innerText();
  for (const words of ['Chain <b>&</b>', 'CONVERGED', `contactctl --server 127.0.0.1:${server.port} run --like jobs/${chain}`, 'restitution: 0.7']) assert.ok(text.includes(words), words);
  assert.equal(await report.locator('button, input, select').count(), 0);
  await report.close();
  await page.context().close();
});

const draws = spawnSync('/usr/bin/python3', ['-c', 'import grpc, matplotlib']).status === 0;
test('the report of contactsim zooms and tells values, too', {skip: !draws}, async () => {
  const path = join(server.folder, 'python.html');
  const code = 'import sys, pathlib, contactsim\nfrom contactsim.pages import write_report\nc = contactsim.Client(sys.argv[1])\nwrite_report(c, [sys.argv[2]], sys.argv[3])';
  execFileSync('/usr/bin/python3', ['-B', '-c', code, `127.0.0.1:${server.port}`, `jobs/${chain}`, path],
    {env: {...process.env, PYTHONPATH: [join(ROOT, 'client/python'), join(dirname(BINARY), '../python')].join(':')}});
  await (await check(path)).close();
});
