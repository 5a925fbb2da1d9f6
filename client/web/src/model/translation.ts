// A contact to translate, as the address of the page has it, as a request, and as a command.

import type {MessageInitShape} from '@bufbuild/protobuf';

import type {ContactModel, ModelTranslation, TranslateModelRequestSchema} from '../api/generated/contact/v1/model_service_pb';

type Request = MessageInitShape<typeof TranslateModelRequestSchema>;

/** A number that is asked for. */
export interface Input {
  /** Its name in the address. */
  key: string;
  label: string;
  unit: string;
  /** What it is, where the label does not say so. */
  hint: string;
}

const input = (key: string, label: string, unit = '', hint = ''): Input => ({key, label, unit, hint});

/** What a contact gives back, and how stiff it is. */
export const WANTED: readonly Input[] = [
  input('e', 'Restitution ε', '', 'without the load'), input('k', 'Stiffness k', 'N/mⁿ', 'of k δⁿ'), input('n', 'Exponent n', '', 'that k goes with'),
  input('time', 'Contact time', 's', 'in place of k')];
/** How the bodies meet, and how they are computed. */
export const SETUP: readonly Input[] = [
  input('v', 'Approach velocity', 'm/s'), input('m', 'Mass', 'kg'), input('m2', 'Other mass', 'kg', 'empty: fixed'),
  input('r', 'Radius', 'm', 'some models need it'), input('r2', 'Other radius', 'm', 'empty: a plane'),
  input('g', 'Gravity', 'm/s²', 'presses on a fixed body'), input('step', 'Time step', 's', 'of the simulator')];

/** What an address without parameters shows. */
export const EXAMPLE: Readonly<Record<string, string>> = {e: '0.8', k: '1e6', n: '1.5', v: '1', m: '1', r: '0.02', step: '1e-5'};

/** The inputs of an address; those of a model as `set.NAME`. */
export function inputsOf(query: URLSearchParams): Record<string, string> {
  if (![...query.keys()].some((key) => key !== 'find')) return {...EXAMPLE};
  const entries = [...query].filter(([key]) => key !== 'set' && key !== 'find');
  const set = query.getAll('set').map((entry): [string, string] => {
    const at = entry.indexOf('=');
    return [`set.${entry.slice(0, at)}`, entry.slice(at + 1)];
  });
  return Object.fromEntries([...entries, ...set]);
}

/** The parameters of an address with these inputs. */
export function queryOf(inputs: Record<string, string>): Record<string, string | string[]> {
  const entries = Object.entries(inputs);
  const set = entries.filter(([key]) => key.startsWith('set.')).map(([key, value]) => `${key.slice(4)}=${value}`);
  return {...Object.fromEntries(entries.filter(([key]) => !key.startsWith('set.'))), set};
}

/** What two bodies count together: 1/x = 1/a + 1/b; a alone where the other is fixed, or a plane. */
export function together(a: number, b: number | undefined): number {
  return b === undefined ? a : a / (1 + a / b);
}

/** A number of an input; undefined if it is empty, NaN if it is none. */
function numberOf(text = ''): number | undefined {
  return text.trim() ? Number(text) : undefined;
}

/** The inputs that are no numbers. */
export function wordsAmong(inputs: Record<string, string>): string[] {
  const numbers = [...WANTED, ...SETUP].map(({key}) => key);
  return Object.keys(inputs).filter((key) => {
    const parts = key === 'v' ? inputs[key]!.split(',') : [inputs[key]!];
    return (numbers.includes(key) || key.startsWith('set.')) && parts.some((part) => Number.isNaN(numberOf(part)));
  });
}

const withoutUnset = <T extends object>(fields: T): T =>
  Object.fromEntries(Object.entries(fields).filter(([, value]) => value !== undefined)) as T;

