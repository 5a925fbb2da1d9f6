// What the pages show and choose among, in a real browser against a real contactd.

import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {after, afterEach, before, beforeEach, test} from 'node:test';

import {CHAIN, openBrowser, openPage, Server, swinging, until} from './harness.mjs';

// Twenty seconds or so, of which samples come some times a second.
const LONG = {...swinging(2, {method: 'RK4', stepS: 1e-7}), output: {sampleIntervalS: 5e-5}};
const BALL = {title: 'A ball alone', bodies: [{name: 'a', massKg: 1}], endTimeS: 1e-3, output: {ledgerOnly: true}};
let server;
let browser;
let page;
let chain;   // A run that has ended.
before(async () => {
  [server, browser] = await Promise.all([new Server('--workers=2', '--max-creates-per-second=0').start(), openBrowser()]);
  chain = await server.submit(CHAIN);
  await server.ended(chain);
});
after(async () => { await browser?.close(); await server?.close(); });
beforeEach(async () => { page = await openPage(browser, server); });
afterEach(async () => {
  assert.deepEqual(page.faults, []);
  await page.context().close();
});

const open = (path) => page.goto(server.origin + path);
const hold = (what) => until(what, what.toString());
const ofAddress = (name) => new URL(page.url()).searchParams.get(name);
const points = (plot) => page.locator(`[data-plot="${plot}"]`).getAttribute('data-points').then(Number);
const drawn = () => hold(async () => await points('force') > 100);
/** The text of a plot's file. */
async function fileOf(title, kind) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByLabel(`${title} as ${kind}`).click()]);
  const chunks = [];
  for await (const chunk of await download.createReadStream()) chunks.push(chunk);
  return Buffer.concat(chunks).toString();
}
const stop = async (id) => { await server.call('CancelJob', {name: `jobs/${id}`}); await server.ended(id); };
const refuse = (method) => page.route(`**/${method}`, (route) => route.fulfill({
  status: 503, contentType: 'application/json', body: JSON.stringify({code: 'unavailable', message: 'The store is full.'})}));

test('the list of runs turns its pages and tells how many match', async () => {
  const rows = page.locator('.runs tbody tr');
  await Promise.all(Array.from({length: 60}, (_, i) => server.submit(BALL, {labels: {half: i % 2 ? 'odd' : 'even'}})));
  const missed = await server.submit({...swinging(0.035, {maxIterations: 1}), title: 'Missed'});
  await server.ended(missed);
  await open('/runs?q=alone');
  await page.getByText('page 1 of 2, 60 runs').waitFor();
  assert.equal(await rows.count(), 50);
  await page.getByRole('button', {name: 'Older ›'}).click();
  await page.getByText('page 2 of 2, 60 runs').waitFor();
  assert.deepEqual([await rows.count(), ofAddress('page')], [10, '2']);
  await page.getByLabel('Label', {exact: true}).fill('half=odd');
  await page.keyboard.press('Enter');
  await page.getByText('page 1 of 1, 30 runs').waitFor();
  await open('/runs');
  await page.getByLabel('State').selectOption('NOT_CONVERGED');
  await page.getByText('page 1 of 1, 1 run').waitFor();
  assert.match(await rows.innerText(), /Missed.*NOT CONVERGED/s);
  await page.getByLabel('State').selectOption('FAILED');
  await page.getByText('No run matches.').waitFor();
});

test('chosen runs are labelled together, and keep their other labels', async () => {
  const ids = await Promise.all(['a', 'b'].map((own) => server.submit(BALL, {labels: {own, trial: '1'}})));
  await open('/runs?label=trial%3D1');
  for (const id of ids) await page.getByLabel(`choose ${id}`).check();
  await page.getByRole('button', {name: 'Label 2 runs …'}).click();
  const labels = page.getByRole('form', {name: 'Labels of the chosen runs'}).getByLabel('Labels');
  await labels.fill('study=first, good');
  await labels.press('Enter');
  await page.getByText('good: write key=value to give a label, key- to take one away').waitFor();
  await refuse('UpdateJob');
  await labels.fill('study=first trial-');
  await labels.press('Enter');
  await page.getByText('2 of 2: The store is full.').waitFor();
  assert.equal(await labels.inputValue(), 'study=first trial-', 'what was typed stays');
  await page.unroute('**/UpdateJob');
  await labels.press('Enter');
  await page.getByText('No run matches.').waitFor();   // They have the label of the filter no more.
  const kept = await Promise.all(ids.map((id) => server.call('GetJob', {name: `jobs/${id}`})));
  assert.deepEqual(kept.map((job) => job.labels), [{own: 'a', study: 'first'}, {own: 'b', study: 'first'}]);
});

