// Measured signals beside those of a run: the same numbers as `contactctl compare JOB measured.csv`
// (client/cli/text/comparison/signal_comparison.h).

import type {Series} from '../../api/series';
import {values} from '../curves';
import {interpolate, lowerBound} from '../panel';
import type {Signal} from './signals';

/** How far measured values may be from the simulated ones: the larger of both, the second one of the measured peak. */
export interface Tolerance {
  absolute: number;
  relative: number;
}

/** One signal; all in SI. */
export interface Row {
  channel: string;
  unit: string;
  /** Measured points within the run, and those outside of it, which do not count. */
  points: number;
  outside: number;
  /** Root of the mean squared deviation, measured − simulated; NaN if no point lies within the run. */
  rms: number;
  /** The deviation of largest size, and its measured time. */
  largest: number;
  largestTime: number;
  /** The values of largest size; the simulated one between the first and the last point. */
  measuredPeak: number;
  simulatedPeak: number;
  /** What |largest| may be. */
  allowed: number;
  holds: boolean;
}

export type Range = [number, number];

const MOST_POINTS = 4000;   // Of a signal that decide about the shift; a recorder may have millions.
const SHIFTS = 1000;
const SECTIONS = 60;        // Of 0.618: to the last digits of a double.
const PART = (Math.sqrt(5) - 1) / 2;

const larger = (peak: number, value: number) => (Math.abs(value) > Math.abs(peak) ? value : peak);

/** A recorded channel as a function of time. */
class Curve {
  readonly #times: Float64Array;
  readonly #values: Float64Array;

  constructor(run: Series, channel: string) {
    this.#times = values(run, 'time');
    this.#values = values(run, channel);
  }

  /** The value between two samples; NaN outside of the run. */
  at(time: number): number {
    const inside = time >= this.#times[0]! && time <= this.#times.at(-1)!;
    return inside ? interpolate(this.#times, this.#values, time) : NaN;
  }

  /** The value of largest size in an interval of time. */
  peak(low: number, high: number): number {
    const [first, end] = [lowerBound(this.#times, low), lowerBound(this.#times, high)];
    return this.#values.subarray(first, end).reduce(larger, larger(this.at(low) || 0, this.at(high) || 0));
  }
}

/** The mean squared deviation of a signal, relative to its peak, by shift; infinite if more than half of the points lie outside. */
function misfitOf({channel, times, values: measured}: Signal, run: Series): (shift: number) => number {
  const curve = new Curve(run, channel);
  const peak = measured.reduce(larger, 0);
  const step = Math.floor(times.length / MOST_POINTS) + 1;
  return (shift) => {
    let [sum, inside, all] = [0, 0, 0];
    for (let i = 0; i < times.length; i += step, ++all) {
      const deviation = measured[i]! - curve.at(times[i]! + shift);
      if (Number.isNaN(deviation)) continue;
      ++inside;
      sum += deviation ** 2;
    }
    return inside === 0 || 2 * inside < all ? Infinity : sum / inside / (peak === 0 ? 1 : peak ** 2);
  };
}

/** The place of the least value of f between two ends, by golden sections. */
function least(f: (x: number) => number, low: number, high: number): number {
  let [left, right] = [high - PART * (high - low), low + PART * (high - low)];
  let [atLeft, atRight] = [f(left), f(right)];
  for (let i = 0; i < SECTIONS; ++i) {
    if (atLeft <= atRight) {
      [high, right, atRight] = [right, left, atLeft];
      left = high - PART * (high - low);
      atLeft = f(left);
    } else {
      [low, left, atLeft] = [left, right, atRight];
      right = low + PART * (high - low);
      atRight = f(right);
    }
  }
  return atLeft <= atRight ? left : right;
}

/** Simulated time minus measured time at which the signals are nearest to the run; undefined if at none half of them lie within it. */
export function fitShift(signals: Signal[], run: Series, [low, high]: Range): number | undefined {
  const misfits = signals.map((signal) => misfitOf(signal, run));
  const misfit = (shift: number) => misfits.reduce((sum, each) => sum + each(shift), 0);
  let [best, smallest] = [low, Infinity];
  for (let i = 0; i <= SHIFTS; ++i) {
    const shift = low + (high - low) * i / SHIFTS;
    const found = misfit(shift);
    if (found < smallest) [best, smallest] = [shift, found];
  }
  if (smallest === Infinity) return undefined;
  const step = (high - low) / SHIFTS;
  const refined = least(misfit, Math.max(low, best - step), Math.min(high, best + step));
  return misfit(refined) < smallest ? refined : best;
}

/** The shifts at which some of the signals and of the run overlap, to two digits more than a thousandth of them. */
export function overlapping(signals: Signal[], run: Series): Range {
  const recorded = values(run, 'time');
  const ends = signals.flatMap(({times}) => (times.length > 0 ? [times.reduce((a, b) => Math.min(a, b)), times.reduce((a, b) => Math.max(a, b))] : []));
  const [low, high] = [recorded[0]! - Math.max(...ends), recorded.at(-1)! - Math.min(...ends)];
  const unit = 10 ** (Math.floor(Math.log10(high - low)) - 4);
  return [Number((Math.floor(low / unit) * unit).toPrecision(12)), Number((Math.ceil(high / unit) * unit).toPrecision(12))];
}

/** A signal beside that of the run, with its clock shifted. */
export function rowOf({channel, unit, times, values: measured}: Signal, run: Series, shift: number, tolerance: Tolerance): Row {
  const curve = new Curve(run, channel);
  const row = {channel, unit, points: 0, outside: 0, rms: NaN, largest: 0, largestTime: NaN, measuredPeak: 0};
  let [first, last, squares] = [Infinity, -Infinity, 0];
  times.forEach((time, i) => {
    const deviation = measured[i]! - curve.at(time + shift);
    if (Number.isNaN(deviation)) { ++row.outside; return; }
    squares += deviation ** 2;
    if (++row.points === 1 || Math.abs(deviation) > Math.abs(row.largest)) [row.largest, row.largestTime] = [deviation, time];
    row.measuredPeak = larger(row.measuredPeak, measured[i]!);
    [first, last] = [Math.min(first, time), Math.max(last, time)];
  });
  const allowed = Math.max(tolerance.absolute, tolerance.relative * Math.abs(row.measuredPeak));
  return {
    ...row, allowed, rms: Math.sqrt(squares / row.points), simulatedPeak: curve.peak(first + shift, last + shift),
    holds: row.points > 0 && Math.abs(row.largest) <= allowed,
  };
}
