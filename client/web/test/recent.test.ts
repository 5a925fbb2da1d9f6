import {expect, test} from 'vitest';

import {Recent} from '../src/model/recent';

test('what was put or got the longest ago is forgotten', () => {
  const recent = new Recent<number>(2);
  recent.put('a', 1);
  recent.put('b', 2);
  expect(recent.get('a')).toBe(1);
  recent.put('c', 3);
  expect([recent.get('a'), recent.get('b'), recent.get('c')]).toEqual([1, undefined, 3]);
});

test('a key has the value that it got last', () => {
  const recent = new Recent<number>(2);
  recent.put('a', 1);
  recent.put('a', 2);
  recent.put('b', 3);
  expect([recent.get('a'), recent.get('b')]).toEqual([2, 3]);
});
