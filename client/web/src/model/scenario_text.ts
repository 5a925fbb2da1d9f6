// A scenario or sweep as a page of YAML: reading it, and finding the line of a field.

import {getOption, hasOption, ScalarType, type DescField, type DescMessage, type JsonValue} from '@bufbuild/protobuf';
import {LineCounter, isMap, isNode, isPair, parseDocument, type Document} from 'yaml';

import {rule} from '../api/generated/contact/v1/field_rules_pb';
import {ScenarioSchema, SweepSchema} from '../api/generated/contact/v1/scenario_pb';
import {rangeOf} from './completion';
import {partsOf, valueAt} from './field_path';

/** Something wrong, at a line from 1; 0 if no line is known. */
export interface Problem {
  line: number;
  path: string;
  text: string;
}

/** What a page says. */
export interface Page {
  kind: 'scenario' | 'sweep';
  /** In the form of the contract's JSON, without the fields that have problems; undefined if the page cannot be read. */
  json: JsonValue | undefined;
  problems: Problem[];
  lineOf: (path: string) => number;
}

type Json = Record<string, unknown>;
const IMPLICIT: DescField['presence'] = 2;

/** Replaces `${name}` by the values of `variables`. */
export function expand(value: unknown, variables: Json): unknown {
  if (typeof value === 'string') {
    const whole = /^\$\{(\w+)\}$/.exec(value);
    if (whole && whole[1]! in variables) return variables[whole[1]!];
    return value.replace(/\$\{(\w+)\}/g, (text, name: string) => (name in variables ? String(variables[name]) : text));
  }
  if (Array.isArray(value)) return value.map((entry) => expand(entry, variables));
  if (value !== null && typeof value === 'object') {
    return Object.fromEntries(Object.entries(value).map(([k, v]) => [k, expand(v, variables)]));
  }
  // JSON has no NaN and no infinities; the contract has words for them.
  if (typeof value === 'number' && !Number.isFinite(value)) return String(value);
  return value;
}

/** How many letters must change to make one word of another. */
export function distance(a: string, b: string): number {
  let row = Array.from({length: b.length + 1}, (_, i) => i);
  for (let i = 1; i <= a.length; ++i) {
    const next = [i];
    for (let j = 1; j <= b.length; ++j) {
      next.push(Math.min(row[j]! + 1, next[j - 1]! + 1, row[j - 1]! + (a[i - 1] === b[j - 1] ? 0 : 1)));
    }
    row = next;
  }
  return row[b.length]!;
}

function hint(name: string, known: string[]): string {
  const best = [...known].sort((a, b) => distance(name, a) - distance(name, b))[0];
  return best && distance(name, best) <= Math.max(2, name.length / 3) ? ` — did you mean '${best}'?` : '';
}

/** What is wrong with a 0 that the contract cannot tell from a field that is missing; empty if 0 is in its range. */
function wrongZero(field: DescField): string {
  if (field.presence !== IMPLICIT || !hasOption(field, rule)) return '';
  const {required, low} = getOption(field, rule);
  const outside = low.case === 'above' ? low.value >= 0 : low.case === 'min' && low.value > 0;
  return required && outside ? `is 0; must be in ${rangeOf(field)}` : '';
}

function wrongValue(field: DescField, value: unknown): string | undefined {
  if (field.fieldKind === 'enum') {
    const names = field.enum.values.map(({name}) => name);
    if (typeof value === 'number' || names.includes(String(value))) return undefined;
    return `is '${String(value)}'; must be one of ${names.slice(1).join(', ')}${hint(String(value), names)}`;
  }
  if (field.fieldKind !== 'scalar') return undefined;
  const number = field.scalar !== ScalarType.STRING && field.scalar !== ScalarType.BOOL;
  if (number && value === 0) return wrongZero(field) || undefined;
  if (number && typeof value !== 'number' && !['NaN', 'Infinity', '-Infinity'].includes(String(value))) return `is '${String(value)}'; must be a number`;
  if (field.scalar === ScalarType.BOOL && typeof value !== 'boolean') return `is '${String(value)}'; must be true or false`;
  return undefined;
}

