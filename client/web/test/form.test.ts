import {readdirSync, readFileSync} from 'node:fs';

import {create} from '@bufbuild/protobuf';
import {describe, expect, it} from 'vitest';
import {parse, parseDocument, stringify} from 'yaml';

import {ScenarioSchema, Wall_Side} from '../src/api/generated/contact/v1/scenario_pb';
import {numberOf, setAt, textOf, type Path} from '../src/model/form/edit';
import {choicesOf, fieldsOf} from '../src/model/form/fields';
import {begun, changed, endOfChange, redone, undone} from '../src/model/form/history';
import {entryOfContact, newEntry, objectsOf} from '../src/model/form/objects';
import {hitAt} from '../src/model/form/hit';
import {placeOf} from '../src/model/form/place';
import {axisAt, axisField, dropAxis, rangeOfAxis, setAxis, withBase, wrongRange} from '../src/model/form/sweep_page';
import {mechanicsOf} from '../src/model/mechanics';
import {readPage} from '../src/model/scenario_text';

const folder = new URL('../../scenarios/', import.meta.url);
const files = Object.fromEntries(readdirSync(folder).filter((name) => name.endsWith('.yaml'))
  .map((name) => [name, readFileSync(new URL(name, folder), 'utf8')]));
const chain = files['three-ball-chain.yaml']!;

/** The lines of `after` that are not in `before`. */
const newLines = (before: string, after: string) => after.split('\n').filter((line) => !before.split('\n').includes(line));
const comments = (text: string) => text.split('\n').flatMap((line) => /#.*$/.exec(line) ?? []);

/** All scalars of a page by their paths. */
function scalars(value: unknown, path: Path = []): [Path, unknown][] {
  if (Array.isArray(value)) return value.flatMap((one, i) => scalars(one, [...path, i]));
  if (value !== null && typeof value === 'object') return Object.entries(value).flatMap(([key, one]) => scalars(one, [...path, key]));
  return [[path, value]];
}

describe('a change at its place', () => {
  it('changes one value in its line and nothing else', () => {
    const made = setAt(chain, ['bodies', 1, 'mass_kg'], '0.75');
    expect(newLines(chain, made)).toEqual(['  - {name: B2, mass_kg: 0.75, radius_m: 0.05, position_m: 0.1}']);
    expect(made.length).toBe(chain.length + 1);
  });
  it('adds a field in braces, before the comment of its line', () => {
    expect(newLines(chain, setAt(chain, ['contacts', 0, 'exponent'], '1.5'))[0]).toMatch(/restitution: 0.8, exponent: 1.5} +# N\/m/);
  });
  it('adds what the field stands in, too', () => {
    expect(parse(setAt(chain, ['bodies', 0, 'material', 'poisson_ratio'], '0.3')).bodies[0].material).toEqual({poisson_ratio: 0.3});
    expect(newLines(chain, setAt(chain, ['output', 'sample_interval_s'], '1e-5'))).toEqual(['output: {sample_interval_s: 1e-5}']);
  });
  it('takes a field and an entry away with what stood between', () => {
    expect(newLines(chain, setAt(chain, ['bodies', 0, 'radius_m'], undefined))).toEqual(['  - {name: B1, mass_kg: 0.5, position_m: 0.0, velocity_m_per_s: 0.2}']);
    expect(newLines(chain, setAt(chain, ['bodies', 0, 'velocity_m_per_s'], undefined))[0]).toMatch(/position_m: 0.0}$/);
    const fewer = setAt(chain, ['contacts', 1], undefined);
    expect([newLines(chain, fewer), chain.split('\n').length - fewer.split('\n').length]).toEqual([[], 1]);
  });
  it('takes the first field of an entry away and leaves its dash', () => {
    expect(setAt('bodies:\n  - name: a # first\n    # Heavy.\n    mass_kg: 1\n', ['bodies', 0, 'name'], undefined)).toBe('bodies:\n  - # Heavy.\n    mass_kg: 1\n');
    expect(parse(setAt('bodies:\n  - name: a\n  - name: b\n', ['bodies', 0, 'name'], undefined))).toEqual({bodies: [{}, {name: 'b'}]});
  });
  it('writes into an empty page and leaves one that cannot be read', () => {
    expect(setAt('', ['end_time_s'], '1')).toBe('end_time_s: 1\n');
    expect(setAt('# mine\n', ['bodies', 0], '{name: B1}')).toBe('# mine\nbodies: [{name: B1}]\n');
    expect(setAt('bodies: [{', ['end_time_s'], '1')).toBe('bodies: [{');
  });
  it('fills a key that stands alone, and a value behind an anchor', () => {
    expect(parse(setAt('bodies:\nend_time_s: 1\n', ['bodies', 0], '{name: a}'))).toEqual({bodies: [{name: 'a'}], end_time_s: 1});
    expect(parse(setAt('a: &x 1\nb: *x # same\n', ['b'], '2'))).toEqual({a: 1, b: 2});
  });
  const inLines = (text: string) => stringify(parse(text)).replace(/^(.*\w: .+)$/gm, '$1   # why');   // As pages of runs are written.
  const pages = Object.entries(files).flatMap(([name, text]) => [[name, text], [`${name} in lines`, inLines(text)]]) as [string, string][];
  it.each(pages)('holds for each value of %s, whose comments all stay', (_, text) => {
    for (const [path] of scalars(parse(text)).slice(0, 60)) {
      const wanted = parseDocument(text);
      wanted.setIn(path, 42);
      const made = setAt(text, path, '42');
      expect(parse(made)).toEqual(wanted.toJS());
      expect(made.split('\n').length).toBe(text.split('\n').length);
      const less = setAt(text, path, undefined);
      wanted.deleteIn(path);
      expect(parse(less)).toEqual(wanted.toJS());
      if (typeof path.at(-1) === 'string' && path.length > 1) expect(comments(less).length).toBeGreaterThanOrEqual(comments(text).length - 1);
      expect(comments(made)).toEqual(comments(text));
    }
  });
  it('writes texts so that they stay texts', () => {
    expect(['B1', 'Two balls', 'a: b', '${v}', 'no', '1e3'].map(textOf)).toEqual(['B1', 'Two balls', '"a: b"', '"${v}"', '"no"', '"1e3"']);
    expect([' 1e-3 ', '${v}', 'abc'].map(numberOf)).toEqual(['1e-3', '"${v}"', 'abc']);
  });
});

