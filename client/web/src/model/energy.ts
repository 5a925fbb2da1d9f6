// Parts of the mechanical energy from positions, velocities and deformations, which jobs of all servers have.

import type {Series} from '../api/series';
import type {Load} from '../api/generated/contact/v1/scenario_pb';
import type {Mechanics} from './mechanics';

export interface EnergyPart {
  name: string;
  values: Float64Array;
}

const GRAVITY = -9.80665;

function column(series: Series, name: string): Float64Array {
  return series.get(name)?.values ?? new Float64Array(0);
}

function kinetic({bodies}: Mechanics, series: Series, into: Float64Array): void {
  for (const body of bodies) {
    if (body.fixed) continue;
    const velocity = column(series, `${body.name}.velocity`);
    for (let i = 0; i < into.length; ++i) into[i]! += 0.5 * body.mass * velocity[i]! ** 2;
  }
}

function elastic({contacts}: Mechanics, series: Series, into: Float64Array): void {
  for (const {name, stiffness, exponent} of contacts) {
    const deformation = column(series, `${name}.deformation`);
    for (let i = 0; i < into.length; ++i) {
      into[i]! += stiffness / (exponent + 1) * Math.max(deformation[i]!, 0) ** (exponent + 1);
    }
  }
}

/** ∫ k₁ d + k₂ d² + … dd. */
function springEnergy(stiffnesses: number[], stretch: number): number {
  return stretch ** 2 * stiffnesses.reduceRight((sum, k, i) => sum * stretch + k / (i + 2), 0);
}

function supports({scenario}: Mechanics, series: Series, into: Float64Array): void {
  for (const {body, other, stiffnessNPerM, higherStiffness, restPositionM, slipForceN} of scenario.supports) {
    const most = slipForceN === undefined ? Infinity : slipForceN / stiffnessNPerM;
    let slack = 0;  // The slack position of a spring that slips goes along, as samples tell.
    const end = column(series, `${body}.position`);
    const start = other ? column(series, `${other}.position`) : undefined;
    for (let i = 0; i < into.length; ++i) {
      const stretch = end[i]! - (start?.[i] ?? 0) - restPositionM;
      slack = Math.min(Math.max(slack, stretch - most), stretch + most);
      into[i]! += springEnergy([stiffnessNPerM, ...higherStiffness], stretch - slack);
    }
  }
}

/** The constant forces of a load on bodies: those of which energy can be told. */
function constantForces({bodies}: Mechanics, {kind, body}: Load): [string, number][] {
  if (kind.case === 'constant') return [[body, kind.value.forceN]];
  if (kind.case === 'step' && kind.value.startTimeS === 0) return [[body, kind.value.forceN]];
  if (kind.case !== 'gravity') return [];
  const acceleration = kind.value.accelerationMPerS2 ?? GRAVITY;
  return bodies.filter(({name, fixed}) => !fixed && (body === '' || name === body))
    .map(({name, mass}) => [name, mass * acceleration]);
}

function loads(mechanics: Mechanics, series: Series, into: Float64Array): boolean {
  const forces = mechanics.scenario.loads.flatMap((load) => constantForces(mechanics, load));
  for (const [body, force] of forces) {
    const position = column(series, `${body}.position`);
    for (let i = 0; i < into.length; ++i) into[i]! -= force * position[i]!;
  }
  return forces.length > 0;
}

/** Columns that the energy needs. */
export function energyChannels({bodies, contacts}: Mechanics): string[] {
  return [...bodies.flatMap(({name}) => [`${name}.position`, `${name}.velocity`]),
    ...contacts.map(({name}) => `${name}.deformation`)];
}

/** The parts of the energy over the time of the series, and their sum. */
export function mechanicalEnergy(mechanics: Mechanics, series: Series): EnergyPart[] {
  const samples = column(series, 'time').length;
  const parts: EnergyPart[] = [];
  const add = (name: string, fill: (into: Float64Array) => boolean | void) => {
    const values = new Float64Array(samples);
    if (fill(values) !== false) parts.push({name, values});
  };
  add('kinetic', (into) => kinetic(mechanics, series, into));
  add('contacts', (into) => elastic(mechanics, series, into));
  if (mechanics.scenario.supports.length > 0) add('supports', (into) => supports(mechanics, series, into));
  add('constant loads', (into) => loads(mechanics, series, into));
  const sum = new Float64Array(samples);
  for (const {values} of parts) values.forEach((value, i) => { sum[i]! += value; });
  return [...parts, {name: 'sum', values: sum}];
}
