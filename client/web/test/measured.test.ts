import {describe, expect, it} from 'vitest';

import type {Series} from '../src/api/series';
import {measuredAsCli} from '../src/model/copy_as';
import {fitShift, overlapping, rowOf} from '../src/model/measured/comparison';
import {guessed, mapsOf, signalsOf, type Known, type Signal} from '../src/model/measured/signals';
import {columnOf, Table} from '../src/model/measured/table';
import {inSi, unitFactor} from '../src/model/measured/units';
import {byTime, MOST_POINTS, withMeasured} from '../src/model/overlay';
import type {Panel} from '../src/model/panel';
import {xRange, yRange} from '../src/plots/range';

const bytes = (text: string) => new TextEncoder().encode(text);
const table = (text: string) => new Table(bytes(text));
const mistakeIn = (text: string, column = 1) => { try { table(text).numbers(column); return ''; } catch (error) { return (error as Error).message; } };
const wide = (text: string, little: boolean) => Uint8Array.from([little ? [0xff, 0xfe] : [0xfe, 0xff], ...[...text].map((c) => (little ? [c.charCodeAt(0), 0] : [0, c.charCodeAt(0)]))].flat());

// The same table as loggers write it; tests/cli/input/measured_test.cpp has the same ones.
const ROWS = '0,0\n1.5,2.25\n3,-4.5\n4.5,1\n';
const COMMAS = `time [ms],force [kN]\n${ROWS}`;
const SEMICOLONS = COMMAS.replaceAll(',', ';').replaceAll('.', ',');
const DIALECTS: Record<string, string | Uint8Array> = {
  commas: COMMAS,
  semicolons: SEMICOLONS,
  tabs: SEMICOLONS.replaceAll(';', '\t'),
  spaces: COMMAS.replaceAll(',', '   ').replaceAll('\n', '\n  '),
  'spaces and decimal commas': SEMICOLONS.replaceAll(';', '  '),
  'row of units': `time,force\nms,kN\n${ROWS}`,
  'row of units in brackets': `time,force\n[ms],[kN]\n${ROWS}`,
  preamble: `Logger 7\nRate,2000\nDate,24.12.25\n\n${COMMAS}`,
  'numbers before': `Channels;2\nRate;2000\n${SEMICOLONS}`,
  comments: `# run 7\n# second line, of it\n${COMMAS}`,
  'header in a comment': `# ${COMMAS}`,
  'byte order mark': `\uFEFF${COMMAS}`,
  'UTF-16, little': wide(COMMAS, true),
  'UTF-16, big': wide(COMMAS, false),
  'Latin-1': Uint8Array.from(`Gr\xF6\xDFe,1\n${COMMAS}`, (c) => c.charCodeAt(0)),
  Windows: COMMAS.replaceAll('\n', '\r\n'),
  quotes: `"time [ms]","force [kN]"\n${ROWS}`,
  'separators at the end': COMMAS.replaceAll('\n', ',\n').replaceAll(',', ';'),
};

describe('a table of measurements', () => {
  it('is the same in each dialect', () => {
    for (const [name, text] of Object.entries(DIALECTS)) {
      const read = new Table(typeof text === 'string' ? bytes(text) : text);
      expect(read.columns.map((column) => [column.name, column.unit]), name).toEqual([['time', 'ms'], ['force', 'kN']]);
      expect([[...read.numbers(0)], [...read.numbers(1)]], name).toEqual([[0, 1.5, 3, 4.5], [0, 2.25, -4.5, 1]]);
    }
  });
  it('has names and units in its headers', () => {
    expect(['B1.velocity (mm/s)', 'force_N', '[kN]', ' F [k[N] '].map(columnOf).map(({name, unit}) => [name, unit]))
      .toEqual([['B1.velocity', 'mm/s'], ['force_N', ''], ['[kN]', ''], ['F [k', 'N']]);
    expect(table('0 1\n2 3\n').columns.map(({header}) => header)).toEqual(['', '']);
  });
  it('tells its mistakes by line, and has NaN for gaps', () => {
    expect(mistakeIn('t,F\n0,1\n1,x\n2,\n3,nan\n4,5\n5,6,7\n6,"1,5"\n8,9\n')).toBe(
      "line 3: expected a number, got 'x'; line 7 has 3 fields; others have 2; line 8: expected a number, got '1,5'");
    expect(mistakeIn('t;F\n0,1;1\n1;2.5\n2;3\n3;4\n', 0)).toBe("line 2: expected a number, got '0,1'");
    expect(mistakeIn('t,F\n0,0,1,5\n0,5,2,5\n1,0,3,5\n')).toBe('line 2 has 4 fields; the header has 2');
    expect([...table('t,F\n0,1\n1,\n2,.nan\n3,4\n').numbers(1)]).toEqual([1, NaN, NaN, 4]);
    for (const text of ['', 't,F\n', 't\n1\n2\n', 'only words\nand more\n']) expect(mistakeIn(text)).toMatch(/no rows of numbers/);
  });
});

