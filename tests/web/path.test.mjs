// The way of a user through the dashboard, in a real browser against a real contactd.

import assert from 'node:assert/strict';
import {after, afterEach, before, beforeEach, test} from 'node:test';

import {AskingServer, CHAIN, openBrowser, openPage, Server, swinging, until} from './harness.mjs';

// Twenty seconds or so. A chunk of 256 samples comes about every half second.
const LONG = {...swinging(2, {method: 'RK4', stepS: 1e-7}), output: {sampleIntervalS: 5e-5}};
let server;
let browser;
let page;
before(async () => { [server, browser] = await Promise.all([new Server('--workers=2').start(), openBrowser()]); });
after(async () => { await browser?.close(); await server?.close(); });
beforeEach(async () => { page = await openPage(browser, server); });
afterEach(async () => {
  assert.deepEqual(page.faults, []);
  await page.context().close();
});

const open = (path) => page.goto(server.origin + path);
const idOf = () => new URL(page.url()).pathname.split('/')[2];
const state = () => page.locator('.head .badge').innerText();
const points = (plot) => page.locator(`[data-plot="${plot}"]`).getAttribute('data-points').then(Number);
const ofAddress = (name) => new URL(page.url()).searchParams.get(name);
const hold = (what) => until(what, what.toString());
const stop = async (id) => { await server.call('CancelJob', {name: `jobs/${id}`}); await server.ended(id); };
/** Times and forces of a curve of the force plot. */
async function forcePoints(curve) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByLabel('Contact force as CSV').click()]);
  const chunks = [];
  for await (const chunk of await download.createReadStream()) chunks.push(chunk);
  const rows = Buffer.concat(chunks).toString().split('\n').filter((row) => row.startsWith(`${curve},`));
  return rows.map((row) => row.split(',').slice(1).map(Number));
}

test('an empty server leads to a first run from a template', async () => {
  await open('/');
  await page.getByText('No runs yet.').waitFor();
  await page.getByRole('link', {name: 'New run'}).first().click();
  await page.getByRole('button', {name: "Newton's cradle"}).click();
  assert.equal(ofAddress('template'), 'newton-cradle');
  await page.getByText('The server accepts it.').waitFor();
  await page.getByRole('button', {name: 'Start the run'}).click();
  await page.getByText('SUCCEEDED').first().waitFor();
  await hold(async () => await points('force') > 100);
  assert.equal(await page.locator('h1').innerText(), "Newton's cradle");
  assert.ok(await points('residual') >= 3);
});

test('numbers of the ledger equal those of the API, digit for digit', async () => {
  const id = await server.submit(CHAIN);
  const job = await server.ended(id);
  await open(`/runs/${id}`);
  const rows = page.getByLabel('Cycle ledger').locator('tbody tr');
  await rows.nth(1).waitFor();
  for (const [i, cycle] of job.cycles.entries()) {
    const cells = await rows.nth(i).locator('td').allInnerTexts();
    for (const field of ['mu', 'restitutionOut', 'peakForceN', 'turnTimeS', 'workRestitutionJ', 'identityResidual']) {
      assert.ok(cells.includes(String(cycle[field])), `${field} ${cycle[field]} in ${cells}`);
    }
  }
  await page.getByLabel('Details').getByText(String(job.finalBodies[2].velocityMPerS)).waitFor();
});

test('a stream that is slower than the job itself takes nothing of it away', async () => {
  const id = await server.submit(CHAIN);
  const job = await server.ended(id);
  let answers = 0;
  let asked;
  const twice = new Promise((resolve) => { asked = resolve; });
  page.on('response', (response) => { if (response.url().endsWith('/GetJob') && ++answers === 2) asked(); });
  await page.route('**/WatchJob', async (route) => { await twice; await route.continue(); });
  await open(`/runs/${id}`);
  await page.getByLabel('Details').getByText(String(job.finalBodies[2].velocityMPerS)).waitFor();
  await hold(async () => await points('residual') >= 3);   // The stream has come.
  assert.match(await page.getByLabel('Details').innerText(), new RegExp(String(job.finalBodies[2].velocityMPerS)));
});

