// What samples are too rare to show, by the rule of contactsim's figures/coarse.py: contacts between two samples, and
// motion of which there are only points. The ledger has the extremes of every contact, however rare the samples are.

import look from '../../../python/contactsim/figures/words.json';
import {Cycle_End, Cycle_Status, type Cycle} from '../api/generated/contact/v1/job_pb';
import type {Scenario} from '../api/generated/contact/v1/scenario_pb';
import type {RunPart, RunView} from './curves';
import type {ContactModel} from './mechanics';
import {extent, joined, lowerBound, travel, type Band, type Curve, type Panel, type Range} from './panel';

const FEW = look.coarse.few;
const OWN = look.coarse.own;
const SWING = 1.5;   // Times its range.

const timesOf = ({series}: RunPart): ArrayLike<number> => series.get('time')?.values ?? [];

/** The first place in ascending values that is above x. */
function upperBound(xs: ArrayLike<number>, x: number): number {
  let place = lowerBound(xs, x);
  while (place < xs.length && xs[place] === x) ++place;
  return place;
}

/** Time between samples, beside those that contacts have of their own. */
const intervalOf = ({output, endTimeS}: Scenario) => output?.sampleIntervalS ?? endTimeS / 1000;

/** Samples in a second, beside those of contacts: in the mean, where the series has a part of them only. */
function rateOf({series, mechanics}: RunView, time: ArrayLike<number>): number {
  const samples = series.recorded ?? time.length;
  const rate = samples > 1 ? (samples - 1) / (time[time.length - 1]! - time[0]!) : 0;
  return Math.min(rate, 1 / intervalOf(mechanics.scenario));
}

const ownEnds = new WeakMap<Cycle[], {of: number; until: number}>();

/**
 * Until when each contact has samples of its own for certain, if nobody asked for them: until they have doubled the
 * samples, or make a million numbers (Output.samples_per_contact). A cycle that lasts longer than expected has twice as many.
 */
function ownUntil({mechanics: {scenario, bodies, contacts}, cycles}: RunView): number {
  const known = ownEnds.get(cycles);
  if (known?.of === cycles.length) return known.until;
  const columns = 6 + 3 * bodies.length + 4 * contacts.length + 2 * scenario.supports.length;
  const most = Math.min(1 + scenario.endTimeS / intervalOf(scenario), 1e6 / columns);
  const starts = cycles.map(({startTimeS}) => startTimeS).sort((a, b) => a - b);
  const until = starts[Math.floor(most / (2 * OWN))] ?? Infinity;
  ownEnds.set(cycles, {of: cycles.length, until});
  return until;
}

/** Samples of its own that a contact has at some time. */
function ownAt(view: RunView, time: number): number {
  return view.mechanics.scenario.output?.samplesPerContact ?? (time < ownUntil(view) ? OWN : 0);
}

/**
 * How many samples are recorded from one time to another, at which `last` ends them. Where the series is thinned, or
 * does not reach so far, they are not counted but told by how close samples are.
 */
function recordedIn(view: RunView, from: number, to: number, last: typeof lowerBound): number {
  const time = timesOf(view);
  const counted = !view.series.thinned && from >= time[0]! && to <= time[time.length - 1]!;
  if (counted) return last(time, to) - lowerBound(time, from);
  return Math.max(ownAt(view, from), (to - from) * rateOf(view, time));
}

/** Whether a cycle is seen. */
export function isFine(view: RunView, {startTimeS, endTimeS}: Cycle): boolean {
  return timesOf(view).length > 0 && recordedIn(view, startTimeS, endTimeS, upperBound) >= FEW;
}

/** Whether a cycle has too few samples; one that the end of the run cuts may have any number. */
export function isCoarse(view: RunView, cycle: Cycle): boolean {
  return timesOf(view).length > 0 && cycle.end !== Cycle_End.RUN_END && !isFine(view, cycle);
}

/** The cycles of some contacts. */
function cyclesOf({cycles}: RunView, contacts: ContactModel[]): Cycle[] {
  const names = new Set(contacts.map(({name}) => name));
  return cycles.filter(({contact}) => names.has(contact));
}

/** How many of the cycles shown have too few samples; empty if all have enough. */
export function stampOf(view: RunView): string {
  const cycles = cyclesOf(view, view.mechanics.contacts);
  const coarse = cycles.filter((cycle) => isCoarse(view, cycle)).length;
  const have = cycles.length === 1 ? 'contact has' : 'contacts have';
  return coarse ? `${coarse} of ${cycles.length} ${have} fewer than ${FEW} samples` : '';
}

/**
 * Where there are fewer than FEW samples from one cycle of a contact to the next, again and again: lines from sample to
 * sample would show a motion that never was.
 */
