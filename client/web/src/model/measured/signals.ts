// Which channels the columns of a table are, and their values in SI.

import type {Channel} from '../../api/series';
import {isTimeName, type Column, type Table} from './table';
import {inSi, unitFactor} from './units';

/** What a column is said to be. */
export interface Meaning {
  /** A channel, `time`, or nothing: then the column is left out. */
  channel: string;
  /** As people write it; empty for the SI unit. */
  unit: string;
}

/** Measured values of one channel, in SI; all finite. */
export interface Signal {
  channel: string;
  unit: string;
  /** By the clock of the measurement [s]. */
  times: Float64Array;
  values: Float64Array;
}

/** A channel that a run has recorded. */
export type Known = Pick<Channel, 'name' | 'quantity' | 'unit'>;

export const TIME: Known = {name: 'time', quantity: 'time', unit: 's'};
/** How people call a quantity where there is but one of it. */
const SHORT: Record<string, string> = {
  v: 'velocity', x: 'position', a: 'acceleration', f: 'contact_force', force: 'contact_force', 'δ': 'deformation'};

const plain = (text: string) => text.toLowerCase().replace(/[\s_.-]+/g, ' ').trim();

/** The channel of this name as contactctl reads it: `X.force` is `X.contact_force`. */
function exactly(name: string, channels: Known[]): Known | undefined {
  if (isTimeName(name)) return TIME;
  const find = (wanted: string) => channels.find((channel) => channel.name === wanted);
  return find(name) ?? find(name.replace(/\.force$/, '.contact_force'));
}

/** The only channel of a name in other letters or signs, or of a quantity. */
function nearly(name: string, channels: Known[]): Known | undefined {
  const words = plain(name);
  const quantity = SHORT[words] ?? words.replaceAll(' ', '_');
  const same = channels.filter((channel) => plain(channel.name) === words || plain(channel.name.replace('.contact_', '.')) === words);
  const found = same.length > 0 ? same : channels.filter((channel) => channel.quantity === quantity);
  return found.length === 1 ? found[0] : undefined;
}

/** The unit that ends a name, as in `time_ms`. */
function unitAtEnd(name: string, si: string): string {
  const end = name.slice(name.lastIndexOf('_') + 1);
  return name.includes('_') && unitFactor(end, si) !== undefined ? end : '';
}

/** What a header seems to mean. */
function guess({name, unit}: Column, channels: Known[]): Meaning {
  const bare = name.replace(/_[^_]*$/, '');
  const [whole, short] = [exactly(name, channels) ?? nearly(name, channels), exactly(bare, channels) ?? nearly(bare, channels)];
  const known = whole ?? (short && unitAtEnd(name, short.unit) ? short : undefined);
  return {channel: known?.name ?? '', unit: unit || (known ? unitAtEnd(name, known.unit) : '')};
}

/** What the headers seem to mean, each channel once; the first column has times if none is called so. */
export function guessed(columns: Column[], channels: Known[]): Meaning[] {
  const meanings = columns.map((column) => guess(column, channels));
  const [first] = columns;
  if (first && meanings.every(({channel}) => channel !== TIME.name) && !meanings[0]!.channel) meanings[0] = {channel: TIME.name, unit: first.unit};
  return meanings.map((meaning, i) =>
    (meanings.findIndex(({channel}) => channel === meaning.channel) < i ? {...meaning, channel: ''} : meaning));
}

/** The numbers of a column in SI. */
function valuesOf(table: Table, column: number, {unit}: Meaning, si: string): Float64Array {
  const factor = unit ? unitFactor(unit, si) : 1;
  if (factor === undefined) throw new Error(`'${unit}' is no unit of a quantity in ${si}`);
  return table.numbers(column).map((value) => inSi(value, factor));
}

/** The measured signals. Throws Error with what is wrong, by column. */
export function signalsOf(table: Table, meanings: Meaning[], channels: Known[]): Signal[] {
  const read = (column: number, si: string) => {
    try {
      return valuesOf(table, column, meanings[column]!, si);
    } catch (error) {
      throw new Error(`column ${table.columns[column]!.header || column + 1}: ${(error as Error).message}`);
    }
  };
  const clock = meanings.findIndex(({channel}) => channel === TIME.name);
  if (clock < 0) throw new Error('no column has times');
  const times = read(clock, TIME.unit);
  return meanings.flatMap(({channel}, column): Signal[] => {
    const known = channels.find(({name}) => name === channel);
    if (!known || channel === TIME.name) return [];
    const values = read(column, known.unit);
    const good = (_: number, i: number) => Number.isFinite(times[i]) && Number.isFinite(values[i]);
    return [{channel, unit: known.unit, times: times.filter(good), values: values.filter(good)}];
  });
}

/** Whether contactctl takes a column for the same thing without being told. */
function isPlain({name, unit}: Column, meaning: Meaning, channels: Known[]): boolean {
  const own = exactly(name, channels);
  const si = own?.unit ?? '';
  return (own?.name ?? '') === meaning.channel && (!own || (unit || unitAtEnd(name, si) || si) === (meaning.unit || si));
}

/** The arguments --map of contactctl that say the same; undefined where headers do not tell columns apart. */
export function mapsOf(columns: Column[], meanings: Meaning[], channels: Known[]): string[] | undefined {
  const wanted = columns.map((column, i) => ({column, meaning: meanings[i]!})).filter(({column, meaning}) => !isPlain(column, meaning, channels));
  const clear = wanted.every(({column: {header}, meaning}) => header && meaning.channel && columns.filter((other) => other.header === header).length === 1);
  const siOf = (channel: string) => [TIME, ...channels].find(({name}) => name === channel)!.unit;
  return clear ? wanted.map(({column: {header}, meaning: {channel, unit}}) => `${header}=${channel} [${unit || siOf(channel)}]`) : undefined;
}