/** The contact as the request has it. */
function contactOf(inputs: Record<string, string>): Request['contact'] {
  if (!inputs.from) {
    return {case: 'wanted', value: withoutUnset({
      restitution: numberOf(inputs.e), stiffness: numberOf(inputs.k), contactTimeS: numberOf(inputs.time),
      exponent: numberOf(inputs.k) === undefined ? undefined : numberOf(inputs.n)})};
  }
  const values = Object.entries(inputs).flatMap(([key, text]) => {
    const value = numberOf(text);
    return key.startsWith('set.') && value !== undefined ? [[key.slice(4), value] as const] : [];
  });
  return {case: 'from', value: {model: inputs.from, values: Object.fromEntries(values)}};
}

/** The request of inputs that are all numbers. With parameters of a model, the others of `known` are asked for. */
export function requestOf(inputs: Record<string, string>, known: readonly ContactModel[]): Request {
  const mass = numberOf(inputs.m);
  const radius = numberOf(inputs.r);
  return withoutUnset({
    models: inputs.from ? known.map(({name}) => name).filter((name) => name !== inputs.from) : [],
    massKg: mass === undefined ? undefined : together(mass, numberOf(inputs.m2)),
    velocitiesMPerS: (inputs.v ?? '').split(',').flatMap((text) => numberOf(text) ?? []),
    gravityMPerS2: inputs.m2 ? undefined : numberOf(inputs.g),
    radiusM: radius === undefined ? undefined : together(radius, numberOf(inputs.r2)),
    stepS: numberOf(inputs.step),
    contact: contactOf(inputs),
  });
}

const PLACES: readonly [RegExp, string][] = [
  [/^wanted\.restitution/, 'e'], [/^wanted\.exponent/, 'n'], [/^wanted\.contact_time/, 'time'], [/^wanted/, 'k'], [/^mass/, 'm'], [/^veloc/, 'v'],
  [/^gravity/, 'g'], [/^radius/, 'r'], [/^step/, 'step'], [/^from\.values\[(.*)\]$/, 'set.$1'], [/^(from|models|contact)/, 'from']];

/** The input of a field of the request. */
export function inputAt(field: string): string {
  for (const [pattern, key] of PLACES) {
    const found = pattern.exec(field);
    if (found) return key.replace('$1', found[1] ?? '');
  }
  return '';
}

/** The same question to contactctl. */
export function commandOf(inputs: Record<string, string>, request: Request): string {
  const flag = (name: string, value: unknown) => (value === undefined || value === '' ? '' : ` --${name} ${String(value)}`);
  const set = Object.entries(inputs).filter(([key]) => key.startsWith('set.')).map(([key, value]) => `${key.slice(4)}=${value}`).join(',');
  const contact = inputs.from
    ? `${request.models!.map((name) => ` ${name}`).join('')}${flag('from', inputs.from)}${flag('set', set)}`
    : flag('restitution', inputs.e) + flag('stiffness', inputs.k) + (inputs.k ? flag('exponent', inputs.n) : '') + flag('contact-time', inputs.time);
  return `contactctl model translate${contact}${flag('velocity', request.velocitiesMPerS?.join(','))}${flag('mass', request.massKg)}`
    + flag('gravity', request.gravityMPerS2) + flag('radius', request.radiusM) + flag('step', request.stepS);
}

/** The ratio of velocities that a model really delivers: at its step, if that is known. */
export function reboundOf({atStep, delivered}: Pick<ModelTranslation, 'atStep' | 'delivered'>): number {
  return atStep?.mean ?? delivered?.velocityRatio ?? NaN;
}

/** A difference with its sign; empty where there is nothing to tell apart. */
export function differenceOf(value: number, asked: number): string {
  const difference = Number((value - asked).toFixed(5));
  if (Number.isNaN(difference)) return '';
  return difference === 0 ? '±0' : `${difference > 0 ? '+' : '−'}${Math.abs(difference).toFixed(5).replace(/0+$/, '')}`;
}
