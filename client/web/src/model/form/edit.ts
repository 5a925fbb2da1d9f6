// Changes a page of YAML at one place, and leaves all else of it as it is written: comments, order, spaces.

import {isMap, isPair, isScalar, isSeq, parseDocument, type Document, type YAMLMap, type YAMLSeq} from 'yaml';

/** The keys and places that lead to a value. */
export type Path = (string | number)[];

type List = YAMLMap | YAMLSeq;
type Ranged = {range?: [number, number, number] | null} | null | undefined;

const startOf = (node: unknown) => (node as Ranged)?.range?.[0] ?? NaN;
const endOf = (node: unknown) => (node as Ranged)?.range?.[1] ?? NaN;
const isList = (node: unknown): node is List => isMap(node) || isSeq(node);
const read = (text: string): unknown => parseDocument(text).toJS() ?? {};

/** A text as it stands in a page, also inside of braces. */
export function textOf(value: string): string {
  const word = /^[A-Za-z][\w.-]*( [\w.-]+)*$/.test(value) && !/^(true|false|null|yes|no|on|off)$/i.test(value);
  return word ? value : JSON.stringify(value);
}

/** What is typed for a number: as it is typed, if it is one. */
export const numberOf = (typed: string): string => (typed.trim() !== '' && Number.isFinite(Number(typed)) ? typed.trim() : textOf(typed.trim()));

const entryStart = (entry: unknown) => startOf(isPair(entry) ? entry.key : entry);

function entryEnd(entry: unknown): number {
  if (!isPair(entry)) return endOf(entry);
  const end = endOf(entry.value);
  return Number.isNaN(end) ? endOf(entry.key) : end;
}

const lineStart = (text: string, at: number) => text.lastIndexOf('\n', at - 1) + 1;

/** The end of the line that holds the last character before `at` that is not white, without its line feed. */
function lineEnd(text: string, at: number): number {
  const last = text.slice(0, at).trimEnd().length;
  const end = text.indexOf('\n', last);
  return end < 0 ? text.length : end;
}

/** The last character of a list in braces that is not white; there is a comma if `comma`. */
function closing(text: string, list: List): {at: number; comma: boolean} {
  const inner = text.slice(0, endOf(list) - 1).trimEnd();
  return {at: inner.length, comma: inner.endsWith(',') || list.items.length === 0};
}

/** Where the dash of an entry of a list in lines is, or the entry itself of a map. */
function indentOf(text: string, list: List): string {
  const first = entryStart(list.items[0]);
  const column = isSeq(list) ? text.lastIndexOf('-', first) : first;
  return ' '.repeat(column - lineStart(text, column));
}

/** Adds an entry, `key: value` or a value, at the end of a list. */
function added(text: string, list: List, entry: string): string {
  if (list.flow) {
    const {at, comma} = closing(text, list);
    return `${text.slice(0, at)}${comma ? '' : ', '}${entry}${text.slice(at)}`;
  }
  const end = lineEnd(text, entryEnd(list.items.at(-1)));
  return `${text.slice(0, end)}\n${indentOf(text, list)}${isSeq(list) ? '- ' : ''}${entry}${text.slice(end)}`;
}

function removed(text: string, list: List, at: number): string {
  const entry = list.items[at];
  if (!list.flow) {
    const start = lineStart(text, entryStart(entry));
    const rest = text.slice(Math.min(lineEnd(text, entryEnd(entry)) + 1, text.length));
    const behindDash = isMap(list) && text.slice(start, entryStart(entry)).trim() !== '';
    return behindDash ? text.slice(0, entryStart(entry)) + rest.trimStart() : text.slice(0, start) + rest;
  }
  const next = list.items[at + 1];
  if (next !== undefined) return text.slice(0, entryStart(entry)) + text.slice(entryStart(next));
  const from = at > 0 ? entryEnd(list.items[at - 1]) : entryStart(entry);
  return text.slice(0, from) + text.slice(entryEnd(entry));
}

function replaced(text: string, node: unknown, value: string): string {
  const [start, end] = [startOf(node), endOf(node)];
  const gap = start === end && !/\s$/.test(text.slice(0, start)) ? ' ' : '';
  return text.slice(0, start) + gap + value + text.slice(end);
}

/** `value` inside of what of its path is not there yet. */
const wrapped = (rest: Path, value: string): string =>
  rest.reduceRight<string>((inner, key) => (typeof key === 'number' ? `[${inner}]` : `{${key}: ${inner}}`), value);

function spliced(text: string, doc: Document, path: Path, value: string): string {
  let holder: unknown = doc.contents;
  for (let i = 0; i < path.length; ++i) {
    if (!isList(holder)) return replaced(text, holder, wrapped(path.slice(i), value));
    const node: unknown = holder.get(path[i], true);
    const there = isMap(holder) ? holder.has(path[i]) : holder.items[path[i] as number] !== undefined;
    if (!there) {
      const entry = wrapped(path.slice(i + 1), value);
      return added(text, holder, isMap(holder) ? `${path[i]}: ${entry}` : entry);
    }
    if (node === null || node === undefined) return text;   // The library knows how.
    holder = node;
  }
  return replaced(text, holder, value);
}

function cut(text: string, doc: Document, path: Path): string {
  const holder: unknown = path.length > 1 ? doc.getIn(path.slice(0, -1), true) : doc.contents;
  const key = path.at(-1)!;
  if (!isList(holder)) return text;
  const at = isMap(holder) ? holder.items.findIndex((pair) => (isScalar(pair.key) ? pair.key.value : pair.key) === key) : Number(key);
  return at < 0 ? text : removed(text, holder, at);
}

/** A change, from the first place on where the page has something else than a list. */
function reachable(doc: Document, path: Path, value: string | undefined): [Path, string | undefined] {
  const depth = path.findIndex((_, i) => i > 0 && doc.hasIn(path.slice(0, i)) && !isList(doc.getIn(path.slice(0, i), true)));
  return depth < 0 || value === undefined ? [path, value] : [path.slice(0, depth), wrapped(path.slice(depth), value)];
}

/**
 * The page with a value, YAML in one line, at a place; without the field if it is undefined. What is done to the
 * text is held to what it must then say; where that fails, as for anchors, the library writes the page anew. A page
 * that cannot be read stays.
 */
export function setAt(text: string, place: Path, asked: string | undefined): string {
  const doc = parseDocument(text);
  if (doc.errors.length > 0) return text;
  if (doc.contents === null) return asked === undefined ? text : `${text}${text === '' || text.endsWith('\n') ? '' : '\n'}${place[0]}: ${wrapped(place.slice(1), asked)}\n`;
  const [path, value] = reachable(doc, place, asked);
  const wanted = doc.clone();
  if (value === undefined) wanted.deleteIn(path);
  else wanted.setIn(path, wanted.createNode(parseDocument(value).toJS()));
  let made = text;
  try {
    made = value === undefined ? cut(text, doc, path) : spliced(text, doc, path, value);
    if (JSON.stringify(read(made)) === JSON.stringify(wanted.toJS() ?? {})) return made;
  } catch { /* It is written anew. */ }
  return String(wanted);
}
