import {create} from '@bufbuild/protobuf';
import type uPlot from 'uplot';
import {describe, expect, it} from 'vitest';

import {IterationSchema} from '../src/api/generated/contact/v1/event_pb';
import {CycleSchema} from '../src/api/generated/contact/v1/job_pb';
import {ScenarioSchema} from '../src/api/generated/contact/v1/scenario_pb';
import type {Series} from '../src/api/series';
import {iterationPanels} from '../src/model/iterations';
import {alongLoop, hysteresis, polygons} from '../src/model/hysteresis';
import {mechanicsOf} from '../src/model/mechanics';
import {logarithmic, without, type Panel} from '../src/model/panel';
import {pixelsOf} from '../src/model/raster';
import {unitOfScale} from '../src/plots/axes';
import {yRange} from '../src/plots/range';

const seriesOf = (columns: Record<string, number[]>): Series => new Map(Object.entries(columns).map(([name, values]) =>
  [name, {name, quantity: '', unit: '', values: Float64Array.from(values)}]));

/** As much of a plot as the functions that place words and units look at. */
const plotOf = (scales: Record<string, Partial<uPlot.Scale>>) => ({scales}) as unknown as uPlot;

describe('an axis', () => {
  it('has a prefix that its ticks are divided by, and none if it is logarithmic', () => {
    const label = 'μ [N·s/m^(n+1)]';
    const of = (distr: uPlot.Scale.Distr) => unitOfScale(plotOf({y: {min: 1e6, max: 1e11, distr}}), 'y', label);
    expect(of(1)).toEqual({factor: 1e9, label: 'μ [GN·s/mⁿ⁺¹]'});
    expect(of(3)).toEqual({factor: 1, label: 'μ [N·s/mⁿ⁺¹]'});
  });
});

describe('powers of ten upwards', () => {
  const panel: Panel = {id: 'p', title: '', xLabel: 'x', yLabel: 'y', overTime: true, note: 'n', curves: [{label: 'c', colour: 0, mark: 'line', x: [0, 1, 2, 3], y: [-1, 0, 2, 5]}]};
  it('are of what is above 0', () => {
    const {logY, curves, note} = logarithmic(panel);
    expect([logY, curves[0]!.y, note, yRange(logarithmic(panel), [0, 3])]).toEqual([true, [null, null, 2, 5], 'n; of what is above 0', [1, 10]]);
  });

  it('is saved without what is hidden, its marks and its ranges', () => {
    const curves = ['A', 'A starts', 'A, 2 to 3', 'B', 'B ends'].map((label) => ({label, colour: 0, mark: 'line' as const, x: [0], y: [1]}));
    const ranges = ['A', 'B'].map((label) => ({label, colour: 0, start: 0, end: 1, low: 0, high: 1}));
    const saved = without({id: 'p', title: '', xLabel: '', yLabel: '', overTime: true, curves, ranges}, new Set(['A']));
    expect([saved.curves.map(({label}) => label), saved.ranges!.map(({label}) => label)]).toEqual([['B', 'B ends'], ['B']]);
  });
});

describe('the passes of an episode', () => {
  it('are told by how far μ is from its last value, if that is asked for', () => {
    const iterations = [4, 1.001, 1].map((mu, number) => create(IterationSchema, {episode: 1, number, unknowns: [{contact: 'A', number: 1, mu, residual: 0.1}]}));
    const [mu] = iterationPanels(iterations, 1, 'N·s/m', true);
    expect([mu!.yLabel, mu!.logY, Array.from(mu!.curves[0]!.y)]).toEqual(['Δμ/μ [1]', undefined, [3, expect.closeTo(1e-3, 9), 0]]);
  });
});

