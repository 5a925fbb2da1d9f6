import {create} from '@bufbuild/protobuf';
import {describe, expect, it} from 'vitest';

import {CycleSchema, Job_Convergence, Job_State, JobSchema, type Cycle, type Job} from '../src/api/generated/contact/v1/job_pb';
import {EventSchema, SweepCellSchema, type Event} from '../src/api/generated/contact/v1/event_pb';
import {WatchJobsResponseSchema} from '../src/api/generated/contact/v1/job_service_pb';
import {Contact_Damping, ScenarioSchema, SweepSchema, Wall_Side} from '../src/api/generated/contact/v1/scenario_pb';
import {doubles, type Series} from '../src/api/series';
import {cellAt, levelOf, mapShapes, nearestLine} from '../src/model/cell_shapes';
import {compareResults, differingParameters, holds, runNames} from '../src/model/comparison';
import {asCli, asCurl, asPython, sweepAsPython} from '../src/model/copy_as';
import {MOST_MARKED, unmarked} from '../src/model/curves';
import {flatten, setField} from '../src/model/field_path';
import {bracketOf, iterationPanels, newestEpisode, nextOf, passesOf} from '../src/model/iterations';
import {bestOf, chosenOf, grouped, groupOf, JobList, labelKeys, labelsOf, METRICS, matches, statesOf} from '../src/model/job_list';
import {fieldsOf, varyingFields} from '../src/model/job_fields';
import {endForce, mechanicsOf} from '../src/model/mechanics';
import {insideOf, interpolate, joined, panelCsv, travel} from '../src/model/panel';
import {PRESETS, presetsShown} from '../src/model/presets';
import {parseMetrics} from '../src/model/prometheus';
import {titleOf} from '../src/model/remarks';
import {emptyRun, MOST_ITERATIONS, takeEvents} from '../src/model/runState';
import {axisValues, cellIndex, viridis} from '../src/model/sweep';
import {yRange} from '../src/plots/range';
import {localField, utcOfField} from '../src/ui/times';
import {leafOf} from '../src/views/run/leaves';

const series = (columns: Record<string, number[]>): Series => new Map(Object.entries(columns).map(([name, values]) =>
  [name, {name, quantity: '', unit: '', values: Float64Array.from(values)}]));
const scenario = create(ScenarioSchema, {
  bodies: [{name: 'A', massKg: 2, radiusM: 0.1}, {name: 'B', densityKgPerM3: 1000, radiusM: 0.1, positionM: 0.3}],
  contacts: [{between: ['A', 'B'], stiffness: 1e6, restitution: 0.8}, {between: ['B'], wall: {positionM: 1, side: Wall_Side.RIGHT}, stiffness: 1e6, exponent: 1, damping: Contact_Damping.KELVIN_VOIGT}],
  loads: [{kind: {case: 'gravity', value: {accelerationMPerS2: -10}}, body: 'A'}],
});
const event = (payload: Event['payload'], sequence = 0n) => create(EventSchema, {sequence, payload});

