// How numbers are written.

/** A number with the fewest digits that identify it, as the API's JSON has it. */
export function exact(value: number | bigint | undefined): string {
  if (value === undefined) return '';
  return Number.isNaN(value) ? '–' : String(value);
}

/** A number with a few digits, for ticks and labels. */
export function short(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? '–' : String(value);
  return String(Number(value.toPrecision(digits)));
}

/** The same for tables: small numbers have a power of ten in place of zeros. */
export function compact(value: number, digits: number): string {
  const shown = Number(value.toPrecision(digits));
  return shown !== 0 && Math.abs(shown) < 1e-3 ? shown.toExponential() : short(value, digits);
}

/** The digits after the point that a step between ticks needs. */
export function decimals(step: number): number {
  if (!(step > 0)) return 0;
  const place = Math.floor(Math.log10(step) + 1e-9);
  const head = step / 10 ** place;
  const more = Math.abs(head - Math.round(head)) > 1e-6 ? 1 : 0;   // 2.5 has one more than 2.
  return Math.min(Math.max(more - place, 0), 15);
}

/** A whole number with thin spaces between thousands. */
export function count(value: number | bigint): string {
  return String(value).replace(/\B(?=(\d{3})+$)/g, '\u202f');
}

/** Bytes with a prefix. */
export function bytes(value: number | bigint): string {
  const n = Number(value);
  if (n < 1000) return `${n} B`;
  const power = Math.min(Math.floor(Math.log10(n) / 3), 4);
  return `${short(n / 1000 ** power, 3)} ${['', 'k', 'M', 'G', 'T'][power]}B`;
}

/** Seconds with a prefix. */
export function seconds(value: number): string {
  if (value === 0) return '0 s';
  if (value >= 120) {
    const minutes = Math.floor(value / 60);
    if (minutes < 120) return `${minutes} min ${Math.round(value % 60)} s`;
    const hours = Math.floor(minutes / 60);
    return hours < 48 ? `${hours} h ${minutes % 60} min` : `${Math.floor(hours / 24)} d ${hours % 24} h`;
  }
  const power = value >= 1 ? 0 : Math.min(Math.ceil(-Math.log10(value) / 3 - 1e-12), 4);
  return `${short(value * 1000 ** power, 3)} ${['', 'm', 'µ', 'n', 'p'][power]}s`;
}
