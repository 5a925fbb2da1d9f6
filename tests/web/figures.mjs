// What the dashboard costs: prints a table of what was measured beside its limit. Ends with 1 if a
// limit is passed. Figures of other machines: run it there.

import {readFileSync, readdirSync} from 'node:fs';
import {fileURLToPath} from 'node:url';
import {gzipSync} from 'node:zlib';

import {CHAIN, openBrowser, openPage, Server, swinging, until} from './harness.mjs';

const JOBS = Number(process.env.JOBS ?? 10_000);
const rows = [];
const report = (name, value, limit, unit, note = '') => {
  rows.push(value <= limit);
  console.log(`${name.padEnd(44)} ${value.toFixed(1).padStart(8)} ${unit.padEnd(3)} limit ${limit}  ${value <= limit ? 'ok' : 'OVER'}  ${note}`);
};
// The nearest rank: the least of them that so large a part of them does not exceed.
const quantile = (values, q) => [...values].sort((a, b) => a - b)[Math.max(Math.ceil(q * values.length) - 1, 0)];
const p95 = (values) => quantile(values, 0.95);

const server = await new Server('--workers=2', '--max-creates-per-second=0').start()
  .catch(() => { throw new Error('contactd does not start'); });
const browser = await openBrowser();

/** Bytes of the files that a page loads, compressed. */
async function loaded(path) {
  const page = await openPage(browser, server);
  const files = new Set();
  page.on('request', (request) => files.add(new URL(request.url()).pathname));
  await page.goto(server.origin + path);
  await page.waitForTimeout(1000);
  await page.context().close();
  const dist = fileURLToPath(new URL('../../client/web/dist', import.meta.url));
  const sizeOf = (name) => gzipSync(readFileSync(dist + name)).length;
  return ['/index.html', ...[...files].filter((name) => name.startsWith('/assets/'))].reduce((sum, name) => sum + sizeOf(name), 0) / 1000;
}

/** Milliseconds from the beginning of the navigation to the first content. */
async function firstPaints(path, times = 9) {
  const paints = [];
  for (let i = 0; i < times; ++i) {
    const page = await openPage(browser, server);
    await page.goto(server.origin + path);
    paints.push(await until(() => page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0]?.startTime), 'paint'));
    await page.context().close();
  }
  return paints;
}

/** From the time of an event at the server to the frame that shows it: cycles of a run that goes on. */
async function eventToPixel() {
  const id = await server.submit(swinging(1, {method: 'RK4', stepS: 1e-7}));
  const page = await openPage(browser, server);
  await page.goto(`${server.origin}/runs/${id}`);
  await page.locator('section[aria-label="Cycle ledger"] tbody tr').first().waitFor();
  await page.locator('section[aria-label="Cycle ledger"]').scrollIntoViewIfNeeded();
  await page.evaluate(() => {
    window.seen = [];
    const ledger = document.querySelector('section[aria-label="Cycle ledger"]');
    new MutationObserver(() => {
      const count = Number(/of ([\d\u202f]+)/.exec(ledger.querySelector('.tools').textContent)?.[1].replaceAll('\u202f', ''));
      requestAnimationFrame(() => setTimeout(() => window.seen.push([count, Date.now()])));
    }).observe(ledger, {subtree: true, childList: true, characterData: true});
  });
  await page.waitForTimeout(12_000);
  const seen = await page.evaluate(() => window.seen);
  await server.call('CancelJob', {name: `jobs/${id}`});
  await server.ended(id);
  const times = await eventTimes(id);
  await page.context().close();
  const first = seen[0]?.[0] ?? 0;
  return times.map((time, i) => {
    const shown = seen.find(([count]) => count >= i + 1);
    return i < first || !shown ? undefined : shown[1] - time;
  }).filter((value) => value !== undefined);
}