describe('mechanics', () => {
  const mechanics = mechanicsOf(scenario);
  it('follow from a scenario as the server resolves it', () => {
    expect(mechanics.contacts.map(({name, left, right}) => [name, left, right])).toEqual([['A-B', 0, 1], ['B-wall', 1, -1]]);
  });
  it('expand a chain of neighbours', () => {
    const chain = create(ScenarioSchema, {bodies: ['a', 'b', 'c'].map((name) => ({name})), contacts: [{name: 'row', between: ['a', 'b', 'c']}]});
    expect(mechanicsOf(chain).contacts.map(({name}) => name)).toEqual(['row-1', 'row-2']);
  });
  it('put bodies beside others, and make two contacts of a play', () => {
    const slot = create(ScenarioSchema, {
      bodies: [{name: 'a', massKg: 1, radiusM: 0.1, positionM: 1}, {name: 'b', massKg: 2, radiusM: 0.2, nextTo: 'a', gapM: 0.01}, {name: 'c', motion: {kind: {case: 'uniform', value: {velocityMPerS: 1}}}}],
      contacts: [{between: ['a', 'c'], clearanceM: 0.5, stiffness: 1}, {name: 'stop', between: ['b'], wall: {positionM: 1.3, motion: {}}, clearanceM: 0.3, stiffness: 1}],
    });
    const {bodies, contacts} = mechanicsOf(slot);
    expect([bodies[1]!.position, bodies[2]!.fixed]).toEqual([1.31, true]);
    expect(contacts.map(({name, left, right}) => [name, left, right])).toEqual(
      [['a-c-left', 2, 0], ['a-c-right', 0, 2], ['stop-left', -1, 1], ['stop-right', 1, -1]]);
    expect(contacts[3]).toMatchObject({wallBody: 'stop', wallOrigin: 1.3});
    expect(contacts[3]!.wallPosition).toBeCloseTo(1.8, 12);  // Where the edge of b, 0.2 m from its centre, meets it.
  });
  it('take the straight line to the last point of a table', () => {
    const forceTable = {deformationsM: [1e-3, 2e-3], forcesN: [5, 40]};
    const cushion = create(ScenarioSchema, {bodies: ['a', 'b'].map((name) => ({name})), contacts: [{between: ['a', 'b'], damping: Contact_Damping.FORCE_TABLE, forceTable}]});
    expect(mechanicsOf(cushion).contacts[0]).toMatchObject({stiffness: 2e4, exponent: 1});
  });
  it('give the force at the ends of a cycle', () => {
    expect(endForce(mechanics, mechanics.contacts[0]!, 5, 0.01, 1)).toBeCloseTo(1e6 * 0.01 ** 1.5);
    expect(endForce(mechanics, mechanics.contacts[1]!, 5, 0, 2)).toBe(10);
  });
});

describe('panels', () => {
  it('read between samples, and have no values of their own outside', () => {
    expect([interpolate([0, 1], [0, 10], 0.25), interpolate([0, 1], [0, 10], 5), interpolate([], [], 1)]).toEqual([2.5, 10, NaN]);
  });
  it('know how far a curve swings, past what is no number', () => {
    expect([travel([0, 2, -1, 5], 0, 2), travel([9, null, 9, NaN, 4, 6], 0, 5), travel([], 0, -1)]).toEqual([5, 7, 0]);
  });
  it('take their y axis from what lies in the window, and one sample more on each side', () => {
    const x = Float64Array.from([0, 1, 2, 3, 4, 5]);
    const y = Float64Array.from([90, 0, 1, 2, -80, -90]);
    const panel = {id: 'p', title: '', xLabel: '', yLabel: '', overTime: true, curves: [{label: 'c', colour: 0, mark: 'line' as const, x, y}]};
    const [low, high] = yRange(panel, [1.5, 2.5]);
    expect([low < 0, low > -1, high > 2, high < 3]).toEqual([true, true, true, true]);
    expect(yRange({...panel, curves: [{...panel.curves[0]!, x: [...x], y: [...y]}]}, [1.5, 2.5])).toEqual([low, high]);
  });
  it('join bands that overlap', () => {
    expect(joined([{start: 2, end: 3}, {start: 0, end: 1}, {start: 1, end: 1.5}])).toEqual([{start: 0, end: 1.5}, {start: 2, end: 3}]);
  });
  it('serve for another window only where they go on beyond its ends', () => {
    const times = [0, 1, 2, 3, 4];
    expect([[0.5, 3.5], [1, 3], [0.5, 4.5], [-1, 2], [5, 6]].map((window) => insideOf(times, window as [number, number]))).toEqual([3, 2, 0, 0, 0]);
  });
  it('mark cycles at their exact ends, whatever the samples', () => {
    const cycle = create(CycleSchema, {contact: 'A-B', number: 1, startTimeS: 0.123456789, endTimeS: 0.5, approachVelocityMPerS: 3});
    const view = {mechanics: mechanicsOf(scenario), cycles: [cycle] as Cycle[], groups: [], bands: [], series: series({time: [0, 1], 'A-B.contact_force': [0, 0]})};
    const force = PRESETS.find(({id}) => id === 'force')!.panel(view);
    expect(force.curves.find(({mark}) => mark === 'start')!.x).toEqual([0.123456789]);
    expect(panelCsv(force).split('\n')[0]).toBe('curve,time [s],force [N]');
  });
  it('tell how many cycles of a contact have no marks', () => {
    const cycles = (n: number, contact: string) => Array.from({length: n}, () => create(CycleSchema, {contact}));
    expect(unmarked([...cycles(MOST_MARKED, 'a'), ...cycles(MOST_MARKED, 'b')])).toBe('');
    expect(unmarked(cycles(MOST_MARKED + 600, 'a'))).toBe('; 400 of 1\u202f000 cycles of a contact shown, zoom in for others');
  });
  it('balance the energies that were recorded, and say where none were', () => {
    const energy = (columns: Record<string, number[]>) => PRESETS.find(({id}) => id === 'energy')!.panel(
      {mechanics: mechanicsOf(scenario), cycles: [], groups: [], bands: [], series: series(columns)});
    const parts = {kinetic_energy: [1, 2], contact_energy: [4, 8], support_energy: [0, 0], dissipated_energy: [0, 16], load_work: [0, 21]};
    const recorded = energy({time: [0, 1], ...Object.fromEntries(Object.entries(parts).map(([name, list]) => [`system.${name}`, list]))});
    expect(recorded.curves.map(({label, y}) => [label, ...Array.from(y)])).toEqual(
      [['kinetic', 1, 2], ['contacts', 4, 8], ['dissipated', 0, 16], ['load work', 0, 21], ['sum less load work', 5, 5]]);
    expect([energy({time: [0, 1]}).curves, energy({time: [0, 1]}).nothing?.split(':')[0]]).toEqual([[], 'This run recorded no energies']);
    expect(energy({}).nothing).toBe(undefined);   // It is still asked for.
  });
  it('name each channel once and know it', () => {
    const mechanics = mechanicsOf(scenario);
    for (const {channels} of PRESETS) {
      const names = channels(mechanics);
      expect(new Set(names).size).toBe(names.length);
      expect(names.every((name) => /^(A|B|A-B|B-wall|system)\.\w+$/.test(name))).toBe(true);
    }
  });
  it('show the passes of one episode', () => {
    const pass = (episode: number, number: number, residual: number) => ({episode, number, unknowns: [{contact: 'A-B', number: 1, mu: 1, residual}]});
    const run = emptyRun();
    takeEvents(run, [pass(1, 0, 0.1), pass(1, 1, -1e-5), pass(2, 0, 1)].map((value) => event({case: 'iteration', value} as Event['payload'])));
    const [, residual] = iterationPanels(run.iterations, 1);
    expect([residual!.curves[0]!.y, residual!.xLabel, residual!.logY]).toEqual([[0.1, 1e-5], 'pass of episode 1', true]);
  });
});

