// Recorded motion of a job.

import {server} from './client';
import {violationsOf} from './errors';

/** A recorded column. */
export interface Channel {
  name: string;
  quantity: string;
  unit: string;
  values: Float64Array;
}

/** Columns by name; `time` is among them. */
export interface Series extends Map<string, Channel> {
  /** True if more samples are recorded than are here. */
  thinned?: boolean;
}

/** The doubles of a column: little-endian, as all machines that run browsers are. */
export function doubles(bytes: Uint8Array): Float64Array {
  const {buffer, byteOffset, byteLength} = bytes;
  if (byteOffset % 8 === 0) return new Float64Array(buffer, byteOffset, byteLength / 8);
  return new Float64Array(bytes.slice().buffer);
}

/** Which part of a recording, and how much of it. */
export interface SeriesQuery {
  name: string;
  channels: string[];
  from?: number | undefined;
  to?: number | undefined;
  maxPoints: number;
}

/** What the first servers did not record: asking for one of these columns of a job of theirs is an error. */
const LATER = new Set(['kinetic_energy', 'contact_energy', 'support_energy', 'dissipated_energy', 'load_work'].map((name) => `system.${name}`));
const withoutLater = new Set<string>();   // The jobs that are known to lack them.

/** Asks for columns, thinned by the server so that no peak is lost. What a job of an older server lacks is left out. */
export async function readSeries(query: SeriesQuery, signal?: AbortSignal): Promise<Series> {
  const recorded = query.channels.filter((channel) => !LATER.has(channel));
  const lacks = withoutLater.has(query.name);
  try {
    return await readColumns(lacks ? {...query, channels: recorded} : query, signal);
  } catch (error) {
    const refused = violationsOf(error).some(({field}) => field.startsWith('channels'));
    if (lacks || !refused || recorded.length === 0 || recorded.length === query.channels.length) throw error;
    withoutLater.add(query.name);
    return readColumns({...query, channels: recorded}, signal);
  }
}

async function readColumns(query: SeriesQuery, signal?: AbortSignal): Promise<Series> {
  const answer = await server.getSeries({
    name: query.name,
    channels: query.channels,
    ...(query.from === undefined ? {} : {startTimeS: query.from}),
    ...(query.to === undefined ? {} : {endTimeS: query.to}),
    maxPoints: Math.max(query.maxPoints, 2 + 2 * query.channels.length),
  }, signal ? {signal} : {});
  const columns = new Map(answer.columns.map(({name, quantity, unit, values}) =>
    [name, {name, quantity, unit, values: doubles(values)}]));
  return Object.assign(columns, {thinned: answer.recordedSamples > answer.samples});
}
