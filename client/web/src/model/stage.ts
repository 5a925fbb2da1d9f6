// The line on which the strip shows bodies: how much of it, and how displacements are magnified.

import type {Series} from '../api/series';
import {values} from './curves';
import type {Mechanics} from './mechanics';
import {extent} from './panel';

/** What of the strip is the same at all moments. */
export interface Stage {
  mechanics: Mechanics;
  series: Series;
  low: number;
  high: number;
  /** Displacements are drawn so many times as large. */
  magnification: number;
  largestForce: number;
  /** Of each body [m/s]; drawn as arrows. */
  velocities?: number[];
}

export const MOST_BODIES = 60;   // Of a strip.

/** The bodies and contacts that a strip shows. */
export function firstBodies(mechanics: Mechanics): Mechanics {
  return {...mechanics, bodies: mechanics.bodies.slice(0, MOST_BODIES),
    contacts: mechanics.contacts.slice(0, MOST_BODIES).filter(({left, right}) => left < MOST_BODIES && right < MOST_BODIES)};
}

/** The strip of a scenario before its run. */
export function atStart(mechanics: Mechanics): Stage {
  const velocities = mechanics.bodies.map((_, i) => {
    const {velocityMPerS, motion} = mechanics.scenario.bodies[i]!;
    return motion?.kind.case === 'uniform' ? motion.kind.value.velocityMPerS : velocityMPerS;
  });
  return {...stageOf(mechanics, new Map(), false), velocities};
}

/** A round factor that makes small displacements visible: 1, 2, 5, 10, 20 … */
export function magnificationFor(displacement: number, room: number): number {
  if (!(displacement > 0) || displacement > 0.1 * room) return 1;
  const wanted = 0.25 * room / displacement;
  const power = 10 ** Math.floor(Math.log10(wanted));
  return power * [5, 2, 1].find((step) => step * power <= wanted)!;
}

/** The strip of a series. `magnified` false draws all to scale. */
export function stageOf(mechanics: Mechanics, series: Series, magnified: boolean): Stage {
  const {bodies, contacts} = mechanics;
  const displaced = bodies.map(({name, position}) => values(series, `${name}.position`).map((x) => x - position));
  const largest = Math.max(0, ...displaced.map((list) => { const e = extent([list]); return e ? Math.max(-e[0], e[1]) : 0; }));
  const radii = bodies.map(({radius}) => radius);
  const sorted = bodies.map(({position}) => position).sort((a, b) => a - b);
  const gaps = sorted.slice(1).map((x, i) => x - sorted[i]!).filter((gap) => gap > 0);
  const room = Math.min(...gaps, ...(radii.some((r) => r > 0) ? [2 * Math.max(...radii)] : []));
  const magnification = magnified && Number.isFinite(room) ? magnificationFor(largest, room) : 1;
  const places = bodies.flatMap(({position, radius}, i) => {
    const [low, high] = extent([displaced[i]!]) ?? [0, 0];
    return [position + magnification * low - radius, position + magnification * high + radius];
  });
  const walls = contacts.map(({wallPosition}) => wallPosition).filter(Number.isFinite);
  const [low, high] = extent([[...places, ...walls]]) ?? [0, 1];
  const forces = extent(contacts.map(({name}) => values(series, `${name}.contact_force`)));
  const margin = 0.08 * (high - low) || 0.01;
  return {mechanics, series, magnification, low: low - margin, high: high + margin, largestForce: forces?.[1] ?? 0};
}