/** When the server recorded each cycle. */
async function eventTimes(id) {
  const body = Buffer.from(JSON.stringify({name: `jobs/${id}`, kinds: ['cycle']}));
  const frame = Buffer.alloc(5 + body.length);
  frame.writeUInt32BE(body.length, 1);
  body.copy(frame, 5);
  const answer = await fetch(`${server.origin}/contact.v1.JobService/WatchJob`, {method: 'POST', headers: {'content-type': 'application/connect+json'}, body: frame});
  const bytes = Buffer.from(await answer.arrayBuffer());
  const times = [];
  for (let at = 0; at < bytes.length;) {
    const size = bytes.readUInt32BE(at + 1);
    const message = JSON.parse(bytes.subarray(at + 5, at + 5 + size).toString());
    for (const event of message.events ?? []) if (event.cycle) times.push(Date.parse(event.eventTime));
    at += 5 + size;
  }
  return times;
}

/** From the creation of a job to its row in the list. */
async function jobToRow(times = 20) {
  const page = await openPage(browser, server);
  await page.goto(`${server.origin}/runs`);
  await page.locator('tbody tr').first().waitFor();
  const delays = [];
  for (let i = 0; i < times; ++i) {
    const title = `row ${i} ${Date.now()}`;
    const shown = page.evaluate((text) => new Promise((resolve) => {
      const look = () => {
        if (!document.querySelector('tbody').textContent.includes(text)) return;
        observer.disconnect();
        requestAnimationFrame(() => setTimeout(() => resolve(Date.now())));
      };
      const observer = new MutationObserver(look);
      look();
      observer.observe(document.querySelector('main'), {subtree: true, childList: true, characterData: true});
    }), title);
    const {createTime} = await server.call('CreateJob', {job: {scenario: {...CHAIN, title}}});
    delays.push(await shown - Date.parse(createTime));
  }
  await page.context().close();
  return delays;
}

/** Time of a click until the frame after the last change that it makes. */
async function clickToPixel(page, button, changed) {
  return page.evaluate(async ([selector, text, marker]) => {
    const target = [...document.querySelectorAll(selector)].find((b) => b.innerText.trim() === text);
    const value = () => document.querySelector(marker[0])?.[marker[1]] ?? document.querySelector(marker[0])?.getAttribute(marker[1]);
    const before = value();
    const start = performance.now();
    target.click();
    for (;;) {
      await new Promise((resolve) => { requestAnimationFrame(() => setTimeout(resolve)); });
      if (value() !== before) return performance.now() - start;
      if (performance.now() - start > 10_000) return Infinity;
    }
  }, [button.selector, button.text, changed]);
}

async function paging() {
  const light = {job: {scenario: {bodies: [{name: 'a', massKg: 1}], endTimeS: 1e-3, output: {ledgerOnly: true}}}};
  for (let made = 0; made < JOBS; made += 100) {
    await Promise.all(Array.from({length: 100}, () => server.call('CreateJob', light)));
  }
  const page = await openPage(browser, server);
  await page.goto(`${server.origin}/runs`);
  await page.waitForFunction((n) => Number(/, ([\d\u202f]+) runs/.exec(document.body.innerText)?.[1].replaceAll('\u202f', '')) >= n, JOBS);
  const delays = [];
  for (let i = 0; i < 60; ++i) delays.push(await clickToPixel(page, {selector: '.pages button', text: 'Older ›'}, ['tbody', 'innerText']));
  await page.context().close();
  return delays;
}

async function zooming() {
  const id = await server.submit({...swinging(5), output: {sampleIntervalS: 5e-6}});
  const job = await server.ended(id);
  const page = await openPage(browser, server);
  await page.goto(`${server.origin}/runs/${id}`);
  await until(async () => Number(await page.locator('[data-plot="force"]').getAttribute('data-points')) > 1000, 'the plot');
  await page.waitForTimeout(1500);
  // From the key to the frames that show its window and the columns of that, as the page has noted it.
  await page.evaluate(() => addEventListener('keydown', ({timeStamp}) => { window.pressed = timeStamp; }, true));
  const delays = {window: [], series: []};
  for (const key of ['+', '-', '+', '-'].flatMap((one) => Array(8).fill(one))) {
    await page.evaluate(() => performance.clearMeasures());
    await page.keyboard.press(key);
    await until(() => page.evaluate(() => performance.getEntriesByName('series').length >= 1), 'answers');
    await page.waitForTimeout(100);
    const ends = (name) => page.evaluate((of) => performance.getEntriesByName(of).map(({startTime, duration}) => startTime + duration - window.pressed), name);
    const own = await ends('series');
    delays.series.push(...own);
    delays.window.push(Math.min(...own, ...await ends('window')));
  }
  await page.context().close();
  return {...delays, samples: 1 + Math.round(job.summary.timeReachedS / 5e-6)};
}