describe('the fields of a form', () => {
  it('have kinds, words, ranges and defaults of the schema', () => {
    const of = (type: string, name: string) => fieldsOf(type).find((field) => field.name === name)!;
    expect(of('Body', 'mass_kg')).toMatchObject({kind: 'number', low: 0, high: 1e12, required: false});
    expect(of('Contact', 'damping')).toMatchObject({kind: 'word', standard: 'ENERGY_RESTITUTION'});
    expect(of('Contact', 'damping').words.every(({about}) => about)).toBe(true);
    expect([of('Contact', 'between').kind, of('Contact', 'wall').kind, of('Body', 'fixed').kind, of('Load.Table', 'points').kind, of('Solver', 'max_steps').kind])
      .toEqual(['texts', 'object', 'truth', 'objects', 'integer']);
    expect(of('Contact', 'wall').type).toBe('Wall');
    expect(choicesOf('Load')).toContain('half_sine_pulse');
    expect(choicesOf('Contact')).toEqual([]);
  });
  it('cover all that the scenarios say', () => {
    const check = (type: string, value: object) => {
      for (const [name, one] of Object.entries(value)) {
        const field = fieldsOf(type).find((each) => each.name === name);
        expect(field, `${type}.${name}`).toBeDefined();
        if (field!.kind === 'object') check(field!.type, one as object);
      }
    };
    for (const text of Object.values(files)) {
      const scenario = readPage(text, files).json as Record<string, unknown>;
      const base = scenario.base ?? scenario;
      for (const {path, type} of objectsOf(base).filter(({path}) => path.length === 2)) check(type, (base as never)[path[0]!][path[1]!]);
    }
  });
});