test('a run is watched while it converges, and is cancelled', async () => {
  const id = await server.submit(LONG);
  await open(`/runs/${id}`);
  await hold(async () => await points('mu') > 0 && await points('force') > 10);
  assert.match(await state(), /RUNNING/);
  const text = () => page.getByLabel('Cycle ledger').locator('.tools').innerText();
  const [before, end] = [await text(), await page.locator('progress').getAttribute('value')];
  await hold(async () => await text() !== before && await page.locator('progress').getAttribute('value') > end);
  const told = await page.evaluate(() => [Math.floor(100 * document.querySelector('progress').value), Number(/(\d+) %/.exec(document.querySelector('.facts').textContent)[1])]);
  assert.equal(told[0], told[1], 'the bar and the words tell the same');
  await page.getByRole('button', {name: 'Cancel run …'}).click();
  await page.getByRole('button', {name: 'Go on'}).click();
  assert.match(await state(), /RUNNING/);
  await page.getByRole('button', {name: 'Cancel run …'}).click();
  await page.getByRole('button', {name: 'Cancel for good'}).click();
  await hold(async () => /CANCELLED/.test(await state()));
  assert.equal((await server.ended(id)).state, 'CANCELLED');
});

test('a window follows the newest samples of a run', async () => {
  const id = await server.submit({...LONG, output: {sampleIntervalS: 1e-5}});   // So close that a window has some of the last chunk.
  await open(`/runs/${id}?from=0&to=0.01&follow=1`);
  const shown = () => page.getByLabel('Motion', {exact: true}).locator('.tools .mono').innerText().then((t) => Number(t.split(' ')[0]));
  await hold(async () => await shown() > 0.005);
  const first = await shown();
  await hold(async () => await shown() > first && await points('force') > 2);
  await stop(id);
});

test('a zoom asks the server again, and no peak is lost', async () => {
  const id = await server.submit({...swinging(3.5), output: {sampleIntervalS: 1e-5}});
  const job = await server.ended(id);
  await open(`/runs/${id}`);
  await hold(async () => await points('force') > 1000);
  const peak = async () => Math.max(...(await forcePoints('ball-wall')).map(([, force]) => force));
  const {columns} = await server.call('GetSeries', {name: `jobs/${id}`, channels: ['ball-wall.contact_force'], decimation: 'RAW', endTimeS: 0.1});
  const recorded = Buffer.from(columns[1].values, 'base64');
  let largest = 0;
  for (let i = 0; i < recorded.length; i += 8) largest = Math.max(largest, recorded.readDoubleLE(i));
  assert.equal(await peak(), largest);
  const canvas = page.locator('[data-plot="force"] .u-over');
  const box = await canvas.boundingBox();
  await page.mouse.move(box.x + 40, box.y + 60);   // Back to time 0: the first peak is the largest.
  await page.mouse.down();
  await page.mouse.move(box.x, box.y + 60, {steps: 4});
  await page.mouse.up();
  await hold(() => ofAddress('from') !== null);
  assert.ok(Number(ofAddress('to')) < 0.5 * job.summary.timeReachedS);
  await page.waitForTimeout(500);
  assert.equal(await peak(), largest);
  await page.getByRole('button', {name: 'All', exact: true}).click();
  assert.equal(ofAddress('from'), null);
});

test('a window that was shown before is shown again without the server', async () => {
  const id = await server.submit({...swinging(1), output: {sampleIntervalS: 1e-4}});
  await server.ended(id);
  await open(`/runs/${id}`);
  await hold(async () => await points('force') > 1000);
  const whole = await forcePoints('ball-wall');
  let asked = 0;
  const count = (request) => { asked += request.url().endsWith('GetSeries'); };
  page.on('request', count);
  await page.keyboard.press('+');
  await hold(async () => asked === 1 && JSON.stringify(await forcePoints('ball-wall')) !== JSON.stringify(whole));
  await page.keyboard.press('-');
  await hold(async () => JSON.stringify(await forcePoints('ball-wall')) === JSON.stringify(whole));
  assert.equal(ofAddress('from'), null);
  await page.keyboard.press('+');
  await hold(() => ofAddress('from') !== null);
  await page.waitForTimeout(300);
  assert.equal(asked, 1);
  page.off('request', count);
});

