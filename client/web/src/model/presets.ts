// The plots of a run: the same channels, axes, words and units as `contactctl plot`.

import type {Series} from '../api/series';
import {Cycle_End, type Cycle, type Group} from '../api/generated/contact/v1/job_pb';
import {energyChannels, mechanicalEnergy} from './energy';
import {endForce, type ContactModel, type Mechanics} from './mechanics';
import {interpolate, joined, lowerBound, type Curve, type Label, type Lane, type Panel} from './panel';
import {short} from './numbers';

/** A run, or the part of it that a plot shows. */
export interface RunView {
  mechanics: Mechanics;
  cycles: Cycle[];
  groups: Group[];
  series: Series;
}

export interface Preset {
  id: string;
  channels: (mechanics: Mechanics) => string[];
  panel: (view: RunView) => Panel;
}

const NOTE = 'o start, × end of a contact cycle; shaded: in contact';
const MOST_MARKED = 400;    // Cycles; more marks would hide the curves.
const MOST_LABELS = 12;

function values(series: Series, name: string): Float64Array {
  return series.get(name)?.values ?? new Float64Array(0);
}

function at(series: Series, name: string, time: number): number {
  return interpolate(values(series, 'time'), values(series, name), time);
}

function lanesOf({mechanics, groups, cycles}: RunView): Lane[] {
  return mechanics.contacts.slice(0, 12).map(({name}, colour) => {
    const own = groups.filter(({contact}) => contact === name);
    const bars = own.length > 0
      ? own.map(({startTimeS, endTimeS, number}) => ({start: startTimeS, end: endTimeS, text: `${number}`}))
      : cycles.filter(({contact}) => contact === name)
        .map(({startTimeS, endTimeS, number}) => ({start: startTimeS, end: endTimeS, text: `${number}`}));
    return {label: name, colour, bars};
  });
}

function overTime(view: RunView, id: string, title: string, yLabel: string): Panel {
  const bands = joined(view.cycles.map(({startTimeS, endTimeS}) => ({start: startTimeS, end: endTimeS})));
  return {id, title, xLabel: 'time [s]', yLabel, overTime: true, curves: [], bands, note: NOTE};
}

function line(view: RunView, channel: string, label: string, colour: number, offset = 0): Curve {
  const column = values(view.series, channel);
  const y = offset === 0 ? column : column.map((value) => value + offset);
  return {label, colour, mark: 'line', x: values(view.series, 'time'), y};
}

/** Circles where cycles start and crosses where they end. */
function marks(
  cycles: Cycle[], label: string, colour: number,
  atStart: (cycle: Cycle) => number, atEnd: (cycle: Cycle) => number,
): Curve[] {
  const shown = cycles.slice(0, MOST_MARKED);
  return [
    {label: `${label} starts`, colour, mark: 'start', keyed: false, x: shown.map((c) => c.startTimeS), y: shown.map(atStart)},
    {label: `${label} ends`, colour, mark: 'end', keyed: false, x: shown.map((c) => c.endTimeS), y: shown.map(atEnd)},
  ];
}

function bodies(view: RunView, quantity: string, panel: Panel, origin: (position: number) => number): Panel {
  view.mechanics.bodies.forEach((body, index) => {
    const channel = `${body.name}.${quantity}`;
    const offset = -origin(body.position);
    panel.curves.push(line(view, channel, body.name, index, offset));
    for (const contact of view.mechanics.contacts) {
      if (contact.left !== index && contact.right !== index) continue;
      const own = view.cycles.filter((cycle) => cycle.contact === contact.name);
      panel.curves.push(...marks(own, `${body.name}, ${contact.name}`, index,
        (cycle) => at(view.series, channel, cycle.startTimeS) + offset,
        (cycle) => at(view.series, channel, cycle.endTimeS) + offset));
    }
  });
  return panel;
}

/** μ/k at the highest peaks that are apart. */
function peakLabels({cycles, series}: RunView): Label[] {
  const time = values(series, 'time');
  const apart = 0.02 * ((time.at(-1) ?? 0) - (time[0] ?? 0));
  const chosen: Cycle[] = [];
  for (const cycle of [...cycles].sort((a, b) => b.peakForceN - a.peakForceN)) {
    if (chosen.length === MOST_LABELS) break;
    if (!(cycle.turnTimeS >= time[0]! && cycle.turnTimeS <= time.at(-1)!)) continue;
    if (chosen.every((other) => Math.abs(other.turnTimeS - cycle.turnTimeS) >= apart)) chosen.push(cycle);
  }
  return chosen.map((cycle) => ({
    x: cycle.turnTimeS, y: cycle.peakForceN, text: `μ/k = ${short(cycle.muOverKSPerM)} s/m`,
  }));
}

