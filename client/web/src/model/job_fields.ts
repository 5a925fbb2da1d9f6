// The fields of the scenarios of a list of jobs.

import {toJson} from '@bufbuild/protobuf';

import type {Job} from '../api/generated/contact/v1/job_pb';
import {ScenarioSchema} from '../api/generated/contact/v1/scenario_pb';
import {flatten} from './field_path';

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
