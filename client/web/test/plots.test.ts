import {create} from '@bufbuild/protobuf';
import type uPlot from 'uplot';
import {describe, expect, it} from 'vitest';

import {CycleSchema} from '../src/api/generated/contact/v1/job_pb';
import {ScenarioSchema} from '../src/api/generated/contact/v1/scenario_pb';
import type {Series} from '../src/api/series';
import {polygons, hysteresis} from '../src/model/hysteresis';
import {mechanicsOf} from '../src/model/mechanics';
import {pixelsOf} from '../src/model/raster';
import {unitOfScale} from '../src/plots/axes';

const seriesOf = (columns: Record<string, number[]>): Series => new Map(Object.entries(columns).map(([name, values]) =>
  [name, {name, quantity: '', unit: '', values: Float64Array.from(values)}]));

/** As much of a plot as the functions that place words and units look at. */
const plotOf = (scales: Record<string, Partial<uPlot.Scale>>) => ({scales}) as unknown as uPlot;

describe('an axis', () => {
  it('has a prefix that its ticks are divided by, and none if it is logarithmic', () => {
    const label = 'μ [N·s/m^(n+1)]';
    const of = (distr: uPlot.Scale.Distr) => unitOfScale(plotOf({y: {min: 1e6, max: 1e11, distr}}), 'y', label);
    expect(of(1)).toEqual({factor: 1e9, label: 'μ [GN·s/m^(n+1)]'});
    expect(of(3)).toEqual({factor: 1, label});
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