test('chosen runs that go on are cancelled together, when that is said twice', async () => {
  const ids = await Promise.all([1, 2].map(() => server.submit(LONG, {labels: {trial: 'stop'}})));
  await open('/runs?label=trial%3Dstop');
  for (const id of ids) await page.getByLabel(`choose ${id}`).check();
  await page.getByRole('button', {name: 'Cancel 2 runs …'}).click();
  await page.getByRole('button', {name: 'Cancel them for good'}).click();
  assert.deepEqual(await Promise.all(ids.map(async (id) => (await server.ended(id)).state)), ['CANCELLED', 'CANCELLED']);
});

test('runs are grouped by a label, which stands in the address, and are saved as CSV', async () => {
  for (const law of ['exact', 'flores', 'exact', undefined]) await server.submit({...BALL, title: 'Grouped, "so"'}, {labels: law ? {law} : {}});
  await open('/runs?q=grouped');
  await page.getByText('page 1 of 1, 4 runs').waitFor();
  await page.getByLabel(/^Group/).selectOption('by label law');
  const heads = page.locator('.runs th[scope=rowgroup]');
  await hold(async () => (await heads.allInnerTexts()).join('; ') === 'law –, 1; law exact, 2; law flores, 1');
  assert.equal(ofAddress('group'), 'label:law');
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', {name: 'List as CSV'}).click()]);
  const chunks = [];
  for await (const chunk of await download.createReadStream()) chunks.push(chunk);
  const rows = Buffer.concat(chunks).toString().split('\n');
  assert.match(rows[0], /^job,title,state,convergence,labels,note,/);
  assert.equal(rows.length, 6);
  assert.match(rows[2], /^jobs\/\w+,"Grouped, ""so""",\w+,\w+,law=exact,,/);
  await page.getByLabel(/^Group/).selectOption('by title');
  await hold(async () => (await heads.allInnerTexts()).join() === 'Grouped, "so", 4');
});

test('a run is renamed on its page, and pinned at the top of the list until it is unpinned', async () => {
  const first = await server.submit({...BALL, title: 'Sphere one'});
  await server.submit({...BALL, title: 'Sphere two'});
  await open(`/runs/${first}`);
  await page.getByRole('button', {name: 'Rename, add labels or a note'}).click();
  await page.getByRole('textbox', {name: 'Title'}).fill('Sphere named');
  await page.getByRole('button', {name: 'Store'}).click();
  await page.getByRole('heading', {name: 'Sphere_named'}).waitFor();
  await hold(async () => await page.title() === 'Sphere_named · contactd');
  const labels = async () => (await server.call('GetJob', {name: `jobs/${first}`})).labels;
  assert.deepEqual(await labels(), {title: 'Sphere_named'});
  await open(`/runs?q=sphere&sort=title&chosen=${first}`);
  const order = async () => (await page.locator('.runs td.title a').allInnerTexts()).join();
  await hold(async () => await order() === 'Sphere two,Sphere_named');
  await page.getByRole('button', {name: 'Pin 1 run'}).click();
  await hold(async () => await order() === 'Sphere_named,Sphere two');
  await page.reload();
  await page.getByRole('button', {name: 'Unpin 1 run'}).click();
  await hold(async () => await order() === 'Sphere two,Sphere_named');
  assert.deepEqual(await labels(), {title: 'Sphere_named'});
});

