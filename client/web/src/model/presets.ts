// The plots of a run: the same channels, axes, words and units as `contactctl plot`.

import look from '../../../python/contactsim/figures/words.json';
import {Cycle_End, type Cycle} from '../api/generated/contact/v1/job_pb';
import type {Scenario} from '../api/generated/contact/v1/scenario_pb';
import {coarseNote, isFine, looseSpans, rangesOf, stampOf} from './coarse';
import {at, endForces, line, marks, overTime, values, type RunView} from './curves';
import {hysteresis} from './hysteresis';
import type {Mechanics} from './mechanics';
import {short} from './numbers';
import type {Measured} from './overlay';
import {extent, type Label, type Lane, type Panel} from './panel';
import {readableUnit, unitOf} from './units';

export interface Preset {
  id: string;
  channels: (mechanics: Mechanics) => string[];
  panel: (view: RunView) => Panel;
  /** What there are too many of for curves: the panel has a row for each of them. */
  many?: 'contacts' | 'bodies';
}

export const FIRST = 6;   // Plots of the page; the others are shown when asked for.
export const MOST_CONTACTS = 12;     // With a curve each.
const MOST_ROWS = 380;   // Of a map: the server answers with at most 499 columns that it thins.
const FEW_ROWS = 300;    // Of more contacts, none of which other plots have,
const LEAST_ROWS = 140;  // and with all plots.
const MOST_LABELS = 12;

const MOST_LANES = 5;    // More would leave the curves no room.
const MOST_TOLD = 6;     // Contacts whose equivalent external forces and labels can be told from each other.

function lanesOf({mechanics, groups, cycles}: RunView): Lane[] {
  if (mechanics.contacts.length > MOST_LANES) return [];
  return mechanics.contacts.map(({name}, colour) => {
    const own = groups.filter(({contact}) => contact === name);
    const bars = own.length > 0
      ? own.map(({startTimeS, endTimeS, number}) => ({start: startTimeS, end: endTimeS, text: `${number}`}))
      : cycles.filter(({contact}) => contact === name)
        .map(({startTimeS, endTimeS, number}) => ({start: startTimeS, end: endTimeS, text: `${number}`}));
    return {label: name, colour, bars};
  });
}

/** μ/k at the highest peaks that are apart. */
function peakLabels(view: RunView): Label[] {
  const {cycles, series} = view;
  const time = values(series, 'time');
  const apart = 0.02 * ((time.at(-1) ?? 0) - (time[0] ?? 0));
  const chosen: Cycle[] = [];
  const inside = (at: number) => at >= time[0]! && at <= time.at(-1)!;   // NaN if cut before.
  const seen = cycles.filter((cycle) => inside(cycle.turnTimeS) && isFine(view, cycle));
  for (const cycle of seen.sort((a, b) => b.peakForceN - a.peakForceN)) {
    if (chosen.length === MOST_LABELS) break;
    if (chosen.every((other) => Math.abs(other.turnTimeS - cycle.turnTimeS) >= apart)) chosen.push(cycle);
  }
  return chosen.map((cycle) => ({
    x: cycle.turnTimeS, y: cycle.peakForceN, text: `μ/k = ${short(cycle.muOverKSPerM)} s/m`,
  }));
}

const told = (panel: Panel): Panel => ({...panel, note: `${panel.note ?? ''}${coarseNote(panel)}`});

function bodies(view: RunView, quantity: string, panel: Panel, origin: (position: number) => number): Panel {
  const {contacts} = view.mechanics;
  const loose = looseSpans(view, contacts);
  const looseBy = contacts.map((contact) => looseSpans(view, [contact]));
  view.mechanics.bodies.forEach((body, index) => {
    const channel = `${body.name}.${quantity}`;
    const offset = -origin(body.position);
    panel.curves.push(line(view, channel, body.name, index, loose, offset));
    for (const [place, contact] of contacts.entries()) {
      if (contact.left !== index && contact.right !== index) continue;
      const own = view.cycles.filter((cycle) => cycle.contact === contact.name);
      panel.curves.push(...marks(own, `${body.name}, ${contact.name}`, index, looseBy[place]!,
        (cycle) => at(view.series, channel, cycle.startTimeS) + offset,
        (cycle) => at(view.series, channel, cycle.endTimeS) + offset));
    }
  });
  return told(panel);
}

