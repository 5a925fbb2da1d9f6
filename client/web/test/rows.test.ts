import {create} from '@bufbuild/protobuf';
import {describe, expect, it} from 'vitest';

import {CycleSchema} from '../src/api/generated/contact/v1/job_pb';
import {ScenarioSchema} from '../src/api/generated/contact/v1/scenario_pb';
import type {Series} from '../src/api/series';
import type {RunView} from '../src/model/curves';
import {mechanicsOf, type Mechanics} from '../src/model/mechanics';
import {panelCsv} from '../src/model/panel';
import {PRESETS, presetsAsked, presetsFor, thinned} from '../src/model/presets';
import {pixelsOf, rowRange, waterfallOf, type Raster} from '../src/model/raster';

// A wave that reaches body i at i/10 s, a pulse of 3 m/s or N, with the sign of each body.
const COUNT = 20;
const time = Float64Array.from({length: 401}, (_, i) => i / 200);
const pulse = (centre: number, sign: number) => Float64Array.from(time, (t) => sign * 3 * Math.exp(-(((t - centre) / 0.02) ** 2)));
const arrival = (i: number) => i / 10;

function run(sign: (i: number) => number): RunView {
  const bodies = Array.from({length: COUNT}, (_, i) => ({name: `B${i}`, positionM: i}));
  const contacts = bodies.slice(1).map(({name}, i) => ({name: `C${i}`, between: [`B${i}`, name]}));
  const columns = [['time', time] as const, ...bodies.map(({name}, i) => [`${name}.velocity`, pulse(arrival(i), sign(i))] as const),
    ...contacts.map(({name}, i) => [`${name}.contact_force`, pulse(arrival(i), 1)] as const)];
  const series = new Map(columns.map(([name, values]) => [name, {name, quantity: '', unit: '', values}])) as unknown as Series;
  return {mechanics: mechanicsOf(create(ScenarioSchema, {bodies, contacts})), series, cycles: [], groups: [], bands: []};
}

const panelOf = (id: string, view: RunView) => PRESETS.find((preset) => preset.id === id)!.panel(view);
const rasterOf = (id: string, sign = (_: number) => 1): Raster => panelOf(id, run(sign)).raster!;

/** Where the red or blue of a row is strongest, in s: row 0 is the lowest. */
function strongest(raster: Raster, row: number, strength: (r: number, g: number, b: number) => number): number {
  const columns = 200;
  const pixels = pixelsOf(raster, [0, 2], columns);
  const at = (i: number) => 4 * (columns * (raster.rows.length - 1 - row) + i);
  const found = Array.from({length: columns}, (_, i) => strength(pixels[at(i)]!, pixels[at(i) + 1]!, pixels[at(i) + 2]!));
  return (found.indexOf(Math.max(...found)) + 0.5) * 2 / columns;
}

describe('a wave through a row of bodies', () => {
  it('is found in each row of a map at its time', () => {
    for (const [id, count] of [['force-map', COUNT - 1], ['velocity-map', COUNT]] as const) {
      const raster = rasterOf(id);
      expect(raster.rows.length).toBe(count);
      for (let i = 0; i < count; ++i) expect(strongest(raster, i, (_r, g) => g), `${id} ${i}`).toBeCloseTo(arrival(i), 1.5);
    }
  });
  it('is red or blue as the bodies go, and white where they rest', () => {
    const raster = rasterOf('velocity-map', (i) => (i % 2 ? -1 : 1));
    const dark = (red: boolean) => (r: number, g: number, b: number) => (red ? r - b : b - r) - g;
    for (let i = 0; i < COUNT; ++i) expect(strongest(raster, i, dark(i % 2 === 0)), `row ${i}`).toBeCloseTo(arrival(i), 1.5);
    expect(Array.from(pixelsOf(raster, [1.5, 1.6], 1)).slice(-4)).toEqual([247, 247, 247, 255]);   // The first body, after the wave.
  });
  it('is found in each line of a waterfall at its time, with colours by place', () => {
    const lines = waterfallOf(rasterOf('velocity-waterfall')).reverse();
    expect(lines.map(({row}) => row)).toEqual(Array.from({length: COUNT}, (_, i) => i + 1));
    lines.forEach(({row, y}, i) => {
      expect(time[y.indexOf(Math.max(...y))]).toBeCloseTo(arrival(i), 9);
      expect(Math.max(...y) - row).toBeCloseTo(2, 9);   // Two rows high.
    });
    expect(new Set(lines.map(({colour}) => colour)).size).toBe(COUNT);
  });
  it('goes down where bodies go back, and all of it is shown', () => {
    const raster = rasterOf('velocity-waterfall', () => -1);
    const [low, high] = rowRange(raster);
    for (const {row, y} of waterfallOf(raster)) expect([Math.min(...y) > low, Math.max(...y) < high, Math.min(...y) < row - 1.9]).toEqual([true, true, true]);
  });
  it('is of every n-th of many rows', () => {
    const rows = Array.from({length: 150}, (_, i) => ({name: `${i}`, values: pulse(1, 1)}));
    const lines = waterfallOf({time, rows, label: 'x [1]', largest: 3});
    expect([lines.length, lines.at(-1)!.row, lines[0]!.row]).toEqual([50, 1, 148]);
  });
  it('stands in its row of the scenario, if only every n-th is there', () => {
    const rows = [0, 1, 2].map((i) => ({name: `${i}`, values: pulse(1, 1)}));
    const raster = {time, rows, label: 'x [1]', largest: 3, every: 10, first: 50};
    expect([rowRange(raster), waterfallOf(raster).map(({row}) => row), Math.max(...waterfallOf(raster)[0]!.y)]).toEqual([[46, 76], [71, 61, 51], 91]);
  });
  it('has its own values in the file', () => {
    const lines = panelCsv(panelOf('velocity-waterfall', run(() => -1))).split('\n');
    expect([lines[0], lines[1 + 401 + 20]]).toEqual(['curve,time [s],velocity [m/s]', 'B1,0.1,-3']);
  });
  it('is shown where there are too many bodies for curves', () => {
    const few = mechanicsOf(create(ScenarioSchema, {bodies: [{name: 'a'}, {name: 'b'}]}));
    const ids = (of: Parameters<typeof presetsFor>[0]) => presetsFor(of).map(({id}) => id).filter((id) => /map|waterfall/.test(id));
    expect(ids(few)).toEqual([]);
    expect(ids(run(() => 1).mechanics)).toEqual(['force-map', 'velocity-map', 'force-waterfall', 'velocity-waterfall']);
    const long = {...run(() => 1).mechanics, contacts: Array.from({length: 10_000}, (_, i) => ({name: `C${i}`}))} as unknown as Mechanics;
    const maps = presetsAsked(long, true).filter(({many}) => many).map(({many, channels}) => channels(thinned(long, many!, true, [])).length);
    const hit = (...places: number[]) => { const {first, every, contacts} = thinned(long, 'contacts', false, places.map((i) => create(CycleSchema, {contact: `C${i}`}))); return [first, every, contacts.length]; };
    expect([hit(), hit(40, 72), hit(0, 9999), maps]).toEqual([[0, 34, 295], [40, 1, 33], [0, 34, 295], [139, 20, 139, 20]]);
    const asked = (all: boolean) => presetsAsked(run(() => 1).mechanics, all).filter(({many}) => many).length;
    expect([asked(false), asked(true)]).toEqual([1, 4]);
  });
});