test('a note is written on the page of a run, stays while it is not stored, and stands in the list', async () => {
  const id = await server.submit({...BALL, title: 'Noted'});
  await open(`/runs/${id}`);
  await page.getByRole('button', {name: 'Add labels or a note'}).click();
  await page.getByRole('textbox', {name: 'Note'}).fill('Good.\nBut ε is off.');
  await page.getByRole('textbox', {name: 'Labels'}).fill('law=x');
  await page.reload();
  assert.equal(await page.getByRole('textbox', {name: 'Note'}).inputValue(), 'Good.\nBut ε is off.');
  await refuse('UpdateJob');
  await page.getByRole('button', {name: 'Store'}).click();
  await page.getByText('The store is full.').waitFor();
  await page.unroute('**/UpdateJob');
  await page.getByRole('button', {name: 'Store'}).click();
  await page.getByRole('button', {name: 'Change labels and note'}).waitFor();
  assert.match(await page.getByRole('region', {name: 'Labels and note'}).innerText(), /law=x\s+Good\.\nBut ε is off\./);
  await open('/runs?q=off');
  await page.locator('.runs').getByText('Good. …').waitFor();
  await page.goto(`${server.origin}/runs/${id}`);
  await page.getByRole('button', {name: 'Change labels and note'}).click();
  await page.getByRole('textbox', {name: 'Note'}).fill('');
  await page.getByRole('button', {name: 'Drop changes'}).click();
  await page.getByText('But ε is off.').waitFor();
});

test('a note that is stored is seen on other pages of the run that are open', async () => {
  const id = await server.submit({...BALL, title: 'Noted twice'});
  await open(`/runs/${id}`);
  const other = await page.context().newPage();
  await other.goto(`${server.origin}/runs/${id}`);
  await other.getByRole('button', {name: 'Add labels or a note'}).waitFor();
  await page.getByRole('button', {name: 'Add labels or a note'}).click();
  await page.getByRole('textbox', {name: 'Note'}).fill('Seen elsewhere.');
  await page.getByRole('button', {name: 'Store'}).click();
  await other.getByText('Seen elsewhere.').waitFor();
});

test('runs are chosen by when they were created, for everybody who has the address', async () => {
  await open('/runs?after=2020-01-01T00:00Z');
  await page.getByText(/page 1 of \d+, \d+ runs/).waitFor();
  await page.getByLabel('before').fill('2020-01-02T00:00');
  await page.getByText('No run matches.').waitFor();
  assert.equal(ofAddress('before'), new Date('2020-01-02T00:00').toISOString().replace(':00.000Z', 'Z'));
  await page.reload();
  await page.getByText('No run matches.').waitFor();
  assert.equal(await page.getByLabel('before').inputValue(), '2020-01-02T00:00');
});

test('a run is deleted when that is said twice', async () => {
  const id = await server.submit(BALL);
  await server.ended(id);
  await open(`/runs/${id}`);
  await page.getByRole('button', {name: 'Delete …'}).click();
  await page.getByRole('button', {name: 'Keep'}).click();
  await page.getByRole('button', {name: 'Delete …'}).click();
  await page.getByRole('button', {name: 'Delete for good'}).click();
  await hold(() => new URL(page.url()).pathname === '/runs');
  await assert.rejects(server.call('GetJob', {name: `jobs/${id}`}), /not_found/);
});

test('runs that look alike are told apart by a column, and are deleted together', async () => {
  const ids = await Promise.all([0.25, 0.75].map((velocityMPerS) => server.submit({...BALL, title: 'Alike', bodies: [{name: 'a', massKg: 1, velocityMPerS}]})));
  for (const id of ids) await server.ended(id);
  await open('/runs?q=alike');
  const field = 'bodies[0].velocity_m_per_s';
  const column = page.getByLabel(/^Column/);
  await column.focus();
  await column.locator('option', {hasText: field}).waitFor({state: 'attached'});
  await column.selectOption(field);
  await page.getByRole('cell', {name: '0.75', exact: true}).waitFor();
  await page.reload();
  await page.getByRole('cell', {name: '0.25', exact: true}).waitFor();
  await page.getByLabel(`remove column ${field}`).click();
  assert.equal(ofAddress('fields'), null);
  for (const id of ids) await page.getByLabel(`choose ${id}`).check();
  await page.getByRole('button', {name: 'Delete 2 runs …'}).click();
  await page.getByRole('button', {name: 'Delete them for good'}).click();
  await page.getByText('No run matches.').waitFor();
  await hold(() => ofAddress('chosen') === null);
  for (const id of ids) await assert.rejects(server.call('GetJob', {name: `jobs/${id}`}), /not_found/);
});

