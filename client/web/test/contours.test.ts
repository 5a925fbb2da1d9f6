import {create} from '@bufbuild/protobuf';
import {describe, expect, it} from 'vitest';

import {SweepCellSchema} from '../src/api/generated/contact/v1/event_pb';
import {Job_Convergence, Job_State} from '../src/api/generated/contact/v1/job_pb';
import {contourShapes} from '../src/model/contour_shapes';
import {contourLevels, contourLines} from '../src/model/contours';

/** A grid of values, row by row. */
const grid = (columns: number, rows: number, of: (x: number, y: number) => number) =>
  Array.from({length: columns * rows}, (_, i) => of(i % columns, Math.floor(i / columns)));

describe('levels', () => {
  it('are about six round numbers in equal steps', () => {
    expect(contourLevels([0.5, 10], false)).toEqual([2, 4, 6, 8, 10]);
    expect(contourLevels([-0.25, 0.35], false).map((level) => Number(level.toFixed(9)))).toEqual([-0.2, -0.1, 0, 0.1, 0.2, 0.3]);
  });
  it('are 1, 2 and 5 of each decade of a logarithmic scale, only 1 of many', () => {
    expect(contourLevels([0.015, 3], true)).toEqual([0.02, 0.05, 0.1, 0.2, 0.5, 1, 2]);
    expect(contourLevels([1e-3, 1e3], true)).toEqual([1e-3, 0.01, 0.1, 1, 10, 100, 1e3]);
    expect(contourLevels([2, 8], true)).toEqual([2, 3, 4, 5, 6, 7, 8]);
  });
  it('are none of one value, of noise and of a scale without values', () => {
    expect([contourLevels([3, 3], false), contourLevels([1, 1 + 1e-12], false), contourLevels([0, 1], true)]).toEqual([[], [], []]);
  });
});

describe('lines', () => {
  it('of a plane are straight', () => {
    const lines = contourLines(grid(5, 4, (x) => x), 5, 2.5);
    expect(lines.map((line) => line.map(([x]) => x))).toEqual([[2.5, 2.5, 2.5, 2.5]]);
    expect(lines[0]!.map(([, y]) => y).sort()).toEqual([0, 1, 2, 3]);
  });
  it('around a peak are closed', () => {
    const [line, ...others] = contourLines(grid(3, 3, (x, y) => (x === 1 && y === 1 ? 1 : 0)), 3, 0.5);
    expect([others, line!.length, line![0]]).toEqual([[], 5, line![4]]);
  });
  it('do not cross in a saddle', () => {
    const ends = (high: number) => contourLines([1, 0, 0, high], 2, 0.5).map((line) => line.flat().reduce((a, b) => a + b));
    expect(ends(1)).toEqual([2, 2]);
    expect(ends(0.6).map((sum) => Number(sum.toFixed(3)))).toEqual([1, 3.667]);
  });
  it('go nowhere beside a cell without value', () => {
    const lines = contourLines(grid(5, 5, (x, y) => (x === 2 && y === 2 ? NaN : x)), 5, 1.5);
    expect(lines.map((line) => line.map(([, y]) => y).sort())).toEqual([[0, 1], [3, 4]]);
  });
});

describe('shapes', () => {
  const axis = (count: number) => ({name: 'axis', values: Array.from({length: count}, (_, i) => i)});
  const data = (convergence: (index: number) => Job_Convergence) => ({
    x: axis(5), y: axis(5), indexAt: (i: number, j: number) => 5 * j + i, metric: 0, metricName: 'x', log: false,
    cells: new Map(grid(5, 5, (x) => x).map((value, index) => [index, create(SweepCellSchema,
      {index, state: Job_State.SUCCEEDED, convergence: convergence(index), metrics: [value]})]))});
  const place = {left: 10, width: 40, height: 20, columns: 5, rows: 5};
  it('have one path and one label for each level', () => {
    const {contours, labels} = contourShapes(data(() => Job_Convergence.FULL), place, [0.5, 3.5]);
    expect(contours.map(({level}) => level)).toEqual(['0.5', '1', '1.5', '2', '2.5', '3', '3.5']);
    expect(contours[0]!.path).toMatch(/^M50 \d+(L50 \d+){4}$/);
    expect(labels.map(({x, y, text}) => [text, x, y])[0]).toEqual(['0.5', 50, 50]);
  });
  it('leave out cells that did not converge', () => {
    const {contours} = contourShapes(data((index) => (index === 12 ? Job_Convergence.PARTIAL : Job_Convergence.FULL)), place, [0.5, 3.5]);
    expect(contours.find(({level}) => level === '1.5')!.path.split('M').length - 1).toBe(2);
  });
});
