// A page of a scenario as that of a sweep over some of its fields, and back.

import {isMap, isSeq, parseDocument} from 'yaml';

import {partsOf} from '../field_path';
import {setAt, textOf, type Path} from './edit';

/** The values of an axis: in a list, or so many between two ends. */
export interface AxisRange {
  spacing: 'linear' | 'log' | 'values';
  low: string;
  high: string;
  count: string;
  values: string;
}

type Json = Record<string, unknown>;

/** Whether a page is that of a sweep, and where its scenario stands: undefined if that is in a file. */
export function scenarioPath(raw: unknown): Path | undefined {
  const {base, axes} = (raw ?? {}) as Json;
  if (base === undefined && axes === undefined) return [];
  return base !== null && typeof base === 'object' ? ['base'] : undefined;
}

const nameOf = (entry: unknown) => (entry as {name?: unknown} | null)?.name;

/** The path of a field as an axis names it: by names of bodies and contacts where they have one. */
export function axisField(scenario: unknown, path: Path): string {
  let at = scenario;
  return path.reduce<string>((text, part) => {
    at = (at as Json | undefined)?.[part];
    if (typeof part === 'string') return text ? `${text}.${part}` : part;
    const name = nameOf(at);
    return `${text}[${typeof name === 'string' && name && !/^\d+$|\$/.test(name) ? name : part}]`;
  }, '');
}

/** The place of the axis of a field; -1 if it has none. */
export function axisAt(raw: unknown, scenario: unknown, path: Path): number {
  const {axes} = (raw ?? {}) as {axes?: {field?: unknown}[]};
  if (!Array.isArray(axes)) return -1;
  const wanted = axisField(scenario, path);
  const list = path[0] as string;
  return axes.findIndex((axis) => {
    if (typeof axis?.field !== 'string') return false;
    const own: Path = partsOf(axis.field).map((part) => {
      const place = /^\[(\d+)\]$/.exec(part)?.[1];
      return place === undefined ? part.replace(/[[\]]/g, '') : Number(place);
    });
    return axis.field === wanted || axis.field === wanted.replace(/\[[^\]]*\]/, '[*]') && typeof path[1] === 'number' && own[0] === list
      || axisField(scenario, own) === wanted;
  });
}

/** An axis as a form has it. */
export function rangeOfAxis(axis: unknown): AxisRange {
  const {values, linear, log} = (axis ?? {}) as {values?: unknown[]; linear?: Json; log?: Json};
  const {low = '', high = '', count = ''} = log ?? linear ?? {};
  return {
    spacing: values ? 'values' : log ? 'log' : 'linear',
    low: String(low), high: String(high), count: String(count), values: (values ?? []).join(', '),
  };
}

const numbers = (text: string) => text.split(/[\s,;]+/).filter(Boolean);

/** What is wrong with a range; empty if nothing is. */
export function wrongRange({spacing, low, high, count, values}: AxisRange): string {
  if (spacing === 'values') {
    const all = numbers(values);
    return all.length > 0 && all.every((one) => Number.isFinite(Number(one))) ? '' : 'give numbers with commas between';
  }
  const [from, to, many] = [low, high, count].map((one) => (one.trim() === '' ? NaN : Number(one))) as [number, number, number];
  if (!(from <= to)) return 'give two numbers, the smaller one first';
  if (spacing === 'log' && !(from > 0)) return 'a log scale begins above 0';
  return Number.isInteger(many) && many >= 1 ? '' : 'give a whole number of values';
}

function yamlOf(field: string, {spacing, low, high, count, values}: AxisRange): string {
  const of = spacing === 'values' ? `values: [${numbers(values).join(', ')}]` : `${spacing}: {low: ${low.trim()}, high: ${high.trim()}, count: ${count.trim()}}`;
  return `{field: ${/^[\w.]+$/.test(field) ? textOf(field) : JSON.stringify(field)}, ${of}}`;
}

const shift = (lines: string[], by: (line: string) => string) => lines.map((line) => (line.trim() === '' ? line : by(line)));

