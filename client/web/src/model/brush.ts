// Ranges of axes and metrics by which cells of a sweep are chosen.

export type Range = [number, number];

/** The ranges, by the place of their axis or metric. */
export type Brushes = ReadonlyMap<number, Range>;

const MOST_STOPS = 50;   // Values that are reached one by one; of more, so many parts are.
const DIGITS = 4;        // Of a span, that an end has in the address.

/** The ranges that an address has, each as `PLACE:LOW:HIGH`; others are passed over. */
export function brushesIn(entries: string[], places: number): Brushes {
  return new Map(entries.flatMap((entry): [number, Range][] => {
    const parts = entry.split(':');
    const [place = NaN, low = NaN, high = NaN] = parts.map((part) => (part.trim() ? Number(part) : NaN));
    return parts.length === 3 && Number.isInteger(place) && place >= 0 && place < places && low <= high ? [[place, [low, high]]] : [];
  }));
}

export const entriesOf = (brushes: Brushes) => [...brushes].map(([place, range]) => [place, ...range].join(':'));

/** True if all ranges hold. What is no number lies in none. */
export function isInside(values: number[], brushes: Brushes): boolean {
  for (const [place, [low, high]] of brushes) {
    if (!(values[place]! >= low && values[place]! <= high)) return false;
  }
  return true;
}

/** A value with as many digits as matter in a span, whose ends stay as they are. */
export function rounded(value: number, [low, high]: Range): number {
  if (value <= low) return low;
  if (value >= high) return high;
  const digits = DIGITS - 1 - Math.floor(Math.log10(high - low));
  return digits > 0 ? Number(value.toFixed(Math.min(digits, 100))) : Math.round(value / 10 ** -digits) * 10 ** -digits;
}

/** The ranges with another one of a place; a range of all that there is chooses nothing, and goes. */
export function withRange(brushes: Brushes, place: number, range: Range | undefined, [low, high]: Range): Brushes {
  const next = new Map(brushes);
  next.delete(place);
  if (range && (range[0] > low || range[1] < high)) next.set(place, range);
  return next;
}

/** Where keys move an end of a range: from value to value if these are few. */
export function stopsOf(values: number[]): number[] {
  const distinct = [...new Set(values.filter(Number.isFinite))].sort((a, b) => a - b);
  const [low, high] = [distinct[0]!, distinct.at(-1)!];
  if (distinct.length <= MOST_STOPS + 1) return distinct;
  return Array.from({length: MOST_STOPS + 1}, (_, i) => rounded(low + (high - low) * i / MOST_STOPS, [low, high]));
}

/** The range with one of its ends moved by stops; the ends do not pass each other. */
export function moved(range: Range, end: 0 | 1, steps: number, stops: number[]): Range {
  const at = range[end];
  const next = steps > 0 ? stops.filter((stop) => stop > at)[steps - 1] ?? stops.at(-1)! : stops.filter((stop) => stop < at).at(steps) ?? stops[0]!;
  return end === 0 ? [Math.min(next, range[1]), range[1]] : [range[0], Math.max(next, range[0])];
}
