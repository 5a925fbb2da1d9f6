import {readdirSync, readFileSync} from 'node:fs';

import {fromJson} from '@bufbuild/protobuf';
import {describe, expect, it} from 'vitest';

import {ScenarioSchema, SweepSchema} from '../src/api/generated/contact/v1/scenario_pb';
import {placeAt, suggestionsAt} from '../src/model/completion';
import {asCli, asPython} from '../src/model/copy_as';
import {readPage} from '../src/model/scenario_text';

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
  it('finds the line of a field that the server names, or of what holds it', () => {
    const {lineOf} = readPage(files['three-ball-chain.yaml']!);
    expect([lineOf('bodies[1].mass_kg'), lineOf('contacts[1].restitution'), lineOf('bodies[2].density_kg_per_m3'), lineOf('end_time_s')])
      .toEqual([8, 12, 9, 14]);
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
  it('can be pasted', () => {
    expect(asCli('title: x\n\n', 'scenario')).toBe("contactctl run - <<'END'\ntitle: x\nEND\n");
    expect(asPython({bodies: [{name: 'a', fixed: true}]})).toContain('{"name": "a", "fixed": True}');
  });
});