function force(view: RunView): Panel {
  const panel: Panel = {...overTime(view, 'force', 'force [N]'), ranges: []};
  const few = view.mechanics.contacts.length <= MOST_TOLD;
  const lanes = lanesOf(view);
  view.mechanics.contacts.forEach((contact, colour) => {
    const loose = looseSpans(view, [contact]);
    const [start, end] = endForces(view, contact);
    panel.curves.push(line(view, `${contact.name}.contact_force`, contact.name, colour, loose));
    if (few) panel.curves.push({
      ...line(view, `${contact.name}.external_force`, `${contact.name} equivalent external`, colour, loose),
      mark: 'dashed',
    });
    const own = view.cycles.filter((cycle) => cycle.contact === contact.name);
    panel.curves.push(...marks(own, contact.name, colour, loose, start, end));
    panel.ranges!.push(...rangesOf(view, contact, colour, (c) => [start(c), end(c), c.peakForceN]));
  });
  const notes = [panel.note, ...(lanes.length > 0 ? ['bars: groups, by number'] : []), ...(few ? ['dashed: equivalent external'] : [])];
  return told({...panel, lanes, labels: few ? peakLabels(view) : [], note: notes.join('; ')});
}

/** A quantity of all contacts or bodies, a row for each in the order of the scenario: as colours, or as lines. */
function rowsOf(view: RunView, moving: boolean, lines: boolean): Panel {
  const {mechanics, series} = view;
  const [quantity, channel, each] = moving ? ['velocity [m/s]', 'velocity', 'body'] : ['force [N]', 'contact_force', 'contact'];
  const id = `${moving ? 'velocity' : 'force'}-${lines ? 'waterfall' : 'map'}` as const;
  const rows = (moving ? mechanics.bodies : mechanics.contacts).map(({name}) => ({name, values: values(series, `${name}.${channel}`)}));
  const [low, high] = extent(rows.map((row) => row.values)) ?? [0, 0];
  const largest = Math.max(-low, high);
  const {factor, label} = readableUnit(quantity, largest);
  const most = `${short(largest / factor)} ${unitOf(label)}`;
  const both = low < 0;
  const {every = 1, first = 0} = mechanics;
  const colour = both ? `from −${most} (blue) over 0 (white) to ${most} (red)` : `from 0 (dark) to ${most} (bright)`;
  return {
    id, title: look.titles[id],
    xLabel: 'time [s]', yLabel: each, overTime: true, stamp: stampOf(view), countedY: true, curves: [], raster: {time: values(series, 'time'), rows, label: quantity, largest, both, lines, every, first},
    note: `${lines ? `each line rises from its row, and ${most} is as high as two lines are apart; coloured by place` : `colour: ${quantity.split(' ')[0]} ${colour}`}; ${moving ? 'bodies' : 'contacts'} in the order of the scenario, the first one lowest${mechanics.first === undefined || moving ? '' : `, from ${first + 1} to ${first + 1 + (rows.length - 1) * every}`}${every > 1 ? `; one of every ${every} ${moving ? 'bodies' : 'contacts'}` : ''}`,
  };
}

