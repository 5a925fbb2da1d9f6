import {create, toJson} from '@bufbuild/protobuf';
import {describe, expect, it} from 'vitest';

import {ContactModelSchema, ModelTranslationSchema, TranslateModelRequestSchema} from '../src/api/generated/contact/v1/model_service_pb';
import {commandOf, differenceOf, EXAMPLE, inputAt, inputsOf, queryOf, reboundOf, requestOf, together, wordsAmong} from '../src/model/translation';

const models = ['drake', 'mujoco', 'ode'].map((name) => create(ContactModelSchema, {name}));
const asked = (inputs: Record<string, string>) =>
  toJson(TranslateModelRequestSchema, create(TranslateModelRequestSchema, requestOf(inputs, models)), {useProtoFieldName: true});

describe('a contact to translate', () => {
  it('is the example while the address says nothing', () => {
    expect(inputsOf(new URLSearchParams())).toEqual(EXAMPLE);
    expect(inputsOf(new URLSearchParams('find=ode'))).toEqual(EXAMPLE);
    expect(inputsOf(new URLSearchParams('e=0.5'))).toEqual({e: '0.5'});
  });
  it('comes back from its address', () => {
    const inputs = {from: 'drake', 'set.k': '1e5', 'set.d': '0.5', v: '0.1, 1', m: '2'};
    const query = new URLSearchParams();
    for (const [key, value] of Object.entries(queryOf(inputs))) for (const entry of [value].flat()) query.append(key, entry);
    expect(inputsOf(query)).toEqual(inputs);
  });
  it('asks with the values that are given, and no others', () => {
    expect(asked({e: '0.5', k: '1e6', n: '', v: '1', m: '2'})).toEqual({
      mass_kg: 2, velocities_m_per_s: [1], wanted: {restitution: 0.5, stiffness: 1e6}});
    expect(asked({e: '0.5', n: '1.5', time: '0.01', v: '1', m: '2', r: '0.1', g: '9.81', step: '1e-5'})).toEqual({
      mass_kg: 2, velocities_m_per_s: [1], gravity_m_per_s2: 9.81, radius_m: 0.1, step_s: 1e-5, wanted: {restitution: 0.5, contact_time_s: 0.01}});
  });
  it('asks for all other models where one is given', () => {
    expect(asked({from: 'mujoco', 'set.stiffness': '1e5', 'set.damping': '', v: '0.1, 1,5', m: '1'})).toEqual({
      models: ['drake', 'ode'], mass_kg: 1, velocities_m_per_s: [0.1, 1, 5], from: {model: 'mujoco', values: {stiffness: 1e5}}});
  });
  it('has the effective mass and radius of two bodies', () => {
    expect([together(2, 2), together(3, undefined), together(1, Infinity)]).toEqual([1, 3, 1]);
    expect(together(0.3, 0.7)).toBeCloseTo(0.21, 15);
    expect(asked({m: '2', m2: '2', r: '0.1', r2: '0.1', v: '1', e: '1', k: '1'})).toMatchObject({mass_kg: 1, radius_m: 0.05});
  });
  it('is pressed by gravity on a fixed body only', () => {
    expect(asked({m: '2', m2: '2', g: '9.81', v: '1', e: '1', k: '1'})).not.toHaveProperty('gravity_m_per_s2');
  });
  it('tells what is no number', () => {
    expect(wordsAmong({...EXAMPLE, from: 'drake', v: '1, 2'})).toEqual([]);
    expect(wordsAmong({...EXAMPLE, e: '0,8', v: '1, x', 'set.k': 'soft'})).toEqual(['e', 'v', 'set.k']);
  });
  it('is the same for contactctl', () => {
    expect(commandOf(EXAMPLE, requestOf(EXAMPLE, models)))
      .toBe('contactctl model translate --restitution 0.8 --stiffness 1e6 --exponent 1.5 --velocity 1 --mass 1 --radius 0.02 --step 0.00001');
    const given = {from: 'drake', 'set.a': '1', 'set.b': '2', v: '1,2', m: '1', m2: '1'};
    expect(commandOf(given, requestOf(given, models)))
      .toBe('contactctl model translate mujoco ode --from drake --set a=1,b=2 --velocity 1,2 --mass 0.5');
  });
});

describe('what the server says of a field', () => {
  it('stands at its input', () => {
    const fields = ['wanted.restitution', 'wanted.stiffness', 'wanted', 'wanted.contact_time_s', 'velocities_m_per_s[0]', 'mass_kg', 'radius_m', 'step_s',
      'from.values[kn]', 'from.values', 'from.model', 'something'];
    expect(fields.map(inputAt)).toEqual(['e', 'k', 'k', 'time', 'v', 'm', 'r', 'step', 'set.kn', 'from', 'from', '']);
  });
});

describe('what a model delivers', () => {
  it('is what comes out at its step, if that is known', () => {
    const delivered = {velocityRatio: 0.5};
    expect(reboundOf(create(ModelTranslationSchema, {delivered}))).toBe(0.5);
    expect(reboundOf(create(ModelTranslationSchema, {delivered, atStep: {least: 0.4, mean: 0.45, most: 0.5}}))).toBe(0.45);
    expect(reboundOf(create(ModelTranslationSchema))).toBeNaN();
  });
  it('differs from what is asked by a number with its sign', () => {
    expect([differenceOf(0.55028, 0.5), differenceOf(0.49979, 0.5), differenceOf(0.5000001, 0.5), differenceOf(NaN, 0.5)])
      .toEqual(['+0.05028', '−0.00021', '±0', '']);
  });
});
