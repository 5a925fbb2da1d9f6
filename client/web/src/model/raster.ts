// A quantity of many contacts or bodies over time, a row for each: how a wave goes through a row of bodies.

import {extent, interpolate, lowerBound} from './panel';
import {colourAmong, viridis} from './sweep';

/** What is drawn as colours: 0 dark, `largest` bright. The first row is the lowest. */
export interface Raster {
  time: ArrayLike<number>;
  rows: {name: string; values: ArrayLike<number>}[];
  /** The quantity with its unit, such as `force [N]`. */
  label: string;
  /** How many rows further in the scenario the next one is; 1 if not told. */
  every?: number;
  /** How many stand before the first one; 0 if not told. */
  first?: number;
  /** The largest magnitude. */
  largest: number;
  /** True where values lie on both sides of 0: blue below it, red above it. */
  both?: boolean;
  /** True if each row is a line, see `waterfallOf`, in place of colours. */
  lines?: boolean;
}

/** RdBu of ColorBrewer from below: that of contactsim's figures. */
const BOTH = ['053061', '2166ac', '4393c3', '92c5de', 'd1e5f0', 'f7f7f7', 'fddbc7', 'f4a582', 'd6604d', 'b2182b', '67001f'];
const levelsOf = (colour: (part: number) => string) =>
  Array.from({length: 257}, (_, i) => [1, 3, 5].map((at) => parseInt(colour(i / 256).slice(at, at + 2), 16)));
const ONE_SIDE = levelsOf(viridis);
const BOTH_SIDES = levelsOf((part) => colourAmong(BOTH, part));

const MOST_LINES = 60;   // Of a waterfall: more would be grey.
const HEIGHT = 2;        // Of its largest value, in lines.
const SHADES: readonly [number, number] = [0, 0.9];      // Of viridis, as far as they can be seen on white,
const ON_DARK: readonly [number, number] = [0.35, 1];    // and on black.

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

/** The sample of largest magnitude in a column, or the value in its middle if it has none. */
function valueIn(time: ArrayLike<number>, values: ArrayLike<number>, {middle, first, end}: Column): number {
  if (first === end) return interpolate(time, values, middle);
  let largest = values[first]!;
  for (let at = first + 1; at < end; ++at) if (Math.abs(values[at]!) > Math.abs(largest)) largest = values[at]!;
  return largest;
}

/** The pixels of a stretch of time, as `ImageData` has them, clear where nothing is recorded: the last row at the top. */
export function pixelsOf({time, rows, largest, both}: Raster, window: [number, number], count: number): Uint8ClampedArray<ArrayBuffer> {
  const pixels = new Uint8ClampedArray(4 * count * rows.length);
  const columns = columnsOf(time, window, count);
  const levels = both ? BOTH_SIDES : ONE_SIDE;
  const part = (value: number) => Math.min(Math.max(both ? (1 + value / largest) / 2 : value / largest, 0), 1);
  rows.forEach(({values}, j) => {
    for (const [i, column] of columns) {
      const level = levels[Math.round(256 * part(valueIn(time, values, column)))] ?? levels[both ? 128 : 0]!;
      pixels.set([...level, 255], 4 * (count * (rows.length - 1 - j) + i));
    }
  });
  return pixels;
}

/** The line of a row. */
export interface RowLine {
  /** Number of the row in the scenario, from 1: where the line stands while its values are 0. */
  row: number;
  colour: string;
  /** Heights above row 0, in rows; at the times of the raster. */
  y: Float64Array;
}

/** A line for each row, of many rows every n-th, coloured by its place. From the top down, so that each lies over the one behind it. */
export function waterfallOf({rows, largest, every = 1, first: before = 0}: Raster, dark = false): RowLine[] {
  const step = Math.ceil(rows.length / MOST_LINES);
  const places = rows.map((_, i) => i).filter((i) => i % step === 0);
  const unit = HEIGHT * step * every / (largest || 1);
  const [first, last] = dark ? ON_DARK : SHADES;
  return places.map((i, place) => ({
    row: before + 1 + i * every,
    colour: viridis(first + (last - first) * place / Math.max(places.length - 1, 1)),
    y: Float64Array.from(rows[i]!.values, (value) => before + 1 + i * every + unit * value),
  })).reverse();
}

/** What of the axis of rows is shown. */
export function rowRange(raster: Raster): [number, number] {
  const {every = 1, first: before = 0, rows: {length}} = raster;
  const [first, last] = [before + 1, before + 1 + (length - 1) * every];
  if (!raster.lines) return [first - every / 2, last + every / 2];
  const [low, high] = extent(waterfallOf(raster).map(({y}) => y)) ?? [first, last];
  const step = every * Math.ceil(length / MOST_LINES);
  return [Math.min(low, first) - 0.5 * step, Math.max(high, last) + 0.3 * step];
}
