// Units as people write them, by the rules of contactctl (client/cli/base/unit.h).

const PREFIXES: Record<string, number> = {n: 1e-9, u: 1e-6, 'µ': 1e-6, 'μ': 1e-6, m: 1e-3, c: 1e-2, k: 1e3, M: 1e6, G: 1e9};
const GRAVITY = 9.80665;
/** Units beside an SI unit and its prefixes. All are exact by definition. */
const OTHERS: Record<string, Record<string, number>> = {
  s: {min: 60, h: 3600},
  m: {in: 0.0254, ft: 0.3048},
  N: {kgf: GRAVITY, kp: GRAVITY, lbf: 4.4482216152605},
  'm/s': {mph: 0.44704, kph: 1 / 3.6},
  'm/s^2': {g: GRAVITY, gn: GRAVITY, mg: GRAVITY / 1000, G: GRAVITY},
};
const USUAL: Record<string, string[]> = {
  s: ['s', 'ms', 'us', 'min', 'h'],
  m: ['m', 'mm', 'cm', 'um', 'in', 'ft'],
  'm/s': ['m/s', 'mm/s', 'km/h', 'mph', 'ft/s'],
  'm/s^2': ['m/s^2', 'mm/s^2', 'g', 'ft/s^2'],
  N: ['N', 'kN', 'mN', 'MN', 'kgf', 'lbf'],
};

/** `m/s²` and `m/s2` as `m/s^2`. */
const withPower = (unit: string) => unit.replaceAll('²', '^2').replaceAll('**2', '^2').replace(/\/s2$/, '/s^2');

/** The factor of a unit without a quotient. */
function simpleFactor(unit: string, si: string): number | undefined {
  if (unit === si) return 1;
  const other = Object.hasOwn(OTHERS, si) ? OTHERS[si]! : {};
  if (Object.hasOwn(other, unit)) return other[unit];
  if (!unit.endsWith(si) || !['s', 'm', 'N'].includes(si)) return undefined;
  const prefix = unit.slice(0, -si.length);
  return Object.hasOwn(PREFIXES, prefix) ? PREFIXES[prefix] : undefined;
}

/** The factor of what stands below a quotient, which may be a square. */
function factorBelow(unit: string, si: string): number | undefined {
  if (unit.endsWith('^2') !== si.endsWith('^2')) return undefined;
  if (!unit.endsWith('^2')) return simpleFactor(unit, si);
  const root = simpleFactor(unit.slice(0, -2), si.slice(0, -2));
  return root === undefined ? undefined : root * root;
}

/** How many of the SI unit one of the unit is; undefined if it is none of that quantity. */
export function unitFactor(unit: string, si: string): number | undefined {
  const [of, to] = [withPower(unit), withPower(si)];
  const known = simpleFactor(of, to);
  if (known !== undefined) return known;
  const [slash, siSlash] = [of.indexOf('/'), to.indexOf('/')];
  if (slash < 0 || siSlash < 0) return undefined;
  const above = simpleFactor(of.slice(0, slash), to.slice(0, siSlash));
  const below = factorBelow(of.slice(slash + 1), to.slice(siSlash + 1));
  return above === undefined || below === undefined ? undefined : above / below;
}

/** A value in SI: divided by whole numbers, so that 1.5 ms is 0.0015 s to the last digit. */
export function inSi(value: number, factor: number): number {
  const inverse = 1 / factor;
  return inverse === Math.round(inverse) ? value / inverse : value * factor;
}

/** Units that people use in place of an SI unit, itself first. */
export const usualUnits = (si: string) => USUAL[withPower(si)] ?? [si];

/** True for the unit of a quantity that can be measured. */
export const isUnit = (text: string) => Object.keys(USUAL).some((si) => unitFactor(text, si) !== undefined);
