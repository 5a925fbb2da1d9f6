// Fields and words that may stand at a place of a scenario, from the contract.

import {getOption, hasOption, type DescField, type DescMessage} from '@bufbuild/protobuf';

import {rule} from '../api/generated/contact/v1/field_rules_pb';
import {ScenarioSchema, SweepSchema} from '../api/generated/contact/v1/scenario_pb';

/** A word to insert, and what it means. */
export interface Suggestion {
  word: string;
  about: string;
}

/** The keys that lead to a place, and what is written of the word there. */
export interface Place {
  keys: string[];
  /** The key whose value is being written; empty if it is a key itself. */
  key: string;
  prefix: string;
}

interface Level {
  indent: number;
  key: string;
}

const KEY = /^\s*(?:- +)*([\w]+)\s*:/;

/** The keys above a line, by its indentation. */
function above(lines: string[], indent: number): Level[] {
  const levels: Level[] = [];
  let limit = indent;
  for (let i = lines.length - 1; i >= 0 && limit > 0; --i) {
    const line = lines[i]!;
    const at = line.search(/[^\s-]/);
    const key = KEY.exec(line)?.[1];
    if (!key || line.trimStart().startsWith('#') || at >= limit) continue;
    levels.unshift({indent: at, key});
    limit = at;
  }
  return levels;
}

/** Keys opened by `{` and `[` and not closed. */
function flow(text: string): {keys: string[]; rest: string; open: boolean} {
  const stack: {key: string; from: number}[] = [];
  let key = '';
  let from = 0;
  for (let i = 0; i < text.length; ++i) {
    const found = /^(\w+)\s*:/.exec(text.slice(i));
    if (found && (i === 0 || /[\s{,[-]/.test(text[i - 1]!))) key = found[1]!;
    if (text[i] === '{' || text[i] === '[') { stack.push({key, from}); key = ''; from = i + 1; }
    else if (text[i] === '}' || text[i] === ']') { const last = stack.pop(); key = last?.key ?? ''; from = i + 1; }
    else if (text[i] === ',') { from = i + 1; }
  }
  return {keys: stack.map((s) => s.key).filter(Boolean), rest: text.slice(from), open: stack.length > 0};
}

/** Where a position is in a page. */
export function placeAt(text: string, position: number): Place {
  const lines = text.slice(0, position).split('\n');
  const line = lines.pop()!;
  const indent = Math.max(line.search(/[^\s-]/) < 0 ? line.length : line.search(/[^\s-]/), 0);
  const inFlow = flow(line);
  const rest = inFlow.open ? inFlow.rest : line;
  const [, key = '', value] = /^\s*(?:- +)*(\w+)\s*:\s*(.*)$/.exec(rest) ?? [];
  const prefix = value ?? /(\w*)$/.exec(rest)![1]!;
  return {keys: [...above(lines, indent).map((l) => l.key), ...inFlow.keys], key, prefix};
}

function messageAt(root: DescMessage, keys: string[]): DescMessage | undefined {
  return keys.reduce<DescMessage | undefined>((at, key) => at?.fields.find((f) => f.name === key)?.message, root);
}

/** A number as the server's messages have it: `1e6`. */
function bound(value: number | undefined, none: string): string {
  if (value === undefined) return none;
  return Math.abs(value) >= 1e5 ? value.toExponential().replace('e+', 'e') : String(value);
}

/** The range of a field that has a rule, such as `(0, 1e6]`. */
export function rangeOf(field: DescField): string {
  const {low, max} = getOption(field, rule);
  return `${low.case === 'above' ? '(' : '['}${bound(low.value, '−∞')}, ${bound(max, '∞')}]`;
}

/** A field in a few words: its kind, range, unit and default. */
export function aboutField(field: DescField): string {
  const parts: string[] = [];
  if (field.fieldKind === 'list') parts.push('list');
  if (field.fieldKind === 'enum') parts.push('word');
  if (field.message) parts.push(field.message.name);
  if (!hasOption(field, rule)) return parts.join(', ');
  const r = getOption(field, rule);
  if (r.required) parts.push('required');
  if (r.low.case || r.max !== undefined) parts.push(rangeOf(field));
  if (r.unit) parts.push(r.unit);
  if (r.default.case) parts.push(`default ${String(r.default.value)}`);
  return parts.join(', ');
}

/** What may be written at a place. */
export function suggestionsAt(text: string, position: number): Suggestion[] {
  const {keys, key, prefix} = placeAt(text, position);
  const sweep = /^(base|axes)\s*:/m.test(text);
  const message = messageAt(sweep ? SweepSchema : ScenarioSchema, keys);
  if (!message) return [];
  const begins = (word: string) => word.toLowerCase().startsWith(prefix.toLowerCase());
  if (key) {
    const field = message.fields.find((f) => f.name === key);
    if (field?.fieldKind === 'scalar' && field.scalar === 8) return ['true', 'false'].filter(begins).map((word) => ({word, about: ''}));
    if (field?.fieldKind !== 'enum') return [];
    return field.enum.values.slice(1).map(({name}) => ({word: name, about: ''})).filter(({word}) => begins(word));
  }
  return message.fields.filter((f) => begins(f.name)).map((f) => ({word: f.name, about: aboutField(f)}));
}