function deformation(view: RunView, rate: boolean): Panel {
  const panel = rate
    ? overTime(view, 'deformation-velocity', 'deformation velocity [m/s]')
    : overTime(view, 'deformation', 'deformation [m]');
  view.mechanics.contacts.forEach((contact, colour) => {
    const {name} = contact;
    const loose = looseSpans(view, [contact]);
    const channel = `${name}.deformation${rate ? '_velocity' : ''}`;
    panel.curves.push(line(view, channel, name, colour, loose));
    const own = view.cycles.filter((cycle) => cycle.contact === name);
    const cut = (c: Cycle, value: number) =>
      (c.end === Cycle_End.RUN_END ? at(view.series, channel, c.endTimeS) : value);
    panel.curves.push(...marks(own, name, colour, loose,
      (c) => (rate ? c.approachVelocityMPerS : c.deltaStartM),
      (c) => cut(c, rate ? c.separationVelocityMPerS : c.deltaEndM)));
    if (!rate) panel.ranges = [...panel.ranges ?? [], ...rangesOf(view, contact, colour, (c) => [c.deltaStartM, c.deltaEndM, c.deltaMaxM])];
  });
  return told(rate ? panel : {...panel, note: `${panel.note}; below 0: the gap`});
}

/** Why a plot of a job of an older server is empty. */
const lacks = (what: string) => `This run recorded no ${what}: an older server made it. Run it again to see them.`;

/** What holds energy, what contacts and supports have dissipated, and the work of loads and drives. */
const ENERGIES = [['kinetic', 'kinetic_energy'], ['contacts', 'contact_energy'], ['supports', 'support_energy'],
  ['dissipated', 'dissipated_energy'], ['load work', 'load_work']] as const;

function acceleration(view: RunView): Panel {
  const panel = bodies(view, 'acceleration', overTime(view, 'acceleration', 'acceleration [m/s^2]'), () => 0);
  if (!view.series.has('time') || view.mechanics.bodies.every(({name}) => view.series.has(`${name}.acceleration`))) return panel;
  return {...panel, curves: [], nothing: lacks('accelerations')};
}

/** True if loads or drives may do work. */
function isDriven({loads, bodies: all, contacts}: Scenario): boolean {
  return loads.length > 0 || all.some(({motion}) => motion) || contacts.some(({wall}) => wall?.motion);
}

/** The parts of the energy that the scenario may have, and their sum less the work of loads, which is constant. */
function energy(view: RunView): Panel {
  const {series, mechanics: {scenario}} = view;
  const panel = {...overTime(view, 'energy', 'energy [J]'), note: 'shaded: in contact'};
  const loose = looseSpans(view, view.mechanics.contacts);
  const parts = ENERGIES.map(([label, quantity]) => ({label, channel: `system.${quantity}`, y: values(series, `system.${quantity}`)}));
  if (parts.some(({y}) => y.length === 0)) {
    return series.has('time') ? {...panel, nothing: lacks('energies')} : panel;
  }
  const sum = parts[0]!.y.map((_, i) => parts.reduce((all, {label, y}) => all + (label === 'load work' ? -y[i]! : y[i]!), 0));
  const absent = [scenario.supports.length === 0 && 'supports', !isDriven(scenario) && 'load work'];
  const shown = [...parts.filter(({label}) => !absent.includes(label)), {label: 'sum less load work', channel: '', y: sum}];
  panel.curves = shown.map(({label, channel, y}, colour) => ({label, colour, mark: 'line', x: values(series, 'time'), y, channel, loose}));
  return told(panel);
}

function wallLines({bodies: all, contacts}: Mechanics): number[] {
  return contacts.filter(({left, right, wallBody}) => (left < 0 || right < 0) && !wallBody).map(({left, right, wallPosition}) =>
    wallPosition - (right < 0 ? all[left]?.radius ?? 0 : -(all[right]?.radius ?? 0)));
}

const ofBodies = (...quantities: string[]) => ({bodies: all}: Mechanics) =>
  all.flatMap(({name}) => quantities.map((quantity) => `${name}.${quantity}`));
const ofContacts = (...quantities: string[]) => ({contacts}: Mechanics) =>
  contacts.flatMap(({name}) => quantities.map((quantity) => `${name}.${quantity}`));

