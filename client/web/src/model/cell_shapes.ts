// The cells of a sweep as few shapes: one path for each colour, so that ten thousand are drawn as fast
// as ten.

import type {SweepCell} from '../api/generated/contact/v1/event_pb';
import look from '../../../python/contactsim/figures/words.json';
import {interpolate} from './panel';
import {short} from './numbers';
import {inkOn, metricOf, outcomeOf, unknownOf, viridis} from './sweep';

const LEVELS = 64;   // Colours of the scale.

/** Where a map stands in its drawing, and the size of its cells. */
export interface MapPlace {
  left: number;
  width: number;
  height: number;
  columns: number;
  rows: number;
}

/** A text in a cell. */
export interface Word {
  x: number;
  y: number;
  text: string;
  ink: string | undefined;
  /** Drawn with a rim, so that it can be read on hatching. */
  rim: boolean;
}

export interface MapShapes {
  /** A path for each colour. */
  fills: [string, string][];
  hatched: string;
  /** The bars of the cells that the end of the run cuts. */
  cut: string;
  words: Word[];
}

/** The colours of cells without a known number. */
export const GREYS = {'CUT': look.map.cut, 'no contact': look.map.no_contact};

/** Paths by colour. */
export function byColour(parts: Iterable<[string, string]>): [string, string][] {
  const paths = new Map<string, string[]>();
  for (const [colour, path] of parts) {
    const known = paths.get(colour);
    if (known) known.push(path);
    else paths.set(colour, [path]);
  }
  return [...paths].map(([colour, list]) => [colour, list.join('')]);
}

/** The colour of a part of the scale, one of a few. */
export function levelOf(part: number): string {
  return viridis(Math.round(Math.min(Math.max(part, 0), 1) * (LEVELS - 1)) / (LEVELS - 1));
}

const round = (value: number) => Math.round(value * 100) / 100;

/** The left upper corner of a cell. The first row is at the top. */
export function cornerOf({left, width, height}: MapPlace, i: number, j: number): [number, number] {
  return [round(left + i * width), round(j * height)];
}

/** The place of the cell at a point of the drawing; undefined outside. */
export function cellAt({left, width, height, columns, rows}: MapPlace, x: number, y: number): [number, number] | undefined {
  const i = Math.floor((x - left) / width);
  const j = Math.floor(y / height);
  return i >= 0 && i < columns && j >= 0 && j < rows ? [i, j] : undefined;
}

/** The shapes of a map. `part`: where a value stands on the scale, from 0 to 1; `numbers`: whether large cells show theirs. */
export function mapShapes(place: MapPlace, cellOf: (i: number, j: number) => SweepCell | undefined, metric: number, part: (value: number) => number, numbers = true): MapShapes {
  const {width, height, columns, rows} = place;
  const roomy = numbers && width > 30 && height > 13;
  const fills: [string, string][] = [];
  const words: Word[] = [];
  let hatched = '';
  let cut = '';
  for (let j = 0; j < rows; ++j) {
    for (let i = 0; i < columns; ++i) {
      const cell = cellOf(i, j);
      const outcome = outcomeOf(cell);
      if (outcome === 'waiting') continue;
      const why = outcome === 'failed' ? '' : unknownOf(cell, metric);
      const value = metricOf(cell, metric);
      const at = part(value);
      const [x, y] = cornerOf(place, i, j);
      const path = `M${x} ${y}h${round(width)}v${round(height)}h${-round(width)}z`;
      if (why) fills.push([GREYS[why], path]);
      if (why === 'CUT') cut += `M${round(x + width / 2)} ${y}v${round(height)}`;
      if (why) continue;
      if (Number.isFinite(at)) fills.push([levelOf(at), path]);
      if (outcome === 'not converged') hatched += path;
      if (!roomy && outcome !== 'failed') continue;
      words.push({x: x + width / 2, y: y + height / 2 + 4, rim: outcome === 'not converged', ink: Number.isFinite(at) ? inkOn(at) : undefined,
        text: outcome === 'failed' ? '×' : Number.isFinite(value) ? short(value, 3) : '–'});
    }
  }
  return {fills: byColour(fills), hatched, cut, words};
}

/** The line that passes closest to a point: its place in the list. `lines` have their heights at `xs`. */
export function nearestLine(xs: number[], lines: number[][], x: number, y: number): number {
  let best = -1;
  let least = Infinity;
  lines.forEach((heights, i) => {
    const distance = Math.abs(interpolate(xs, heights, x) - y);
    if (distance < least) [best, least] = [i, distance];
  });
  return best;
}
