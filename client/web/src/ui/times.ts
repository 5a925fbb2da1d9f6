// Moments and durations of the contract.

interface Moment {
  seconds: bigint;
  nanos: number;
}

/** Seconds since 1970. */
export function epoch(moment: Moment): number {
  return Number(moment.seconds) + moment.nanos / 1e9;
}

/** Local time of day, with the date if it is not today. */
export function clock(moment: Moment | undefined): string {
  if (!moment) return '';
  const date = new Date(epoch(moment) * 1000);
  const pad = (n: number) => String(n).padStart(2, '0');
  const time = `${pad(date.getHours())}:${pad(date.getMinutes())}:${pad(date.getSeconds())}`;
  if (date.toDateString() === new Date().toDateString()) return time;
  return `${date.getFullYear()}-${pad(date.getMonth() + 1)}-${pad(date.getDate())} ${time}`;
}

/** What a field of a local time holds for a moment of the address; empty if there is none. */
export function localField(utcText: string): string {
  const date = new Date(utcText);
  if (Number.isNaN(date.getTime())) return '';
  return new Date(date.getTime() - date.getTimezoneOffset() * 60_000).toISOString().slice(0, 16);
}

/** The moment of a field of a local time, in UTC for the address. */
export function utcOfField(local: string): string {
  const date = new Date(local);
  return Number.isNaN(date.getTime()) ? '' : date.toISOString().replace(':00.000Z', 'Z');
}

/** UTC, for provenance. */
export function utc(moment: Moment | undefined): string {
  return moment ? new Date(epoch(moment) * 1000).toISOString() : '';
}
