import {create} from '@bufbuild/protobuf';
import {describe, expect, it} from 'vitest';

import {ScenarioSchema} from '../src/api/generated/contact/v1/scenario_pb';
import type {Series} from '../src/api/series';
import {columnsOf, derivedPanel, formulaOf, formulasIn} from '../src/model/derived';
import {mechanicsOf} from '../src/model/mechanics';

const mechanics = mechanicsOf(create(ScenarioSchema, {bodies: [{name: 'A'}, {name: 'B-1'}], contacts: [{between: ['A', 'B-1']}]}));
const columns = columnsOf(mechanics);
const at = (text: string) => formulaOf(text, columns).at((name) => ({'A.velocity': [3], 'B-1.velocity': [2], 'A-B-1.contact_force': [8]})[name] ?? [NaN], 0);

describe('a formula', () => {
  it('is computed as it is written, over columns whose names may have its signs', () => {
    expect(['A.velocity-B-1.velocity', '2 + 3 * A.velocity ^ 2', '-(A.velocity)^2', '10 - 4 - 3', '2 ^ 3 ^ 2', 'sqrt(A-B-1.contact_force * 2)', 'abs(1e1 - 3.5e+1)/.5', '8/2/2'].map(at))
      .toEqual([1, 29, -9, 3, 512, 4, 50, 2]);
    expect(formulaOf('A.velocity * A-B-1.contact_force + A.velocity', columns).channels).toEqual(['A.velocity', 'A-B-1.contact_force']);
  });
  it('tells what is wrong with it', () => {
    const why = (text: string) => { try { formulaOf(text, columns); return ''; } catch (error) { return (error as Error).message; } };
    expect(['A.speed', '(A.velocity', 'A.velocity +', '2 3', 'constructor(1)'].map(why)).toEqual([
      'A.speed: no column of this run, such as A.velocity', 'a ) is missing', 'something is missing at the end', '3: not understood', 'constructor: no column of this run, such as A.velocity']);
    expect(formulasIn(['A.speed', 'time'], mechanics).map(({text}) => text)).toEqual(['time']);
  });
  it('is plotted over time, and is empty where a column was not recorded', () => {
    const series = new Map([['time', [0, 1]], ['A.velocity', [3, 4]]].map(([name, values]) => [name, {name, quantity: '', unit: '', values: Float64Array.from(values as number[])}])) as unknown as Series;
    const curves = (text: string) => derivedPanel(formulaOf(text, columns), {mechanics, series, cycles: [], groups: [], bands: []}).curves.map(({x, y}) => [Array.from(x), Array.from(y)]);
    expect([curves('A.velocity * time'), curves('B-1.velocity')]).toEqual([[[[0, 1], [0, 4]]], []]);
  });
});
