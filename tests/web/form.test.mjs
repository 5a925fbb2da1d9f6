// The form beside the text of a new run: each changes the other, and fields become axes of a sweep.

import assert from 'node:assert/strict';
import {after, afterEach, before, beforeEach, test} from 'node:test';

import {openBrowser, openPage, Server, until} from './harness.mjs';

let server;
let browser;
let page;
let editor;
let form;
let chain;   // The text that the page begins with.
before(async () => {
  [server, browser] = await Promise.all([new Server().start(), openBrowser()]);
  page = await openPage(browser, server);
  editor = page.getByRole('textbox', {name: /Scenario/});
  form = page.getByRole('region', {name: 'Form'});
  await page.goto(`${server.origin}/new`);
  await page.getByText('The server accepts it.').waitFor();
  await form.waitFor();
  chain = await editor.inputValue();
});
after(async () => { await browser?.close(); await server?.close(); });
beforeEach(() => editor.fill(chain));
afterEach(() => assert.deepEqual(page.faults, []));

const hold = (what) => until(what, what.toString());
const objects = () => form.getByLabel('Object of the form');
const fill = async (name, value) => {
  await form.getByLabel(name, {exact: true}).fill(value);
  await form.getByLabel(name, {exact: true}).press('Enter');
};

test('a field of the form changes the text at its place, and the text changes the field', async () => {
  await objects().selectOption({label: 'body B2'});
  await fill('mass_kg', '0.75');
  const made = chain.replace('{name: B2, mass_kg: 0.5', '{name: B2, mass_kg: 0.75');
  await hold(async () => await editor.inputValue() === made);
  await editor.fill(made.replace('mass_kg: 0.75', 'mass_kg: 2'));
  await hold(async () => await form.getByLabel('mass_kg', {exact: true}).inputValue() === '2');
  await form.getByLabel('fixed', {exact: true}).selectOption('true');
  await hold(async () => /B2, mass_kg: 2, .*fixed: true}/.test(await editor.inputValue()));
});

test('what is wrong stands at the field', async () => {
  await objects().selectOption({label: 'contact B2-B3'});
  await fill('restitution', '1.7');
  await form.getByText('is 1.7; must be in (0, 1]').waitFor();
  assert.equal(await form.getByLabel('restitution', {exact: true}).getAttribute('aria-invalid'), 'true');
});

test('each change can be taken back, from the form and from the keys of the editor', async () => {
  await objects().selectOption({label: 'body B1'});
  await fill('velocity_m_per_s', '0.3');
  await fill('radius_m', '0.04');
  await page.getByRole('button', {name: 'Undo'}).click();
  await hold(async () => await editor.inputValue() === chain.replace('velocity_m_per_s: 0.2', 'velocity_m_per_s: 0.3'));
  await editor.press('Control+z');
  await hold(async () => await editor.inputValue() === chain);
  await editor.press('Control+y');
  assert.equal(await editor.evaluate((area) => area.selectionEnd), chain.indexOf('velocity_m_per_s: 0.2') + 'velocity_m_per_s: 0.3'.length);
  await hold(async () => /velocity_m_per_s: 0.3/.test(await editor.inputValue()));
});

test('bodies come and go by buttons', async () => {
  await form.getByRole('button', {name: 'Add a body'}).click();
  await hold(async () => /\n {2}- \{name: B4, /.test(await editor.inputValue()));
  assert.equal(await form.getByLabel('name', {exact: true}).inputValue(), 'B4');
  await form.getByRole('button', {name: 'Remove it'}).click();
  await hold(async () => await editor.inputValue() === chain);
});

test('a table is written point by point', async () => {
  await form.getByRole('button', {name: 'Add a load'}).click();
  await form.getByLabel('kind').selectOption('table');
  const says = (points) => hold(async () => (await editor.inputValue()).includes(`table: {points: [${points}]}`));
  for (let i = 0; i < 3; ++i) await form.getByRole('button', {name: 'Add a point'}).click();
  await says('{time_s: 0, force_n: 0}, {time_s: 1, force_n: 0}, {time_s: 2, force_n: 0}');
  await fill('force_n of point 2', '5');
  await fill('time_s of point 3', '0.5');
  await form.getByText('points[2].time_s').first().waitFor();
  await form.getByRole('button', {name: 'Remove point 3'}).click();
  await says('{time_s: 0, force_n: 0}, {time_s: 1, force_n: 5}');
});

test('a click on the drawing shows what is there', async () => {
  const canvas = page.getByLabel('The scenario as it begins').locator('canvas');
  await page.getByText('The server accepts it.').waitFor();
  const box = await canvas.boundingBox();
  const shown = async () => objects().evaluate((select) => select.selectedOptions[0].text);
  await canvas.click({position: {x: box.width / 2, y: 60}});
  await hold(async () => await shown() === 'body B2');
  const seen = new Set();   // From the left to the right.
  for (let x = 0; x < box.width; x += 8) {
    await canvas.click({position: {x, y: 60}});
    await hold(async () => seen.add(await shown()));
  }
  for (const one of ['body B1', 'contact B1-B2', 'contact B2-B3', 'body B3']) assert.ok(seen.has(one), `${one} of ${[...seen]}`);
});

test('a field becomes the axis of a sweep, which is submitted, and no axis leaves the text as it was', async () => {
  await objects().selectOption({label: 'contact B1-B2'});
  const vary = form.getByRole('button', {name: 'axis over restitution'});
  await vary.click();
  await form.getByLabel('from').fill('0.9');
  await form.getByLabel('to').fill('0.5');
  await form.getByRole('button', {name: 'Make it an axis'}).click();
  await form.getByText('give two numbers, the smaller one first').waitFor();
  await form.getByLabel('from').fill('0.5');
  await form.getByLabel('to').fill('0.9');
  await form.getByLabel('count').fill('3');
  await form.getByRole('button', {name: 'Make it an axis'}).click();
  await hold(async () => (await editor.inputValue()).endsWith('axes:\n  - {field: "contacts[B1-B2].restitution", linear: {low: 0.5, high: 0.9, count: 3}}\n'));
  assert.equal(await vary.getAttribute('aria-pressed'), 'true');
  await page.getByText('The server accepts it.').waitFor();
  await page.getByRole('button', {name: 'Start the sweep'}).click();
  await page.getByRole('heading', {name: '3 of 3 cells'}).waitFor();
  await page.goBack();
  await hold(async () => /axes:/.test(await editor.inputValue()));
  await objects().selectOption({label: 'contact B1-B2'});
  await vary.click();
  await form.getByRole('button', {name: 'No axis'}).click();
  await hold(async () => await editor.inputValue() === chain);
});