function endForces(view: RunView, contact: ContactModel): [(c: Cycle) => number, (c: Cycle) => number] {
  const {mechanics, series} = view;
  return [
    (c) => endForce(mechanics, contact, c.mu, c.deltaStartM, c.approachVelocityMPerS),
    (c) => (c.end === Cycle_End.RUN_END ? at(series, `${contact.name}.contact_force`, c.endTimeS)
      : endForce(mechanics, contact, c.mu, c.deltaEndM, c.separationVelocityMPerS)),
  ];
}

function force(view: RunView): Panel {
  const panel = overTime(view, 'force', 'Contact force', 'force [N]');
  view.mechanics.contacts.forEach((contact, colour) => {
    panel.curves.push(line(view, `${contact.name}.contact_force`, contact.name, colour));
    panel.curves.push({
      ...line(view, `${contact.name}.external_force`, `${contact.name} equivalent external`, colour),
      mark: 'dashed',
    });
    const own = view.cycles.filter((cycle) => cycle.contact === contact.name);
    panel.curves.push(...marks(own, contact.name, colour, ...endForces(view, contact)));
  });
  return {...panel, lanes: lanesOf(view), labels: peakLabels(view),
    note: `${NOTE}; bars: groups, by number; dashed: equivalent external`};
}

function deformation(view: RunView, rate: boolean): Panel {
  const panel = rate
    ? overTime(view, 'deformation-velocity', 'Deformation velocity', 'deformation velocity [m/s]')
    : overTime(view, 'deformation', 'Deformation', 'deformation [m]');
  view.mechanics.contacts.forEach(({name}, colour) => {
    const channel = `${name}.deformation${rate ? '_velocity' : ''}`;
    panel.curves.push(line(view, channel, name, colour));
    const own = view.cycles.filter((cycle) => cycle.contact === name);
    const cut = (c: Cycle, value: number) =>
      (c.end === Cycle_End.RUN_END ? at(view.series, channel, c.endTimeS) : value);
    panel.curves.push(...marks(own, name, colour,
      (c) => (rate ? c.approachVelocityMPerS : c.deltaStartM),
      (c) => cut(c, rate ? c.separationVelocityMPerS : c.deltaEndM)));
  });
  return rate ? panel : {...panel, note: `${NOTE}; below 0: the gap`};
}

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

function hysteresis(view: RunView): Panel {
  const panel: Panel = {id: 'hysteresis', title: 'Hysteresis', xLabel: 'deformation [m]',
    yLabel: 'contact force [N]', overTime: false, curves: [],
    note: 'o start, × end of a contact cycle; the area of a loop is the energy lost'};
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

function energy(view: RunView): Panel {
  const panel = overTime(view, 'energy', 'Energy balance', 'energy [J]');
  mechanicalEnergy(view.mechanics, view.series).forEach(({name, values: y}, colour) => {
    panel.curves.push({label: name, colour, mark: 'line', x: values(view.series, 'time'), y});
  });
  return {...panel, note: 'shaded: in contact'};
}

function wallLines({bodies: all, contacts}: Mechanics): number[] {
  return contacts.filter(({left, right}) => left < 0 || right < 0).map(({left, right, wallPosition}) =>
    wallPosition - (right < 0 ? all[left]?.radius ?? 0 : -(all[right]?.radius ?? 0)));
}

const ofBodies = (...quantities: string[]) => ({bodies: all}: Mechanics) =>
  all.flatMap(({name}) => quantities.map((quantity) => `${name}.${quantity}`));
const ofContacts = (...quantities: string[]) => ({contacts}: Mechanics) =>
  contacts.flatMap(({name}) => quantities.map((quantity) => `${name}.${quantity}`));

/** The presets in the order of the page. */
export const PRESETS: Preset[] = [
  {id: 'force', channels: ofContacts('contact_force', 'external_force'), panel: force},
  {id: 'velocity', channels: ofBodies('velocity'),
    panel: (view) => bodies(view, 'velocity', overTime(view, 'velocity', 'Velocity', 'velocity [m/s]'), () => 0)},
  {id: 'deformation', channels: ofContacts('deformation'), panel: (view) => deformation(view, false)},
  {id: 'displacement', channels: ofBodies('position'),
    panel: (view) => bodies(view, 'position', overTime(view, 'displacement', 'Displacement', 'displacement [m]'), (x) => x)},
  {id: 'hysteresis', channels: ofContacts('deformation', 'contact_force'), panel: hysteresis},
  {id: 'energy', channels: energyChannels, panel: energy},
  {id: 'deformation-velocity', channels: ofContacts('deformation_velocity'), panel: (view) => deformation(view, true)},
  {id: 'position', channels: ofBodies('position'),
    panel: (view) => ({
      ...bodies(view, 'position', overTime(view, 'position', 'Position', 'position [m]'), () => 0),
      dottedLines: wallLines(view.mechanics),
    })},
];