describe('units of measurements', () => {
  it('are those of a quantity, with prefixes and without', () => {
    const factors: [string, string, number | undefined][] = [['ms', 's', 1e-3], ['µm', 'm', 1e-6], ['kN', 'N', 1e3], ['km/h', 'm/s', 1e3 / 3600], ['mm/s²', 'm/s^2', 1e-3],
      ['g', 'm/s^2', 9.80665], ['mN', 'N', 1e-3], ['N', 's', undefined], ['kPa', 'N', undefined], ['constructor', 's', undefined], ['J', 'J', 1]];
    for (const [unit, si, factor] of factors) expect(unitFactor(unit, si), unit).toBe(factor);
    expect(inSi(1.5, 1e-3)).toBe(0.0015);
  });
});

const CHANNELS: Known[] = [['B1.velocity', 'velocity', 'm/s'], ['B2.velocity', 'velocity', 'm/s'], ['C.contact_force', 'contact_force', 'N']]
  .map(([name, quantity, unit]) => ({name: name!, quantity: quantity!, unit: unit!}));

describe('the columns of a file', () => {
  const read = (header: string) => { const {columns} = table(`${header}\n${'0,1,2\n1,2,3\n'}`); return {columns, meanings: guessed(columns, CHANNELS)}; };
  it('are guessed by their headers', () => {
    const meant = (header: string) => read(header).meanings.map(({channel, unit}) => `${channel} ${unit}`.trim());
    expect(meant('time [ms],B1.velocity [mm/s],C.force')).toEqual(['time ms', 'B1.velocity mm/s', 'C.contact_force']);
    expect(meant('Zeit,b1 velocity,F [kN]')).toEqual(['time', 'B1.velocity', 'C.contact_force kN']);
    expect(meant('time_ms,B2.velocity_mm/s,velocity')).toEqual(['time ms', 'B2.velocity mm/s', '']);   // There are two velocities.
    expect(meant('clock [s],force,F')).toEqual(['time s', 'C.contact_force', '']);                     // Each channel once.
  });
  it('are none of a file without', () => expect(guessed([], CHANNELS)).toEqual([]));
  it('are named to contactctl where it takes them for something else', () => {
    const maps = (header: string) => { const {columns, meanings} = read(header); return mapsOf(columns, meanings, CHANNELS); };
    expect(maps('t,B1.velocity [mm/s],C.contact_force')).toEqual([]);
    expect(maps('t [ms],B1.velocity,F [kN]')).toEqual(['F [kN]=C.contact_force [kN]']);
    expect(maps('clock,time_of_day,force_N')).toEqual(['clock=time [s]', 'force_N=C.contact_force [N]']);
    const {columns} = read('t,F,F');
    expect(mapsOf(columns, [{channel: 'time', unit: ''}, {channel: 'C.contact_force', unit: ''}, {channel: '', unit: ''}], CHANNELS)).toBe(undefined);
  });
  it('become signals in SI without what is no number', () => {
    const given = table('t [ms],F [kN]\n0,1\n1,\n2,3\n');
    const [signal] = signalsOf(given, guessed(given.columns, CHANNELS), CHANNELS);
    expect([signal!.channel, [...signal!.times], [...signal!.values]]).toEqual(['C.contact_force', [0, 0.002], [1000, 3000]]);
    expect(() => signalsOf(given, [{channel: 'time', unit: 'mm'}, {channel: 'C.contact_force', unit: ''}], CHANNELS)).toThrow("column t [ms]: 'mm' is no unit of a quantity in s");
  });
});

// A pulse of 100 N at 0.5 s, sampled every millisecond; tests/cli/text/signal_comparison_test.cpp has the same one.
const pulse = (time: number) => 100 * Math.exp(-(((time - 0.5) / 0.05) ** 2));
const clock = Float64Array.from({length: 1001}, (_, i) => i * 1e-3);
const run: Series = new Map([['time', clock], ['C.contact_force', clock.map(pulse)]].map(([name, values]) => [name, {name, quantity: '', unit: '', values}])) as unknown as Series;
const signal = (times: number[], values: number[]): Signal => ({channel: 'C.contact_force', unit: 'N', times: Float64Array.from(times), values: Float64Array.from(values)});
/** The pulse as a recorder has it whose clock is behind by `lag`, with an error that alternates. */
function measured(lag = 0, error = 0): Signal {
  const times = Array.from({length: 400}, (_, i) => 0.3 + i * 1.01e-3);
  return signal(times.map((time) => time - lag), times.map((time, i) => pulse(time) + (i % 2 === 0 ? error : -error)));
}
const FIVE = {absolute: 0, relative: 0.05};

