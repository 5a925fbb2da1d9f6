// How the rows of a table are written, by the rules of contactctl (client/cli/input/table_dialect.h).

/** How the rows of a table are written. */
export interface Dialect {
  /** ' ' stands for runs of spaces. */
  separator: string;
  decimalComma: boolean;
  /** For each field of a row: `n` a number, `t` a text. */
  kinds: string;
  /** The first line that is a row. */
  firstRow: number;
}

const SEPARATORS = ['\t', ';', ',', ' '];   // Earlier ones first, where several fit.
const MOST_LOOKS = 1000;                    // Lines that are looked at.
const GAPS = ['', 'nan', '.nan', '-nan', 'na', 'n/a'];
const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
const INFINITE = /^([+-]?)\.?inf(inity)?$/i;

/** The text of a file, without byte order mark: of UTF-16 by its mark, of UTF-8, or else of Latin-1. */
export function textOf(bytes: Uint8Array): string {
  const [first, second] = bytes;
  if (first === 0xff && second === 0xfe) return new TextDecoder('utf-16le').decode(bytes);
  if (first === 0xfe && second === 0xff) return new TextDecoder('utf-16be').decode(bytes);
  try {
    return new TextDecoder('utf-8', {fatal: true}).decode(bytes);
  } catch {
    return new TextDecoder('latin1').decode(bytes);
  }
}

/** The fields of a line with quotes, in which a field may have separators; "" in quotes is one quote. */
function quotedFields(line: string, separator: string): string[] {
  const fields = [''];
  const last = () => fields.length - 1;
  let [quoted, begun] = [false, separator !== ' '];
  for (let i = 0; i < line.length; ++i) {
    const c = line[i]!;
    const parts = !quoted && (c === separator || (separator === ' ' && c === '\t'));
    if (c === '"' && quoted && line[i + 1] === '"') { fields[last()] += c; ++i; }
    else if (c === '"') { quoted = !quoted; begun = true; }
    else if (!parts) { fields[last()] += c; begun = true; }
    else if (separator !== ' ' || begun) { fields.push(''); begun = separator !== ' '; }
  }
  return fields.map((field) => field.trim());
}

function allFieldsOf(line: string, separator: string): string[] {
  if (line.includes('"')) return quotedFields(line, separator);
  if (separator === ' ') return line.replace(/^[ \t]+/, '').split(/[ \t]+/).map((field) => field.trim());
  return line.split(separator).map((field) => field.trim());
}

/** The fields of a line without space around them, and without empty ones at the end. */
export function fieldsOf(line: string, separator: string): string[] {
  const fields = allFieldsOf(line, separator);
  while (fields.at(-1) === '') fields.pop();
  return fields;
}

/** A field as a number, with a decimal comma or with a point; undefined for one that is none. */
export function numberOf(text: string, decimalComma: boolean): number | undefined {
  if (decimalComma && text.includes('.')) return undefined;
  const pointed = decimalComma ? text.replaceAll(',', '.') : text;
  if (NUMBER.test(pointed)) return Number(pointed);
  const infinite = INFINITE.exec(pointed);
  return infinite ? (infinite[1] === '-' ? -Infinity : Infinity) : undefined;
}

/** True for a field without a number: empty, nan or na. */
export function isGap(text: string): boolean {
  return GAPS.includes(text.toLowerCase());
}

/** `n` for a number, `g` for a gap, `t` for a text. */
function kindOf(text: string, separator: string): string {
  if (isGap(text)) return 'g';
  if (numberOf(text, false) !== undefined) return 'n';
  return separator !== ',' && numberOf(text, true) !== undefined ? 'n' : 't';
}

const kindsOf = (line: string, separator: string) => allFieldsOf(line, separator).map((text) => kindOf(text, separator)).join('');
const texts = (kinds: string) => kinds.split('t').length - 1;

/** Whether all that `kinds` has after the fields of a row is empty. */
const endsAs = (row: string, kinds: string) => /^g*$/.test(kinds.slice(row.length));