test('zooms faster than the server answers end with the last window', async () => {
  const id = await server.submit(CHAIN);
  const {summary: {timeReachedS}} = await server.ended(id);
  await open(`/runs/${id}`);
  await hold(async () => await points('force') > 100);
  const calls = {asked: 0, answered: 0};
  let release;
  const pressed = new Promise((resolve) => { release = resolve; });
  await page.route('**/GetSeries', async (route) => {
    ++calls.asked;
    await pressed;
    await route.fulfill({response: await route.fetch()});
    ++calls.answered;
  });
  for (let i = 0; i < 4; ++i) await page.keyboard.press('+');
  const range = () => [Number(ofAddress('from')), Number(ofAddress('to'))];
  await hold(() => range()[1] - range()[0] < 0.07 * timeReachedS);
  release();
  await hold(() => calls.answered === 2);
  await page.waitForTimeout(500);   // Chromium begins ten downloads a second and drops others without a word: one look.
  const [startTimeS, endTimeS] = range();
  const recorded = await server.call('GetSeries', {name: `jobs/${id}`, channels: ['B1-B2.contact_force'], decimation: 'RAW', startTimeS, endTimeS, plainNumbers: true});
  const [times, forces] = recorded.columns.map(({numbers}) => numbers);
  assert.ok(times.length > 10);
  assert.deepEqual(await forcePoints('B1-B2'), times.map((time, i) => [time, forces[i]]));
  assert.deepEqual(calls, {asked: 2, answered: 2}, 'the first window and the last');
  await page.unrouteAll();
});

test('a zoom whose answer is lost is asked for again', async () => {
  const id = await server.submit(CHAIN);
  await server.ended(id);
  await open(`/runs/${id}`);
  await hold(async () => await points('force') > 100);
  const whole = await points('force');
  await page.route('**/GetSeries', (route) => route.abort(), {times: 1});
  await page.keyboard.press('+');
  await hold(async () => await points('force') < whole);
});

test('one cursor reads all plots', async () => {
  const id = await server.submit(CHAIN);
  await server.ended(id);
  await open(`/runs/${id}`);
  await hold(async () => await points('force') > 100 && await points('velocity') > 100);
  await page.setViewportSize({width: 1280, height: 2600});   // Plots are drawn where they can be seen.
  const box = await page.locator('[data-plot="force"] .u-over').boundingBox();
  await page.mouse.move(box.x + box.width / 4, box.y + 50);
  for (const plot of ['force', 'velocity', 'deformation', 'displacement', 'energy']) {
    await hold(async () => /\d/.test(await page.locator(`[data-plot="${plot}"] output`).first().innerText()));
  }
  assert.match(await page.locator('[data-plot="deformation"] .key').innerText(), /B1-B2\s+−?-?[\d.]{3,8}\s.*\sµm$/s, 'few digits in the unit of the axis');
  assert.equal(await page.locator('[data-plot="force"] .u-cursor-pt').first().evaluate((ring) => getComputedStyle(ring).backgroundColor), 'rgba(0, 0, 0, 0)', 'curves are seen through the cursor');
});

/** Saves a figure in each of its forms; what comes must be of that form. */
async function saved(title) {
  for (const [kind, begins] of [['SVG', '<svg'], ['PNG', '\x89PNG'], ['CSV', '']]) {
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', {name: `${title} as ${kind}`}).click()]);
    const chunks = [];
    for await (const chunk of await download.createReadStream()) chunks.push(chunk);
    const text = Buffer.concat(chunks).toString('latin1');
    assert.ok(text.startsWith(begins) && text.length > 100, `${title} as ${kind}`);
  }
}

test('every plot is saved as SVG, PNG and CSV', async () => {
  const id = await server.submit(CHAIN);
  await server.ended(id);
  await open(`/runs/${id}?plots=all`);
  await hold(async () => await points('force') > 100);
  const plots = await page.locator('.plot').count();
  assert.ok(plots >= 10);
  for (const kind of ['SVG', 'PNG', 'CSV']) assert.equal(await page.locator('.exports').getByText(kind, {exact: true}).count(), plots);
  for (const at of [2, 6]) await saved(await page.locator('.plot h3').nth(at).innerText());
});

test('the strip plays, pauses and is scrubbed', async () => {
  const id = await server.submit(CHAIN);
  await server.ended(id);
  await open(`/runs/${id}`);
  await hold(async () => await points('force') > 100);
  const moment = () => page.getByLabel('Bodies in motion').locator('output').innerText();
  await page.getByRole('button', {name: 'Play'}).click();
  await hold(async () => Number.parseFloat(await moment()) > 0.1);
  await page.getByRole('button', {name: 'Pause'}).click();
  await hold(() => ofAddress('t') !== null);
  await page.getByLabel('moment').fill('0.5');
  assert.equal(await moment(), '2 ms');
  assert.equal(await page.locator('[data-plot="force"] .playhead').isVisible(), true);
});

