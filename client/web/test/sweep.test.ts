import {describe, expect, it} from 'vitest';

import {cellAt, cornerOf} from '../src/model/cell_shapes';
import {planeOf} from '../src/model/map_data';

describe('a map', () => {
  it('has the first axis down, its first value at the top, as contactctl and contactsim draw it', () => {
    const place = {left: 10, width: 5, height: 4, columns: 3, rows: 2};
    expect([cornerOf(place, 0, 0), cornerOf(place, 2, 1), cellAt(place, 12, 1), cellAt(place, 24, 7)]).toEqual([[10, 0], [20, 4], [0, 0], [2, 1]]);
    expect(planeOf(2, undefined, undefined)).toEqual({down: 0, across: 1});
  });
  it('never has the same axis both ways', () => {
    expect([[0, undefined], [1, undefined], [1, 1], [2, 2], [0, 0], [9, 9]].map(([y, x]) => planeOf(3, y, x))).toEqual(
      [{down: 0, across: 1}, {down: 1, across: 0}, {down: 1, across: 0}, {down: 2, across: 0}, {down: 0, across: 1}, {down: 2, across: 0}]);
  });
});
