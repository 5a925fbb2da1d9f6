// Rows of 1, 5, 20, 100 and 1000 contacts: what shows a wave in each, at a size that can be read.

import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';

import {openBrowser, openPage, Server, until} from './harness.mjs';

const LEAST_PX = 150;   // Of the field of a plot, without its axes.
let server;
let browser;
before(async () => { [server, browser] = await Promise.all([new Server('--workers=2').start(), openBrowser()]); });
after(async () => { await browser?.close(); await server?.close(); });

/** A row of balls that stand apart, of which the first is thrown at the others; the last samples are taken when some are hit. */
function row(contacts) {
  const bodies = Array.from({length: contacts + 1}, (_, i) => ({name: `b${i}`, massKg: 0.1, radiusM: 0.05, positionM: 0.1001 * i, velocityMPerS: i === 0 ? 1 : 0}));
  return {title: `A row of ${contacts}`, bodies, endTimeS: 0.006, output: {sampleIntervalS: 2e-5},
    contacts: [{name: 'row', between: bodies.map(({name}) => name), stiffness: 1e8, restitution: 0.9}]};
}

/** Where each of some stretches of a map is brightest, in parts of its width, from the lowest stretch up; none where it is dark. */
const brightest = (map) => map.locator('canvas').first().evaluate((canvas) => {
  const over = canvas.closest('.uplot').querySelector('.u-over').getBoundingClientRect();
  const from = canvas.getBoundingClientRect();
  const ratio = canvas.width / from.width;
  const [left, top, width, height] = [over.left - from.left, over.top - from.top, over.width, over.height].map((px) => Math.round(px * ratio));
  const {data} = canvas.getContext('2d').getImageData(left, top, width, height);
  return Array.from({length: height}, (_, j) => height - 1 - j).flatMap((y) => {
    let [best, at] = [120, -1];   // Green: 1 in the darkest colour, 231 in the brightest; grids are grey.
    for (let x = 0; x < width; ++x) {
      const [red, green] = data.subarray(4 * (y * width + x));
      if (green > best && Math.abs(green - red) > 20) [best, at] = [green, x];
    }
    return at < 0 ? [] : [at / width];
  });
});

for (const contacts of [1, 5, 20, 100, 1000]) {
  test(`a row of ${contacts} is shown at sizes that can be read, with a wave that goes through it`, async () => {
    const id = await server.submit(row(contacts));
    const job = await server.ended(id);
    assert.equal(job.state, 'SUCCEEDED');
    for (const viewport of [{width: 1280, height: 900}, {width: 400, height: 800}]) {
      for (const query of ['', '?plots=all']) {
        const page = await openPage(browser, server, {viewport});
        await page.goto(`${server.origin}/runs/${id}${query}`);
        await until(async () => Number(await page.locator('[data-plot="force"]').getAttribute('data-points')) > 100, 'samples');
        const heights = await page.locator('.u-over').evaluateAll((fields) => fields.map((field) => field.clientHeight));
        assert.ok(heights.length > 5 && Math.min(...heights) >= LEAST_PX, heights.join());
        const map = page.locator('[data-plot="force-map"]');
        assert.equal(await map.count(), contacts > 12 ? 1 : 0);
        if (contacts > 12) {
          await map.scrollIntoViewIfNeeded();
          await until(async () => {
            const places = await brightest(map);
            return places.length > 3 && places.at(-1) > places[0] + 0.05;
          }, 'a wave that is further up later');
          const note = await map.locator('.note').innerText();
          const rows = contacts > 380 && new Set(job.cycles.map(({contact}) => contact)).size;
          assert.equal(/, from 1 to (\d+)$/.exec(note)?.[1], rows ? String(rows) : undefined, 'of many those that were touched');
        }
        assert.deepEqual(page.faults, []);
        await page.context().close();
      }
    }
  });
}
