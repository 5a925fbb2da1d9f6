// A scenario or sweep as a page of YAML: reading it, and finding the line of a field.

import {ScalarType, type DescField, type DescMessage, type JsonValue} from '@bufbuild/protobuf';
import {LineCounter, isMap, isNode, isPair, parseDocument, type Document} from 'yaml';

import {ScenarioSchema, SweepSchema} from '../api/generated/contact/v1/scenario_pb';
import {partsOf} from './field_path';

/** Something wrong, at a line from 1; 0 if no line is known. */
export interface Problem {
  line: number;
  path: string;
  text: string;
}

/** What a page says. */
export interface Page {
  kind: 'scenario' | 'sweep';
  /** In the form of the contract's JSON; undefined if the page cannot be read. */
  json: JsonValue | undefined;
  problems: Problem[];
  lineOf: (path: string) => number;
}

type Json = Record<string, unknown>;

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

function wrongValue(field: DescField, value: unknown): string | undefined {
  if (field.fieldKind === 'enum') {
    const names = field.enum.values.map(({name}) => name);
    if (typeof value === 'number' || names.includes(String(value))) return undefined;
    return `is '${String(value)}'; must be one of ${names.slice(1).join(', ')}${hint(String(value), names)}`;
  }
  if (field.fieldKind !== 'scalar') return undefined;
  const number = field.scalar !== ScalarType.STRING && field.scalar !== ScalarType.BOOL;
  if (number && typeof value !== 'number' && !['NaN', 'Infinity', '-Infinity'].includes(String(value))) return `is '${String(value)}'; must be a number`;
  if (field.scalar === ScalarType.BOOL && typeof value !== 'boolean') return `is '${String(value)}'; must be true or false`;
  return undefined;
}

/** Fields that the contract does not have, and values of a wrong kind. */
export function check(value: unknown, message: DescMessage, path: string, told: (path: string, text: string) => void): void {
  if (value === null || typeof value !== 'object' || Array.isArray(value)) { told(path, 'must have fields'); return; }
  for (const [name, entry] of Object.entries(value)) {
    const own = path ? `${path}.${name}` : name;
    const field = message.fields.find((f) => f.name === name || f.jsonName === name);
    if (!field) { told(own, `unknown field${hint(name, message.fields.map((f) => f.name))}`); continue; }
    if (entry === null) continue;
    const list = field.fieldKind === 'list';
    if (list !== Array.isArray(entry)) { told(own, list ? 'must be a list' : 'must not be a list'); continue; }
    (list ? entry as unknown[] : [entry]).forEach((one, i) => {
      const place = list ? `${own}[${i}]` : own;
      if (field.message) check(one, field.message, place, told);
      else {
        const wrong = list ? undefined : wrongValue(field, one);
        if (wrong) told(place, wrong);
      }
    });
  }
}

/** The line of a field, or of what holds it. */
function lineFinder(doc: Document, counter: LineCounter): (path: string) => number {
  return (path) => {
    let at: unknown = doc.contents;
    let line = 1;
    for (const part of partsOf(path.replace(/^base\./, ''))) {
      const key = part.startsWith('[') ? Number(part.slice(1, -1)) : part;
      const pair: unknown = isMap(at) ? at.items.find((p) => String(p.key) === part) : undefined;
      const next = isPair(pair) ? pair.value : (at as {get?: (key: unknown, keep: boolean) => unknown}).get?.(key, true);
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
    else json.base = readPage(base).json;
  }
  check(json, kind === 'sweep' ? SweepSchema : ScenarioSchema, '', told);
  return {kind, json: problems.length > 0 ? undefined : json as JsonValue, problems, lineOf};
}