describe('the objects of a page', () => {
  it('are named as people name them', () => {
    expect(objectsOf(parse(chain)).map(({label}) => label)).toEqual(['The run', 'body B1', 'body B2', 'body B3', 'contact B1-B2', 'contact B2-B3', 'Solver', 'Output']);
    expect(objectsOf({loads: [{body: 'a'}, null], contacts: [{between: ['a'], wall: {}}]}).map(({label}) => label).slice(1, 4)).toEqual(['contact a-wall', 'load a', 'load 2']);
  });
  it('begin as entries that fit to the others', () => {
    const scenario = parse(chain);
    expect(newEntry(scenario, 'bodies')).toBe('{name: B4, mass_kg: 0.5, radius_m: 0.05, position_m: 0.3}');
    expect(parse(setAt(chain, ['bodies', 3], newEntry(scenario, 'bodies'))).bodies).toHaveLength(4);
    expect(newEntry({}, 'loads')).toMatch(/constant/);
  });
  it('are found by the names of contacts, also of one of several', () => {
    const scenario = {contacts: [{between: ['a', 'b', 'c']}, {name: 'n', between: ['x', 'y', 'z']}, {between: ['a'], wall: {}}, {name: 'play', between: ['p'], clearance_m: 1, wall: {}}]};
    expect(['b-c', 'n-2', 'a-wall', 'play-left', 'none'].map((name) => entryOfContact(scenario, name))).toEqual([0, 1, 2, 3, -1]);
  });
});

describe('a click on the drawing', () => {
  it('finds the body under it, the contact where two touch, and the nearest beside them', () => {
    const scenario = create(ScenarioSchema, {
      bodies: [{name: 'a', radiusM: 0.1}, {name: 'b', radiusM: 0.1, positionM: 0.2}, {name: 'c', positionM: 0.9}],
      contacts: [{between: ['a', 'b']}, {between: ['c'], wall: {positionM: 1, side: Wall_Side.RIGHT}}],
    });
    const drawn = {mechanics: mechanicsOf(scenario), scale: 100, toX: (x: number) => 100 * x};
    expect([0, 10, 20, 55, 95].map((x) => hitAt(drawn, x)?.name)).toEqual(['a', 'a-b', 'b', 'b', 'c-wall']);
    expect(hitAt({...drawn, mechanics: {...drawn.mechanics, bodies: [], contacts: []}}, 0)).toBeUndefined();
  });
  it('finds their entries in the page, also within a sweep', () => {
    const sweep = setAxis(chain, ['end_time_s'], {spacing: 'values', low: '', high: '', count: '', values: '1'});
    for (const text of [chain, sweep]) {
      expect([placeOf(text, 'bodies', 'B2'), placeOf(text, 'contacts', 'B2-B3'), placeOf(text, 'bodies', 'B9')]).toEqual([['bodies', 1], ['contacts', 1], undefined]);
    }
    expect(placeOf('bodies: [', 'bodies', 'B1')).toBeUndefined();
    expect(placeOf(files['table-3-sweep.yaml']!, 'bodies', 'B1')).toBeUndefined();
  });
});

