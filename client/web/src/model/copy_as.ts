// The same job from a shell, from Python, and by curl.

import {toJson, type JsonValue} from '@bufbuild/protobuf';

import {ScenarioSchema, type Sweep} from '../api/generated/contact/v1/scenario_pb';
import {axisValues, isGrid} from './sweep';

export type Labels = Record<string, string>;

/** A word of a shell. */
function quoted(word: string): string {
  return /^[\w=.,:/@+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

const AUTHORITIES = '/etc/ssl/certs/ca-certificates.crt';   // Of the system: those that browsers trust as well.

/** The server of a page: the port that serves pages also speaks gRPC. */
function serverOf(origin: string): {address: string; secure: boolean} {
  const {hostname, port, protocol} = new URL(origin);
  const secure = protocol === 'https:';
  return {address: `${hostname}:${port || (secure ? 443 : 80)}`, secure};
}

/** contactctl with the server of a page. */
function contactctl(origin: string): string {
  const {address, secure} = serverOf(origin);
  return `contactctl --server ${address}${secure ? ` --tls-ca ${AUTHORITIES}` : ''}`;
}

/** How a file of measurements is compared with a job. */
export interface MeasuredComparison {
  job: string;
  file: string;
  maps: string[];
  /** Given, or looked for in a range. */
  shift: number | undefined;
  within: [number, number];
  relative: number;
  absolute: number;
}

/** The same comparison by contactctl. */
export function measuredAsCli({job, file, maps, shift, within, relative, absolute}: MeasuredComparison, origin: string): string {
  const tolerance = [...(relative === 0.05 ? [] : [`--rel=${relative}`]), ...(absolute === 0 ? [] : [`--abs=${absolute}`])];
  const words = ['compare', job.replace('jobs/', ''), file, ...maps.map((map) => `--map=${map}`),
    shift === undefined ? `--fit-shift=${within.join(':')}` : `--shift=${shift}`, ...tolerance];
  return `${contactctl(origin)} ${words.map(quoted).join(' ')}`;
}

/** For contactctl; needs no file. */
export function asCli(text: string, kind: 'scenario' | 'sweep', origin: string, labels: Labels = {}): string {
  const options = Object.entries(labels).map(([key, value]) => ` --label ${quoted(`${key}=${value}`)}`).join('');
  return `${contactctl(origin)} ${kind === 'sweep' ? 'sweep run' : 'run'} -${options} <<'END'\n${text.trimEnd()}\nEND\n`;
}

/** JSON as a literal of Python. */
export function pythonLiteral(value: JsonValue, indent = ''): string {
  const deeper = `${indent}    `;
  if (value === null) return 'None';
  if (value === true) return 'True';
  if (value === false) return 'False';
  if (Array.isArray(value)) return `[${value.map((entry) => pythonLiteral(entry, indent)).join(', ')}]`;
  if (typeof value !== 'object') return JSON.stringify(value);
  const rows = Object.entries(value).map(([k, v]) => [JSON.stringify(k), v!] as const);
  if (indent) return `{${rows.map(([k, v]) => `${k}: ${pythonLiteral(v, deeper)}`).join(', ')}}`;
  return `{\n${rows.map(([k, v]) => `    ${k}: ${pythonLiteral(v, deeper)},`).join('\n')}\n}`;
}

/** The client of the server of a page. */
function pythonClient(origin: string): string {
  const {address, secure} = serverOf(origin);
  return `contactsim.Client("${address}"${secure ? `, tls_ca="${AUTHORITIES}"` : ''})`;
}

/** The argument with labels, if there are any. */
function labelsArgument(labels: Labels): string {
  return Object.keys(labels).length > 0 ? `, labels=${pythonLiteral(labels, ' ')}` : '';
}

/** For the package contactsim. */
export function asPython(json: JsonValue, origin: string, labels: Labels = {}): string {
  return `import contactsim\n\nresult = ${pythonClient(origin)}.run(${pythonLiteral(json)}${labelsArgument(labels)})\n`
    + 'print(result.cycles)\n';
}

/** For the package contactsim; undefined for sweeps that it cannot make: it makes grids of single fields. */
export function sweepAsPython(sweep: Sweep, origin: string, labels: Labels = {}): string | undefined {
  const {base, axes, metrics} = sweep;
  if (!base || !isGrid(sweep) || axes.some((axis) => axis.also.length > 0 || axisValues(axis).length === 0)) return undefined;
  const scenario = toJson(ScenarioSchema, base, {useProtoFieldName: true});
  const grid = Object.fromEntries(axes.map((axis) => [axis.field, axisValues(axis)]));
  return `import contactsim\n\nscenario = ${pythonLiteral(scenario)}\ngrid = ${pythonLiteral(grid)}\n`
    + `result = ${pythonClient(origin)}.sweep(scenario, grid${metrics.length ? `, metrics=${pythonLiteral(metrics)}` : ''}${labelsArgument(labels)})\n`
    + 'print(result.frame)\n';
}

/** For curl. */
export function asCurl(json: JsonValue, kind: 'scenario' | 'sweep', origin: string, labels: Labels = {}): string {
  const labelled = Object.keys(labels).length > 0 ? {labels} : {};
  return `curl -H 'content-type: application/json' -d @- ${origin}/contact.v1.JobService/CreateJob <<'END'\n`
    + `${JSON.stringify({job: {[kind]: json, ...labelled}}, null, 1)}\nEND\n`;
}
