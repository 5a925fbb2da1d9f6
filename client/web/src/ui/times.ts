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

/** UTC, for provenance. */
export function utc(moment: Moment | undefined): string {
  return moment ? new Date(epoch(moment) * 1000).toISOString() : '';
}
