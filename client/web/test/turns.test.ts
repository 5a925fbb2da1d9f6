import {afterEach, beforeEach, expect, test, vi} from 'vitest';

import {Turns, type Rest} from '../src/api/turns';

let newest = 0;                                  // What is wanted.
let begun: number[] = [];                        // What each call took up.
let answer: (rest: Rest) => void = () => undefined;
let turns: Turns;

/** Ends the call that is under way. */
async function answered(rest: Rest = {pauseMs: 0}): Promise<void> {
  answer(rest);
  await vi.advanceTimersByTimeAsync(0);
}
function want(value: number): void {
  newest = value;
  turns.now();
}

beforeEach(() => {
  vi.useFakeTimers();
  begun = [];
  turns = new Turns(() => new Promise((resolve) => { begun.push(newest); answer = resolve; }));
});
afterEach(() => { vi.useRealTimers(); });

test('of all that is wanted during a call only the last is called', async () => {
  for (const value of [1, 2, 3, 4]) want(value);
  expect(begun).toEqual([1]);
  await answered();
  expect(begun).toEqual([1, 4]);
  await answered();
  await vi.advanceTimersByTimeAsync(10_000);
  expect(begun).toEqual([1, 4]);
});

test('what has time waits for the end of the pause, and what has none does not', async () => {
  want(1);
  turns.later();
  await answered({pauseMs: 400});
  await vi.advanceTimersByTimeAsync(399);
  expect(begun).toHaveLength(1);
  await vi.advanceTimersByTimeAsync(1);
  expect(begun).toHaveLength(2);
  want(3);
  turns.later();
  await answered({pauseMs: 400});
  expect(begun).toEqual([1, 1, 3]);
});

test('many that have time make one call', async () => {
  want(1);
  await answered({pauseMs: 400});
  for (let i = 0; i < 5; ++i) turns.later();
  await vi.advanceTimersByTimeAsync(400);
  expect(begun).toHaveLength(2);
});

test('a call that failed is made again after its pause, unless another was wanted', async () => {
  want(1);
  await answered({pauseMs: 1000, again: true});
  expect(begun).toEqual([1]);
  await vi.advanceTimersByTimeAsync(1000);
  expect(begun).toEqual([1, 1]);
  want(2);
  await answered({pauseMs: 1000, again: true});
  expect(begun).toEqual([1, 1, 2]);
});

test('after the end nothing is called', async () => {
  want(1);
  turns.end();
  await answered({pauseMs: 0, again: true});
  turns.now();
  await vi.advanceTimersByTimeAsync(10_000);
  expect(begun).toEqual([1]);
});