test('a window that follows goes on to follow after a zoom', async () => {
  const id = await server.submit({...LONG, output: {sampleIntervalS: 1e-5}});   // So close that a window has some of the last chunk.
  await open(`/runs/${id}?from=0&to=0.01&follow=1`);
  const shown = () => page.getByLabel('Motion', {exact: true}).locator('.tools .mono').innerText().then((text) => text.match(/[\d.e-]+/g).map(Number));
  await hold(async () => await points('force') > 2 && (await shown())[0] > 0.002);
  await page.keyboard.press('+');
  await hold(() => Number(ofAddress('to')) - Number(ofAddress('from')) < 0.006);
  const [from, to] = await shown();
  assert.ok(to - from < 0.006 && ofAddress('follow') === '1');
  await hold(async () => (await shown())[0] > from);
  await stop(id);
});

test('the ledger shows what its filters choose', async () => {
  await open(`/runs/${chain}`);
  const ledger = page.getByLabel('Cycle ledger');
  const rows = ledger.locator('tbody tr');
  await hold(async () => await rows.count() === 2);
  await ledger.getByLabel('Contact').selectOption('B2-B3');
  await hold(async () => await rows.count() === 1);
  assert.match(await rows.innerText(), /^B2-B3/);
  await ledger.getByText('1 of 2').waitFor();
  await ledger.getByLabel('Show').selectOption('groups');
  await ledger.getByText('encounter').waitFor();
  await ledger.getByLabel('Status').selectOption('CONVERGED');
  await hold(() => ofAddress('status') === 'CONVERGED');
  assert.equal(await rows.count(), 1);
});

test('the ledger names larger μ that solve a group, too', async () => {
  const id = await server.submit(JSON.parse(readFileSync(new URL('../reference/cases/f4-two-answers-press40024-a.json', import.meta.url), 'utf8')));
  await server.ended(id);
  await open(`/runs/${id}?ledger=groups`);
  await hold(async () => /\s5\d{7}\.\d+$/.test(await page.getByLabel('Cycle ledger').locator('tbody tr').first().innerText()));
});

test('a loop of a short contact in a long run is round', async () => {
  const id = await server.submit({title: 'Bouncing ball', bodies: [{name: 'ball', massKg: 0.5, radiusM: 0.05, positionM: 1}],
    contacts: [{name: 'floor', between: ['ball'], wall: {positionM: 0, side: 'LEFT'}, stiffness: 1e8, restitution: 0.8}],
    loads: [{gravity: {accelerationMPerS2: -9.81}}], endTimeS: 3, output: {sampleIntervalS: 5e-5}});
  await server.ended(id);
  await open(`/runs/${id}`);
  await drawn();
  await hold(async () => (await fileOf('Hysteresis', 'CSV')).split('\n').filter((row) => row.startsWith('floor,')).length > 20);
});

test('a saved figure names all its curves, and holds all its words', async () => {
  for (const width of [1280, 400]) {
    await page.setViewportSize({width, height: 900});
    await open(`/runs/${chain}`);
    await drawn();
    const figure = await fileOf('Contact force', 'SVG');
    const words = await page.evaluate((text) => {
      const drawing = document.body.appendChild(Object.assign(document.createElement('div'), {innerHTML: text})).firstChild;
      return [...drawing.querySelectorAll('text')].map((word) => ({text: word.textContent, end: word.getBoundingClientRect().right - drawing.getBoundingClientRect().right,
        below: word.getBoundingClientRect().bottom - drawing.getBoundingClientRect().bottom}));
    }, figure);
    for (const curve of ['B1-B2', 'B2-B3', 'B1-B2 equivalent external', 'B2-B3 equivalent external']) assert.ok(words.some(({text}) => text === curve), `${curve} at ${width}`);
    assert.equal(figure.match(/<rect [^>]*height="8"/g).length, 2, 'a bar for each group');
    assert.deepEqual(words.filter(({end, below}) => end > 0 || below > 0), [], `at ${width}`);
  }
});

