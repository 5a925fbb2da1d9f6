// A table of numbers as loggers and people write it, by the rules of contactctl (client/cli/input/measured.h).

import {fieldsOf, findDialect, isGap, mayBeRow, numberOf, textOf, type Dialect} from './dialect';
import {isUnit} from './units';

/** What a table says of one of its columns. */
export interface Column {
  /** As it stands in the file; empty if there is none. */
  header: string;
  /** The header without its unit. */
  name: string;
  /** At the end of the header, or below it; may be empty. */
  unit: string;
}

/** What is wrong with a file. */
export class TableMistake extends Error {}

const MOST_MISTAKES = 5;   // That are told of a column.

/** `force [kN]` or `force (kN)` as name and unit. */
export function columnOf(header: string): Column {
  const text = header.trim();
  const found = /^(.*?)\s*\[([^[]*)\]$/s.exec(text) ?? /^(.*?)\s*\(([^(]*)\)$/s.exec(text);
  return found?.[1] ? {header, name: found[1], unit: found[2]!.trim()} : {header, name: text, unit: ''};
}

const isTimeNamed = ['time', 't', 'zeit', 'temps'];
/** True for the names of a column of times. */
export const isTimeName = (name: string) => isTimeNamed.includes(name.toLowerCase());

const withoutBrackets = (text: string) => /^(?:\[(.+)\]|\((.+)\))$/s.exec(text)?.slice(1).join('').trim() ?? text;

/** Headers, in which what stands in brackets belongs to what is before it. */
function headersOf(line: string, separator: string): string[] {
  const headers: string[] = [];
  for (const text of fieldsOf(line, separator)) {
    const bracketed = separator === ' ' && /^[[(]/.test(text) && headers.length > 0;
    if (bracketed && !isUnit(withoutBrackets(headers.at(-1)!))) headers.push(`${headers.pop()} ${text}`);
    else headers.push(text);
  }
  return headers;
}

/** Whether a row below the headers has units. Some of them may be of other quantities. */
const areUnits = (fields: string[]) => fields.some((field) => isUnit(withoutBrackets(field))) && fields.every((field) => field.length < 16);

export class Table {
  readonly columns: Column[];
  readonly #lines: string[];
  readonly #rows: number[];
  readonly #dialect: Dialect;

  /** Reads the bytes of a file. Throws TableMistake if it has no rows of numbers. */
  constructor(bytes: Uint8Array) {
    this.#lines = textOf(bytes).split('\n').map((line) => line.replace(/\r$/, ''));
    const dialect = findDialect(this.#lines);
    if (!dialect) throw new TableMistake('has no rows of numbers in two columns or more; columns are separated by tabs, semicolons, commas or spaces');
    this.#dialect = dialect;
    this.#rows = this.#lines.flatMap((line, i) => (i >= dialect.firstRow && mayBeRow(line) ? [i] : []));
    this.columns = this.#headers();
  }

  get rows(): number { return this.#rows.length; }

  /** How the file is written, in words. */
  get dialect(): string {
    const {separator, decimalComma} = this.#dialect;
    const names: Record<string, string> = {'\t': 'tabs', ';': 'semicolons', ',': 'commas', ' ': 'spaces'};
    return `separated by ${names[separator]}${decimalComma ? ', decimal commas' : ''}, rows from line ${this.#dialect.firstRow + 1} on`;
  }

  /** The numbers of a column, one a row; NaN for a gap. Throws TableMistake for what is no number. */
  numbers(column: number): Float64Array {
    const {separator, decimalComma} = this.#dialect;
    const mistakes: string[] = [];
    const numbers = Float64Array.from(this.#rows, (line) => {
      const fields = mistakes.length < MOST_MISTAKES ? fieldsOf(this.#lines[line]!, separator) : [];
      if (fields.length > this.columns.length) mistakes.push(`line ${line + 1} has ${fields.length} fields; others have ${this.columns.length}`);
      const text = fields[column] ?? '';
      if (isGap(text)) return NaN;
      const number = numberOf(text, decimalComma);
      if (number === undefined) mistakes.push(`line ${line + 1}: expected a number${decimalComma ? ' with a decimal comma' : ''}, got '${text}'`);
      return number ?? NaN;
    });
    if (mistakes.length > 0) throw new TableMistake(mistakes.join('; '));
    return numbers;
  }

  /** The lines before the rows that may be headers, the last one first. */
  #above(): string[][] {
    const above: string[][] = [];
    for (let i = this.#rows[0]! - 1; i >= 0 && above.length < 2; --i) {
      const comment = this.#lines[i]!.startsWith('#');
      const line = this.#lines[i]!.slice(comment ? 1 : 0).replace(/^ +| +$/g, '');
      const headers = headersOf(line, this.#dialect.separator);
      if (line && (!comment || headers.length === this.#dialect.kinds.length)) above.push(headers);
    }
    return above;
  }

  #headers(): Column[] {
    const {length} = this.#dialect.kinds;
    const [nearest = [], upper = []] = this.#above();
    const hasUnits = areUnits(nearest) && upper.length >= Math.max(nearest.length, 2);
    const [headers, units] = hasUnits ? [upper, nearest] : [nearest, []];
    if (headers.length < 2) return Array.from({length}, () => ({header: '', name: '', unit: ''}));   // A title, or nothing.
    if (headers.length < length) {
      throw new TableMistake(`line ${this.#rows[0]! + 1} has ${length} fields; the header has ${headers.length}`);
    }
    return headers.map(columnOf).map((column, i) => ({...column, unit: column.unit || withoutBrackets(units[i] ?? '')}));
  }
}
