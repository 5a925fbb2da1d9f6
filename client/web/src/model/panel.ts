// What a plot shows: plain values in SI units, as contactctl's figures have them.

import type {Raster} from './raster';

/** How the points of a curve are drawn. */
export type Mark = 'line' | 'dashed' | 'linePoints' | 'points' | 'rare' | 'start' | 'end' | 'faint';

/** Points (x, y) in the order in which they are joined. */
export interface Curve {
  label: string;
  /** Curves of one colour belong together, such as all those of a contact. */
  colour: number;
  mark: Mark;
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  /** False if it has no entry in the key. */
  keyed?: boolean;
  /** The recorded column that it shows, and what was added to its values. */
  channel?: string;
  offset?: number;
  /** Spans of x whose points are too rare to be joined. */
  loose?: Band[];
}

/** A stretch of the x axis. */
export interface Band {
  start: number;
  end: number;
}

/** Between which values something was, over a stretch of the x axis. */
export interface Range extends Band {
  /** The curve that it belongs to, and its colour. */
  label: string;
  colour: number;
  low: number;
  high: number;
}

/** Stretches of one contact, drawn as a row of bars above the curves. */
export interface Lane {
  label: string;
  colour: number;
  bars: (Band & {text: string})[];
}

/** A text above a point. */
export interface Label {
  x: number;
  y: number;
  text: string;
}

/** One pair of axes. */
export interface Panel {
  /** Names the panel in addresses, files and tests, such as `force`. */
  id: string;
  title: string;
  xLabel: string;
  yLabel: string;
  /** True if all curves have x in time, ascending, so that a cursor can read them. */
  overTime: boolean;
  countedX?: boolean;
  countedY?: boolean;
  logX?: boolean;
  logY?: boolean;
  curves: Curve[];
  bands?: Band[];
  /** What the end of the run cuts. */
  cut?: Band[];
  ranges?: Range[];
  /** What the samples are too few for. */
  stamp?: string;
  lanes?: Lane[];
  labels?: Label[];
  dottedLines?: number[];
  /** Drawn in place of curves; y is the number of a row, from 1. */
  raster?: Raster;
  /** What marks and shades mean. */
  note?: string;
  /** Why there are no curves, if that is known. */
  nothing?: string;
}

/** The panel with powers of ten upwards: what is not above 0 is not there. */
export function logarithmic(panel: Panel): Panel {
  const above = ({y}: Curve) => Array.from(y, (value) => (value > 0 ? value : null)) as number[];
  return {...panel, logY: true, curves: panel.curves.map((curve) => ({...curve, y: above(curve)})), note: [panel.note, 'of what is above 0'].filter(Boolean).join('; ')};
}

/** Whether a curve is hidden, or that whose marks or loops it is. */
export function isHidden({label}: Curve, hidden: Set<string>): boolean {
  return hidden.has(label) || hidden.has(label.replace(/ (starts|ends)$/, '').replace(/,.*| #.*$/, ''));
}

/** The panel of what is not hidden. */
export function without(panel: Panel, hidden: Set<string>): Panel {
  return {...panel, curves: panel.curves.filter((curve) => !isHidden(curve, hidden)), ranges: panel.ranges?.filter(({label}) => !hidden.has(label))};
}

/** Bands in order, those that touch or overlap as one. */
export function joined(bands: Band[]): Band[] {
  const result: Band[] = [];
  for (const band of [...bands].sort((a, b) => a.start - b.start)) {
    const last = result.at(-1);
    if (last && band.start <= last.end) last.end = Math.max(last.end, band.end);
    else result.push({...band});
  }
  return result;
}

/** y at x between samples; `xs` ascends. */
export function interpolate(xs: ArrayLike<number>, ys: ArrayLike<number>, x: number): number {
  const next = lowerBound(xs, x);
  if (xs.length === 0) return NaN;
  if (next === xs.length) return ys[xs.length - 1]!;
  if (next === 0) return ys[0]!;
  const part = (x - xs[next - 1]!) / (xs[next]! - xs[next - 1]!);
  return ys[next - 1]! + part * (ys[next]! - ys[next - 1]!);
}

/** The first place in ascending values that is not below x. */
export function lowerBound(xs: ArrayLike<number>, x: number): number {
  let low = 0;
  let high = xs.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (xs[middle]! < x) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** How many ascending values lie between two others; 0 unless the values go on beyond both. */
export function insideOf(xs: ArrayLike<number>, [from, to]: [number, number]): number {
  const [first, end] = [lowerBound(xs, from), lowerBound(xs, to)];
  return first > 0 && end < xs.length ? end - first : 0;
}

/** Smallest and largest finite value; undefined without any. */
export function extent(lists: Iterable<ArrayLike<number>>, positive = false): [number, number] | undefined {
  let low = Infinity;
  let high = -Infinity;
  for (const list of lists) {
    for (let i = 0; i < list.length; ++i) {
      const value = list[i]!;
      if (!Number.isFinite(value) || (positive && value <= 0)) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low <= high ? [low, high] : undefined;
}

/** How far values go up and down in all between two places; what is no number is passed over. */
export function travel(values: ArrayLike<number | null | undefined>, first: number, last: number): number {
  let sum = 0;
  let before: number | undefined;
  for (let i = first; i <= last; ++i) {
    const value = values[i];
    if (!Number.isFinite(value)) continue;
    sum += Math.abs(value! - (before ?? value!));
    before = value!;
  }
  return sum;
}

/** A text as a field of CSV. */
export function csvField(text: string): string {
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** The points of a panel as CSV, as `contactctl plot -o csv` has them. */
export function panelCsv(panel: Panel): string {
  const {raster} = panel;
  const rows = [['curve', panel.xLabel, raster?.label ?? panel.yLabel].map(csvField).join(',')];
  const curves = raster ? raster.rows.map(({name, values}) => ({label: name, x: raster.time, y: values})) : panel.curves;
  for (const {label, x, y} of curves) {
    for (let i = 0; i < x.length; ++i) rows.push(`${csvField(label)},${x[i]},${y[i]}`);
  }
  return `${rows.join('\n')}\n`;
}