test('the page of the server tells what waits and what runs', async () => {
  const ids = await Promise.all([LONG, LONG, LONG].map((scenario) => server.submit(scenario)));
  await open('/server');
  const tile = (name) => page.locator('.tile', {hasText: name}).innerText().then((text) => text.replace(/\s+/g, ' '));
  await hold(async () => /queued 1 of/.test(await tile('queued')) && /running 2 of 2 workers/.test(await tile('running')));
  await Promise.all(ids.map(stop));
  await hold(async () => /queued 0/.test(await tile('queued')) && /running 0/.test(await tile('running')));
});

test('the passes of an episode stand in a table that keys open', async () => {
  const {cycles} = await server.call('GetJob', {name: `jobs/${chain}`});
  await open(`/runs/${chain}`);
  await page.getByText('Passes in numbers').press('Enter');
  const rows = page.getByLabel('Passes', {exact: true}).locator('tbody tr');
  await hold(async () => await rows.count() >= 4);
  assert.equal(ofAddress('passes'), '1');
  const accepted = rows.filter({hasText: 'accepted'});
  assert.deepEqual(await accepted.locator('td:nth-child(4)').allInnerTexts(), cycles.map(({mu}) => String(mu)));
  assert.match(await rows.first().innerText(), /^1\s+0\s+B1-B2 #1\s.*NEWTON/s);
});

test('keys move the moment, and every plot over time tells its values there', async () => {
  await open(`/runs/${chain}`);
  await drawn();
  await page.getByLabel('moment').focus();
  await page.keyboard.press('PageUp');   // A tenth of all.
  for (const [plot, words] of [['force', /^Contact force, force \[N\], at 0\.0004\d* s: B1-B2 \d/], ['velocity', /^Velocity.*B1 0\.\d/], ['energy', /^Energy balance, energy \[mJ\].*kinetic \d/]]) {
    const figure = page.locator(`[data-plot="${plot}"]`);
    await hold(async () => words.test(await figure.locator('> output').textContent()));
    assert.match(await figure.locator('.key output').first().innerText(), /\d/);
  }
});

test('a job of an older server has all its plots but that of energies, which says why', async () => {
  await page.route('**/GetSeries', async (route) => {
    if (!route.request().postDataBuffer().includes('system.kinetic_energy')) return route.continue();
    const unknown = JSON.stringify({name: `jobs/${chain}`, channels: ['system.not_recorded_then']});
    return route.fulfill({response: await page.request.post(`${server.origin}/contact.v1.JobService/GetSeries`, {data: unknown, headers: {'content-type': 'application/json'}})});
  });
  await open(`/runs/${chain}`);
  await drawn();
  await page.locator('[data-plot="energy"]').getByText('This run recorded no energies').waitFor();
  await page.unrouteAll();
  await page.reload();
  await hold(async () => await points('energy') > 100);
  const curves = await page.locator('[data-plot="energy"] .key button').allInnerTexts();
  assert.deepEqual(curves.map((text) => text.trim()), ['kinetic', 'contacts', 'dissipated', 'sum less load work']);
  const sums = (await fileOf('Energy balance', 'CSV')).split('\n').filter((row) => row.startsWith('sum')).map((row) => Number(row.split(',')[2]));
  assert.ok(Math.max(...sums) - Math.min(...sums) < 1e-9 * 0.5 * 0.5 * 0.2 ** 2, 'the balance is constant');
});

test('plots, their order, powers of ten and Δμ/μ are chosen, and stand in the address', async () => {
  await open(`/runs/${chain}`);
  await drawn();
  const shown = () => page.locator('[aria-label="Motion"] .plot').evaluateAll((plots) => plots.map((plot) => plot.dataset.plot).join());
  await page.getByText('Choose plots').click();
  for (const name of ['Velocity', 'Deformation', 'Displacement', 'Hysteresis', 'Contact force']) await page.getByLabel(name, {exact: true}).uncheck();
  await hold(async () => await shown() === 'energy');
  await page.getByLabel('Contact force', {exact: true}).check();
  await hold(async () => await shown() === 'energy,force');
  assert.equal(ofAddress('plots'), 'energy,force');
  await page.getByRole('button', {name: 'Contact force, log scale'}).click();
  await page.locator('[data-plot="force"] .note').getByText('of what is above 0').waitFor();
  await page.getByLabel('Δμ/μ').check();
  await page.locator('[data-plot="mu"] .note').getByText('from the last pass').waitFor();
  await page.reload();
  await hold(async () => await shown() === 'energy,force' && await points('force') > 100);
  assert.deepEqual([ofAddress('logs'), ofAddress('relative')], ['force', '1']);
  assert.match(await fileOf('Contact force', 'SVG'), />10[⁰¹²³⁴⁻]+</);
  assert.match(await fileOf('Damping factor', 'CSV'), /^curve,pass,Δμ\/μ \[1\]/);
});

test('a formula of columns is plotted, stands in the address, and is taken away', async () => {
  await open(`/runs/${chain}`);
  await drawn();
  const formula = page.getByLabel('Formula');
  await formula.fill('B1.speed');
  await formula.press('Enter');
  await page.getByRole('alert').getByText('B1.speed: no column of this run, such as B1.velocity').waitFor();
  await formula.fill('0.5 * (B1.velocity + B2.velocity + B3.velocity)');   // Times 1 kg: the momentum.
  await formula.press('Enter');
  const plot = page.locator('[data-plot^="0.5 * (B1"]');
  await hold(async () => Number(await plot.getAttribute('data-points')) > 100);
  await page.reload();
  await hold(async () => Number(await plot.getAttribute('data-points')) > 100);
  const rows = (await fileOf('0.5 * (B1.velocity + B2.velocity + B3.velocity)', 'CSV')).trim().split('\n').slice(1).map((row) => Number(row.split(',')[2]));
  assert.ok(rows.every((momentum) => Math.abs(momentum - 0.1) < 1e-12), 'it is conserved');
  await page.getByRole('button', {name: /^remove 0\.5/}).click();
  await hold(async () => await plot.count() === 0 && ofAddress('derived') === null);
});

test('a point of the line of a sweep is chosen and becomes a run', async () => {
  const {name} = await server.call('CreateJob', {job: {sweep: {base: CHAIN, metrics: ['iterations', 'cycles[B1-B2].alpha'],
    axes: [{field: 'bodies[0].velocity_m_per_s', linear: {low: 0.1, high: 0.5, count: 5}}]}}});
  const id = name.replace('jobs/', '');
  await server.ended(id);
  await open(`/runs/${id}?metric=1`);
  await hold(async () => await points('line') === 5);
  const line = page.getByLabel(/arrow keys choose a cell/);
  await line.press('ArrowRight');
  await hold(() => ofAddress('cell') === '0');
  await line.press('ArrowRight');
  await page.getByText(/velocity of B1 \[m\/s\] = 0.2: alpha of B1-B2 \[1\] [\d.]+ converged/).waitFor();
  const box = await line.locator('.u-over').boundingBox();
  await page.mouse.click(box.x + box.width - 3, box.y + 40);
  await hold(() => ofAddress('cell') === '4');
  await refuse('CreateJob');
  await line.press('Enter');
  await page.getByRole('alert').getByText('The store is full.').waitFor();
  await page.unrouteAll();
  await line.press('Enter');
  await hold(() => !page.url().includes(id));
  const job = await server.ended(new URL(page.url()).pathname.split('/')[2]);
  assert.deepEqual([job.labels, job.scenario.bodies[0].velocityMPerS], [{sweep: id, cell: '4'}, 0.5]);
});

test('a map shows lines of equal value in place of numbers, if its address says so', async () => {
  const axis = (field) => ({field: `bodies[0].${field}`, linear: {low: 0.1, high: 1, count: 6}});
  const {name} = await server.call('CreateJob', {job: {sweep: {base: BALL, metrics: ['final_bodies[a].position_m'], axes: [axis('velocity_m_per_s'), axis('position_m')]}}});
  const id = name.replace('jobs/', '');
  await server.ended(id);
  await open(`/runs/${id}`);
  const map = page.locator('[data-plot="map"][data-filled="36"]');
  const levels = () => map.locator('[data-level]').evaluateAll((paths) => paths.map((path) => path.dataset.level));
  const words = () => map.locator('.halo').allTextContents();
  await map.waitFor();
  assert.deepEqual(await levels(), []);
  await page.getByLabel('contours').check();
  await hold(() => ofAddress('contours') === '1');
  await hold(async () => (await levels()).join() === '0.2,0.4,0.6,0.8,1');
  assert.deepEqual((await words()).sort(), ['0.2', '0.4', '0.6', '0.8', '1']);
  await page.reload();
  await hold(async () => (await levels()).length === 5);
  await page.getByLabel('contours').uncheck();
  await hold(async () => (await levels()).length === 0);
});

test('any two axes of a sweep of three span its map', async () => {
  const axis = (field, ...values) => ({field: `bodies[0].${field}`, values});
  const {name} = await server.call('CreateJob', {job: {sweep: {base: BALL, metrics: ['final_bodies[a].position_m'], axes: [axis('velocity_m_per_s', 1, 2), axis('position_m', 3, 4), axis('mass_kg', 5, 6)]}}});
  const id = name.replace('jobs/', '');
  await server.ended(id);
  await open(`/runs/${id}`);
  const shown = () => page.locator('[data-plot="map"] h3').innerText();
  const chosen = (label) => page.getByLabel(new RegExp(`^${label}`)).locator('option:checked').innerText();
  const axes = async (down, across) => {
    await hold(async () => await shown() === `final position of a [m] over ${down} and ${across}`);
    assert.deepEqual([await chosen('Down'), await chosen('Across')], [down, across]);
  };
  await axes('velocity of a [m/s]', 'position of a [m]');
  await page.getByLabel(/^Across/).selectOption('mass of a [kg]');
  await axes('velocity of a [m/s]', 'mass of a [kg]');
  await page.getByLabel(/^Down/).selectOption('mass of a [kg]');
  await axes('mass of a [kg]', 'velocity of a [m/s]');
});

test('a link that is copied brings the view back to another reader', async () => {
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  const copy = async () => {
    await page.getByRole('button', {name: 'Copy link to this view'}).press('Enter');
    await page.getByText('Copied', {exact: true}).waitFor();
  };
  for (const path of [`/runs/${chain}?contact=B2-B3&from=0.001&to=0.002`, `/compare?jobs=${chain}&channels=B1.velocity`]) {
    await open(path);
    await copy();
    assert.equal(await page.evaluate(() => navigator.clipboard.readText()), server.origin + path);
  }
  await page.evaluate(() => { Object.defineProperty(navigator, 'clipboard', {value: undefined}); });   // As without TLS.
  await page.mouse.click(2, 400);
  await copy();
});

test('ranges along parallel coordinates choose cells, by dragging, by keys and by the address', async () => {
  const axis = (field) => ({field: `bodies[0].${field}`, linear: {low: 1, high: 6, count: 6}});
  const {name} = await server.call('CreateJob', {job: {sweep: {base: BALL, metrics: ['final_bodies[a].position_m'], axes: [axis('velocity_m_per_s'), axis('position_m')]}}});
  const id = name.replace('jobs/', '');
  await server.ended(id);
  await open(`/runs/${id}?view=parallel`);
  const figure = page.locator('[data-plot="parallel"][data-lines="36"]');
  const brushes = () => new URL(page.url()).searchParams.getAll('brush').join(' ');
  const chosen = (n) => figure.getByRole('status').getByText(`${n} of 36 cells chosen`).waitFor();
  const grey = () => figure.locator('path[stroke="var(--rule)"]').evaluateAll((all) => all.map((path) => path.getAttribute('d').split('M').length - 1).join());
  await figure.waitFor();
  const end = (which, axis) => figure.getByRole('slider', {name: `${which} end of ${axis}`});
  const centre = async (of) => { const box = await of.boundingBox(); return [box.x + box.width / 2, box.y + box.height / 2]; };
  const [x, top] = await centre(end('upper', 'velocity of a [m/s]'));
  const [, bottom] = await centre(end('lower', 'velocity of a [m/s]'));
  const at = (part) => bottom + part * (top - bottom);
  await page.mouse.move(x, at(0.5));   // From the middle up: 4, 5, 6.
  await page.mouse.down();
  await page.mouse.move(x, at(0.8), {steps: 3});
  await page.mouse.move(x, top - 20, {steps: 3});
  await page.mouse.up();
  await chosen(18);
  assert.match(brushes(), /^0:3\.[45]\d*:6$/);
  assert.equal(ofAddress('cell'), null, 'a drag chooses no line');
  assert.equal(await grey(), '18');
  const lower = end('lower', 'position of a [m]');
  await lower.focus();
  await page.keyboard.press('ArrowUp');   // From 1 to 2.
  await page.keyboard.press('ArrowUp');
  await chosen(12);
  assert.equal(await lower.getAttribute('aria-valuenow'), '3');
  await page.reload();
  await chosen(12);
  await figure.getByRole('application').press('ArrowRight');   // The first of those chosen.
  await hold(() => ofAddress('cell') === '20');
  assert.equal((await fileOf('parallel coordinates', 'CSV')).trim().split('\n').length, 13);
  await page.keyboard.press('Escape');
  await figure.getByRole('application').press('Escape');
  await hold(() => brushes() === '');
  assert.equal(await grey(), '');
  await open(`/runs/${id}?view=parallel&brush=2:0:3`);
  await figure.getByRole('button', {name: 'Choose all again'}).click();
  await hold(() => brushes() === '');
});

test('a file that does not come says why, and can be asked for again', async () => {
  await open(`/runs/${chain}`);
  await page.route('**/ReadArtifact', (route) => route.abort());
  const button = page.locator('.files button').first();
  await button.click();
  await page.getByRole('alert').getByText('The server does not answer.').waitFor();
  assert.ok(await button.isEnabled());
  await page.unrouteAll();
  await Promise.all([page.waitForEvent('download'), button.click()]);
  assert.equal(await page.getByRole('alert').count(), 0);
});

test('a page says how much of a large scenario it shows', async () => {
  const bodies = Array.from({length: 110}, (_, i) => ({name: `b${i}`, massKg: 1, radiusM: 0.05, positionM: 0.2 * i, velocityMPerS: i === 0 ? 1 : 0}));
  const id = await server.submit({title: 'A row', bodies, endTimeS: 0.001, output: {sampleIntervalS: 1e-4},
    contacts: [{name: 'row', between: bodies.map(({name}) => name), stiffness: 1e6, restitution: 0.8}]});
  await server.ended(id);
  await open(`/runs/${id}`);
  for (const words of ['60 of 110 bodies shown', '12 of 109 contacts shown; choose a contact in the ledger', '13 of 110 bodies shown', '100 of 110 bodies shown']) {
    await page.getByText(words).waitFor();
  }
  const map = page.locator('[data-plot="force-map"]');
  await hold(async () => await points('force-map') > 2);
  await hold(() => map.locator('canvas').first().evaluate((canvas) => {   // No ball is touched: the map is as dark as it can be.
    const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return data.filter((red, i) => i % 4 === 0 && red === 0x44 && data[i + 1] === 0x01 && data[i + 2] === 0x54).length > 10_000;
  }));
  assert.match(await fileOf('Contact forces over time', 'SVG'), /<image .*href="data:image\/png/);
  assert.match(await fileOf('Contact forces over time', 'CSV'), /^curve,time \[s\],force \[N\]\nrow-1,0,0\n/);
});
