import {describe, expect, it} from 'vitest';

import {bytes, compact, count, decimals, exact, seconds, short} from '../src/model/numbers';

describe('numbers', () => {
  it('keep every digit that identifies a double', () => {
    for (const value of [0.1, 1 / 3, 225937807.9203246, -0.003731206344233148, 5e-324, 1e300]) {
      expect(Number(exact(value))).toBe(value);
    }
  });
  it('say that there is none', () => {
    expect(exact(NaN)).toBe('–');
    expect(exact(undefined)).toBe('');
  });
  it('have as many decimals as the step between ticks needs', () => {
    expect([1, 0.5, 0.25, 0.02, 20, 2.5].map(decimals)).toEqual([0, 1, 2, 2, 0, 1]);
  });
  it('are short with prefixes', () => {
    expect([0.00042, 0.0421, 3, 125, 90000].map(seconds)).toEqual(['420 µs', '42.1 ms', '3 s', '2 min 5 s', '25 h 0 min']);
    expect([512, 126000, 2097152].map(bytes)).toEqual(['512 B', '126 kB', '2.1 MB']);
    expect(count(1234567)).toBe('1\u202f234\u202f567');
    expect(short(0.451875612)).toBe('0.4519');
    expect([0.00009916607606633963, -0.003731206344233148, 225937807.9203246, 0, NaN].map((value) => compact(value, 7)))
      .toEqual(['9.916608e-5', '-0.003731206', '225937800', '0', '–']);
  });
});
