// contactsim and the dashboard show the same of rare samples: tests/python/coarse_test.py has the same runs.
import {create} from '@bufbuild/protobuf';
import {describe, expect, it} from 'vitest';

import shown from '../../../tests/reference/coarse.json';
import {Cycle_End, Cycle_Status, CycleSchema} from '../src/api/generated/contact/v1/job_pb';
import {ScenarioSchema} from '../src/api/generated/contact/v1/scenario_pb';
import type {Series} from '../src/api/series';
import {rarePoints, spreadOf} from '../src/model/coarse';
import type {RunView} from '../src/model/curves';
import {mechanicsOf} from '../src/model/mechanics';
import type {Panel} from '../src/model/panel';
import {PRESETS} from '../src/model/presets';
import {yRange} from '../src/plots/range';

interface Run {
  period: number;
  samples: number;
  length?: number;
  cut?: boolean;
}

const SCENARIO = create(ScenarioSchema, {
  bodies: [{name: 'ball', massKg: 1, radiusM: 0.5}], contacts: [{name: 'floor', between: ['ball'], stiffness: 1e6, restitution: 1, wall: {positionM: 0}}],
  endTimeS: 1, output: {sampleIntervalS: 1e-5, samplesPerContact: 0},
});

const CYCLE = {contact: 'floor', deltaStartM: 0, deltaEndM: 0, approachVelocityMPerS: 0, separationVelocityMPerS: 0, mu: 0};

/** A ball that bounces for a second: the force is half a sine whose peaks grow by 1 N from cycle to cycle. */
function bouncing({period, samples, length = 0.1, cut = false}: Run): RunView {
  const cycles = Array.from({length: Math.round(1 / period) - 1}, (_, i) => create(CycleSchema, {
    ...CYCLE, number: i + 1, startTimeS: (i + 0.5) * period, endTimeS: (i + 0.5 + length) * period, end: Cycle_End.SEPARATION,
    status: Cycle_Status.CONVERGED, deltaMaxM: 1e-3 * (i + 1), peakForceN: i + 1, turnTimeS: (i + 0.5 + length / 2) * period,
  }));
  const time = Float64Array.from({length: samples}, (_, i) => i / (samples - 1));
  const force = time.map((t) => {
    const {number = 0, startTimeS = 0, endTimeS = 1} = cycles.find((c) => t >= c.startTimeS && t <= c.endTimeS) ?? {};
    return number * Math.sin(Math.PI * (t - startTimeS) / (endTimeS - startTimeS));
  });
  if (cut) {
    cycles.push(create(CycleSchema, {...CYCLE, number: 99, startTimeS: 0.99, endTimeS: 1, end: Cycle_End.RUN_END, status: Cycle_Status.CUT, peakForceN: NaN}));
  }
  const column = (name: string, values: Float64Array) => [name, {name, quantity: '', unit: '', values}] as const;
  const quantities = ['contact_force', 'external_force', 'deformation', 'deformation_velocity'].map((name) => column(`floor.${name}`, force));
  const series: Series = new Map([column('time', time), column('ball.velocity', time), ...quantities]);
  return {mechanics: mechanicsOf(SCENARIO), cycles, groups: [], bands: [], series};
}

const panelOf = (id: string, view: RunView): Panel => PRESETS.find((preset) => preset.id === id)!.panel(view);
const ends = ({start, end}: {start: number; end: number}) => [start, end];
const near = (rows: number[][]) => rows.map((row) => row.map((value) => expect.closeTo(value, 10) as number));

