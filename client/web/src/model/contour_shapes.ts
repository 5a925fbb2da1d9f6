// Lines of equal value as shapes of a map, with their labels.

import type {MapPlace} from './cell_shapes';
import {contourLevels, contourLines, type ContourLine} from './contours';
import type {MapData} from './map_data';
import {short} from './numbers';
import {metricOf, outcomeOf} from './sweep';

const SHORTEST_PX = 40;   // Of a line with a label.
const LETTER_PX = 8;
const LABEL_PX = 16;      // The height of a label.
const DIGITS = 10;

/** The lines of a level. */
export interface Contour {
  level: string;
  path: string;
}

/** The middle of a label in the drawing. */
export interface ContourLabel {
  x: number;
  y: number;
  text: string;
}

const round = (value: number) => Math.round(value * 10) / 10;
const lengthOf = (line: ContourLine) => line.slice(1).reduce((sum, [x, y], i) => sum + Math.hypot(x - line[i]![0], y - line[i]![1]), 0);

/** The values between which lines go, row by row; NaN where none may go. */
function valuesOf({x, y, cells, indexAt, metric}: MapData, scale: (value: number) => number): number[] {
  return y.values.flatMap((_, j) => x.values.map((__, i) => {
    const cell = cells.get(indexAt(i, j));
    return outcomeOf(cell) === 'converged' ? scale(metricOf(cell, metric)) : NaN;
  }));
}

/** Labels on the longest lines first, each where it covers no other. */
function labelsOf(lines: [string, ContourLine][], {left, width, columns}: MapPlace): ContourLabel[] {
  const labels: ContourLabel[] = [];
  const long = lines.map(([text, line]) => ({text, line, length: lengthOf(line)})).filter(({length}) => length >= SHORTEST_PX);
  for (const {text, line} of long.sort((a, b) => b.length - a.length)) {
    const half = text.length * LETTER_PX / 2;
    const places = [1 / 2, 1 / 3, 2 / 3].map((part) => line[Math.floor(part * (line.length - 1))]!)
      .map(([x, y]): ContourLabel => ({x: Math.min(Math.max(x, left + half), left + width * columns - half), y, text}));
    const free = places.find((one) => labels.every((other) =>
      Math.abs(one.x - other.x) > half + other.text.length * LETTER_PX / 2 || Math.abs(one.y - other.y) > LABEL_PX));
    if (free) labels.push(free);
  }
  return labels;
}

/** The lines of a map over the range of its colours, and their labels. */
export function contourShapes(data: MapData, place: MapPlace, range: [number, number]): {contours: Contour[]; labels: ContourLabel[]} {
  const {left, width, height, columns} = place;
  const scale = (value: number) => (data.log ? Math.log(value) : value);
  const values = valuesOf(data, scale);
  const drawn = ([i, j]: [number, number]): [number, number] => [round(left + (i + 0.5) * width), round((j + 0.5) * height)];
  const lines = contourLevels(range, data.log).flatMap((level) =>
    contourLines(values, columns, scale(level)).map((line): [string, ContourLine] => [short(level, DIGITS), line.map(drawn)]));
  const paths = new Map<string, string>();
  for (const [level, line] of lines) paths.set(level, `${paths.get(level) ?? ''}M${line.map((point) => point.join(' ')).join('L')}`);
  return {contours: [...paths].map(([level, path]) => ({level, path})), labels: labelsOf(lines, place)};
}
