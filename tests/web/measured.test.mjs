// Measurements beside a run: the numbers are those of contactctl, the points lie over the curves.

import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, afterEach, before, beforeEach, test} from 'node:test';

import {AxeBuilder} from '@axe-core/playwright';

import {CHAIN, openBrowser, openPage, Server, swinging, until} from './harness.mjs';

const FORCE = 'B1-B2.contact_force';
const SPEED = 'B3.velocity';
let server;
let browser;
let page;
let folder;
let chain;
let rows;   // Time, force and speed of its samples.
before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'contact-measured-'));
  [server, browser] = await Promise.all([new Server().start(), openBrowser()]);
  chain = await server.submit({...CHAIN, output: {sampleIntervalS: 2e-6}});
  await server.ended(chain);
  const {columns} = await server.call('GetSeries', {name: `jobs/${chain}`, channels: [FORCE, SPEED], decimation: 'RAW', plainNumbers: true});
  const [times, forces, speeds] = columns.map(({numbers}) => numbers);
  rows = times.map((time, i) => [time, forces[i], speeds[i]]);
});
after(async () => {
  await browser?.close();
  await server?.close();
  rmSync(folder, {recursive: true, force: true});
});
beforeEach(async () => { page = await openPage(browser, server); });
afterEach(async () => {
  assert.deepEqual(page.faults, []);
  await page.context().close();
});

const hold = (what) => until(what, what.toString());
const ofAddress = (name) => new URL(page.url()).searchParams.get(name);
const verdict = () => page.getByLabel('Deviations from the run');
const cells = (channel) => page.locator(`[data-signal="${channel}"] td`).allInnerTexts();
const exactly = (channel) => page.locator(`[data-signal="${channel}"] td[title]`).evaluateAll((all) => all.map(({title}) => Number(title)));
async function open(id = chain) {
  await page.goto(`${server.origin}/runs/${id}`);
  await page.getByLabel('CSV beside this run').waitFor();
}

/** A file as a European logger writes it, whose clock is 12.5 ms late; every 7th sample, the force 3 % too large. */
function written(name, header = 'Zeit [ms];F_12 [kN];Geschwindigkeit [mm/s]') {
  const comma = (value) => String(value).replace('.', ',');
  const lines = rows.filter((_, i) => i % 7 === 0).map(([t, f, v]) => [(t + 0.0125) * 1e3, 1.03 * f / 1e3, v * 1e3].map(comma).join(';'));
  const path = join(folder, name);
  writeFileSync(path, `Logger 7\nDatum;24.12.25\n\n${header}\n${lines.join('\n')}\n`);
  return path;
}

test('a file beside a run has the verdict that contactctl gives it', async () => {
  await open();
  await page.getByLabel('CSV beside this run').setInputFiles(written('logger.csv'));
  await page.getByText(/rows of 3 columns, separated by semicolons, decimal commas, rows from line 5 on/).waitFor();
  const chosen = () => page.getByLabel('Columns of the file').locator('select').evaluateAll((all) => all.map(({value}) => value).join());
  await hold(async () => await chosen() === 'time,,');
  const force = page.getByLabel('F_12 [kN] is');   // By keys alone.
  await force.focus();
  await page.keyboard.type(FORCE);
  await hold(async () => await force.inputValue() === FORCE);
  await page.getByLabel('Geschwindigkeit [mm/s] is').selectOption(SPEED);
  await hold(async () => (await cells(SPEED)).at(-1) === '✓ ok' && (await cells(FORCE)).at(-1) === '✓ ok');
  const shift = Number(await page.locator('[data-shift]').getAttribute('data-shift'));
  assert.ok(Math.abs(shift + 0.0125) < 1e-7, `${shift}`);
  assert.match((await cells(FORCE))[3], /%$/);
  await page.getByLabel('relative tolerance').first().fill('0.02');
  await page.keyboard.press('Tab');
  await hold(async () => (await cells(FORCE)).at(-1) === '✗ differs');
  await page.getByText('1 of 2 not within tolerance').waitFor();
  assert.equal(ofAddress('rel'), '0.02');
  if (!process.env.CONTACTCTL) return;
  const command = await page.getByLabel('Measurements', {exact: true}).locator('code').innerText();
  const asked = `${command.replace(/^contactctl/, process.env.CONTACTCTL)} -o json || test $? = 8`;
  const told = JSON.parse(execFileSync('bash', ['-c', asked], {cwd: folder, encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore']}));
  assert.ok(Math.abs(told.shift_s - shift) < 1e-12, `${told.shift_s} and ${shift}`);
  for (const {name, points, ...signal} of told.signals) {
    assert.equal((await cells(name))[1].replace(/\s/g, ''), String(points));
    const here = await exactly(name);
    ['rms', 'largest', 'largest_time_s', 'measured_peak', 'simulated_peak', 'allowed'].forEach((field, i) =>
      assert.ok(Math.abs(here[i] - signal[field]) <= 1e-6 * Math.abs(signal[field]), `${name} ${field}: ${here[i]} and ${signal[field]}`));
    assert.equal((await cells(name)).at(-1), signal.holds ? '✓ ok' : '✗ differs');
  }
  assert.equal(told.signals.length, 2);
});

test('a file that is dropped lies over the curves of its channels, until it is taken away', async () => {
  await open();
  const lines = rows.filter((_, i) => i % 20 === 0).map(([t, f]) => `${t}\t${f}`);
  await page.evaluate((text) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([text], 'dropped.tsv'));
    for (const name of ['dragover', 'drop']) document.querySelector('main').dispatchEvent(new DragEvent(name, {dataTransfer, bubbles: true, cancelable: true}));
  }, `\uFEFFt [s]\t${FORCE}\n${lines.join('\n')}\n`);
  const key = page.locator('[data-plot="force"] .key').getByText('B1-B2 measured');
  await key.waitFor();
  await page.getByText('✓ within tolerance').waitFor();
  const saved = async () => {
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByLabel('Contact force as CSV').click()]);
    const chunks = [];
    for await (const chunk of await download.createReadStream()) chunks.push(chunk);
    return Buffer.concat(chunks).toString().split('\n').filter((row) => row.startsWith('B1-B2 measured,')).map((row) => row.split(',').slice(1).map(Number));
  };
  const points = await saved();
  assert.equal(points.length, lines.length);
  const largest = Math.max(...rows.filter((_, i) => i % 20 === 0).map(([, f]) => f));
  assert.equal(Math.max(...points.map(([, f]) => f)), largest);
  await page.getByLabel('Simulated time − measured time [s]').fill('0.001');
  await page.keyboard.press('Tab');
  await hold(async () => ofAddress('shift') === '0.001' && Math.abs((await saved())[0][0] - 0.001) < 1e-12);
  await page.getByRole('button', {name: 'Fit it'}).click();
  await hold(async () => ofAddress('shift') === null && Math.abs((await saved())[0][0]) < 1e-9);
  const {violations} = await new AxeBuilder({page}).include('section[aria-label="Measurements"]').analyze();
  assert.deepEqual(violations.filter(({impact}) => impact === 'serious' || impact === 'critical').map(({id, nodes}) => `${id}: ${nodes[0].html}`), []);
  await page.getByRole('button', {name: 'Take it away'}).click();
  await key.waitFor({state: 'detached'});
  assert.equal(await verdict().count(), 0);
});