/** What is wrong with an entry as a whole; undefined if it is of the kind of its field. */
function wrongEntry(name: string, entry: unknown, field: DescField | undefined, known: string[]): string | undefined {
  if (!field) return `unknown field${hint(name, known)}`;
  if (entry === null) return undefined;
  const list = field.fieldKind === 'list';
  if (list !== Array.isArray(entry)) return list ? 'must be a list' : 'must not be a list';
  return list || field.message ? undefined : wrongValue(field, entry);
}

/** Tells of fields that the contract does not have and of values of a wrong kind, and takes them out. */
function takeOutWrong(value: unknown, message: DescMessage, path: string, told: (path: string, text: string) => void): void {
  if (value === null || typeof value !== 'object' || Array.isArray(value)) { told(path, 'must have fields'); return; }
  const fields = value as Json;
  for (const [name, entry] of Object.entries(fields)) {
    const own = path ? `${path}.${name}` : name;
    const field = message.fields.find((f) => f.name === name || f.jsonName === name);
    const wrong = wrongEntry(name, entry, field, message.fields.map((f) => f.name));
    if (wrong) {
      told(own, wrong);
      delete fields[name];
    } else if (field?.message && entry !== null) {
      if (Array.isArray(entry)) entry.forEach((one, i) => takeOutWrong(one, field.message!, `${own}[${i}]`, told));
      else takeOutWrong(entry, field.message, own, told);
    }
  }
}

/** The line of a field, or of what holds it. */
function lineFinder(doc: Document, counter: LineCounter): (path: string) => number {
  return (path) => {
    let at: unknown = doc.contents;
    let line = 1;
    for (const part of partsOf(isMap(at) && isMap(at.get('base')) ? path : path.replace(/^base\./, ''))) {
      const key = part.startsWith('[') ? Number(part.slice(1, -1)) : part;
      const pair: unknown = isMap(at) ? at.items.find((p) => String(p.key) === part) : undefined;
      const next = isPair(pair) ? pair.value : (at as {get?: (key: unknown, keep: boolean) => unknown} | null)?.get?.(key, true);   // An empty page holds null.
      const node = isPair(pair) && isNode(pair.key) ? pair.key : next;
      if (!isNode(node) || !node.range) break;
      line = counter.linePos(node.range[0]).line;
      at = next;
    }
    return line;
  };
}

/** Reads a page. `files` are the scenarios that a sweep may name as its base. */
export function readPage(text: string, files: Record<string, string> = {}): Page {
  const counter = new LineCounter();
  const doc = parseDocument(text, {lineCounter: counter, prettyErrors: false});
  const lineOf = lineFinder(doc, counter);
  const problems: Problem[] = doc.errors.map((e) => ({line: counter.linePos(e.pos[0]).line, path: '', text: e.message}));
  const raw = problems.length > 0 ? undefined : doc.toJS() as Json | null;
  if (raw === undefined) return {kind: 'scenario', json: undefined, problems, lineOf};
  const {variables = {}, ...rest} = (raw ?? {}) as Json;
  const json = expand(rest, variables as Json) as Json;
  const kind = 'base' in json || 'axes' in json ? 'sweep' : 'scenario';
  const told = (path: string, what: string) => problems.push({line: lineOf(path), path, text: what});
  if (kind === 'sweep' && typeof json.base === 'string') {
    const base = files[json.base];
    if (base === undefined) told('base', `there is no scenario '${json.base}' here`);
    json.base = base === undefined ? {} : readPage(base).json;
  }
  takeOutWrong(json, kind === 'sweep' ? SweepSchema : ScenarioSchema, '', told);
  return {kind, json: json as JsonValue, problems, lineOf};
}

const holderOf = (path: string) => path.slice(0, Math.max(path.lastIndexOf('.'), 0));

/**
 * What is wrong with a page, line by line: what was seen here, and what the server says of the rest of the page. A
 * field that is missing beside a wrong field is not told: the wrong field may be meant for it.
 */
export function allProblems({json, problems}: Page, ofServer: Problem[]): Problem[] {
  const holders = new Set(problems.map(({path}) => holderOf(path)));
  const others = ofServer.filter(({path}) => !holders.has(holderOf(path)) || valueAt(json, path) !== undefined);
  return [...problems, ...others].sort((a, b) => a.line - b.line);
}
