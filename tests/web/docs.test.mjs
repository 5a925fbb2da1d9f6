// The site of documentation as contactd serves it: axe's rules, narrow screens, its policy, the search.

import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';

import {AxeBuilder} from '@axe-core/playwright';

import {openBrowser, openPage, Server} from './harness.mjs';

// The sample that docs/site makes has two cards of each group of the gallery, gear-rattle among them.
const PAGES = ['', 'gallery/index.html', 'gallery/gear-rattle.html', 'search.html?q=restitution', 'materials.html'];

let server;
let browser;
before(async () => {
  [server, browser] = await Promise.all([
    new Server('--workers=1', `--docs-dir=${process.env.SITE ?? '../../build/docs-sample'}`).start(), openBrowser()]);
});
after(async () => { await browser?.close(); await server?.close(); });

for (const [colorScheme, width] of [['light', 1280], ['dark', 1280], ['dark', 400]]) {
  test(`axe finds nothing serious and no page is too wide, ${colorScheme}, ${width} px`, async () => {
    const page = await openPage(browser, server, {colorScheme, viewport: {width, height: 900}});
    for (const path of PAGES) {
      await page.goto(`${server.origin}/docs/${path}`);
      await page.locator('article').waitFor();
      const {violations} = await new AxeBuilder({page}).analyze();
      const serious = violations.filter(({impact}) => impact === 'serious' || impact === 'critical');
      assert.deepEqual(serious.map(({id, nodes}) => `${path}: ${id}: ${nodes[0].html} ${nodes[0].failureSummary}`), []);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), path);
      assert.deepEqual(page.faults, [], path);
    }
    await page.context().close();
  });
}

test('the search finds a page without a network', async () => {
  const page = await openPage(browser, server);
  await page.goto(`${server.origin}/docs/search.html?q=restitution`);
  await page.locator('#search-results li a').first().waitFor();
  assert.deepEqual(page.faults, []);
  await page.context().close();
});

test('a card opens its scenario in the dashboard, and the dashboard leads back', async () => {
  const page = await openPage(browser, server);
  await page.goto(`${server.origin}/docs/gallery/gear-rattle.html`);
  await page.locator('a.open').click();
  await page.getByText('The server accepts it.').waitFor();
  assert.match(await page.locator('main').innerText(), /Gear rattle/);
  await page.getByRole('link', {name: 'Documentation'}).click();
  await page.getByRole('heading', {name: 'contactd'}).waitFor();
  assert.deepEqual(page.faults, []);
  await page.context().close();
});