/** Whether a line is a row of these kinds. It may end early, or with empty fields. */
function fits(kinds: string, row: string): boolean {
  if (kinds.length < 2 || !endsAs(row, kinds) || !kinds.includes('n')) return false;
  return [...kinds.slice(0, row.length)].every((kind, i) => kind === 'g' || kind === row[i]);
}

/** Whether a line has a number where rows have their first one, so that it is no header. */
function beginsAs(row: string, kinds: string): boolean {
  return kinds.length >= 2 && kinds[row.indexOf('n')] === 'n';
}

/** Whether a line is a row with a mistake. */
const isAlmostARow = (kinds: string, row: string) => beginsAs(row, kinds) && kinds.length >= row.length && endsAs(row, kinds);

/** What most lines of the second half are with this separator; empty: no rows. */
function mostCommonKinds(lines: string[], candidates: number[], separator: string): string {
  const counts = new Map<string, number>();
  const half = Math.floor(candidates.length / 2);
  const stride = Math.floor((candidates.length - half) / MOST_LOOKS) + 1;
  for (let i = half; i < candidates.length; i += stride) {
    const kinds = kindsOf(lines[candidates[i]!]!, separator).replace(/g+$/, '');
    if (kinds.length < 2 || !kinds.includes('n')) continue;
    const all = kinds.replaceAll('g', 'n');
    counts.set(all, (counts.get(all) ?? 0) + 1);
  }
  const [best] = [...counts].sort(([a, n], [b, m]) => m - n || texts(a) - texts(b) || (a < b ? -1 : 1));
  return best?.[0] ?? '';
}

/**
 * The first of two lines, one after the other, that are rows; or one before it that would be but for a mistake, so that
 * a mistake hides no row.
 */
function firstRow(lines: string[], candidates: number[], row: string, separator: string): number | undefined {
  const kinds = (i: number) => kindsOf(lines[candidates[i]!]!, separator);
  for (let i = 0; i < candidates.length; ++i) {
    if (!fits(kinds(i), row)) continue;
    if (i + 1 < candidates.length && !fits(kinds(i + 1), row) && !isAlmostARow(kinds(i + 1), row)) continue;
    while (i > 0 && beginsAs(row, kinds(i - 1))) --i;
    for (let j = 0; j < i; ++j) if (isAlmostARow(kinds(j), row)) return candidates[j];
    return candidates[i];
  }
  return undefined;
}

/** Whether rows have decimal commas: some number has one, and none a point. */
function hasDecimalCommas(lines: string[], rows: number[], separator: string): boolean {
  if (separator === ',') return false;
  let comma = false;
  const stride = Math.floor(rows.length / MOST_LOOKS) + 1;
  for (let i = 0; i < rows.length; i += stride) {
    for (const text of fieldsOf(lines[rows[i]!]!, separator)) {
      if (text.includes('.') && numberOf(text, false) !== undefined) return false;
      comma ||= text.includes(',') && numberOf(text, true) !== undefined;
    }
  }
  return comma;
}

/** True for a line that may be a row: neither blank nor a comment. */
export const mayBeRow = (line: string) => !line.startsWith('#') && /[^ \t\r]/.test(line);

/** Finds how a table is written by what most lines of its second half have in common; undefined: it has no rows. */
export function findDialect(lines: string[]): Dialect | undefined {
  const candidates = lines.flatMap((line, i) => (mayBeRow(line) ? [i] : []));
  let best = {separator: '', kinds: ''};
  for (const separator of SEPARATORS) {
    const kinds = mostCommonKinds(lines, candidates, separator);
    if (kinds && (!best.kinds || texts(kinds) < texts(best.kinds))) best = {separator, kinds};
  }
  const first = best.kinds ? firstRow(lines, candidates, best.kinds, best.separator) : undefined;
  if (first === undefined) return undefined;
  return {...best, firstRow: first, decimalComma: hasDecimalCommas(lines, candidates.filter((i) => i >= first), best.separator)};
}
