// Pictures of every page in every state, for people who look at them:
//   tests/web/run shots FOLDER [NAME…]   light and dark, 1280 and 400 px wide

import {mkdirSync} from 'node:fs';

import {AskingServer, CHAIN, openBrowser, openPage, Server, swinging} from './harness.mjs';

const [folder, ...only] = process.argv.slice(2);
const DRAWN_MS = 1000;
mkdirSync(folder, {recursive: true});
const [browser, server, asking, empty] = await Promise.all([openBrowser(), new Server('--workers=2').start(),
  new AskingServer().start(), new Server('--workers=1').start()]);

async function sweep(base, metrics, axes) {
  return (await server.call('CreateJob', {job: {sweep: {base, metrics, axes}}})).name.replace('jobs/', '');
}

const chain = await server.submit(CHAIN, {labels: {study: 'chain'}});
const softer = await server.submit({...CHAIN, contacts: CHAIN.contacts.map((c) => ({...c, restitution: 0.6}))});
const wall = await server.submit(swinging(0.035));
const missed = await server.submit({...swinging(0.035, {maxIterations: 1}), title: 'One that does not converge'});
const map = await sweep({...CHAIN, solver: {maxIterations: 3}}, ['iterations', 'cycles[B1-B2].alpha'], [
  {field: 'bodies[0].velocity_m_per_s', linear: {low: 0.1, high: 0.5, count: 5}}, {field: 'contacts[*].restitution', linear: {low: 0.4, high: 0.95, count: 8}}]);
const large = await sweep({bodies: [{name: 'a', massKg: 1}], endTimeS: 1e-3, output: {ledgerOnly: true}}, ['final_bodies[a].position_m'],
  ['velocity_m_per_s', 'position_m'].map((field) => ({field: `bodies[0].${field}`, linear: {low: 0.1, high: 1, count: 100}})));
for (const id of [chain, softer, wall, missed, map, large]) await server.ended(id);
const live = await server.submit({...swinging(3, {method: 'RK4', stepS: 1e-7}), title: 'A run that goes on'});

/** Path, and the server if it is not the common one. */
const pages = {
  runs: [`/runs?chosen=${chain},${softer}`], empty: ['/runs', empty], token: ['/runs', asking],
  run: [`/runs/${chain}?t=0.0012`], wall: [`/runs/${wall}?plots=all`], missed: [`/runs/${missed}`], live: [`/runs/${live}`], none: ['/runs/none'], loading: [`/runs/${chain}`],
  map: [`/runs/${map}?cell=3`], large: [`/runs/${large}?cell=5050`], contours: [`/runs/${map}?metric=1&contours=1`], 'large-contours': [`/runs/${large}?contours=1&log=1`], parallel: [`/runs/${map}?view=parallel&cell=3`],
  compare: [`/compare?jobs=${chain},${softer}`], 'compare-none': ['/compare'],
  new: ['/new'], 'new-wrong': [`/new#text=${encodeURIComponent('title: x\nbodies:\n  - {name: A, mass_kg: -1}\ncontact: []\n')}`], translate: ['/translate?e=0.5&k=1e6&n=1.5&v=1&m=1&r=0.02&step=1e-4&g=9.81'], server: ['/server'],
};

for (const colorScheme of ['light', 'dark']) {
  for (const width of [1280, 400]) {
    for (const [name, [path, from = server]] of Object.entries(pages)) {
      if (only.length > 0 && !only.includes(name)) continue;
      const page = await openPage(browser, from, {colorScheme, viewport: {width, height: 800}});
      if (name === 'loading') await page.route('**/contact.v1.JobService/*', () => undefined);
      await page.goto(from.origin + path);
      await page.waitForTimeout(DRAWN_MS);
      await page.setViewportSize({width, height: await page.evaluate(() => document.documentElement.scrollHeight)});   // Plots are drawn where they can be seen.
      await page.waitForTimeout(DRAWN_MS);
      await page.screenshot({path: `${folder}/${name}-${colorScheme}-${width}.png`, fullPage: true});
      await page.context().close();
    }
  }
}
await browser.close();
await Promise.all([server, asking, empty].map((one) => one.close()));
