// Measured points over the curves of the same channels.

import {lowerBound, type Curve, type Panel} from './panel';

/** Measured values of a channel by simulated time, which ascends; all in SI. */
export interface Points {
  x: Float64Array;
  y: Float64Array;
}

/** What was measured, by channel. */
export type Measured = ReadonlyMap<string, Points>;

export const MOST_POINTS = 1500;   // Of a curve in what is shown: more hide the curve below.

/** Points by time. */
export function byTime(times: Float64Array, values: Float64Array, shift: number): Points {
  const order = Uint32Array.from(times, (_, i) => i).sort((a, b) => times[a]! - times[b]!);
  return {x: Float64Array.from(order, (i) => times[i]! + shift), y: Float64Array.from(order, (i) => values[i]!)};
}

function pointsOver(curve: Curve, {x, y}: Points, window: [number, number] | undefined): {points: Curve; every: number} {
  const [first, end] = window ? [lowerBound(x, window[0]), lowerBound(x, window[1])] : [0, x.length];
  const every = Math.ceil((end - first) / MOST_POINTS) || 1;
  const some = (_: number, i: number) => i % every === 0;
  const offset = curve.offset ?? 0;
  return {every, points: {
    label: `${curve.label} measured`, colour: curve.colour, mark: 'points',
    x: x.subarray(first, end).filter(some), y: y.subarray(first, end).filter(some).map((value) => value + offset),
  }};
}

/** The panel with dots where one of its channels was measured. */
export function withMeasured(panel: Panel, measured: Measured | undefined, window: [number, number] | undefined): Panel {
  const over = panel.curves.flatMap((curve) => {
    const points = curve.channel && measured?.get(curve.channel);
    return points ? [pointsOver(curve, points, window)] : [];
  });
  if (over.length === 0) return panel;
  const every = Math.max(...over.map((each) => each.every));
  const note = [panel.note, `dots: measured${every > 1 ? `, every ${every}th` : ''}`].filter(Boolean).join('; ');
  return {...panel, curves: [...panel.curves, ...over.map(({points}) => points)], note};
}