describe('an axis of a sweep', () => {
  const range = {spacing: 'linear' as const, low: '0.1', high: '0.5', count: '5', values: ''};
  it('makes a sweep of a scenario, whose comments stay, and back', () => {
    const made = setAxis(chain, ['bodies', 0, 'velocity_m_per_s'], range);
    const {kind, json, problems} = readPage(made, files);
    expect([kind, problems]).toEqual(['sweep', []]);
    expect(json).toEqual({base: readPage(chain).json, metrics: ['iterations'], axes: [{field: 'bodies[B1].velocity_m_per_s', linear: {low: 0.1, high: 0.5, count: 5}}]});
    expect(comments(made).length).toBe(comments(chain).length);
    expect(dropAxis(made, 0)).toBe(chain);
  });
  it.each(Object.keys(files).filter((name) => !/sweep/.test(name)))('makes one of %s and back', (name) => {
    const made = setAxis(files[name]!, ['end_time_s'], range);
    expect(readPage(made).problems).toEqual([]);
    expect((readPage(made).json as {base: unknown}).base).toEqual(readPage(files[name]!).json);
    expect(readPage(dropAxis(made, 0)).json).toEqual(readPage(files[name]!).json);
  });
  it('comes beside others, is changed and goes', () => {
    const one = setAxis(chain, ['bodies', 0, 'velocity_m_per_s'], range);
    const path: Path = ['contacts', 0, 'restitution'];
    const two = setAxis(one, path, {...range, spacing: 'values', values: '0.9 0.8'});
    const raw = parse(two);
    expect(raw.axes[1]).toEqual({field: 'contacts[B1-B2].restitution', values: [0.9, 0.8]});
    expect(axisAt(raw, raw.base, path)).toBe(1);
    expect(rangeOfAxis(raw.axes[1])).toMatchObject({spacing: 'values', values: '0.9, 0.8'});
    expect(parse(setAxis(two, path, {...range, spacing: 'log'})).axes[1]).toEqual({field: 'contacts[B1-B2].restitution', log: {low: 0.1, high: 0.5, count: 5}});
    expect(parse(dropAxis(two, 1)).axes).toEqual(parse(one).axes);
  });
  it('needs the scenario in the page, where its file can be brought', () => {
    const text = files['table-3-sweep.yaml']!;
    expect(setAxis(text, ['end_time_s'], range)).toBe(text);
    const made = withBase(text, chain)!;
    expect(readPage(made).json).toEqual({...readPage(text, files).json as object, base: readPage(chain).json});
    expect(withBase(`variables: {a: 1}\n${text}`, files['bouncing-ball.yaml']!)).toBeUndefined();
    expect(readPage(withBase(text, files['bouncing-ball.yaml']!)!).problems).toEqual([]);
  });
  it('is found by place, name and star', () => {
    const scenario = parse(chain);
    const at = (field: string) => axisAt({axes: [{field}]}, scenario, ['contacts', 1, 'restitution']);
    expect(['contacts[1].restitution', 'contacts[B2-B3].restitution', 'contacts[*].restitution', 'contacts[0].restitution', 'end_time_s'].map(at)).toEqual([0, 0, 0, -1, -1]);
    expect(axisField(scenario, ['contacts', 1, 'wall', 'position_m'])).toBe('contacts[B2-B3].wall.position_m');
  });
  it('says what is wrong with its range', () => {
    expect(wrongRange(range)).toBe('');
    expect([{low: ''}, {low: '2'}, {count: '1.5'}, {spacing: 'log' as const, low: '0'}, {spacing: 'values' as const}].map((some) => wrongRange({...range, ...some}) !== '')).toEqual([true, true, true, true, true]);
  });
});

describe('the history of a text', () => {
  it('takes letters that follow each other as one step, and steps back and forth', () => {
    let history = begun('');
    ['a', 'ab', 'abc'].forEach((text, i) => { history = changed(history, text, 'editor', 100 * i); });
    history = changed(history, 'abc!', 'form', 301);
    expect(undone(history).text).toBe('abc');
    expect(undone(undone(history)).text).toBe('');
    expect(redone(redone(undone(undone(history)))).text).toBe('abc!');
    expect(undone(begun('x')).text).toBe('x');
    expect(changed(undone(history), 'other', 'form', 9e9).future).toEqual([]);
  });
  it('knows where the cursor belongs', () => {
    expect([['a: 1\nb', 'a: 12\nb'], ['aaa', 'aa'], ['', 'x'], ['x', 'x']].map(([before, after]) => endOfChange(before!, after!))).toEqual([5, 2, 1, 1]);
  });
});
