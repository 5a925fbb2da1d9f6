// Recorded motion of a job.

import {server} from './client';

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

/** Asks for columns, thinned by the server so that no peak is lost. */
export async function readSeries(query: SeriesQuery, signal?: AbortSignal): Promise<Series> {
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
