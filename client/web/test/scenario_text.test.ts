import {readdirSync, readFileSync} from 'node:fs';

import {fromJson} from '@bufbuild/protobuf';
import {describe, expect, it} from 'vitest';

import {ScenarioSchema, SweepSchema} from '../src/api/generated/contact/v1/scenario_pb';
import {placeAt, suggestionsAt} from '../src/model/completion';
import {asCli, asPython} from '../src/model/copy_as';
import {allProblems, readPage} from '../src/model/scenario_text';

const folder = new URL('../../scenarios/', import.meta.url);
const files = Object.fromEntries(readdirSync(folder).filter((name) => name.endsWith('.yaml'))
  .map((name) => [name, readFileSync(new URL(name, folder), 'utf8')]));

describe('a page of YAML', () => {
  it.each(Object.keys(files))('%s is read without a problem', (name) => {
    const {problems, json, kind} = readPage(files[name]!, files);
    expect(problems).toEqual([]);
    fromJson(kind === 'sweep' ? SweepSchema : ScenarioSchema, json!);
  });
  it('tells unknown fields at their line, with a hint', () => {
    const {problems} = readPage('title: x\nbodies:\n  - name: a\n    mas_kg: 1\n');
    expect(problems).toEqual([{line: 4, path: 'bodies[0].mas_kg', text: "unknown field — did you mean 'mass_kg'?"}]);
  });
  it('tells values of a wrong kind', () => {
    expect(readPage('end_time_s: soon').problems[0]!.text).toBe("is 'soon'; must be a number");
    expect(readPage('contacts: [{damping: EXAKT}]').problems[0]!.text).toMatch(/did you mean 'EXACT'/);
    expect(readPage('bodies: {name: a}').problems[0]!.text).toBe('must be a list');
  });
  it('tells where YAML itself is broken', () => {
    expect(readPage('title: x\nbodies: [{name: a\n').problems[0]!.line).toBeGreaterThan(1);
  });
  it('tells that a 0 is out of range, which the server takes for a field that is missing', () => {
    expect(readPage('title: x\nend_time_s: 0\n').problems).toEqual([{line: 2, path: 'end_time_s', text: 'is 0; must be in (0, 1e6]'}]);
    expect(readPage('loads: [{body: a, constant: {force_n: 0}}]').problems).toEqual([]);
  });
  it('is judged by the server without what is wrong in it, and all is told at once', () => {
    const page = readPage('bodies:\n  - {name: a, mas_kg: 1, radius_m: 7}\nend_time_s: 9\n');
    expect(page.json).toEqual({bodies: [{name: 'a', radius_m: 7}], end_time_s: 9});
    const said = (path: string) => ({line: page.lineOf(path), path, text: 'is wrong'});
    const told = allProblems(page, ['end_time_s', 'bodies[0].radius_m', 'bodies[0].mass_kg'].map(said));
    expect(told.map(({path}) => path)).toEqual(['bodies[0].mas_kg', 'bodies[0].radius_m', 'end_time_s']);
  });
  it('finds the line of a field that the server names, or of what holds it', () => {
    const {lineOf} = readPage(files['three-ball-chain.yaml']!);
    expect([lineOf('bodies[1].mass_kg'), lineOf('contacts[1].restitution'), lineOf('bodies[2].density_kg_per_m3'), lineOf('end_time_s')])
      .toEqual([8, 12, 9, 14]);
  });
  it('has line 1 for every field while it is empty', () => {
    expect(['', '# nothing yet\n', 'bodies:\n'].map((text) => readPage(text).lineOf('bodies[0].mass_kg'))).toEqual([1, 1, 1]);
  });
  it('replaces variables', () => {
    const {json} = readPage('variables: {h: 2.5}\nbodies: [{name: "b${h}", position_m: "${h}"}]');
    expect(json).toEqual({bodies: [{name: 'b2.5', position_m: 2.5}]});
  });
  it('passes NaN on for the server to refuse', () => {
    expect(readPage('end_time_s: .nan').json).toEqual({end_time_s: 'NaN'});
  });
});

describe('completion', () => {
  const at = (text: string) => suggestionsAt(text, text.length).map(({word}) => word);
  it('offers the fields of the place, in blocks and in braces', () => {
    expect(at('bodies:\n  - name: a\n    mas')).toEqual(['mass_kg']);
    expect(at('contacts:\n  - {name: c, rest')).toEqual(['restitution']);
    expect(at('contacts:\n  - {between: [a], wall: {pos')).toEqual(['position_m']);
    expect(at('end')).toEqual(['end_time_s']);
  });
  it('offers the words of an enum', () => {
    expect(at('contacts:\n  - damping: HU')).toEqual(['HUNT_CROSSLEY', 'HU_GUO']);
    expect(at('solver: {method: R')).toEqual(['RK4']);
  });
  it('says range, unit and default', () => {
    const about = suggestionsAt('contacts:\n  - {restit', 23)[0]!.about;
    expect(about).toBe('(0, 1]');
    expect(suggestionsAt('bodies:\n  - radi', 16)[0]!.about).toMatch(/default 0/);
  });
  it('knows where it is', () => {
    expect(placeAt('solver:\n  method: ADA', 21)).toEqual({keys: ['solver'], key: 'method', prefix: 'ADA'});
  });
});

describe('copies', () => {
  it('name the server of the page, with TLS where the page has it', () => {
    expect(asCli('', 'scenario', 'https://lab.example')).toContain('contactctl --server lab.example:443 --tls-ca /etc/');
    expect(asPython({}, 'http://[::1]:8080')).toContain('contactsim.Client("[::1]:8080").run(');
    expect(asPython({}, 'https://lab.example')).toMatch(/Client\("lab.example:443", tls_ca="\/etc\/.*"\)/);
  });
  it('can be pasted', () => {
    expect(asCli('title: x\n\n', 'scenario', 'http://h:8080')).toBe("contactctl --server h:8080 run - <<'END'\ntitle: x\nEND\n");
    expect(asPython({bodies: [{name: 'a', fixed: true}]}, 'http://h:8080')).toContain('{"name": "a", "fixed": True}');
  });
});
