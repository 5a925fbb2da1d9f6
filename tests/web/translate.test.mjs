// A contact in other simulators: what the page asks, shows, copies and keeps in its address.

import assert from 'node:assert/strict';
import {after, afterEach, before, beforeEach, test} from 'node:test';

import {openBrowser, openPage, Server, until} from './harness.mjs';

let server;
let browser;
let page;
before(async () => { [server, browser] = await Promise.all([new Server().start(), openBrowser()]); });
after(async () => { await browser?.close(); await server?.close(); });
beforeEach(async () => { page = await openPage(browser, server); });
afterEach(async () => {
  assert.deepEqual(page.faults, []);
  await page.context().close();
});

const open = (query = '') => page.goto(`${server.origin}/translate${query}`);
const hold = (what) => until(what, what.toString());
const model = (name) => page.locator(`[data-model="${name}"]`);
const settled = () => page.locator('[data-settled=true]').waitFor({state: 'attached'});

test('a linear contact has the damper of the closed form in LAMMPS, at once and as it is written', async () => {
  await page.goto(server.origin);
  await page.getByRole('link', {name: 'Translate'}).click();
  await model('lammps-hooke').waitFor();
  assert.equal(await page.locator('[data-model]').count(), 26);
  await page.getByLabel('Stiffness k').fill('1e5');
  await page.getByLabel('Exponent n').fill('1');
  await page.getByLabel('Restitution ε').fill('0.5');
  const damping = 2 * Math.sqrt(1e5) * Math.log(2) / Math.hypot(Math.PI, Math.log(2));
  await hold(async () => (await model('lammps-hooke').innerText()).includes(String(Number(damping.toPrecision(8)))));
  assert.match(await model('lammps-tsuji').innerText(), /e is not the restitution/);
});

test('an address shows the same page again', async () => {
  await open('?e=0.5&time=0.005&v=1&m=1&r=0.02&step=1e-5&find=ode');
  await model('ode').waitFor();
  assert.match(await model('ode').innerText(), /0\.010524747/);
  assert.match(await model('ode').innerText(), /0\.49702 −0\.00298/, 'as client/docs/theory/translation.md has it');
  await page.getByLabel('Contact time').fill('0.01');
  await hold(() => page.url().includes('time=0.01'));
  const before = await hold(async () => { const text = await model('ode').innerText(); return !text.includes('0.010524747') && text; });
  await page.reload();
  await model('ode').waitFor();
  assert.equal(await model('ode').innerText(), before);
});

test('all that is wrong stands at its input', async () => {
  await open('?e=1.5&k=1e6&time=1&v=0&m=x');
  await page.getByText('is no number').waitFor();
  await page.getByLabel('Mass', {exact: false}).first().fill('-1');
  await page.getByText('is 1.5; must be in [0.01, 1]').waitFor();
  await page.getByText('must have either stiffness or contact_time_s').waitFor();
  assert.deepEqual(await page.locator('[aria-invalid=true]').evaluateAll((all) => all.map(({value}) => value)), ['1.5', '1e6', '0', '-1']);
  assert.equal(await page.locator('[data-model]').count(), 0);
});

test("a model's own parameters lead to those of the others", async () => {
  await open();
  await model('drake').waitFor();
  await page.getByLabel('The contact is given by').selectOption('drake');
  await page.getByLabel('point_contact_stiffness').fill('1e5');
  await page.getByLabel('hunt_crossley_dissipation').fill('0.5');
  await page.getByLabel('Approach velocity').fill('0.1, 1, 5');
  const rebounds = page.getByRole('region', {name: 'What it gives back at each velocity'});
  await rebounds.getByText('0.35238').first().waitFor();
  assert.equal(await model('drake').count(), 0);
  assert.match(await model('simscape-damped').innerText(), /6\.6014825/, 'as client/docs/theory/translation.md has it');
});

test('the ready line is copied by keys alone', async () => {
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  await open('?e=0.5&time=0.005&v=1&m=1');
  await settled();
  const copy = model('mujoco').getByRole('button', {name: /^Copy the line/});
  await copy.focus();
  await page.keyboard.press('Enter');
  await model('mujoco').getByText('Copied').waitFor();
  assert.match(await page.evaluate(() => navigator.clipboard.readText()), /solref="-294911\.8164 -277\.2588723"/);
});