/** A map of 10,000 cells: its first drawing, and the longest that the page is busy while cells come. */
async function largeMap() {
  const base = {bodies: [{name: 'a', massKg: 1}], endTimeS: 1e-3, output: {ledgerOnly: true}};
  const axis = (field) => ({field: `bodies[0].${field}`, linear: {low: 0.1, high: 1, count: 100}});
  const {name} = await server.call('CreateJob', {job: {sweep: {base, metrics: ['final_bodies[a].position_m'], axes: [axis('velocity_m_per_s'), axis('position_m')]}}});
  const id = name.replace('jobs/', '');
  const page = await openPage(browser, server);
  await page.addInitScript(() => {
    window.busy = [];
    new PerformanceObserver((list) => window.busy.push(...list.getEntries().map(({duration}) => duration))).observe({type: 'longtask', buffered: true});
  });
  await page.goto(`${server.origin}/runs/${id}`);
  await page.waitForFunction(() => document.querySelector('[data-filled="10000"]'));
  await page.waitForTimeout(300);
  const busy = await page.evaluate(() => window.busy);
  const draws = [];
  for (let i = 0; i < 8; ++i) {
    await page.getByLabel('Show').selectOption('parallel');
    await page.locator('[data-plot="parallel"]').waitFor();
    await page.waitForTimeout(300);
    draws.push(await page.evaluate(async () => {
      const choice = [...document.querySelectorAll('label')].find((l) => l.textContent.startsWith('Show')).querySelector('select');
      const start = performance.now();
      choice.value = 'map';
      choice.dispatchEvent(new Event('change', {bubbles: true}));
      for (;;) {
        await new Promise((resolve) => { requestAnimationFrame(() => setTimeout(resolve)); });
        if (document.querySelector('[data-plot="map"] .map')) return performance.now() - start;
      }
    }));
  }
  await page.context().close();
  return {busy: Math.max(0, ...busy), draws};
}

report('first load of the list, gzip', await loaded('/runs'), 70, 'kB');
report('first load of a run, gzip', await loaded(`/runs/${await server.submit(CHAIN)}`), 200, 'kB', 'no limit of the issue');
const paints = await firstPaints('/runs');
report('first paint, median', quantile(paints, 0.5), 500, 'ms', `largest ${Math.max(...paints).toFixed(0)}`);
const live = await eventToPixel();
report('cycle at the server to pixel, p95', p95(live), 150, 'ms', `median ${quantile(live, 0.5).toFixed(0)}, ${live.length} cycles`);
const rowDelays = await jobToRow();
report('new job to its row, p95', p95(rowDelays), 150, 'ms', `median ${quantile(rowDelays, 0.5).toFixed(0)}`);
const zoom = await zooming();
report('zoom into a long run, p95', p95(zoom.window), 100, 'ms', `median ${quantile(zoom.window, 0.5).toFixed(0)}, ${zoom.samples} samples`);
report('its own samples, p95', p95(zoom.series), 100, 'ms', `no limit of the issue, median ${quantile(zoom.series, 0.5).toFixed(0)}`);
const map = await largeMap();
report('first drawing of 10,000 cells, p95', p95(map.draws), 200, 'ms', `no limit of the issue, median ${quantile(map.draws, 0.5).toFixed(0)}`);
report('longest task while 10,000 cells come', map.busy, 400, 'ms', 'no limit of the issue');
const pages = await paging();
report('page of 10,000 runs, p95', p95(pages), 100, 'ms', `median ${quantile(pages, 0.5).toFixed(0)}`);

await browser.close();
await server.close();
process.exit(rows.every(Boolean) ? 0 : 1);
