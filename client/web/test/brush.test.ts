import {describe, expect, it} from 'vitest';

import {brushesIn, entriesOf, isInside, moved, rounded, stopsOf, withRange} from '../src/model/brush';

describe('ranges of a sweep', () => {
  it('stand in the address, where what is none is passed over', () => {
    const brushes = brushesIn(['0:0.2:0.4', '2:-1e-9:5'], 3);
    expect([...brushes]).toEqual([[0, [0.2, 0.4]], [2, [-1e-9, 5]]]);
    expect(brushesIn(entriesOf(brushes), 3)).toEqual(brushes);
    expect([...brushesIn(['', '3:0:1', '-1:0:1', '0:2:1', '0:x:1', '0::1', '0:1', '0.5:0:1', '0:0:1:2'], 3)]).toEqual([]);
  });
  it('choose the cells in all of them, their ends among them', () => {
    const brushes = brushesIn(['0:1:2', '1:5:6'], 2);
    expect([[1, 5], [2, 6], [0.9, 5], [1, 6.1], [NaN, 5], [1, NaN]].map((values) => isInside(values, brushes))).toEqual([true, true, false, false, false, false]);
    expect(isInside([NaN], brushesIn([], 1))).toBe(true);
  });
  it('end where they are drawn, to four digits of the axis, and exactly at its ends', () => {
    expect([rounded(0.123456, [0, 1]), rounded(1000001.23456, [1e6, 1e6 + 10]), rounded(123456, [0, 1e6]), rounded(3.4e-9, [0, 1e-6])]).toEqual([0.123, 1000001.23, 123000, 3e-9]);
    expect([rounded(-5, [0.1234567, 1]), rounded(9, [0, 0.7654321])]).toEqual([0.1234567, 0.7654321]);
  });
  it('go when they are of all that there is', () => {
    const one = withRange(new Map(), 1, [2, 3], [0, 3]);
    expect([[...one], [...withRange(one, 1, [0, 3], [0, 3])], [...withRange(one, 1, undefined, [0, 3])]]).toEqual([[[1, [2, 3]]], [], []]);
  });
  it('move by the values that there are, or by parts of many', () => {
    expect(stopsOf([3, 1, NaN, 2, 1])).toEqual([1, 2, 3]);
    const many = stopsOf(Array.from({length: 1000}, (_, i) => i / 999));
    expect([many.length, many[1], many.at(-1)]).toEqual([51, 0.02, 1]);
    const stops = [1, 2, 3, 4];
    expect(moved([1, 4], 0, 1, stops)).toEqual([2, 4]);
    expect(moved([1, 4], 1, -5, stops)).toEqual([1, 1]);
    expect(moved([2.5, 3], 0, 1, stops)).toEqual([3, 3]);
    expect(moved([2.5, 3], 0, 5, stops)).toEqual([3, 3]);   // Not past the other end.
    expect(moved([2.5, 3], 0, -1, stops)).toEqual([2, 3]);
    expect(moved([2, 3], 1, 1, [1, 4])).toEqual([2, 4]);
  });
});