describe('a run', () => {
  const pass = (number: number, episode = 1) => ({case: 'iteration', value: {episode, number, accepted: number === 1, unknowns: [
    {contact: 'A-B', number: 1, mu: 5, bracketLow: 2, bracketHigh: 0, update: number === 1 ? 0 : 1}]}}) as unknown as Event['payload'];
  it('tells of each pass what contactctl tells', () => {
    const run = emptyRun();
    takeEvents(run, [pass(0), pass(1), pass(0, 2)].map((payload) => event(payload)));
    expect(passesOf(run.iterations, 1).map((row) => [row.number, nextOf(row), bracketOf(row)])).toEqual([[0, 'NEWTON', '[2, –]'], [1, 'accepted', '[2, –]']]);
  });
  it('is followed by episodes that have come to an end', () => {
    const run = emptyRun();
    takeEvents(run, [pass(0)].map((payload) => event(payload)));
    expect([newestEpisode([]), newestEpisode(run.iterations)]).toEqual([undefined, 1]);
    takeEvents(run, [pass(1), pass(0, 2)].map((payload) => event(payload)));
    expect(newestEpisode(run.iterations)).toBe(1);
  });
  it('keeps the newest passes and knows what it dropped', () => {
    const run = emptyRun();
    takeEvents(run, Array.from({length: MOST_ITERATIONS}, (_, i) => event(pass(i % 2, 1 + (i >> 1)))));
    expect([run.dropped, run.droppedTo]).toEqual([0, 0]);
    takeEvents(run, [0, 1, 2].map((i) => event(pass(i, MOST_ITERATIONS))));
    expect([run.iterations.length, run.dropped, run.droppedTo, run.iterations[0]!.episode]).toEqual([MOST_ITERATIONS, 3, 2, 2]);
  });
  it('has tables whose pages end where the rows do', () => {
    const rows = Array.from({length: 201}, (_, i) => i);
    expect([null, '3', '9', '-1', 'x'].map((page) => leafOf(rows, page)).map(({first, shown}) => [first, shown.length]))
      .toEqual([[0, 100], [200, 1], [200, 1], [0, 100], [0, 100]]);
    expect(leafOf([], '2').first).toBe(0);
  });
  it('begins anew with an attempt, but keeps cells', () => {
    const run = emptyRun();
    takeEvents(run, [event({case: 'cycle', value: create(CycleSchema)}), event({case: 'sweepCell', value: {index: 3}} as Event['payload'])]);
    takeEvents(run, [event({case: 'attemptStarted', value: {attempt: 2}} as Event['payload'])]);
    expect([run.cycles.length, run.cells.size, run.attempt]).toEqual([0, 1, 2]);
  });
  it('takes doubles from any place in a message', () => {
    const bytes = new Uint8Array(17);
    new DataView(bytes.buffer).setFloat64(1, 0.1, true);
    expect([...doubles(bytes.subarray(1, 9))]).toEqual([0.1]);
  });
});

