// Whether everybody can use the dashboard: axe's rules, keyboard alone, large print, dark and light.

import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';

import {AxeBuilder} from '@axe-core/playwright';

import {CHAIN, openBrowser, openPage, Server, swinging, until} from './harness.mjs';

let server;
let browser;
const pages = {};
before(async () => {
  [server, browser] = await Promise.all([new Server('--workers=2').start(), openBrowser()]);
  const chain = await server.submit(CHAIN, {labels: {study: 'chain'}});
  const other = await server.submit({...CHAIN, contacts: CHAIN.contacts.map((c) => ({...c, restitution: 0.6}))});
  const wall = await server.submit(swinging(0.035));
  const {name} = await server.call('CreateJob', {job: {sweep: {base: {...CHAIN, solver: {maxIterations: 3}}, metrics: ['iterations', 'cycles[B1-B2].alpha'],
    axes: [{field: 'bodies[0].velocity_m_per_s', linear: {low: 0.1, high: 0.5, count: 5}}, {field: 'contacts[*].restitution', linear: {low: 0.4, high: 0.95, count: 8}}]}}});
  const sweep = name.replace('jobs/', '');
  for (const id of [chain, other, wall, sweep]) await server.ended(id);
  Object.assign(pages, {
    runs: '/runs', run: `/runs/${chain}?t=0.0012`, wall: `/runs/${wall}?plots=all`, sweep: `/runs/${sweep}?cell=3`, parallel: `/runs/${sweep}?view=parallel`,
    compare: `/compare?jobs=${chain},${other}`, new: '/new', translate: '/translate', server: '/server'});
});
after(async () => { await browser?.close(); await server?.close(); });

async function settled(page, name) {
  await page.locator('main h1').first().waitFor();
  if (['run', 'wall', 'compare'].includes(name)) await until(async () => await page.locator('.plot').last().getAttribute('data-points') !== '0' || await page.locator('.plot').count() > 5, 'plots');
  await page.waitForTimeout(250);
}

for (const colorScheme of ['light', 'dark']) {
  test(`axe finds nothing serious on any page, ${colorScheme}`, async () => {
    const page = await openPage(browser, server, {colorScheme});
    for (const [name, path] of Object.entries(pages)) {
      await page.goto(server.origin + path);
      await settled(page, name);
      const {violations} = await new AxeBuilder({page}).analyze();
      const serious = violations.filter(({impact}) => impact === 'serious' || impact === 'critical');
      assert.deepEqual(serious.map(({id, nodes}) => `${name}: ${id}: ${nodes[0].html} ${nodes[0].failureSummary}`), []);
      assert.deepEqual(page.faults, []);
    }
    await page.context().close();
  });
}

test('no page is wider than a narrow screen or one at 400 %', async () => {
  const page = await openPage(browser, server, {viewport: {width: 320, height: 256}, colorScheme: 'dark'});
  for (const [name, path] of Object.entries(pages)) {
    await page.goto(server.origin + path);
    await settled(page, name);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), name);
  }
  await page.context().close();
});

test('keyboard alone starts a run, zooms, plays and comes back', async () => {
  const page = await openPage(browser, server);
  await page.goto(`${server.origin}/runs`);
  await page.getByRole('heading', {name: 'Runs'}).waitFor();
  const focus = async (name) => {
    for (let i = 0; i < 60; ++i) {
      await page.keyboard.press('Tab');
      const text = await page.evaluate(() => document.activeElement.matches('a, button') ? document.activeElement.innerText : '');
      if (text.includes(name)) {
        assert.ok(await page.evaluate(() => document.activeElement.matches(':focus-visible')), `${name} shows its focus`);
        return;
      }
    }
    assert.fail(`no way to ${name}`);
  };
  await focus('New run');
  await page.keyboard.press('Enter');
  await page.getByText('The server accepts it.').waitFor();
  await focus('Start the run');
  await page.keyboard.press('Enter');
  await page.getByText('SUCCEEDED').first().waitFor();
  await until(async () => Number(await page.locator('[data-plot="force"]').getAttribute('data-points')) > 100, 'the plot');
  await page.keyboard.press('+');
  await until(() => page.url().includes('from='), 'a zoom');
  await page.keyboard.press('0');
  await until(() => !page.url().includes('from='), 'all of it');
  await focus('Play');
  await page.keyboard.press('Enter');
  await page.getByRole('button', {name: 'Pause'}).waitFor();
  await page.keyboard.press('Enter');
  await focus('SVG');
  await page.goBack();
  await page.goBack();
  await page.getByRole('heading', {name: 'Runs'}).waitFor();
  assert.deepEqual(page.faults, []);
  await page.context().close();
});

test('every page has a title of its own, and an address without a page says so', async () => {
  const page = await openPage(browser, server);
  const titled = (title) => until(async () => await page.title() === `${title} · contactd`, `the title ${title}`);
  await page.goto(server.origin + pages.run);
  await titled('Triple-ball chain');
  for (const name of ['Server', 'New run', 'Compare', 'Translate', 'Runs']) {
    await page.getByRole('link', {name, exact: true}).first().click();
    await titled(name);
  }
  await page.goto(`${server.origin}/foo`);
  await page.getByRole('heading', {name: 'No such page'}).waitFor();
  assert.deepEqual([page.faults, await page.title()], [[], 'No such page · contactd']);
  await page.context().close();
});

test('a question mark tells the keys, but is written where words are', async () => {
  const page = await openPage(browser, server, {colorScheme: 'dark'});
  await page.goto(`${server.origin}/runs`);
  const keys = page.getByRole('dialog', {name: 'Keys'});
  await page.getByLabel('Find').press('?');
  assert.equal(await page.getByLabel('Find').inputValue(), '?');
  assert.equal(await keys.isVisible(), false);
  await page.getByRole('heading', {name: 'Runs'}).click();
  await page.keyboard.press('?');
  await keys.getByText('zoom in and out').waitFor();
  const {violations} = await new AxeBuilder({page}).analyze();
  assert.deepEqual(violations.filter(({impact}) => impact === 'serious' || impact === 'critical').map(({id}) => id), []);
  await page.keyboard.press('Escape');
  assert.equal(await keys.isVisible(), false);
  await page.context().close();
});

test('the switch between dark and light is kept', async () => {
  const page = await openPage(browser, server, {colorScheme: 'light'});
  await page.goto(`${server.origin}/runs`);
  const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await background();
  await page.getByRole('button', {name: 'Dark'}).click();
  await page.reload();
  assert.notEqual(await background(), light);
  await page.getByRole('button', {name: 'Light'}).click();
  assert.equal(await background(), light);
  await page.context().close();
});

test('an address brings back the whole view', async () => {
  const page = await openPage(browser, server);
  const path = `${pages.wall.split('?')[0]}?from=0.002&to=0.008&episode=2&contact=ball-wall&status=CONVERGED&ledger=groups&plots=all`;
  await page.goto(server.origin + path);
  await settled(page, 'wall');
  const chosen = (label) => page.locator('label', {hasText: new RegExp(`^${label}`)}).locator('select, input').inputValue();
  assert.equal(await chosen('Contact'), 'ball-wall');
  assert.equal(await chosen('Episode'), '2');
  assert.equal(await chosen('Show'), 'groups');
  await page.getByText('0.002 … 0.008 s').waitFor();
  assert.equal(await page.locator('.plot').count(), 11);
  await page.context().close();
});
