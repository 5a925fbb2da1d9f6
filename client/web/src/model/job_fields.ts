// The fields of the scenarios of a list of jobs.

import {toJson} from '@bufbuild/protobuf';

import {Job_Convergence, Job_State, type Job} from '../api/generated/contact/v1/job_pb';
import {ScenarioSchema} from '../api/generated/contact/v1/scenario_pb';
import {flatten} from './field_path';
import type {Metric} from './job_list';
import {csvField} from './panel';
import {titleOf} from './remarks';

/** Values by their paths; those of the base of a sweep. */
export type Fields = Map<string, string>;

export function fieldsOf({spec}: Job): Fields {
  const scenario = spec.case === 'sweep' ? spec.value.base : spec.case === 'scenario' ? spec.value : undefined;
  return scenario ? flatten(toJson(ScenarioSchema, scenario, {useProtoFieldName: true})) : new Map<string, string>();
}

/** The paths whose values are not the same in all, those of most different values first. */
export function varyingFields(all: Fields[]): string[] {
  const paths = new Set(all.flatMap((fields) => [...fields.keys()]));
  const variety = new Map([...paths].map((path) => [path, new Set(all.map((fields) => fields.get(path))).size]));
  return [...paths].filter((path) => variety.get(path)! > 1).sort((a, b) => variety.get(b)! - variety.get(a)! || (a < b ? -1 : 1));
}

/** A list of jobs as CSV: what it shows of each, with the fields that are known. */
export function listCsv(jobs: Job[], metric: Metric, columns: string[], fields: Map<string, Fields>): string {
  const time = ({createTime}: Job) => (createTime ? new Date(Number(createTime.seconds) * 1000).toISOString() : '');
  const rows = jobs.map((job) => [job.name, titleOf(job), Job_State[job.state], Job_Convergence[job.convergence],
    Object.entries(job.labels).map(([key, value]) => `${key}=${value}`).join(' '), job.note, ...columns.map((path) => fields.get(job.name)?.get(path) ?? ''),
    `${metric.of(job) ?? ''}`, time(job)]);
  return [['job', 'title', 'state', 'convergence', 'labels', 'note', ...columns, metric.label, 'created'], ...rows]
    .map((row) => `${row.map((cell) => csvField(cell ?? '')).join(',')}\n`).join('');
}