describe('measurements beside a run', () => {
  it('deviate by the errors that were made', () => {
    const row = rowOf(measured(0, 2), run, 0, FIVE);
    expect([row.points, row.outside, row.simulatedPeak, row.holds]).toEqual([400, 0, 100, true]);
    expect(Math.abs(row.rms - 2)).toBeLessThan(0.01);
    expect(Math.abs(row.measuredPeak - 102)).toBeLessThan(0.1);
    expect(row.allowed).toBeCloseTo(5.1, 2);
  });
  it('are compared with what lies between two samples', () => {
    expect(rowOf(signal([0.5005], [0]), run, 0, FIVE).largest).toBeCloseTo(-(pulse(0.5) + pulse(0.501)) / 2, 9);
  });
  it('may deviate by the larger tolerance', () => {
    expect([[1, 0.01], [3, 0.01], [1, 0.03]].map(([absolute, relative]) => rowOf(measured(0, 2), run, 0, {absolute: absolute!, relative: relative!}).holds)).toEqual([false, true, true]);
  });
  it('count only within the run', () => {
    const row = rowOf(signal([-1, 0.5, 2], [1e9, 100, 1e9]), run, 0, FIVE);
    expect([row.points, row.outside, row.holds]).toEqual([1, 2, true]);
    expect([rowOf(measured(), run, 10, FIVE).rms, rowOf(measured(), run, 10, FIVE).holds]).toEqual([NaN, false]);
  });
  it('tell the lag of their clock', () => {
    for (const lag of [-0.0123, 0, 0.04]) {
      expect(Math.abs(fitShift([measured(lag, 1)], run, [-0.1, 0.1])! - lag), `${lag}`).toBeLessThan(1e-4);
      expect(Math.abs(fitShift([measured(lag)], run, overlapping([measured(lag)], run))! - lag), `${lag}`).toBeLessThan(1e-6);
    }
    expect(fitShift([measured(0.04)], run, [-0.01, 0.01])).toBeCloseTo(0.01, 9);
    expect(fitShift([measured()], run, [5, 6])).toBe(undefined);
  });
  it('are compared by contactctl with the same words', () => {
    expect(measuredAsCli({job: 'jobs/x', file: 'my data.csv', maps: ['F=C.contact_force [kN]'], shift: undefined, within: [-0.1, 0.2], relative: 0.05, absolute: 2}, 'http://h:8080'))
      .toBe("contactctl --server h:8080 compare x 'my data.csv' '--map=F=C.contact_force [kN]' --fit-shift=-0.1:0.2 --abs=2");
  });
});

describe('measured points in a plot', () => {
  const panel: Panel = {id: 'p', title: '', xLabel: '', yLabel: '', overTime: true, note: 'n', curves: [
    {label: 'C', colour: 3, mark: 'line', x: clock, y: clock.map(pulse), channel: 'C.contact_force', offset: 1}, {label: 'other', colour: 0, mark: 'line', x: clock, y: clock}]};
  const over = (times: number[], window?: [number, number]) => withMeasured(panel, new Map([['C.contact_force', byTime(Float64Array.from(times), Float64Array.from(times, (t) => 10 * t), 0.5)]]), window);
  it('lie over their curve, by time, with the offset of the curve', () => {
    const points = over([3, 1, 2]).curves.at(-1)!;
    expect([points.label, points.colour, points.mark, [...points.x as Float64Array], [...points.y as Float64Array]]).toEqual(['C measured', 3, 'points', [1.5, 2.5, 3.5], [11, 21, 31]]);
    expect([over([1]).note, withMeasured(panel, undefined, undefined), withMeasured(panel, new Map(), undefined)]).toEqual(['n; dots: measured', panel, panel]);
  });
  it('widen no axis of time, but that of values', () => {
    expect([xRange(over([9]), undefined), yRange(over([0.1]), [0, 1])[1] > 100]).toEqual([[0, 1], true]);
    expect(yRange(over([0.4, 99]), [0, 10])[1]).toBeGreaterThan(900);
  });
  it('are few, of what is shown', () => {
    const many = Array.from({length: 10 * MOST_POINTS}, (_, i) => i);
    expect([over(many).curves.at(-1)!.x.length, over(many).note]).toEqual([MOST_POINTS, 'n; dots: measured, every 10th']);
    expect(over(many, [100.4, 110.6]).curves.at(-1)!.x.length).toBe(11);
  });
});