describe('the list of jobs', () => {
  const job = (name: string, seconds: bigint) => create(JobSchema, {name, title: `T ${name}`, labels: {a: 'b'}, createTime: {seconds}, state: Job_State.QUEUED});
  it('is newest first, and drops what a new snapshot no longer has', () => {
    const list = new JobList();
    const take = (change: object) => list.take(create(WatchJobsResponseSchema, change));
    list.begin();
    take({jobs: [job('x', 1n), job('y', 2n)], snapshotComplete: true});
    expect(list.sorted().map(({name}) => name)).toEqual(['y', 'x']);
    list.begin();
    take({jobs: [job('x', 1n)]});
    expect(list.sorted().length).toBe(2);
    take({snapshotComplete: true});
    expect(list.sorted().map(({name}) => name)).toEqual(['x']);
    take({gone: ['x'], snapshotComplete: true});
    expect(list.sorted()).toEqual([]);
  });
  it('chooses plots in the order of the address', () => {
    const mechanics = mechanicsOf(create(ScenarioSchema, {bodies: [{name: 'a'}, {name: 'b'}], contacts: [{between: ['a', 'b']}]}));
    const ids = (chosen: string) => presetsShown(mechanics, chosen, undefined).map(({id}) => id).join();
    expect([ids('energy,velocity,none'), ids('').split(',').length, ids('all').split(',').length > 8]).toEqual(['energy,velocity', 6, true]);
  });
  it('begins with what is pinned, then has groups, and calls runs by the label title', () => {
    const named = (name: string, labels: Record<string, string>) => create(JobSchema, {name, title: 'T', labels});
    const jobs = [named('a', {}), named('b', {title: 'B', pin: '1'}), named('c', {title: 'A'}), named('d', {pin: ''})];
    const order = (by: string) => grouped(jobs, by).map(({name}) => name).join('');
    expect([order(''), order('title'), groupOf(jobs[1]!, 'title'), groupOf(jobs[2]!, 'title')]).toEqual(['bdac', 'bdca', 'pinned', 'A']);
    expect([jobs.map(titleOf), labelKeys(jobs), matches(jobs[1]!, 't')]).toEqual([['T', 'B', 'A', 'T'], ['title'], true]);
  });
  it('finds words in titles and labels', () => {
    expect([matches(job('x', 1n), 't a=b'), matches(job('x', 1n), 'q')]).toEqual([true, false]);
    expect(labelsOf('a=b, c=, d')).toEqual({a: 'b'});
  });
  it('is chosen from by time and by convergence', () => {
    const jobs = [1n, 60n, 120n].map((at) => job(`j${at}`, at));
    jobs[2]!.convergence = Job_Convergence.PARTIAL;
    const names = (choice: object) => chosenOf(jobs, {words: '', state: '', after: '', before: '', ...choice}).map(({name}) => name);
    expect([names({after: '1970-01-01T00:01Z'}), names({before: '1970-01-01T00:01Z'}), names({after: 'x'}).length]).toEqual([['j60', 'j120'], ['j1'], 3]);
    expect([names({state: 'NOT_CONVERGED'}), names({words: 'j60'}), statesOf('NOT_CONVERGED')]).toEqual([['j120'], ['j60'], [Job_State.SUCCEEDED]]);
  });
  it('calls the least value best only among runs that converged', () => {
    const run = (convergence: Job_Convergence, iterations: bigint) => create(JobSchema, {convergence, summary: {iterations}});
    const best = (...jobs: Job[]) => bestOf(jobs, METRICS[0]!);
    const [missed, ...others] = [run(Job_Convergence.PARTIAL, 0n), run(Job_Convergence.FULL, 5n), run(Job_Convergence.FULL, 3n)];
    expect([best(missed!, ...others), best(missed!), best(others[0]!, others[0]!), best(create(JobSchema))]).toEqual([3, undefined, undefined, undefined]);
  });
  it('offers the fields that differ, those of most values first', () => {
    const all = [[0.8, 1], [0.8, 2], [0.7, 3]].map(([restitution, endTimeS]) => fieldsOf(create(JobSchema, {
      spec: {case: 'scenario', value: create(ScenarioSchema, {title: 'x', contacts: [{restitution}], endTimeS})}})));
    expect(varyingFields(all)).toEqual(['end_time_s', 'contacts[0].restitution']);
    expect([varyingFields(all.slice(0, 1)), varyingFields([])]).toEqual([[], []]);
  });
  it('has times in its address that a field gives back', () => {
    for (const at of ['2026-01-02T03:04Z', '2026-07-02T23:59Z']) expect(utcOfField(localField(at))).toBe(at);
    expect([localField(''), localField('x'), utcOfField('')]).toEqual(['', '', '']);
  });
});

