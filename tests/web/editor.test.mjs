// A text that is written on the page of a new run: what is told of it, and that none is lost.

import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {after, afterEach, before, beforeEach, test} from 'node:test';

import {openBrowser, openPage, Server, until} from './harness.mjs';

let server;
let browser;
let page;
let editor;
let chain;   // The text that the page begins with.
before(async () => {
  [server, browser] = await Promise.all([new Server().start(), openBrowser()]);
  page = await openPage(browser, server);
  editor = page.getByRole('textbox', {name: /Scenario/});
  await page.goto(`${server.origin}/new`);
  await page.getByText('The server accepts it.').waitFor();
  chain = await editor.inputValue();
});
after(async () => { await browser?.close(); await server?.close(); });
beforeEach(() => editor.fill(chain));
afterEach(() => assert.deepEqual(page.faults, []));

const hold = (what) => until(what, what.toString());

test('an empty text is told what is missing', async () => {
  await editor.fill('');
  await page.locator('.verdicts').getByText('end_time_s', {exact: true}).waitFor();
  assert.equal(await page.locator('.lines .wrong').count(), 1);
});

test('a word that is unknown hides no other mistake', async () => {
  await editor.fill(chain.replace('mass_kg', 'mas_kg').replace('restitution: 0.7', 'restitution: 1.7'));
  await page.getByText('is 1.7; must be in (0, 1]').waitFor();
  assert.deepEqual(await page.locator('.verdicts code').allInnerTexts(), ['bodies[0].mas_kg', 'contacts[1].restitution']);
  assert.ok(await page.getByRole('button', {name: 'Start the run'}).isDisabled());
});

test('the scenario is drawn as it is written, and the last right one stays, greyed, while the text is wrong', async () => {
  const picture = page.getByLabel('The scenario as it begins');
  const canvas = picture.locator('canvas');
  const drawing = () => canvas.evaluate((drawn) => drawn.toDataURL());
  const told = (words) => hold(async () => await canvas.getAttribute('aria-label') === words && await picture.getAttribute('data-stale') === null);
  await told('B1 at 0 m, 0.2 m/s; B2 at 0.1 m; B3 at 0.2 m');
  const first = await drawing();
  const faster = chain.replace('velocity_m_per_s: 0.2', 'velocity_m_per_s: -0.3');
  await editor.fill(faster);
  await told('B1 at 0 m, -0.3 m/s; B2 at 0.1 m; B3 at 0.2 m');
  const second = await drawing();
  assert.notEqual(second, first);
  await editor.fill(faster.replace('restitution: 0.7', 'restitution: 1.7'));
  await picture.getByText('the last text that was right').waitFor();
  assert.deepEqual([await drawing(), await canvas.evaluate((drawn) => getComputedStyle(drawn).filter)], [second, 'grayscale(1)']);
  await editor.fill(chain);
  await told('B1 at 0 m, 0.2 m/s; B2 at 0.1 m; B3 at 0.2 m');
  assert.equal(await drawing(), first);
});

test('completion opens below the word that is written', async () => {
  const lines = chain.split('\n');
  await editor.fill(`${chain}solv`);
  const [offers, area] = await Promise.all([page.getByRole('listbox').boundingBox(), editor.boundingBox()]);
  assert.ok(Math.abs(offers.x - area.x) < 30, `${offers.x} beside ${area.x}`);
  assert.ok(Math.abs(offers.y - area.y - 8 - 19 * lines.length) < 12, `${offers.y - area.y} below line ${lines.length}`);
});

test('a template takes no text away: it is one step back', async () => {
  const own = `${chain}# Mine.\n`;
  await editor.fill(own);
  await page.getByRole('button', {name: "Newton's cradle"}).click();
  await hold(async () => /cradle/.test(await editor.inputValue()));
  await page.getByRole('button', {name: 'Back to my text'}).click();
  await hold(async () => await editor.inputValue() === own);
  await page.goForward();
  await hold(async () => /cradle/.test(await editor.inputValue()));
  await page.goBack();
  await hold(async () => await editor.inputValue() === own);
});

test('a text that was just written is there again after a link and Back', async () => {
  const faster = chain.replace('velocity_m_per_s: 0.2', 'velocity_m_per_s: 0.7');
  await editor.fill(faster);
  await page.getByRole('link', {name: 'Runs'}).first().click();
  await hold(() => !new URL(page.url()).pathname.startsWith('/new'));
  await page.goBack();
  await hold(async () => await editor.inputValue() === faster);
});

test('what is copied for the command line runs on the server of the page', {skip: !process.env.CONTACTCTL && 'needs CONTACTCTL'}, async () => {
  await page.getByText('The server accepts it.').waitFor();
  await page.getByRole('button', {name: 'CLI', exact: true}).click();
  const copied = await page.getByLabel('copied text').innerText();
  execFileSync('bash', ['-c', copied.replace('contactctl', process.env.CONTACTCTL)], {stdio: 'ignore'});
  const {jobs} = await server.call('ListJobs');
  assert.deepEqual(jobs.map(({title}) => title), ['Triple-ball chain']);
});
