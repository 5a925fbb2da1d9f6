// Where runs differ, and whether it matters: the first run is the baseline.

import {toJson} from '@bufbuild/protobuf';

import {Cycle_End, Cycle_Status, Job_State, type Job} from '../api/generated/contact/v1/job_pb';
import {ScenarioSchema} from '../api/generated/contact/v1/scenario_pb';
import {flatten} from './field_path';
import {mechanicsOf, muUnit} from './mechanics';
import {restitutionOf} from './status';

export type Value = number | string | undefined;

/** A parameter or result of all runs. */
export interface Row {
  name: string;
  values: Value[];
}

/** A result with its verdict. */
export interface Result extends Row {
  unit: string;
  holds: boolean[];
}

export interface Tolerance {
  absolute: number;
  relative: number;
}

/** The fields that are set in at least one scenario and not equal in all. */
export function differingParameters(jobs: Job[]): Row[] {
  const fields = jobs.map((job) => (job.spec.case === 'scenario'
    ? flatten(toJson(ScenarioSchema, job.spec.value, {useProtoFieldName: true})) : new Map<string, string>()));
  const paths = new Set(fields.flatMap((map) => [...map.keys()]));
  return [...paths].sort().map((name) => ({name, values: fields.map((map) => map.get(name))}))
    .filter(({values}) => values.some((value) => value !== values[0]));
}

const MOST_NAMED = 2;   // Values in the name of a run.

/** What tells runs from each other in a key: the values of the parameters that differ, with their fields; ids where these do not tell. */
export function runNames(jobs: Job[]): string[] {
  const rows = differingParameters(jobs).slice(0, MOST_NAMED);
  const field = (name: string) => name.slice(name.lastIndexOf('.') + 1).replaceAll('_', ' ');
  const told = (i: number) => rows.map(({name, values}, place) => {
    const same = place > 0 && field(rows[place - 1]!.name) === field(name);   // restitution 0.8, 0.7
    return `${same ? '' : `${field(name)} `}${values[i] ?? 'default'}`;
  });
  const names = jobs.map((_, i) => told(i).join(', '));
  return names.map((name, i) => {
    const id = jobs[i]!.name.replace('jobs/', '');
    if (!name) return id;
    return names.indexOf(name) === names.lastIndexOf(name) ? name : `${name}, ${id}`;
  });
}

/** True if a value is as far from the baseline as it may be; words must be equal. */
export function holds(value: Value, baseline: Value, {absolute, relative}: Tolerance): boolean {
  if (typeof value !== 'number' || typeof baseline !== 'number') return value === baseline;
  if (Number.isNaN(value) || Number.isNaN(baseline)) return Number.isNaN(value) && Number.isNaN(baseline);
  return Math.abs(value - baseline) <= Math.max(absolute, relative * Math.abs(baseline));
}

type Entry = [name: string, unit: string, value: Value];

function resultsOf(job: Job): Entry[] {
  const contacts = job.spec.case === 'scenario' ? mechanicsOf(job.spec.value).contacts : [];
  const units = new Map(contacts.map((contact) => [contact.name, muUnit([contact])]));
  const cycles = job.cycles.flatMap((c): Entry[] => {
    const name = `${c.contact} #${c.number}`;
    return [
      [`${name} status`, '', Cycle_Status[c.status]], [`${name} end`, '', Cycle_End[c.end]],
      [`${name} μ`, units.get(c.contact) ?? muUnit([]), c.mu], [`${name} ε out`, '1', restitutionOf(c)],
      [`${name} peak force`, 'N', c.peakForceN], [`${name} δ max`, 'm', c.deltaMaxM],
      [`${name} t end`, 's', c.endTimeS],
    ];
  });
  const bodies = job.finalBodies.flatMap((b): Entry[] => [
    [`${b.name} position`, 'm', b.positionM], [`${b.name} velocity`, 'm/s', b.velocityMPerS]]);
  return [['state', '', Job_State[job.state]], ...cycles, ...bodies];
}

/** All results beside each other, with verdicts against the first run. */
export function compareResults(jobs: Job[], tolerance: Tolerance): Result[] {
  const rows = new Map<string, Result>();
  jobs.forEach((job, i) => {
    for (const [name, unit, value] of resultsOf(job)) {
      let row = rows.get(name);
      if (!row) rows.set(name, row = {name, unit, values: new Array<Value>(jobs.length).fill(undefined), holds: []});
      row.values[i] = value;
    }
  });
  for (const row of rows.values()) row.holds = row.values.map((value) => holds(value, row.values[0], tolerance));
  return [...rows.values()];
}

/** How far a number is from the baseline, in percent. */
export function deviation(value: Value, baseline: Value): string {
  if (typeof value !== 'number' || typeof baseline !== 'number' || baseline === 0 || value === baseline) return '';
  const percent = 100 * (value - baseline) / Math.abs(baseline);
  return `${percent > 0 ? '+' : ''}${Number(percent.toPrecision(3))} %`.replace('-', '−');
}
