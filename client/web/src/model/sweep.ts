// Axes, cells and values of a sweep.

import {Job_Convergence, Job_State} from '../api/generated/contact/v1/job_pb';
import {SweepCell_Source, type SweepCell} from '../api/generated/contact/v1/event_pb';
import {Sweep_Combination, type Sweep, type Sweep_Axis} from '../api/generated/contact/v1/scenario_pb';
import {exact} from './numbers';

/** What became of a cell. */
export type Outcome = 'waiting' | 'converged' | 'not converged' | 'failed';

export function outcomeOf(cell: SweepCell | undefined): Outcome {
  if (!cell) return 'waiting';
  if (cell.state !== Job_State.SUCCEEDED) return 'failed';
  return cell.convergence === Job_Convergence.PARTIAL ? 'not converged' : 'converged';
}

/** The name of an axis in tables and figures. */
export function axisName(axis: Sweep_Axis): string {
  return axis.label || axis.field;
}

/** The values of an axis in order; empty for one that is drawn. */
export function axisValues({values, linear, log}: Sweep_Axis): number[] {
  if (values.length > 0) return values;
  const range = linear ?? log;
  if (!range || range.count < 1) return [];
  const {low, high, count} = range;
  return Array.from({length: count}, (_, i) => {
    const part = count === 1 ? 0 : i / (count - 1);
    return log ? low * (high / low) ** part : low + (high - low) * part;
  });
}

/** True if cells are all combinations of the axes. */
export function isGrid({combination}: Sweep): boolean {
  return combination === Sweep_Combination.GRID || combination === Sweep_Combination.COMBINATION_UNSPECIFIED;
}

/** The number of a cell of a grid from its place on each axis; the last axis varies fastest. */
export function cellIndex(sizes: number[], places: number[]): number {
  return sizes.reduce((index, size, i) => index * size + places[i]!, 0);
}

/** Why a metric is no known number; empty if it is one, or if the server does not tell. */
export type Unknown = '' | 'CUT' | 'no contact';

/** Why a metric of a cell is no known number: the end of the run cuts its cycle, or nothing was touched. */
export function unknownOf(cell: SweepCell | undefined, metric: number): Unknown {
  const source = cell?.sources[metric];
  if (source === SweepCell_Source.CUT) return 'CUT';
  return source === SweepCell_Source.NO_CONTACT ? 'no contact' : '';
}

/** What the map and the line show of a cell; NaN if it has no such number that is known. */
export function metricOf(cell: SweepCell | undefined, metric: number): number {
  return unknownOf(cell, metric) ? NaN : cell?.metrics[metric] ?? NaN;
}

/** The same for people. */
export function metricText(cell: SweepCell | undefined, metric: number): string {
  return unknownOf(cell, metric) || (cell ? exact(metricOf(cell, metric)) : '');
}

/** The metrics of a cell that are not known: `cycles[0].mu: CUT`. */
export function unknownsOf(cell: SweepCell, metrics: string[]): string {
  return metrics.map((name, i) => [name, unknownOf(cell, i)] as const).filter(([, why]) => why).map((pair) => pair.join(': ')).join('; ');
}

/** How many cells have no known number of a metric, by the reason. */
export function countUnknown(cells: Iterable<SweepCell>, metric: number): Record<Exclude<Unknown, ''>, number> {
  const counts = {'CUT': 0, 'no contact': 0};
  for (const cell of cells) {
    const why = outcomeOf(cell) === 'failed' ? '' : unknownOf(cell, metric);
    if (why) ++counts[why];
  }
  return counts;
}

const VIRIDIS = ['440154', '482878', '3e4989', '31688e', '26828e', '1f9e89', '35b779', '6ece58', 'b5de2b', 'fde725'];

/** The colour of a value between 0 and 1 among colours of equal distance, in hexadecimal digits. */
export function colourAmong(colours: readonly string[], part: number): string {
  const at = Math.min(Math.max(part, 0), 1) * (colours.length - 1);
  const low = Math.min(Math.floor(at), colours.length - 2);
  const channel = (i: number) => {
    const [a, b] = [colours[low]!, colours[low + 1]!].map((hex) => parseInt(hex.slice(2 * i, 2 * i + 2), 16));
    return Math.round(a! + (b! - a!) * (at - low)).toString(16).padStart(2, '0');
  };
  return `#${channel(0)}${channel(1)}${channel(2)}`;
}

/** The colour of a value between 0 and 1, of the map viridis. */
export function viridis(part: number): string {
  return colourAmong(VIRIDIS, part);
}

/** Black or white, whichever can be read on viridis. */
export function inkOn(part: number): string {
  return part > 0.55 ? '#000000' : '#ffffff';
}
