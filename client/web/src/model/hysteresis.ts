// Force over deformation: a loop for each cycle.

import type {Cycle} from '../api/generated/contact/v1/job_pb';
import {endForces, MOST_MARKED, unmarked, values, type RunView} from './curves';
import type {ContactModel} from './mechanics';
import {lowerBound, type Curve, type Panel} from './panel';

interface Loop {
  x: number[];
  y: number[];
  /** Whether its ends are in the part that is shown. */
  starts: boolean;
  ends: boolean;
}

/** The loop of a cycle, or the part of it that is shown. */
function loop(view: RunView, cycle: Cycle, contact: ContactModel): Loop {
  const time = values(view.series, 'time');
  const [start, end] = endForces(view, contact);
  const first = lowerBound(time, cycle.startTimeS);
  const last = lowerBound(time, cycle.endTimeS);
  const part = (name: string) => Array.from(values(view.series, `${contact.name}.${name}`).subarray(first, last));
  const starts = cycle.startTimeS >= time[0]!;
  const ends = cycle.endTimeS <= time.at(-1)!;
  const whole = (first: number, middle: number[], last: number) =>
    [...(starts ? [first] : []), ...middle, ...(ends ? [last] : [])];
  return {
    starts, ends,
    x: whole(cycle.deltaStartM, part('deformation'), cycle.deltaEndM),
    y: whole(start(cycle), part('contact_force'), end(cycle)),
  };
}

/** The loops of all contacts. */
export function hysteresis(view: RunView): Panel {
  const panel: Panel = {id: 'hysteresis', title: 'Hysteresis', xLabel: 'deformation [m]',
    yLabel: 'contact force [N]', overTime: false, curves: [],
    note: 'o start, × end of a contact cycle; the area of a loop is the energy lost' + unmarked(view.cycles)};
  view.mechanics.contacts.forEach((contact, colour) => {
    let keyed = true;
    for (const cycle of view.cycles.filter(({contact: name}) => name === contact.name).slice(0, MOST_MARKED)) {
      const {x, y, starts, ends} = loop(view, cycle, contact);
      if (x.length <= 2) continue;
      const label = keyed ? contact.name : `${contact.name} #${cycle.number}`;
      const mark = (name: string, kind: 'start' | 'end', i: number): Curve =>
        ({label: `${label} ${name}`, colour, mark: kind, keyed: false, x: [x.at(i)!], y: [y.at(i)!]});
      panel.curves.push({label, colour, mark: 'line', keyed, x, y});
      if (starts) panel.curves.push(mark('starts', 'start', 0));
      if (ends) panel.curves.push(mark('ends', 'end', -1));
      keyed = false;
    }
  });
  return panel;
}
