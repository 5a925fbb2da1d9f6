// A quantity of many contacts as colours over time, a row for each: how a wave goes through a row of bodies.

import {interpolate, lowerBound} from './panel';
import {viridis} from './sweep';

/** What is drawn as colours: 0 dark, `largest` bright. The first row is the lowest. */
export interface Raster {
  time: ArrayLike<number>;
  rows: {name: string; values: ArrayLike<number>}[];
  /** The quantity with its unit, such as `force [N]`. */
  label: string;
  largest: number;
}

const LEVELS = Array.from({length: 256}, (_, i) => [1, 3, 5].map((at) => parseInt(viridis(i / 255).slice(at, at + 2), 16)));

/** What stands at one of many equal parts of a stretch of time. */
interface Column {
  middle: number;
  /** Its samples, as far as there are any. */
  first: number;
  end: number;
}

/** The parts of a stretch of time in which something is recorded, by their places. */
function columnsOf(time: ArrayLike<number>, [from, to]: [number, number], count: number): Map<number, Column> {
  const step = (to - from) / count;
  const columns = new Map<number, Column>();
  for (let i = 0; i < count; ++i) {
    const [start, stop] = [from + i * step, from + (i + 1) * step];
    if (stop < time[0]! || start > time[time.length - 1]!) continue;
    columns.set(i, {middle: (start + stop) / 2, first: lowerBound(time, start), end: lowerBound(time, stop)});
  }
  return columns;
}

/** The largest sample of a column, or the value in its middle if it has none. */
function valueIn(time: ArrayLike<number>, values: ArrayLike<number>, {middle, first, end}: Column): number {
  if (first === end) return interpolate(time, values, middle);
  let largest = values[first]!;
  for (let at = first + 1; at < end; ++at) largest = Math.max(largest, values[at]!);
  return largest;
}

/** The pixels of a stretch of time, as `ImageData` has them, clear where nothing is recorded: the last row at the top. */
export function pixelsOf({time, rows, largest}: Raster, window: [number, number], count: number): Uint8ClampedArray<ArrayBuffer> {
  const pixels = new Uint8ClampedArray(4 * count * rows.length);
  const columns = columnsOf(time, window, count);
  rows.forEach(({values}, j) => {
    for (const [i, column] of columns) {
      const level = LEVELS[Math.round(255 * Math.min(Math.max(valueIn(time, values, column) / largest, 0), 1))] ?? LEVELS[0]!;
      pixels.set([...level, 255], 4 * (count * (rows.length - 1 - j) + i));
    }
  });
  return pixels;
}
