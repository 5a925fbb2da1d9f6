// Where words and marks stand in a plot, on its canvas as in its SVG.

import type uPlot from 'uplot';

import type {Curve, Panel} from '../model/panel';

const MOST_LETTERS = 24;

/** As much of the name of a curve as has room beside it. */
export function shortName(label: string): string {
  return label.length > MOST_LETTERS ? `${label.slice(0, MOST_LETTERS - 1)}…` : label;
}

/** Names of curves beside their right ends, so that colour is not needed to tell them. */
export function endNames(u: uPlot, curves: Curve[], height: number, line: number, toY: (y: number) => number): {curve: Curve; y: number}[] {
  const {min, max} = u.scales.x!;
  const names = curves.filter(({keyed, mark}) => keyed !== false && mark !== 'dashed' && mark !== 'points').flatMap((curve) => {
    let last = curve.x.length - 1;
    while (last >= 0 && (curve.x[last]! > (max ?? Infinity) || !Number.isFinite(curve.y[last]!))) --last;
    return last < 0 || curve.x[last]! < (min ?? -Infinity) ? [] : [{curve, y: toY(curve.y[last]!)}];
  }).sort((a, b) => a.y - b.y);
  names.forEach((name, i) => { if (i > 0) name.y = Math.max(name.y, names[i - 1]!.y + line); });
  for (let i = names.length - 1, low = height; i >= 0; --i) {
    names[i]!.y = Math.min(names[i]!.y, low);
    low = names[i]!.y - line;
  }
  return names;
}

/** Labels that lie in the plot and not over another one, with the left ends of their lines. */
export function placeLabels(
  u: uPlot, {labels = []}: Panel, toX: (x: number) => number, toY: (y: number) => number,
  size: (text: string) => number, line: number,
): {text: string; x: number; y: number}[] {
  const {min, max} = u.scales.x!;
  const placed: {text: string; x: number; y: number; end: number}[] = [];
  for (const {x, y, text} of labels) {
    if (x < min! || x > max!) continue;
    const width = size(text);
    const own = {text, x: toX(x) - width / 2, y: toY(y), end: toX(x) + width / 2};
    const crowded = placed.some((other) => own.x < other.end + 4 && own.end > other.x - 4 && Math.abs(own.y - other.y) < line);
    if (!crowded) placed.push(own);
  }
  return placed;
}

const MARK_ROOM_PX = 12;

/** True if so many marks are in the part that is shown that they would hide the curves; a closer look shows them. */
export function crowded(u: uPlot, {x}: Curve): boolean {
  const {min, max} = u.scales.x!;
  let inside = 0;
  for (let i = 0; i < x.length; ++i) if (x[i]! >= min! && x[i]! <= max!) ++inside;
  return inside * MARK_ROOM_PX > u.bbox.width / devicePixelRatio;
}
