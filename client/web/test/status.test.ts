import {create} from '@bufbuild/protobuf';
import {describe, expect, it} from 'vitest';

import {SweepCell_Source, SweepCellSchema, type SweepCell} from '../src/api/generated/contact/v1/event_pb';
import {Cycle_Status, CycleSchema, GroupSchema, Job_Convergence, Job_State, JobSchema} from '../src/api/generated/contact/v1/job_pb';
import {GREYS, mapShapes} from '../src/model/cell_shapes';
import {compareResults} from '../src/model/comparison';
import {csvOf, scaleOf, wordsOf, type MapData} from '../src/model/map_data';
import {isCut, lookOfStatus, reachedOf, restitutionOf} from '../src/model/status';
import {countUnknown, metricOf, metricText, unknownsOf} from '../src/model/sweep';

const NAMES = Object.values(Cycle_Status).filter((s): s is Cycle_Status => typeof s === 'number' && s > 0);

describe('a status', () => {
  it('has a sign and a meaning', () => {
    for (const status of NAMES) expect(lookOfStatus(status).meaning, Cycle_Status[status]).not.toBe('');
    expect(lookOfStatus(99 as Cycle_Status)).toMatchObject({sign: '!', tone: 'warn'});   // Of a newer server.
  });
  it('is bad only where the restitution is missed', () => {
    expect(NAMES.filter((s) => lookOfStatus(s).tone === 'bad').map((s) => Cycle_Status[s])).toEqual(['INFEASIBLE', 'NOT_CONVERGED']);
    expect(NAMES.filter((status) => isCut({status})).map((s) => Cycle_Status[s])).toEqual(['UNFINISHED', 'CUT']);
  });
  it('tells whether ε says something', () => {
    const of = (status: Cycle_Status) => restitutionOf(create(CycleSchema, {status, restitutionOut: 62.8}));
    expect([Cycle_Status.SETTLED, Cycle_Status.RELEASED, Cycle_Status.CONVERGED].map(of)).toEqual([NaN, NaN, 62.8]);
    const jobs = [62.8, NaN].map((restitutionOut) => create(JobSchema, {cycles: [{contact: 'C', number: 1, status: Cycle_Status.SETTLED, restitutionOut}]}));
    expect(compareResults(jobs, {absolute: 0, relative: 0}).every(({holds}) => holds.every(Boolean))).toBe(true);
  });
  it('comes with what the search has reached', () => {
    const group = {status: Cycle_Status.LIMITED, tooMuchMu: 8, tooMuchRestitution: 0.75};
    expect(reachedOf(create(GroupSchema, group))).toBe('ε 0.75 at μ = 8');
    expect(reachedOf(create(GroupSchema, {...group, status: Cycle_Status.JUMP, tooLittleMu: 9, tooLittleRestitution: 0.5}))).toBe('ε 0.75 at μ = 8; ε 0.5 at μ = 9');
    expect(reachedOf(create(GroupSchema, {...group, status: Cycle_Status.CONVERGED}))).toBe('');
  });
});

describe('cells without a known number', () => {
  const {RESULT, CUT, NO_CONTACT} = SweepCell_Source;
  const cell = (index: number, source: SweepCell_Source): [number, SweepCell] => [index, create(SweepCellSchema, {
    index, metrics: [index + 1], sources: [source], state: Job_State.SUCCEEDED, convergence: Job_Convergence.FULL})];
  const cells = new Map([cell(0, RESULT), cell(1, CUT), cell(2, NO_CONTACT), cell(3, RESULT)]);
  const map: MapData = {x: {name: 'x', values: [0, 1]}, y: {name: 'y', values: [0, 1]}, indexAt: (i, j) => 2 * j + i, cells, metric: 0, metricName: 'peak', log: false};

  it('have a word instead', () => {
    expect([0, 1, 2].map((i) => metricOf(cells.get(i), 0))).toEqual([1, NaN, NaN]);
    expect([0, 1, 2].map((i) => metricText(cells.get(i), 0))).toEqual(['1', 'CUT', 'no contact']);
    expect(wordsOf(map, [1, 0])).toBe('x = 1, y = 0: peak CUT converged');
    expect(unknownsOf(cells.get(1)!, ['peak'])).toBe('peak: CUT');
    expect(csvOf(map)).toBe('x,y,peak,outcome,unknown\n0,0,1,converged,\n1,0,NaN,converged,CUT\n0,1,NaN,converged,no contact\n1,1,4,converged,\n');
  });
  it('are counted, and do not count for the scale', () => {
    expect(countUnknown(cells.values(), 0)).toEqual({'CUT': 1, 'no contact': 1});
    expect(scaleOf(map).range).toEqual([1, 4]);
    cells.get(3)!.sources = [CUT];
    expect(scaleOf(map).range).toEqual([1, 1]);
    cells.get(3)!.sources = [RESULT];
  });
  it('are grey in a map, and barred where the end cuts them', () => {
    const place = {left: 0, width: 50, height: 20, columns: 2, rows: 2};
    const shapes = mapShapes(place, (i, j) => cells.get(2 * j + i), 0, scaleOf(map).part);
    expect(shapes.fills).toContainEqual([GREYS.CUT, 'M50 0h50v20h-50z']);
    expect(shapes.fills).toContainEqual([GREYS['no contact'], 'M0 20h50v20h-50z']);
    expect(shapes.cut).toBe('M75 0v20');
    expect(shapes.words.map(({text}) => text)).toEqual(['1', '4']);
  });
  it('are those of servers that tell so', () => {
    const old = create(SweepCellSchema, {metrics: [5]});
    expect([metricOf(old, 0), metricText(old, 0)]).toEqual([5, '5']);
  });
});
