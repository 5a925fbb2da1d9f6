// What a map of a sweep shows, without drawing it.

import type {SweepCell} from '../api/generated/contact/v1/event_pb';
import {csvField, extent} from './panel';
import {exact} from './numbers';
import {cellIndex, metricOf, metricText, outcomeOf, unknownOf} from './sweep';

/** An axis of a map. */
export interface Axis {
  name: string;
  values: number[];
}

/** Two axes of a grid, and a metric of its cells. */
export interface MapData {
  x: Axis;
  y: Axis;
  /** The number of the cell at a place. */
  indexAt: (x: number, y: number) => number;
  cells: Map<number, SweepCell>;
  metric: number;
  metricName: string;
  log: boolean;
}

/** Where a value stands on the scale of colours. */
export function scaleOf({cells, metric, log}: MapData): {range: [number, number]; part: (value: number) => number} {
  const range = extent([[...cells.values()].filter((c) => outcomeOf(c) !== 'failed').map((c) => metricOf(c, metric))], log) ?? [0, 1];
  const scale = (v: number) => (log ? Math.log(v) : v);
  return {range, part: (v) => (range[0] === range[1] && Number.isFinite(v) ? 0.5 : (scale(v) - scale(range[0])) / (scale(range[1]) - scale(range[0])))};
}

/** What a cell is, in words. */
export function wordsOf({x, y, cells, indexAt, metric, metricName}: MapData, [i, j]: [number, number]): string {
  const cell = cells.get(indexAt(i, j));
  return `${x.name} = ${exact(x.values[i]!)}, ${y.name} = ${exact(y.values[j]!)}: ${metricName} ${metricText(cell, metric)} ${outcomeOf(cell)}`;
}

/** The cells of the map as CSV. */
export function csvOf(props: MapData): string {
  const {x, y, cells, indexAt, metric, metricName} = props;
  const rows = y.values.flatMap((v, j) => x.values.map((u, i) => {
    const cell = cells.get(indexAt(i, j));
    return [exact(u), exact(v), cell ? String(metricOf(cell, metric)) : '', outcomeOf(cell), unknownOf(cell, metric)].join(',');
  }));
  return `${[[x.name, y.name, metricName, 'outcome', 'unknown'].map(csvField).join(','), ...rows].join('\n')}\n`;
}

/** The place of a cell; undefined if it is not in the map. */
export function placeOfCell({x, y, indexAt}: MapData, index: number | undefined): [number, number] | undefined {
  if (index === undefined) return undefined;
  for (let j = 0; j < y.values.length; ++j) {
    for (let i = 0; i < x.values.length; ++i) if (indexAt(i, j) === index) return [i, j];
  }
  return undefined;
}

/** The axes of a grid of `count` that a map shows: those wanted, as far as they are there and differ. */
export function planeOf(count: number, y = 0, x = 0): {down: number; across: number} {
  const down = Math.min(y || 0, count - 1);
  const across = Math.min(x || 0, count - 1);
  return {down, across: across !== down ? across : down === 0 ? 1 : 0};
}

/** A slice of a grid: the place on each axis that is not shown. */
export function sliceIndex(sizes: number[], slice: number[], xAxis: number, yAxis: number) {
  return (i: number, j: number) => {
    const places = [...slice];
    places[xAxis] = i;
    places[yAxis] = j;
    return cellIndex(sizes, places);
  };
}