test('a run is run again with another ε and compared', async () => {
  const id = await server.submit(CHAIN);
  await server.ended(id);
  await open(`/runs/${id}`);
  await page.getByRole('link', {name: 'Run again with changes'}).click();
  const editor = page.getByRole('textbox', {name: /Scenario/});
  await hold(async () => (await editor.inputValue()).includes('restitution: 0.8'));
  await editor.fill((await editor.inputValue()).replace('restitution: 0.8', 'restitution: 0.6'));
  await page.getByText('The server accepts it.').waitFor();
  await page.getByRole('button', {name: 'Start the run'}).click();
  await hold(() => page.url().includes('/runs/') && idOf() !== id);
  const other = idOf();
  await server.ended(other);
  await open('/runs');
  for (const one of [id, other]) await page.getByLabel(`choose ${one}`).check();
  assert.equal(ofAddress('chosen'), `${id},${other}`);
  await page.reload();
  await page.getByRole('link', {name: 'Compare 2 runs'}).click();
  const row = page.getByLabel('Parameters that differ').locator('tbody tr');
  await row.first().waitFor();
  assert.equal(await row.count(), 1);
  assert.deepEqual((await row.locator('td').allInnerTexts()).slice().sort(), ['0.6', '0.8', 'contacts[0].restitution']);
  await page.getByText(/of \d+ differ/).waitFor();
  await hold(async () => await points('B1-B2.contact_force') > 100);
  const curve = () => page.locator('[data-plot="B1-B2.contact_force"] .key').getByRole('button', {name: 'restitution 0.6'});
  await curve().click();
  await hold(() => ofAddress('hide') === 'B1-B2.contact_force:restitution 0.6');
  await page.reload();
  await hold(async () => await curve().getAttribute('aria-pressed') === 'false');
});

test('errors of the page and of the server stand at their lines', async () => {
  await open('/new');
  const editor = page.getByRole('textbox', {name: /Scenario/});
  await page.getByText('The server accepts it.').waitFor();
  const text = await editor.inputValue();
  await editor.fill(text.replace('restitution: 0.8', 'restituton: 0.8'));
  await page.getByText("did you mean 'restitution'?").waitFor();
  assert.equal(await page.locator('.lines .wrong').innerText(), '✗ 11');
  await editor.fill(text.replace('restitution: 0.7', 'restitution: 1.7'));
  await page.getByText('is 1.7; must be in (0, 1]').waitFor();
  assert.equal(await page.locator('.lines .wrong').innerText(), '✗ 12');
  assert.equal(await page.getByRole('button', {name: 'Start the run'}).isDisabled(), true);
  await editor.fill(`${text}solv`);
  await page.getByRole('option', {name: /^solver/}).waitFor();
  await page.keyboard.press('Enter');
  await hold(async () => (await editor.inputValue()).endsWith('solver: '));
  await hold(() => page.url().endsWith('solver%3A%20'));   // The address holds the text.
  await page.reload();
  await hold(async () => (await editor.inputValue()).endsWith('solver: '));
});

test('a sweep is copied for each client', async () => {
  await open('/new?template=table-3-sweep');
  await page.getByText('The server accepts it.').waitFor();
  for (const [client, words] of [['CLI', `contactctl --server ${new URL(server.origin).host} sweep run -`], ['Python', `Client("${new URL(server.origin).host}").sweep(scenario, grid, metrics=["iterations"`], ['curl', '"sweep":']]) {
    await page.getByRole('button', {name: client, exact: true}).click();
    assert.ok((await page.getByLabel('copied text').innerText()).includes(words), client);
  }
});

test('what is copied for curl makes the same job', async () => {
  await open('/new?template=two-balls');
  await page.getByText('The server accepts it.').waitFor();
  await page.getByLabel('Labels').fill('study=copied');
  await page.getByRole('button', {name: 'curl'}).click();
  const [, address, body] = /CreateJob|@- (\S+) <<'END'\n([\s\S]*)\nEND/.exec(await page.getByLabel('copied text').innerText().then((t) => t.slice(t.indexOf('@-'))));
  const answer = await fetch(address, {method: 'POST', headers: {'content-type': 'application/json'}, body});
  assert.equal(answer.status, 200);
  const {title, labels} = await answer.json();
  assert.deepEqual([title, labels], ['Two balls, one collision', {study: 'copied'}]);
});

