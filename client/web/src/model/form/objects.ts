// The objects of a scenario that a form shows, one at a time.

import type {Path} from './edit';

/** An object of a page. */
export interface FormObject {
  /** From the scenario on; also what identifies it. */
  path: Path;
  label: string;
  /** A name for `fieldsOf`. */
  type: string;
}

type Json = Record<string, unknown>;

export const LISTS = [
  {list: 'bodies', one: 'body', type: 'Body'},
  {list: 'contacts', one: 'contact', type: 'Contact'},
  {list: 'supports', one: 'support', type: 'Support'},
  {list: 'loads', one: 'load', type: 'Load'},
] as const;
export type ListName = typeof LISTS[number]['list'];

const entriesOf = (scenario: unknown, list: ListName): Json[] => {
  const entries = (scenario as Json | null | undefined)?.[list];
  return Array.isArray(entries) ? entries.map((entry) => (entry !== null && typeof entry === 'object' ? entry as Json : {})) : [];
};

/** How an entry of a list is called: by its name, or whose it is. */
function titleOf({name, between, wall, body, other}: Json, at: number): string {
  if (typeof name === 'string' && name) return name;
  if (Array.isArray(between)) return `${between.join('-')}${wall ? '-wall' : ''}`;
  return [body ?? `${at + 1}`, other].filter(Boolean).join('-');
}

/** All of them, the scenario itself first. */
export function objectsOf(scenario: unknown): FormObject[] {
  return [
    {path: [], label: 'The run', type: 'Scenario'},
    ...LISTS.flatMap(({list, one, type}) => entriesOf(scenario, list).map((entry, i) => ({path: [list, i], label: `${one} ${titleOf(entry, i)}`, type}))),
    {path: ['solver'], label: 'Solver', type: 'Solver'},
    {path: ['output'], label: 'Output', type: 'Output'},
  ];
}

/** A name that no body has. */
function newName(bodies: Json[]): string {
  for (let n = bodies.length + 1; ; ++n) if (bodies.every(({name}) => name !== `B${n}`)) return `B${n}`;
}

const num = (value: unknown) => (typeof value === 'number' ? value : 0);

/** An entry to begin with, as YAML. */
export function newEntry(scenario: unknown, list: ListName): string {
  const bodies = entriesOf(scenario, 'bodies');
  const names = bodies.map(({name}) => String(name));
  const last = bodies.at(-1);
  if (list === 'bodies') {
    const radius = num(last?.radius_m);
    const place = last ? num(last.position_m) + (2 * radius || 1) : 0;
    return `{name: ${newName(bodies)}, mass_kg: ${num(last?.mass_kg) || 1}${radius ? `, radius_m: ${radius}` : ''}, position_m: ${Number(place.toPrecision(12))}}`;
  }
  if (list === 'contacts') {
    const like = entriesOf(scenario, 'contacts').at(-1);
    return `{between: [${names.slice(-2).join(', ')}], stiffness: ${num(like?.stiffness) || '1e8'}, restitution: ${num(like?.restitution) || 0.8}}`;
  }
  return list === 'supports' ? `{body: ${names[0] ?? 'B1'}, stiffness_n_per_m: 1000}` : `{body: ${names[0] ?? 'B1'}, constant: {force_n: 1}}`;
}

/** The place in `contacts` of the entry that makes a contact of this name, also one of several; -1 if none does. */
export function entryOfContact(scenario: unknown, name: string): number {
  return entriesOf(scenario, 'contacts').findIndex((entry, i) => {
    const own = titleOf(entry, i).replace(/-wall$/, '');
    const {between} = entry;
    const pairs = Array.isArray(between) ? between.slice(1).map((right, at) => `${between[at]}-${right}`) : [];
    return [own, `${own}-wall`, `${own}-left`, `${own}-right`, ...(entry.name ? pairs.map((_, at) => `${own}-${at + 1}`) : pairs)].includes(name);
  });
}
