// Units with SI prefixes, by the rules that contactsim's figures follow, too.

import look from '../../../python/contactsim/figures/words.json';

const PREFIXES: Record<string, string> = look.prefixes;

/** A unit for an axis: values are divided by `factor`. */
export interface AxisUnit {
  factor: number;
  label: string;
}

/** The unit in a label such as `time [s]`; empty if there is none. */
export function unitOf(label: string): string {
  return /\[([^\]]*)\]$/.exec(label)?.[1] ?? '';
}

/** The first symbol of a unit: `N` of `N/m`. */
const firstOf = (unit: string) => unit.split(/[/^*·]/)[0]!;

/** Whether a prefix before the unit is that of its first symbol, alone and not a power of it. */
const takesPrefix = (unit: string) => look.symbols.includes(firstOf(unit)) && unit[firstOf(unit).length] !== '^';

const RAISED = Object.fromEntries([...'0123456789+-n/.'].map((letter, i) => [letter, '⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ⁿᐟ·'[i]!]));

/** With raised exponents, for the eye: `m/s^2` as m/s², `m^(5/2)` as m⁵ᐟ². */
export function typeset(label: string): string {
  return label.replace(/\^(?:\(([-+n0-9./]+)\)|(-?[0-9n.]+))/g, (_all, long?: string, brief?: string) => [...long ?? brief!].map((letter) => RAISED[letter]).join(''));
}

export const power = (exponent: number): string => typeset(`10^${exponent}`);

/** The unit in which numbers up to `largest` are easy to read. */
export function readableUnit(label: string, largest: number): AxisUnit {
  const unit = unitOf(label);
  const {plain} = look;
  const few = largest >= plain.least && largest < plain.most;
  if (!unit || few || !Number.isFinite(largest) || largest <= 0) return {factor: 1, label};
  const exponent = 3 * Math.floor(Math.log10(largest) / 3 + 1e-12);
  const name = label.slice(0, label.lastIndexOf('['));
  const prefix = PREFIXES[exponent] ?? '';
  const usual = exponent < 0 || !look.never_above_one.includes(firstOf(unit));
  if (prefix && takesPrefix(unit) && usual) {
    return {factor: 10 ** exponent, label: `${name}[${prefix}${unit}]`};
  }
  if (largest >= plain.least_without_prefix && largest < plain.most_without_prefix) return {factor: 1, label};
  const shown = unit === '1' ? power(exponent) : `${power(exponent)} ${unit}`;
  return {factor: 10 ** exponent, label: `${name}[${shown}]`};
}
