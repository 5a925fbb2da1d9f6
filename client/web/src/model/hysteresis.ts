// Force over deformation: a loop for each cycle.

import look from '../../../python/contactsim/figures/words.json';
import type {Series} from '../api/series';
import type {Cycle} from '../api/generated/contact/v1/job_pb';
import {isCoarse, stampOf} from './coarse';
import {cycleKey, endForces, MOST_MARKED, unmarked, values, type RunPart, type RunView} from './curves';
import type {ContactModel} from './mechanics';
import {extent, lowerBound, type Curve, type Panel} from './panel';

const SMOOTH = 32;   // Samples of a loop whose corners nobody sees.

interface Loop {
  x: number[];
  y: number[];
  /** Whether its ends are in the part that is shown. */
  starts: boolean;
  ends: boolean;
}

/** The loop of a cycle, or the part of it that is shown. */
function loop(view: RunView, cycle: Cycle, contact: ContactModel): Loop {
  const shown = values(view.series, 'time');
  const samples = view.loops?.get(cycleKey(cycle)) ?? view.series;
  const time = values(samples, 'time');
  const [start, end] = endForces(view, contact);
  const starts = cycle.startTimeS >= shown[0]!;
  const ends = cycle.endTimeS <= shown.at(-1)!;
  const first = lowerBound(time, Math.max(cycle.startTimeS, shown[0]!));
  const last = lowerBound(time, Math.min(cycle.endTimeS, shown.at(-1)!));
  const part = (name: string) => Array.from(values(samples, `${contact.name}.${name}`).subarray(first, last));
  const whole = (first: number, middle: number[], last: number) =>
    [...(starts ? [first] : []), ...middle, ...(ends ? [last] : [])];
  return {
    starts, ends,
    x: whole(cycle.deltaStartM, part('deformation'), cycle.deltaEndM),
    y: whole(start(cycle), part('contact_force'), end(cycle)),
  };
}

/**
 * At most so many samples of a loop, even along it in the plane of two columns, in which its width and its height are
 * as long; its ends and its extreme points are among them. Over time there would be few where it is steep.
 */
export function alongLoop(samples: Series, [along, up]: [string, string], most: number): Series {
  const [x, y] = [values(samples, along), values(samples, up)];
  if (x.length <= most || x.length !== y.length) return samples;
  const kept = new Set([0, x.length - 1]);
  const spans = [x, y].map((column) => {
    const [low, high] = extent([column]) ?? [0, 0];
    kept.add(column.indexOf(low)).add(column.indexOf(high));
    return high - low || 1;
  });
  const travelled = new Float64Array(x.length);
  for (let i = 1; i < x.length; ++i) {
    travelled[i] = travelled[i - 1]! + Math.hypot((x[i]! - x[i - 1]!) / spans[0]!, (y[i]! - y[i - 1]!) / spans[1]!);
  }
  const step = travelled.at(-1)! / (most - kept.size) || Infinity;   // That of a point that stays.
  for (let i = 1, next = step; i < x.length; ++i) {
    if (travelled[i]! < next) continue;
    kept.add(i);
    next = travelled[i]! + step;
  }
  kept.delete(-1);
  const order = [...kept].sort((a, b) => a - b);
  const columns = [...samples].map(([name, column]) => [name, {...column, values: Float64Array.from(order, (i) => column.values[i]!)}] as const);
  return Object.assign(new Map(columns), {thinned: true, recorded: samples.recorded});
}

/** The cycles whose loops have fewer samples than are needed for a smooth line. */
export function polygons({series, loops}: RunPart, cycles: Cycle[]): Cycle[] {
  const time = values(series, 'time');
  const samples = ({startTimeS, endTimeS}: Cycle) => lowerBound(time, endTimeS) - lowerBound(time, startTimeS);
  return cycles.filter((cycle) => !loops?.has(cycleKey(cycle)) && samples(cycle) < SMOOTH);
}

/** The loops of all contacts; of a cycle with too few samples there are points. */
export function hysteresis(view: RunView): Panel {
  const panel: Panel = {id: 'hysteresis', title: look.titles.hysteresis, xLabel: 'deformation [m]',
    yLabel: 'contact force [N]', overTime: false, curves: [], stamp: stampOf(view),
    note: 'o start, × end of a contact cycle; the area of a loop is the energy lost' + unmarked(view.cycles)};
  view.mechanics.contacts.forEach((contact, colour) => {
    let keyed = true;
    for (const cycle of view.cycles.filter(({contact: name}) => name === contact.name).slice(0, MOST_MARKED)) {
      const {x, y, starts, ends} = loop(view, cycle, contact);
      if (x.length <= 2) continue;
      const label = keyed ? contact.name : `${contact.name} #${cycle.number}`;
      const mark = (name: string, kind: 'start' | 'end', i: number): Curve =>
        ({label: `${label} ${name}`, colour, mark: kind, keyed: false, x: [x.at(i)!], y: [y.at(i)!]});
      panel.curves.push({label, colour, mark: isCoarse(view, cycle) ? 'rare' : 'line', keyed, x, y});
      if (starts) panel.curves.push(mark('starts', 'start', 0));
      if (ends) panel.curves.push(mark('ends', 'end', -1));
      keyed = false;
    }
  });
  return panel;
}
