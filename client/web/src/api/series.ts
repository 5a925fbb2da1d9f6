// Recorded motion of a job.

import {Code, ConnectError} from '@connectrpc/connect';

import {server} from './client';
import {GetSeriesRequest_Decimation} from './generated/contact/v1/job_service_pb';
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
  /** How many are recorded in the time asked for. */
  recorded?: number;
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
  /** Undefined: every sample; an error if they do not fit into an answer. */
  maxPoints: number | undefined;
}

/** What the first servers did not record: asking for one of these columns of a job of theirs is an error. */
const LATER = /^system\.(kinetic_energy|contact_energy|support_energy|dissipated_energy|load_work)$|\.(acceleration|support_force|support_energy)$/;
const withoutLater = new Set<string>();   // The jobs that are known to lack them.

/** Asks for columns, thinned by the server so that no peak is lost. What a job of an older server lacks is left out. */
export async function readSeries(query: SeriesQuery, signal?: AbortSignal): Promise<Series> {
  const recorded = query.channels.filter((channel) => !LATER.test(channel));
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
    ...(query.maxPoints === undefined ? {decimation: GetSeriesRequest_Decimation.RAW}
      : {maxPoints: Math.max(query.maxPoints, 2 + 2 * query.channels.length)}),
  }, signal ? {signal} : {});
  const columns = new Map(answer.columns.map(({name, quantity, unit, values}) =>
    [name, {name, quantity, unit, values: doubles(values)}]));
  return Object.assign(columns, {thinned: answer.recordedSamples > answer.samples, recorded: Number(answer.recordedSamples)});
}

const MOST_HALVINGS = 12;

/** Every sample of columns between two times, in as many calls as it takes. */
export async function readAll(name: string, channels: string[], from: number, to: number, halvings = 0): Promise<Series> {
  try {
    return await readSeries({name, channels, from, to, maxPoints: undefined});
  } catch (error) {
    if (ConnectError.from(error).code !== Code.OutOfRange || halvings === MOST_HALVINGS) throw error;
  }
  const middle = (from + to) / 2;
  const [first, second] = [await readAll(name, channels, from, middle, halvings + 1), await readAll(name, channels, middle, to, halvings + 1)];
  const last = first.get('time')!.values.at(-1);
  const start = second.get('time')!.values[0] === last ? 1 : 0;   // A sample in the middle is in both.
  return new Map([...first].map(([channel, column]) => [channel, {...column, values: joined(column.values, second.get(channel)!.values.subarray(start))}]));
}

function joined(first: Float64Array, second: Float64Array): Float64Array {
  const all = new Float64Array(first.length + second.length);
  all.set(first);
  all.set(second, first.length);
  return all;
}

/** The columns that a job has recorded, without their values. */
export async function recordedColumns(name: string): Promise<Omit<Channel, 'values'>[]> {
  const {columns} = await server.getSeries({name, endTimeS: 0, decimation: GetSeriesRequest_Decimation.RAW});
  return columns.map(({name: channel, quantity, unit}) => ({name: channel, quantity, unit}));
}
