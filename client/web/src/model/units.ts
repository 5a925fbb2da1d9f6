// Units with SI prefixes, by the rules of contactctl's figures.

const PREFIXES: Record<number, string> = {
  [-12]: 'p', [-9]: 'n', [-6]: 'µ', [-3]: 'm', 0: '', 3: 'k', 6: 'M', 9: 'G', 12: 'T',
};
const SYMBOLS = ['s', 'm', 'N', 'J', 'Pa'];   // Those that take prefixes.
const SUPERSCRIPT: Record<string, string> = {
  '-': '⁻', 0: '⁰', 1: '¹', 2: '²', 3: '³', 4: '⁴', 5: '⁵', 6: '⁶', 7: '⁷', 8: '⁸', 9: '⁹',
};

/** A unit for an axis: values are divided by `factor`. */
export interface AxisUnit {
  factor: number;
  label: string;
}

/** The unit in a label such as `time [s]`; empty if there is none. */
export function unitOf(label: string): string {
  return /\[([^\]]*)\]$/.exec(label)?.[1] ?? '';
}

function takesPrefix(unit: string): boolean {
  const end = unit.search(/[/^*·]/);
  if (end >= 0 && unit[end] === '^') return false;
  return SYMBOLS.includes(end < 0 ? unit : unit.slice(0, end));
}

function power(exponent: number): string {
  return `10${[...String(exponent)].map((digit) => SUPERSCRIPT[digit]).join('')}`;
}

/** The unit in which numbers up to `largest` are easy to read. */
export function readableUnit(label: string, largest: number): AxisUnit {
  const unit = unitOf(label);
  const plain = largest >= 0.1 && largest < 1000;
  if (!unit || plain || !Number.isFinite(largest) || largest <= 0) return {factor: 1, label};
  const exponent = 3 * Math.floor(Math.log10(largest) / 3 + 1e-12);
  const name = label.slice(0, label.lastIndexOf('['));
  const prefix = PREFIXES[exponent] ?? '';
  const usual = exponent < 0 || !unit.startsWith('s');
  if (prefix && takesPrefix(unit) && usual) {
    return {factor: 10 ** exponent, label: `${name}[${prefix}${unit}]`};
  }
  if (largest >= 0.01 && largest < 1e5) return {factor: 1, label};
  const shown = unit === '1' ? power(exponent) : `${power(exponent)} ${unit}`;
  return {factor: 10 ** exponent, label: `${name}[${shown}]`};
}