export function looseSpans(view: RunView, contacts: ContactModel[]): Band[] {
  if (timesOf(view).length === 0) return [];
  return joined(contacts.flatMap((contact) => {
    const starts = cyclesOf(view, [contact]).map(({startTimeS}) => startTimeS);
    const rare = starts.slice(1).map((next, i) => recordedIn(view, starts[i]!, next, lowerBound) < FEW);
    return rare.slice(1).flatMap((is, i) => (is && rare[i] ? [{start: starts[i]!, end: starts[i + 2]!}] : []));
  }));
}

/** Where the end of the run cuts cycles of contacts shown, whose peaks may be still to come. */
export function cutSpans(view: RunView): Band[] {
  const time = timesOf(view);
  if (time.length === 0) return [];
  return joined(cyclesOf(view, view.mechanics.contacts)
    .filter(({status}) => status === Cycle_Status.CUT || status === Cycle_Status.UNFINISHED)
    .map(({startTimeS, endTimeS}) => ({start: Math.max(startTimeS, time[0]!), end: Math.min(endTimeS, time[time.length - 1]!)})));
}

/** From which to which value something went in each cycle of a contact that has too few samples. */
export function rangesOf(view: RunView, contact: ContactModel, colour: number, valuesOf: (cycle: Cycle) => number[]): Range[] {
  return cyclesOf(view, [contact]).filter((cycle) => isCoarse(view, cycle)).flatMap((cycle) => {
    const values = valuesOf(cycle);
    const range = {label: contact.name, colour, start: cycle.startTimeS, end: cycle.endTimeS, low: Math.min(...values), high: Math.max(...values)};
    return values.every(Number.isFinite) ? [range] : [];
  });
}

/** Whether samples are too rare there to be joined. */
export const isLoose = (spans: Band[], x: number) => spans.some(({start, end}) => x >= start && x <= end);

const within = ({x, y}: Curve, {start, end}: Band) => Array.from(x, (at, i): [number, number] => [at, y[i]!]).filter(([at]) => at >= start && at <= end);

/**
 * Whether samples go up and down: of a swing that is seen too rarely, dots would be a slow one that never was. A drift,
 * such as of dissipated energy, goes its range once.
 */
function swings(points: [number, number][]): boolean {
  const known = points.map(([, y]) => y).filter(Number.isFinite);
  const [low, high] = extent([known]) ?? [0, 0];
  return known.length > 2 && travel(known, 0, known.length - 1) > SWING * (high - low);
}

/** What is shown of a curve where its samples are too rare to be joined. */
interface Loose {
  points: [number, number][];
  spreads: (Band & {low: number; high: number})[];
}

const known = new WeakMap<Curve, Loose>();   // Curves do not change, and are drawn again and again.

function looseOf(curve: Curve): Loose {
  let found = known.get(curve);
  if (found) return found;
  known.set(curve, found = {points: [], spreads: []});
  for (const span of curve.loose ?? []) {
    const points = within(curve, span);
    const [low, high] = extent([points.map(([, y]) => y)]) ?? [0, 0];
    if (swings(points)) found.spreads.push({...span, low, high});
    else found.points = found.points.concat(points);
  }
  return found;
}

/** The points of a curve that no line joins, unless they swing. What is dashed goes with another curve, and has none. */
export const rarePoints = (curve: Curve): [number, number][] => (curve.mark === 'dashed' ? [] : looseOf(curve).points);

/** Between which values the points of each curve are that swings where they are too rare, unless the ledger tells it. */
export function spreadOf({curves, ranges = []}: Panel): Range[] {
  const told = new Set(ranges.map(({label}) => label));
  return curves.filter(({mark, label}) => mark === 'line' && !told.has(label))
    .flatMap((curve) => looseOf(curve).spreads.map((spread) => ({label: curve.label, colour: curve.colour, ...spread})));
}

/** The cycles whose starts and ends are marked: where samples are rarer than contacts, marks hide all. */
export function outside(spans: Band[], cycles: Cycle[]): Cycle[] {
  return cycles.filter(({startTimeS, endTimeS}) => !isLoose(spans, startTimeS) && !isLoose(spans, endTimeS));
}

/** What ranges, dots and hatches mean. */
export function coarseNote(panel: Panel): string {
  const {ranges = [], cut = [], curves} = panel;
  return [ranges.length > 0 && `pale: ${look.coarse.range}`, spreadOf(panel).length > 0 && `pale: ${look.coarse.spread}`,
    curves.some((curve) => curve.loose?.length && rarePoints(curve).length > 0) && `dots: ${look.coarse.rare}`,
    cut.length > 0 && `hatched: ${look.coarse.cut}`].filter(Boolean).map((text) => `; ${text}`).join('');
}