describe('rare samples', () => {
  for (const {run, stamp, ranges, loose, cut} of shown.cases) {
    it(`show what contactsim shows of ${JSON.stringify(run)}`, () => {
      const panel = panelOf('force', bouncing(run));
      expect(panel.stamp).toBe(stamp);
      expect(panel.ranges!.map(({start, end, low, high}) => [start, end, low, high])).toEqual(near(ranges));
      expect(panel.curves[0]!.loose!.map(ends)).toEqual(near(loose));
      expect(panel.cut!.map(ends)).toEqual(near(cut));
      expect(panel.labels!.length > 0).toBe(!stamp);   // Peaks that are not seen are not labelled.
    });
  }
  const rare = bouncing({period: 0.01, samples: 300});
  it('are points that no line joins and no mark hides, or ranges where they swing', () => {
    for (const [id, drifts] of [['velocity', true], ['force', false], ['deformation', false], ['deformation-velocity', false]] as const) {
      const panel = panelOf(id, rare);
      expect(rarePoints(panel.curves[0]!).length > 280, id).toBe(drifts);
      expect(rarePoints(panel.curves[0]!).length > 0, id).toBe(drifts);
      expect(Math.max(...panel.curves.filter(({mark}) => mark === 'start' || mark === 'end').map(({x}) => x.length))).toBeLessThan(4);
      expect(panel.note!.includes('dots: samples too rare to be joined'), id).toBe(drifts);
      expect(spreadOf(panel).length, id).toBe(id === 'deformation-velocity' ? 1 : 0);   // The ledger tells the others.
    }
    expect(panelOf('hysteresis', rare).curves[0]!.mark).toBe('rare');
  });
  it('of a swing are a range and no slow swing', () => {
    const view = bouncing({period: 0.01, samples: 300});
    const time = view.series.get('time')!.values;
    view.series.get('ball.velocity')!.values = time.map((t) => 2 + 3 * Math.sin(2 * Math.PI * 301 * t));   // Sampled: once a second.
    const panel = panelOf('velocity', view);
    expect(rarePoints(panel.curves[0]!)).toEqual([]);
    expect(spreadOf(panel).map(({low, high}) => [low, high])).toEqual([[expect.closeTo(-1, 2), expect.closeTo(5, 2)]]);
    expect(panel.note).toContain('pale: range of samples too rare to show the motion');
  });
  it('are looked for once in a curve, which is drawn again and again', () => {
    let reads = 0;
    const y = new Proxy([0, 3, 1, 4, 2, 5], {get: (all, place) => { ++reads; return Reflect.get(all, place) as unknown; }});
    const panel = {id: 'p', title: '', xLabel: '', yLabel: '', overTime: true, curves: [{label: 'c', colour: 0, mark: 'line' as const, x: [0, 1, 2, 3, 4, 5], y, loose: [{start: 0, end: 9}]}]};
    const first = [spreadOf(panel), rarePoints(panel.curves[0]!)];
    expect([first[0]!.length, reads > 5]).toEqual([1, true]);
    reads = 0;
    expect([spreadOf(panel), rarePoints(panel.curves[0]!), reads]).toEqual([...first, 0]);
  });
  it('leave room for the peaks of the ledger', () => {
    expect(yRange(panelOf('force', bouncing({period: 0.1, samples: 60})), [0, 1])[1]).toBeGreaterThan(9);
  });
  it('are those that are recorded, not the fewer ones that the server hands out', () => {
    const thinned = bouncing({period: 0.1, samples: 600});
    Object.assign(thinned.series, {thinned: true, recorded: 60_000});
    expect(panelOf('force', thinned).stamp).toBe('');
    Object.assign(thinned.series, {recorded: 800});
    expect(panelOf('force', thinned).stamp).toBe('9 of 9 contacts have fewer than 10 samples');
    thinned.mechanics.scenario.output = create(ScenarioSchema, {output: {samplesPerContact: 20}}).output;
    expect(panelOf('force', thinned).stamp).toBe('');
  });
  it('are not in the first contacts of a run, which have some of their own though nobody asked', () => {
    const many = bouncing({period: 0.01, samples: 600});
    Object.assign(many.series, {thinned: true, recorded: 2000});
    many.mechanics.scenario.output = undefined;
    expect(panelOf('force', many).stamp).toBe(`${99 - Math.floor(1001 / 40)} of 99 contacts have fewer than 10 samples`);
  });
});
