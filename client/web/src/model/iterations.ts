// μ and residual over the passes of an episode, as `contactctl plot iterations` shows them.

import look from '../../../python/contactsim/figures/words.json';
import {Iteration_Update, type Iteration, type Iteration_Unknown} from '../api/generated/contact/v1/event_pb';
import {muUnit} from './mechanics';
import {exact} from './numbers';
import type {Curve, Panel} from './panel';

const LEAST_RESIDUAL = 1e-17;

/** The episodes in order, each with the number of its last pass. */
export function episodesOf(iterations: Iteration[]): Map<number, number> {
  const episodes = new Map<number, number>();
  for (const {episode, number} of iterations) {
    episodes.set(episode, Math.max(episodes.get(episode) ?? 0, number));
  }
  return episodes;
}

/** The episode that needed most passes; undefined if nothing was iterated. */
export function hardestEpisode(iterations: Iteration[]): number | undefined {
  let hardest: Iteration | undefined;
  for (const pass of iterations) if (!hardest || pass.number > hardest.number) hardest = pass;
  return hardest?.episode;
}

/** The newest episode whose passes have come to an end, else the newest: what to show of a run that goes on. */
export function newestEpisode(iterations: Iteration[]): number | undefined {
  return (iterations.findLast(({accepted}) => accepted) ?? iterations.at(-1))?.episode;
}

/** What became of one contact or group in one pass. */
export interface Pass {
  episode: number;
  number: number;
  accepted: boolean;
  unknown: Iteration_Unknown;
}

/** The passes of an episode, a row for each contact or group. */
export function passesOf(iterations: Iteration[], episode: number): Pass[] {
  return iterations.filter((pass) => pass.episode === episode)
    .flatMap(({number, accepted, unknowns}) => unknowns.map((unknown) => ({episode, number, accepted, unknown})));
}

/** How the next μ was found, as `contactctl watch` tells it. */
export function nextOf({accepted, unknown: {update}}: Pass): string {
  if (accepted) return 'accepted';
  return update === Iteration_Update.UPDATE_UNSPECIFIED ? '–' : Iteration_Update[update]!;
}

/** The interval in which μ is known to lie; a side that is not known yet is `–`. */
export function bracketOf({unknown: {bracketLow, bracketHigh}}: Pass): string {
  return `[${[bracketLow, bracketHigh].map((mu) => (mu === 0 ? '–' : exact(mu))).join(', ')}]`;
}

function haveManySizes(curves: Curve[]): boolean {
  const values = curves.flatMap(({y}) => Array.from(y));
  const low = Math.min(...values);
  return low > 0 && Math.max(...values) > 1000 * low;
}

function curvesOf(passes: Iteration[], value: (unknown: Iteration['unknowns'][number]) => number): Curve[] {
  const curves = new Map<string, Curve & {x: number[]; y: number[]}>();
  for (const pass of passes) {
    for (const unknown of pass.unknowns) {
      const label = `${unknown.contact} #${unknown.number}`;
      let curve = curves.get(label);
      if (!curve) {
        curve = {label, colour: curves.size, mark: 'linePoints', x: [], y: []};
        curves.set(label, curve);
      }
      curve.x.push(pass.number);
      curve.y.push(value(unknown));
    }
  }
  return [...curves.values()];
}

/** How far each value is from the last one of its curve, of which it is a part. */
function toLast(curve: Curve): Curve {
  const last = curve.y[curve.y.length - 1]!;
  return {...curve, y: Array.from(curve.y, (value) => (value === last ? 0 : value / last - 1))};
}

/** The passes of one episode as two panels; of μ how far it is from its last value, if `relative`. */
export function iterationPanels(iterations: Iteration[], episode: number, unit = muUnit([]), relative = false): Panel[] {
  const passes = iterations.filter((pass) => pass.episode === episode);
  const only = passes.length === iterations.length;
  const mu = curvesOf(passes, ({mu: value}) => value);
  const residual = curvesOf(passes, (unknown) => Math.max(Math.abs(unknown.residual), LEAST_RESIDUAL));
  const xLabel = only ? 'pass' : `pass of episode ${episode}`;
  const common = {xLabel, overTime: true, countedX: true};
  return [
    relative ? {...common, id: 'mu', title: look.titles.mu, yLabel: 'Δμ/μ [1]', curves: mu.map(toLast), note: 'Δμ: from the last pass'}
      : {...common, id: 'mu', title: look.titles.mu, yLabel: `μ [${unit}]`, logY: haveManySizes(mu), curves: mu},
    {...common, id: 'residual', title: look.titles.residual, yLabel: '|W_r/W_c + ε²| [1]', logY: true, curves: residual},
  ];
}
