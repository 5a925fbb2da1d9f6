// What the plots of a run are made of: columns as curves, marks at the exact ends of cycles.

import look from '../../../python/contactsim/figures/words.json';
import type {Series} from '../api/series';
import {Cycle_End, type Cycle, type Group} from '../api/generated/contact/v1/job_pb';
import {cutSpans, outside, stampOf} from './coarse';
import {endForce, tabled, type ContactModel, type Mechanics} from './mechanics';
import {count} from './numbers';
import {interpolate, joined, type Band, type Curve, type Panel} from './panel';

/** What happened in a run, or in a part of its time. */
export interface RunPart {
  cycles: Cycle[];
  groups: Group[];
  series: Series;
  /** When bodies were in contact. */
  bands: Band[];
  /** Closer samples of cycles, by `cycleKey`. */
  loops?: Map<string, Series>;
}

/** The name of a cycle in a run. */
export function cycleKey({contact, number}: Cycle): string {
  return `${contact} #${number}`;
}

/** What a plot shows. */
export interface RunView extends RunPart {
  mechanics: Mechanics;
}

const NOTE = 'o start, × end of a contact cycle; shaded: in contact';
export const MOST_MARKED = 400;    // Cycles; more marks would hide the curves.

/** The values of a column; none if it is not there. */
export function values(series: Series, name: string): Float64Array {
  return series.get(name)?.values ?? new Float64Array(0);
}

/** The value of a column at a time, between samples. */
export function at(series: Series, name: string, time: number): number {
  return interpolate(values(series, 'time'), values(series, name), time);
}

/** What a note adds if the cycles of a contact are more than are marked. */
export function unmarked(cycles: Cycle[]): string {
  if (cycles.length <= MOST_MARKED) return '';
  const numbers = new Map<string, number>();
  for (const {contact} of cycles) numbers.set(contact, (numbers.get(contact) ?? 0) + 1);
  const most = Math.max(...numbers.values());
  return most > MOST_MARKED ? `; ${MOST_MARKED} of ${count(most)} cycles of a contact shown, zoom in for others` : '';
}

/** The stretches of time with a cycle. */
export function bandsOf(cycles: Cycle[]): Band[] {
  return joined(cycles.map(({startTimeS, endTimeS}) => ({start: startTimeS, end: endTimeS})));
}

/** A panel over time, with contact shaded. */
export function overTime(view: RunView, id: keyof typeof look.titles, yLabel: string): Panel {
  const {bands, cycles} = view;
  return {id, title: look.titles[id], xLabel: 'time [s]', yLabel, overTime: true, curves: [], bands, cut: cutSpans(view), stamp: stampOf(view),
    note: NOTE + unmarked(cycles)};
}

/** A column as a curve; `loose`: where its samples are too rare to be joined. */
export function line(view: RunView, channel: string, label: string, colour: number, loose: Band[], offset = 0): Curve {
  const column = values(view.series, channel);
  const y = offset === 0 ? column : column.map((value) => value + offset);
  return {label, colour, mark: 'line', x: values(view.series, 'time'), y, channel, offset, loose};
}

/** Circles where cycles start and crosses where they end, but for cycles in `loose`. */
export function marks(
  cycles: Cycle[], label: string, colour: number, loose: Band[],
  atStart: (cycle: Cycle) => number, atEnd: (cycle: Cycle) => number,
): Curve[] {
  const shown = outside(loose, cycles).slice(0, MOST_MARKED);
  return [
    {label: `${label} starts`, colour, mark: 'start', keyed: false, x: shown.map((c) => c.startTimeS), y: shown.map(atStart)},
    {label: `${label} ends`, colour, mark: 'end', keyed: false, x: shown.map((c) => c.endTimeS), y: shown.map(atEnd)},
  ];
}

/** The forces at the start and at the end of a cycle of the contact. */
export function endForces(view: RunView, contact: ContactModel): [(c: Cycle) => number, (c: Cycle) => number] {
  const {mechanics, series} = view;
  const sampled = (time: number) => at(series, `${contact.name}.contact_force`, time);
  return [
    (c) => (tabled(contact) && c.deltaStartM > 0 ? sampled(c.startTimeS)
      : endForce(mechanics, contact, c.mu, c.deltaStartM, c.approachVelocityMPerS)),
    (c) => (c.end === Cycle_End.RUN_END || (tabled(contact) && c.deltaEndM > 0) ? sampled(c.endTimeS)
      : endForce(mechanics, contact, c.mu, c.deltaEndM, c.separationVelocityMPerS)),
  ];
}