/** The presets in the order of the page. */
export const PRESETS: Preset[] = [
  {id: 'force-map', channels: ofContacts('contact_force'), panel: (view) => rowsOf(view, false, false), many: 'contacts'},
  {id: 'force', channels: ofContacts('contact_force', 'external_force'), panel: force},
  {id: 'velocity', channels: ofBodies('velocity'),
    panel: (view) => bodies(view, 'velocity', overTime(view, 'velocity', 'velocity [m/s]'), () => 0)},
  {id: 'deformation', channels: ofContacts('deformation'), panel: (view) => deformation(view, false)},
  {id: 'displacement', channels: ofBodies('position'),
    panel: (view) => bodies(view, 'position', overTime(view, 'displacement', 'displacement [m]'), (x) => x)},
  {id: 'hysteresis', channels: ofContacts('deformation', 'contact_force'), panel: hysteresis},
  {id: 'energy', channels: () => ENERGIES.map(([, quantity]) => `system.${quantity}`), panel: energy},
  {id: 'deformation-velocity', channels: ofContacts('deformation_velocity'), panel: (view) => deformation(view, true)},
  {id: 'position', channels: ofBodies('position'),
    panel: (view) => ({
      ...bodies(view, 'position', overTime(view, 'position', 'position [m]'), () => 0),
      dottedLines: wallLines(view.mechanics),
    })},
  {id: 'acceleration', channels: ofBodies('acceleration'), panel: acceleration},
  {id: 'velocity-map', channels: ofBodies('velocity'), panel: (view) => rowsOf(view, true, false), many: 'bodies'},
  {id: 'force-waterfall', channels: ofContacts('contact_force'), panel: (view) => rowsOf(view, false, true), many: 'contacts'},
  {id: 'velocity-waterfall', channels: ofBodies('velocity'), panel: (view) => rowsOf(view, true, true), many: 'bodies'},
];

/** The plots of the page: the first ones and those of measured channels, `all`, or those named in `chosen`, in its order. */
export function presetsShown(mechanics: Mechanics, chosen: string, measured: Measured | undefined): Preset[] {
  const presets = presetsFor(mechanics);
  if (chosen && chosen !== 'all') return chosen.split(',').flatMap((id) => presets.find((preset) => preset.id === id) ?? []);
  return presets.filter(({channels}, place) =>
    chosen || place < FIRST || (measured && channels(mechanics).some((channel) => measured.has(channel))));
}

/** The plots that can be made of a scenario. */
export function presetsFor(mechanics: Mechanics): Preset[] {
  return PRESETS.filter(({many}) => !many || mechanics[many].length > MOST_CONTACTS);
}

/** The contacts from the first to the last that has a cycle; all if none has. */
function touched({contacts}: Mechanics, cycles: Cycle[]): [number, number] {
  const names = new Set(cycles.map(({contact}) => contact));
  const places = contacts.flatMap(({name}, i) => (names.has(name) ? [i] : []));
  return places.length > 0 ? [places[0]!, places.at(-1)! + 1] : [0, contacts.length];
}

/**
 * The scenario with as many of its contacts or bodies as a map has rows. Of too many contacts those that were touched, as
 * far as `cycles` are all there are, and of still too many every n-th.
 */
export function thinned(mechanics: Mechanics, many: 'contacts' | 'bodies', all: boolean, cycles: Cycle[]): Mechanics {
  const list: {name: string}[] = mechanics[many];
  const room = (count: number) => (all ? LEAST_ROWS : count > MOST_ROWS ? FEW_ROWS : MOST_ROWS);
  if (list.length <= room(list.length)) return mechanics;
  const [first, end] = many === 'contacts' ? touched(mechanics, cycles) : [0, list.length];
  const every = Math.ceil((end - first) / room(end - first));
  return {...mechanics, first, every, [many]: list.slice(first, end).filter((_, i) => i % every === 0)};
}

/** Those of which the columns are asked for: where there are many, only as far as they are shown. */
export function presetsAsked(mechanics: Mechanics, all: boolean): Preset[] {
  return presetsFor(mechanics).filter(({many}, place) => all || !many || place < FIRST);
}