describe('a loop', () => {
  const scenario = create(ScenarioSchema, {bodies: [{name: 'A', massKg: 1}, {name: 'B', massKg: 1}], contacts: [{between: ['A', 'B'], stiffness: 1e6}]});
  const cycle = create(CycleSchema, {contact: 'A-B', number: 1, startTimeS: 1, endTimeS: 2});
  const times = Array.from({length: 40}, (_, i) => 1 + i / 40);
  const of = (time: number[]) => seriesOf({time, 'A-B.deformation': time.map((t) => t - 1), 'A-B.contact_force': time});
  const view = {mechanics: mechanicsOf(scenario), cycles: [cycle], groups: [], bands: [], series: of([0, 1.5, 3])};
  it('is made of the closer samples of its cycle, if the series has few', () => {
    expect(polygons(view, [cycle])).toEqual([cycle]);
    const loops = new Map([['A-B #1', of(times)]]);
    const lengths = [view, {...view, loops}].map((one) => hysteresis(one).curves[0]!.x.length);
    expect([lengths, polygons({...view, loops}, [cycle]), polygons({...view, series: of(times)}, [cycle])]).toEqual([[3, 42], [], []]);
  });
  it('ends where the window does', () => {
    const part = hysteresis({...view, series: of([1.25, 1.5]), loops: new Map([['A-B #1', of(times)]])});
    expect([part.curves.length, part.curves[0]!.x.length]).toEqual([1, 10]);
  });
});

describe('the samples of a loop', () => {
  const SAMPLES = 5000;
  const phases = Array.from({length: SAMPLES}, (_, i) => (i / (SAMPLES - 1)) ** 4);   // Most samples lie where it starts.
  const x = phases.map((phase) => 1e-5 * Math.sin(Math.PI * phase));
  const y = phases.map((phase, i) => 1e4 * ((x[i]! / 1e-5) ** 1.5 + 0.3 * Math.sin(2 * Math.PI * phase) * (x[i]! / 1e-5)));
  const loop = seriesOf({time: phases, x, y});
  const area = (samples: Series) => {
    const [a, b] = [samples.get('x')!.values, samples.get('y')!.values];
    return a.reduce((sum, value, i) => (i ? sum + (value - a[i - 1]!) * (b[i]! + b[i - 1]!) / 2 : 0), 0);
  };
  const thinned = alongLoop(loop, ['x', 'y'], 60);
  const column = (name: string) => Array.from(thinned.get(name)!.values);
  it('keep its area within 1 %, which they do not if they are thinned over time', () => {
    expect([column('x').length <= 60, column('x').length > 40]).toEqual([true, true]);
    expect(Math.abs(area(thinned) / area(loop) - 1)).toBeLessThan(0.01);
    const some = (_: number, i: number) => i % Math.ceil(SAMPLES / 12) === 0 || i === SAMPLES - 1;
    const overTime = seriesOf({x: x.filter(some), y: y.filter(some)});
    expect(Math.abs(area(overTime) / area(loop) - 1)).toBeGreaterThan(Math.abs(area(alongLoop(loop, ['x', 'y'], 12)) / area(loop) - 1));
  });
  it('keep its ends and its extreme points, and are samples', () => {
    for (const [name, all] of [['x', x], ['y', y]] as const) {
      expect([column(name)[0], column(name).at(-1), Math.min(...column(name)), Math.max(...column(name))])
        .toEqual([all[0], all.at(-1), Math.min(...all), Math.max(...all)]);
    }
    expect(column('time').every((time) => phases.includes(time))).toBe(true);
  });
  it('are all there if they are few, or lie on one point', () => {
    expect(alongLoop(loop, ['x', 'y'], SAMPLES)).toBe(loop);
    const still = seriesOf({x: new Array<number>(100).fill(1), y: new Array<number>(100).fill(2)});
    expect(alongLoop(still, ['x', 'y'], 10).get('x')!.values.length).toBeLessThanOrEqual(10);
  });
});

describe('a raster', () => {
  const rows = [[0, 0, 8, 0], [0, 4, 0, 0]].map((values, i) => ({name: `c${i}`, values}));
  const raster = {time: [0, 1, 2, 3], rows, label: 'force [N]', largest: 8};
  const brightness = (window: [number, number], count: number) => Array.from(pixelsOf(raster, window, count)).filter((_, i) => i % 4 === 1);
  it('has the first row at the bottom, and loses no peak when many samples are one pixel', () => {
    const [top, bottom] = brightness([0, 3.5], 1);
    expect([bottom! > top!, top! > 100]).toEqual([true, true]);
  });
  it('shows what lies between samples, and nothing beside them', () => {
    const [, second, third] = brightness([-2.1, 3.9], 3);   // Of the upper row: before the first sample, past a peak, after it.
    expect([brightness([5, 6], 2).every((value) => value === 0), Array.from(pixelsOf(raster, [-2.1, 3.9], 3))[3]]).toEqual([true, 0]);
    expect(second! > third!).toBe(true);
  });
});