describe('sweeps and comparisons', () => {
  it('number cells with the last axis fastest', () => {
    expect(cellIndex([5, 10], [1, 5])).toBe(15);
    const {axes} = {axes: [{values: [], linear: {low: 0, high: 1, count: 3}}, {values: [], log: {low: 1, high: 100, count: 3}}]};
    expect(axes.map((axis) => axisValues(axis as never).map((v) => Math.round(v * 10) / 10))).toEqual([[0, 0.5, 1], [1, 10, 100]]);
    expect([viridis(0), viridis(1)]).toEqual(['#440154', '#fde725']);
  });
  it('draw ten thousand cells as a path for each of few colours', () => {
    const place = {left: 0, width: 8, height: 4, columns: 100, rows: 100};
    const cells = Array.from({length: 10_000}, (_, index) => create(SweepCellSchema, {index, state: Job_State.SUCCEEDED, metrics: [index]}));
    const {fills, hatched, words} = mapShapes(place, (i, j) => cells[100 * j + i], 0, (value) => value / 9999);
    expect(fills.length).toBe(64);
    expect(fills.map(([, path]) => path.split('z').length - 1).reduce((a, b) => a + b)).toBe(10_000);
    expect([hatched, words.length]).toEqual(['', 0]);
  });
  it('tell in a map what failed, what did not converge and what has no value', () => {
    const place = {left: 10, width: 50, height: 20, columns: 4, rows: 1};
    const cells = [{state: Job_State.FAILED}, {state: Job_State.SUCCEEDED, convergence: Job_Convergence.PARTIAL, metrics: [0.5]}, {state: Job_State.SUCCEEDED, metrics: [NaN]}]
      .map((cell) => create(SweepCellSchema, cell));
    const {fills, hatched, words} = mapShapes(place, (i) => cells[i], 0, (value) => value);
    expect(fills).toEqual([[levelOf(0.5), 'M60 0h50v20h-50z']]);
    expect(hatched).toBe('M60 0h50v20h-50z');
    expect(words.map(({text, rim}) => [text, rim])).toEqual([['×', false], ['0.5', true], ['–', false]]);
  });
  it('find the cell and the line at a point', () => {
    const place = {left: 10, width: 5, height: 4, columns: 3, rows: 2};
    expect([cellAt(place, 12, 1), cellAt(place, 24, 7), cellAt(place, 9, 1), cellAt(place, 12, 8)]).toEqual([[0, 0], [2, 1], undefined, undefined]);
    expect([nearestLine([0, 10], [[0, 10], [10, 0]], 9, 2), nearestLine([0, 10], [[NaN, NaN]], 1, 1)]).toEqual([1, -1]);
  });
  it('are copied with their labels', () => {
    const labels = {study: 'chain', note: "it's $HOME"};
    expect(asCli('a: 1', 'sweep', 'http://h', labels)).toBe("contactctl --server h:80 sweep run - --label study=chain --label 'note=it'\\''s $HOME' <<'END'\na: 1\nEND\n");
    expect(asPython({a: 1}, 'http://h', labels)).toContain('}, labels={"study": "chain", "note": "it\'s $HOME"})');
    expect(JSON.parse(asCurl({a: 1}, 'scenario', 'http://h', labels).split("'END'\n")[1]!.split('\nEND')[0]!)).toEqual({job: {scenario: {a: 1}, labels}});
    expect(asCurl({}, 'sweep', 'http://h')).not.toContain('labels');
  });
  it('become Python, if contactsim can make them', () => {
    const axis = {field: 'contacts[*].restitution', linear: {low: 0.5, high: 1, count: 2}};
    const sweep = (axes: object[]) => create(SweepSchema, {base: {title: 'x'}, metrics: ['iterations'], axes});
    expect(sweepAsPython(sweep([axis]), 'http://h')).toContain('grid = {\n    "contacts[*].restitution": [0.5, 1],\n}');
    expect(sweepAsPython(sweep([{...axis, also: ['solver.step_s']}]), 'http://h')).toBeUndefined();
  });
  it('set fields by index, name and star', () => {
    const json = {contacts: [{name: 'A-B'}, {between: ['B', 'C']}]};
    setField(json, 'contacts[*].restitution', 0.5);
    setField(json, 'contacts[B-C].restitution', 0.6);
    setField(json, 'solver.step_s', 1);
    expect(json).toEqual({contacts: [{name: 'A-B', restitution: 0.5}, {between: ['B', 'C'], restitution: 0.6}], solver: {step_s: 1}});
    expect([...flatten(json).keys()]).toContain('contacts[1].between[0]');
  });
  it('judge by the larger of the tolerances', () => {
    const tolerance = {absolute: 0.1, relative: 0.01};
    expect([holds(1.05, 1, tolerance), holds(101, 100, tolerance), holds(102, 100, tolerance), holds('A', 'B', tolerance), holds(undefined, 1, tolerance)])
      .toEqual([true, true, false, false, false]);
  });
  it('show only what differs', () => {
    const jobs = [0.8, 0.6].map((restitution) => create(JobSchema, {spec: {case: 'scenario', value: create(ScenarioSchema, {title: 'x', contacts: [{restitution}]})},
      cycles: [{contact: 'A-B', number: 1, mu: restitution}]}));
    expect(differingParameters(jobs)).toEqual([{name: 'contacts[0].restitution', values: ['0.8', '0.6']}]);
    expect(compareResults(jobs, {absolute: 0, relative: 1e-6}).filter((row) => row.holds.includes(false)).map(({name}) => name)).toEqual(['A-B #1 μ']);
  });
  it('name runs by what differs, and by ids where that does not tell them apart', () => {
    const run = (name: string, restitution: number) => create(JobSchema, {name: `jobs/${name}`, spec: {case: 'scenario', value: create(ScenarioSchema, {contacts: [{restitution}]})}});
    expect(runNames([run('a', 0.8), run('b', 0.6)])).toEqual(['restitution 0.8', 'restitution 0.6']);
    expect(runNames([run('a', 0.8), run('b', 0.8)])).toEqual(['a', 'b']);
    const two = (...restitutions: number[]) => create(JobSchema, {spec: {case: 'scenario', value: create(ScenarioSchema, {contacts: restitutions.map((restitution) => ({restitution}))})}});
    expect(runNames([two(0.8, 0.7), two(0.6, 0.5)])).toEqual(['restitution 0.8, 0.7', 'restitution 0.6, 0.5']);
    expect(runNames([run('a', 0.8), run('b', 0.6), run('c', 0.6)])).toEqual(['restitution 0.8', 'restitution 0.6, b', 'restitution 0.6, c']);
  });
  it('read metrics', () => {
    const [family] = parseMetrics('# HELP a Things.\n# TYPE a counter\na{x="1"} 2\na 3e9\n');
    expect([family!.help, family!.samples.map(({value}) => value)]).toEqual(['Things.', [2, 3e9]]);
  });
});
