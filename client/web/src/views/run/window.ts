// The part of the time that all plots of a run show; it stands in the address.

import {setQuery} from '../../ui/route';
import type {Window} from '../../plots/range';

/** The window of the address. With `follow` it ends at the newest sample. */
export function windowOf(query: URLSearchParams, newest: number): Window | undefined {
  const from = Number(query.get('from') ?? NaN);
  const to = Number(query.get('to') ?? NaN);
  if (!(from < to)) return undefined;
  return query.has('follow') && newest > to ? [newest - (to - from), newest] : [from, to];
}

export function setWindow(window: Window | undefined): void {
  setQuery({
    from: window && String(Number(window[0].toPrecision(9))),
    to: window && String(Number(window[1].toPrecision(9))),
    ...(window ? {} : {follow: undefined}),
  });
}

/** The window closer or wider by a factor, or moved by a part of itself. */
export function changed(window: Window, factor: number, move = 0): Window {
  const [from, to] = window;
  const middle = (from + to) / 2 + move * (to - from);
  const half = (to - from) / 2 * factor;
  return [middle - half, middle + half];
}

/** True if a window shows all of another one, but for rounding. */
export function covers([from, to]: Window, whole: Window): boolean {
  const rounding = 1e-6 * (whole[1] - whole[0]);
  return from <= whole[0] + rounding && to >= whole[1] - rounding;
}