test('a sweep fills cell by cell, and a cell becomes a run', async () => {
  const base = {...CHAIN, solver: {method: 'RK4', stepS: 5e-8, maxIterations: 6}};
  const {name} = await server.call('CreateJob', {job: {sweep: {base, metrics: ['iterations', 'final_bodies[B3].velocity_m_per_s'],
    axes: [{field: 'bodies[0].velocity_m_per_s', linear: {low: 0.1, high: 0.5, count: 5}}, {field: 'contacts[*].restitution', values: [0.9, 0.8, 0.7, 0.6]}]}}});
  const id = name.replace('jobs/', '');
  await page.addInitScript(() => {
    window.fillings = new Set();
    new MutationObserver(() => window.fillings.add(document.querySelector('[data-cells]')?.dataset.cells))
      .observe(document, {subtree: true, childList: true, attributeFilter: ['data-cells']});
  });
  await open(`/runs/${id}`);
  await hold(async () => await page.locator('[data-plot="map"]').getAttribute('data-filled') === '20');
  const seen = await page.evaluate(() => [...window.fillings].filter(Boolean));
  assert.ok(seen.length > 2, `filled in ${seen}`);
  await page.getByLabel(/^Map of iterations/).focus();
  for (const cell of ['0', '1']) {
    await page.keyboard.press('ArrowRight');
    await hold(() => ofAddress('cell') === cell);
  }
  await page.getByText(/restitution of all contacts \[1\] = 0.8, velocity of B1 \[m\/s\] = 0.1: iterations \d+/).waitFor();
  await saved('map of iterations');
  await page.getByLabel('Show').selectOption('parallel');
  await saved('parallel coordinates');
  await page.getByLabel(/cells as lines/).press('ArrowLeft');
  await hold(() => ofAddress('cell') === '0');
  await page.getByLabel(/cells as lines/).press('ArrowRight');
  await hold(() => ofAddress('cell') === '1');
  await page.getByRole('button', {name: 'Run this cell'}).click();
  await hold(() => idOf() !== id);
  const job = await server.ended(idOf());
  assert.deepEqual(job.labels, {sweep: id, cell: '1'});
  assert.deepEqual([job.scenario.contacts[0].restitution, job.scenario.bodies[0].velocityMPerS], [0.8, 0.1]);
});

test('a page goes on by itself when the server was killed and is back', async () => {
  const id = await server.submit(LONG);
  await open(`/runs/${id}`);
  await page.evaluate(() => { window.sameDocument = true; });
  await hold(async () => await points('force') > 10);
  await server.end('SIGKILL');
  await page.locator('[data-link="waiting"]').waitFor();
  await server.start();
  await page.locator('[data-link="waiting"]').waitFor({state: 'detached'});
  const progress = () => page.locator('progress').getAttribute('value').then(Number);
  const before = await progress();
  await hold(async () => await progress() > before);
  assert.equal(await page.evaluate(() => window.sameDocument), true);
  await stop(id);
  await hold(async () => /CANCELLED/.test(await state()));
});

test('the list of runs is live, filtered and paged', async () => {
  await open('/runs?q=needle');
  await page.getByText('No run matches.').waitFor();
  const id = await server.submit({...CHAIN, title: 'A needle'}, {labels: {place: 'haystack'}});
  await page.getByRole('link', {name: 'A needle'}).waitFor();
  await page.getByText('place=haystack').waitFor();
  await server.ended(id);
  await server.call('DeleteJob', {name: `jobs/${id}`});
  await page.getByText('No run matches.').waitFor();
});

test('a server that wants a token is given one, which nothing shows', async () => {
  const asking = await new AskingServer().start();
  const own = await openPage(browser, asking);
  const {token} = asking;
  try {
    await own.goto(`${asking.origin}/runs`);
    const field = own.getByLabel(/Token/i);
    const use = own.getByRole('button', {name: 'Use it'});
    await own.getByText('This server asks who calls').waitFor();
    await field.fill(`${token.slice(0, -1)}b`);
    await use.click();
    await own.getByText('does not take this token').waitFor();
    await field.fill(token);
    await use.click();
    await own.getByText('No runs yet.').waitFor();
    await own.getByRole('link', {name: 'New run'}).first().click();
    await own.getByText('The server accepts it.').waitFor();
    await own.getByRole('button', {name: 'Start the run'}).click();
    await own.getByText('SUCCEEDED').first().waitFor();
    await own.getByText('ada', {exact: true}).waitFor();   // The owner of the run.
    assert.ok(!own.url().includes('ctk_'));
    assert.ok(!await own.evaluate(() => JSON.stringify(localStorage) + document.cookie).then((kept) => kept.includes('ctk_')));
    assert.ok(!asking.written().includes(token), 'in no log');
    assert.match(asking.written(), /CreateJob/);
  } finally {
    await own.context().close();
    await asking.close();
  }
  assert.deepEqual(own.faults, []);
});