/** The first and last line of a field of a page, from 0; undefined without it. */
function linesOf(text: string, key: string): [number, number] | undefined {
  const {contents} = parseDocument(text);
  if (!isMap(contents)) return undefined;
  const pair = contents.items.find((one) => String(one.key) === key);
  if (!pair) return undefined;
  const start = (pair.key as {range: [number, number, number]}).range[0];
  const end = (pair.value as {range?: [number, number, number]} | null)?.range?.[1] ?? start;
  const line = (at: number) => text.slice(0, at).split('\n').length - 1;
  return [line(start), line(text.slice(0, end).trimEnd().length)];
}

/** The page as the base of a sweep without axes. Comments at its beginning and its variables stay where they are. */
function asBase(text: string): string {
  const lines = text.trimEnd().split('\n').filter((line) => line !== '---');
  const first = lines.findIndex((line) => !/^\s*(#|$)/.test(line));
  const head = first < 0 ? lines : lines.slice(0, first).map((line) => line.replace('$schema=contact.schema.json', '$schema=contact-sweep.schema.json'));
  const rest = first < 0 ? [] : lines.slice(first);
  const own = linesOf(rest.join('\n'), 'variables');
  const variables = own ? rest.splice(own[0], own[1] - own[0] + 1) : [];
  return [...head, ...variables, 'base:', ...shift(rest, (line) => `  ${line}`), 'metrics: [iterations]'].join('\n') + '\n';
}

/** The page of a sweep with this scenario in it, in place of the file that it names; undefined if both have variables. */
export function withBase(text: string, scenario: string): string | undefined {
  const place = linesOf(text, 'base');
  if (!place || (linesOf(text, 'variables') && linesOf(scenario, 'variables'))) return undefined;
  const lines = text.split('\n');
  const body = asBase(scenario.split('\n').filter((line) => !/^#/.test(line)).join('\n')).trimEnd().split('\n').slice(0, -1);
  return [...lines.slice(0, place[0]), ...body, ...lines.slice(place[1] + 1)].join('\n');
}

/** The page of the scenario that a page of a sweep has in it. */
function asScenario(text: string): string {
  const lines = text.split('\n');
  const base = linesOf(text, 'base')!;
  const gone = ['axes', 'metrics'].flatMap((key) => [linesOf(text, key) ?? []].flat());
  const within = (at: number) => gone.some((_, i) => i % 2 === 0 && at >= gone[i]! && at <= gone[i + 1]!);
  const inner = shift(lines.slice(base[0] + 1, base[1] + 1), (line) => line.replace(/^ {2}/, ''));
  const outer = (from: number, to: number) => lines.slice(from, to).filter((_, i) => !within(from + i));
  return [...outer(0, base[0]), ...inner, ...outer(base[1] + 1, lines.length)].join('\n')
    .replace('$schema=contact-sweep.schema.json', '$schema=contact.schema.json');
}

/** The page with an axis over a field of its scenario, in place of the one that it has. */
export function setAxis(text: string, path: Path, range: AxisRange): string {
  const raw: unknown = parseDocument(text).toJS();
  const root = scenarioPath(raw);
  if (root === undefined) return text;
  const scenario = root.length > 0 ? (raw as Json).base : raw;
  const at = axisAt(raw, scenario, path);
  const page = root.length > 0 ? text : asBase(text);
  const axes = (raw as Json | null)?.axes;
  const place = at >= 0 ? at : Array.isArray(axes) ? axes.length : 0;
  const field = at >= 0 ? String((axes as Json[])[at]!.field) : axisField(scenario, path);
  if (place > 0 || at >= 0) return setAt(page, ['axes', place], yamlOf(field, range));
  const without = setAt(page, ['axes'], undefined);
  return `${without.trimEnd()}\naxes:\n  - ${yamlOf(field, range)}\n`;
}

/** The page without that axis; without its last one it is that of a scenario again. */
export function dropAxis(text: string, at: number): string {
  const doc = parseDocument(text);
  const axes: unknown = doc.get('axes');
  const alone = isSeq(axes) && axes.items.length === 1;
  const base: unknown = doc.get('base');
  if (!alone || !isMap(base) || base.flow) return setAt(text, ['axes', at], undefined);
  return asScenario(text);
}
