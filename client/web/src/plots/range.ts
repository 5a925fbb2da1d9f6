// What part of the plane a panel shows.

import {extent, lowerBound, type Panel} from '../model/panel';
import {rowRange} from '../model/raster';

export type Window = [number, number];

const drawn = (panel: Panel) => panel.curves.filter(({mark}) => mark !== 'start' && mark !== 'end');

/** The x axis: the window, or all there is. */
export function xRange(panel: Panel, window: Window | undefined): Window {
  if (window && panel.overTime && !panel.countedX) return window;
  const found = extent([...drawn(panel).filter(({mark}) => mark !== 'points').map(({x}) => x), panel.raster?.time ?? []], panel.logX) ?? [0, 1];
  if (panel.overTime) return found[0] < found[1] ? found : [found[0], found[0] + (panel.countedX ? 1 : 1e-9)];
  return padded(found, !!panel.logX);
}

function padded([low, high]: Window, log: boolean): Window {
  if (log) return [10 ** Math.floor(Math.log10(low) + 1e-9), 10 ** Math.ceil(Math.log10(high) - 1e-9) * (low === high ? 10 : 1)];
  const span = high - low || Math.abs(high) || 1;
  return [low - 0.04 * span, high + 0.04 * span];
}

const between = (values: ArrayLike<number>, first: number, end: number): ArrayLike<number> =>
  (values instanceof Float64Array ? values.subarray(first, end) : Array.from(values).slice(first, end));

/** The y axis: all values inside the x range, and room for labels. */
export function yRange(panel: Panel, [from, to]: Window): Window {
  if (panel.raster) return rowRange(panel.raster);
  const inside = drawn(panel).map(({x, y}) => {
    if (!panel.overTime) return y;
    const first = Math.max(lowerBound(x, from) - 1, 0);
    return between(y, first, lowerBound(x, to) + 1);
  });
  const ranges = (panel.ranges ?? []).filter(({start, end}) => end >= from && start <= to).map(({low, high}) => [low, high]);
  const found = extent([...inside, ...ranges], panel.logY);
  if (!found) return panel.logY ? [1e-3, 1] : [0, 1];
  const [low, high] = padded(found, !!panel.logY);
  return panel.labels?.length ? [low, high + 0.1 * (high - low)] : [low, high];
}
