// Plots of what is computed from recorded columns, such as `B1.velocity - B2.velocity`.

import {looseSpans} from './coarse';
import {values, type RunView} from './curves';
import type {Mechanics} from './mechanics';
import type {Panel} from './panel';

type Columns = (name: string) => ArrayLike<number>;
type Value = (columns: Columns, i: number) => number;

/** A formula that can be computed. */
export interface Formula {
  text: string;
  /** The columns that it needs. */
  channels: string[];
  at: Value;
}

const FUNCTIONS: Record<string, (value: number) => number> = {abs: Math.abs, sqrt: Math.sqrt, exp: Math.exp, log10: Math.log10};
const OPERATORS: Record<string, (a: number, b: number) => number> = {
  '+': (a, b) => a + b, '-': (a, b) => a - b, '*': (a, b) => a * b, '/': (a, b) => a / b,
};

/** The columns of a run that formulas may have. */
export function columnsOf({bodies, contacts}: Mechanics): string[] {
  return ['time', ...bodies.flatMap(({name}) => ['position', 'velocity', 'acceleration'].map((quantity) => `${name}.${quantity}`)),
    ...contacts.flatMap(({name}) => ['deformation', 'deformation_velocity', 'contact_force', 'external_force'].map((quantity) => `${name}.${quantity}`)),
    ...['kinetic_energy', 'contact_energy', 'support_energy', 'dissipated_energy', 'load_work'].map((quantity) => `system.${quantity}`)];
}

/** Reads a formula of + - * / ^, brackets, numbers, functions and columns, whose names may have any of these signs. Throws an Error that tells what is wrong. */
export function formulaOf(text: string, columns: string[]): Formula {
  let rest = text;
  const channels = new Set<string>();
  const names = [...columns].sort((a, b) => b.length - a.length);   // The longest that fits is meant.
  const take = (pattern: RegExp) => {
    rest = rest.trimStart();
    const found = pattern.exec(rest)?.[0];
    rest = rest.slice(found?.length ?? 0);
    return found;
  };
  const bracket = (): Value => {
    const inner = terms();
    if (!take(/^\)/)) throw new Error('a ) is missing');
    return inner;
  };
  function atom(): Value {
    if (take(/^-/)) { const value = powers(); return (c, i) => -value(c, i); }
    if (take(/^\(/)) return bracket();
    rest = rest.trimStart();
    const name = names.find((one) => rest.startsWith(one));
    if (name) {
      rest = rest.slice(name.length);
      channels.add(name);
      return (c, i) => c(name)[i]!;
    }
    const number = take(/^(\d+\.?\d*|\.\d+)(e[-+]?\d+)?/i);
    if (number) return () => Number(number);
    const called = FUNCTIONS[take(/^(abs|sqrt|exp|log10)(?=\s*\()/) ?? ''];
    if (called && take(/^\(/)) { const value = bracket(); return (c, i) => called(value(c, i)); }
    throw new Error(rest ? `${rest.split(/[\s()]/)[0] || rest}: no column of this run, such as ${columns[2] ?? 'time'}` : 'something is missing at the end');
  }
  const chain = (next: () => Value, signs: RegExp): Value => {
    let value = next();
    for (let sign = take(signs); sign; sign = take(signs)) {
      const [left, right, apply] = [value, next(), OPERATORS[sign]!];
      value = (c, i) => apply(left(c, i), right(c, i));
    }
    return value;
  };
  function powers(): Value {
    const base = atom();
    if (!take(/^\^/)) return base;
    const exponent = powers();
    return (c, i) => base(c, i) ** exponent(c, i);
  }
  const factors = () => chain(powers, /^[*/]/);
  function terms(): Value { return chain(factors, /^[-+]/); }
  const at = terms();
  if (rest.trim()) throw new Error(`${rest.trim()}: not understood`);
  return {text, channels: [...channels], at};
}

/** Formulas of the address, but for those that this run cannot have. */
export function formulasIn(texts: string[], mechanics: Mechanics): Formula[] {
  const columns = texts.length > 0 ? columnsOf(mechanics) : [];
  return texts.flatMap((text) => { try { return [formulaOf(text, columns)]; } catch { return []; } });
}

/** A formula over time. */
export function derivedPanel({text, channels, at}: Formula, view: RunView): Panel {
  const time = values(view.series, 'time');
  const known = new Map(['time', ...channels].map((name) => [name, values(view.series, name)]));
  const whole = channels.every((name) => known.get(name)!.length === time.length);
  const y = whole ? Float64Array.from(time, (_, i) => at((name) => known.get(name)!, i)) : new Float64Array(0);
  return {id: text, title: text, xLabel: 'time [s]', yLabel: 'in SI units', overTime: true, bands: view.bands,
    note: `shaded: in contact${view.series.thinned ? '; of samples that the server thinned, which may lack peaks of a formula: zoom in' : ''}`,
    curves: whole ? [{label: text, colour: 0, mark: 'line', x: time, y, loose: looseSpans(view, view.mechanics.contacts)}] : []};
}