test('an accelerometer opens the plot of accelerations', async () => {
  await open();
  const path = join(folder, 'a.csv');
  writeFileSync(path, 't [ms],B1.acceleration [g]\n0,0\n0.5,-20\n1,0\n');
  await page.getByLabel('CSV beside this run').setInputFiles(path);
  await page.locator('[data-plot="acceleration"] .key').getByText('B1 measured').waitFor();
});

test('what is no table, or has no such unit, says so', async () => {
  await open();
  let files = 0;
  const chosen = (text) => {
    const path = join(folder, `wrong-${++files}.csv`);
    writeFileSync(path, text);
    return page.getByLabel('CSV beside this run').setInputFiles(path);
  };
  await chosen('only words\nand more\n');
  await page.getByRole('alert').getByText('has no rows of numbers').waitFor();
  await chosen(`t [s],${FORCE} [kN]\n0,1\n0.001,x\n0.002,3\n`);
  await page.getByRole('alert').getByText(`column ${FORCE} [kN]: line 3: expected a number, got 'x'`).waitFor();
  await chosen(`t [s],${FORCE} [kN]\n0,1\n0.001,2\n`);
  await page.getByLabel(`unit of ${FORCE} [kN]`).fill('kPa');
  await page.getByRole('alert').getByText("'kPa' is no unit of a quantity in N").waitFor();
});

test('every sample of a long run counts', async () => {
  const id = await server.submit({...swinging(3), output: {sampleIntervalS: 1e-5}});
  await server.ended(id);
  await open(id);
  let asked = 0;
  page.on('response', (response) => { asked += response.url().endsWith('GetSeries') && response.request().postDataBuffer().includes('ball.velocity') && response.ok(); });
  const path = join(folder, 'long.csv');
  writeFileSync(path, 'time,ball.velocity\n0.1,0\n2.9,0\n');
  await page.getByLabel('CSV beside this run').setInputFiles(path);
  await page.getByLabel('Simulated time − measured time [s]').fill('0');
  await page.keyboard.press('Tab');
  await hold(() => ofAddress('shift') === '0');
  const largest = async (low, high) => {   // In parts that fit into an answer.
    const {columns} = await server.call('GetSeries', {name: `jobs/${id}`, channels: ['ball.velocity'], decimation: 'RAW', startTimeS: low, endTimeS: high, plainNumbers: true});
    return columns[1].numbers.reduce((peak, value) => (Math.abs(value) > Math.abs(peak) ? value : peak), 0);
  };
  const peaks = [await largest(0.1, 1), await largest(1, 2), await largest(2, 2.9)];
  const peak = peaks.reduce((a, b) => (Math.abs(b) > Math.abs(a) ? b : a));
  await hold(async () => (await exactly('ball.velocity'))[4] === peak);
  assert.ok(asked >= 2, `${asked} calls`);
});
