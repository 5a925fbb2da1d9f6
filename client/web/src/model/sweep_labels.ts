// What the axes and metrics of a sweep are in words with their units, as contactsim has them.

import {getOption, hasOption, ScalarType, type DescField, type DescMessage} from '@bufbuild/protobuf';

import {rule} from '../api/generated/contact/v1/field_rules_pb';
import {JobSchema, RunSummarySchema} from '../api/generated/contact/v1/job_pb';
import {ScenarioSchema, type Contact, type Scenario, type Sweep} from '../api/generated/contact/v1/scenario_pb';
import {partsOf} from './field_path';
import look from '../../../python/contactsim/figures/words.json';

/** A field, and what stands in brackets behind it. */
interface Step {
  name: string;
  entry: string | undefined;
}

/** None if that is no path. */
function stepsOf(path: string): Step[] {
  if (!/^([^.[\]]+(\[[^[\]]+\])?(\.(?!$)|$))+$/.test(path)) return [];
  const steps: Step[] = [];
  for (const part of partsOf(path)) {
    if (part.startsWith('[')) steps.at(-1)!.entry = part.slice(1, -1);
    else steps.push({name: part, entry: undefined});
  }
  return steps;
}

/** The fields of a path; none if the contract does not have one. */
function fieldsOf(steps: Step[], root: DescMessage): DescField[] {
  const fields: DescField[] = [];
  let type: DescMessage | undefined = root;
  for (const {name} of steps) {
    const field: DescField | undefined = type?.fields.find((one) => one.name === name);
    if (!field) return [];
    fields.push(field);
    type = field.message;
  }
  return fields;
}

/** The name of a quantity without its unit, and the unit; empty for whole numbers and words. */
function quantityOf(field: DescField): [string, string] {
  const {name} = field;
  if (field.fieldKind !== 'scalar' || field.scalar !== ScalarType.DOUBLE) return [name, ''];
  const unit = hasOption(field, rule) ? getOption(field, rule).unit : '';
  if (unit) return [name, unit];
  const [ending = '', found = '1'] = look.endings.find(([end]) => name.endsWith(end!)) ?? [];
  return [name.slice(0, name.length - ending.length), found];
}

const words = (name: string) => name.replaceAll('_', ' ');

/** `before`, what the path says without its entry, and whose it is: `wall position of ball-wall [m]`. */
function labelOf(steps: Step[], root: DescMessage, before: string, ownerOf: (name: string, entry: string) => string): string {
  const fields = fieldsOf(steps, root);
  if (fields.length === 0) return '';
  const [name, unit] = quantityOf(fields.at(-1)!);
  const between = steps.slice(0, -1).filter(({entry}) => entry === undefined).map((step) => words(step.name));
  const owner = steps.flatMap((step) => (step.entry === undefined ? [] : [ownerOf(step.name, step.entry)])).reverse().join(' of ');
  const quantity = [before, ...between, words(name)].filter(Boolean).join(' ');
  const link = / (in|out)$/.test(quantity) ? ', ' : ' of ';   // Restitution goes in and out, but not out of a contact.
  return `${quantity}${owner && link + owner}${unit && ` [${unit}]`}`;
}

const nameOf = ({name, between, wall}: Contact) => name || `${between.join('-')}${wall ? '-wall' : ''}`;

/** Whose the entry of a scenario's list is. */
function ownerIn(base: Scenario | undefined, list: string, entry: string): string {
  if (entry === '*') return `all ${list}`;
  if (!/^\d+$/.test(entry)) return entry;
  const i = Number(entry);
  const contact = base?.contacts[i];
  const load = base?.loads[i];
  if (list === 'bodies' && base?.bodies[i]) return base.bodies[i].name;
  if (list === 'contacts' && contact) return nameOf(contact);
  return `${list}[${entry}]${list === 'loads' && load ? ` on ${load.body}` : ''}`;
}

/** The label of an axis; without one what it varies, such as `velocity of B1 [m/s]`, or its path if the contract does not know that. */
export function axisLabel({base, axes}: Sweep, axis: number): string {
  const {label, field} = axes[axis]!;
  return label || labelOf(stepsOf(field), ScenarioSchema, '', (list, entry) => ownerIn(base, list, entry)) || field;
}

/** A metric of samples, such as `series[B1.velocity].max`; empty of others. */
function seriesLabel([series, pick, ...more]: Step[]): string {
  if (series?.name !== 'series' || !series.entry || !pick || pick.entry !== undefined || more.length > 0) return '';
  const dot = series.entry.lastIndexOf('.');
  const [owner, quantity] = [series.entry.slice(0, Math.max(dot, 0)), series.entry.slice(dot + 1)];
  const unit = new Map(Object.entries(look.channels)).get(quantity);
  const word = new Map(Object.entries(look.picks)).get(pick.name);
  if (!unit || !word) return '';
  return `${word} ${words(quantity)}${owner && ` of ${owner}`} [${pick.name.startsWith('time_of_') ? 's' : unit}]`;
}

/** A metric, such as `final velocity of B3 [m/s]`, or its path if the contract does not know that. */
export function metricLabel(metric: string): string {
  const steps = stepsOf(metric);
  const series = seriesLabel(steps);
  if (series) return series;
  const before = {final_bodies: 'final', groups: 'group'}[steps[0]?.name ?? ''] ?? '';
  const own = steps[0]?.name === 'summary' ? steps.slice(1) : steps;
  const owner = (list: string, entry: string) => (/^\d+$/.test(entry) ? `${list}[${entry}]` : entry);
  return labelOf(own, RunSummarySchema, before, owner) || labelOf(own, JobSchema, before, owner) || metric;
}
