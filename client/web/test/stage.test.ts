import {create} from '@bufbuild/protobuf';
import {describe, expect, it} from 'vitest';

import {ScenarioSchema, Wall_Side} from '../src/api/generated/contact/v1/scenario_pb';
import {mechanicsOf} from '../src/model/mechanics';
import {atStart, firstBodies} from '../src/model/stage';

describe('a scenario before its run', () => {
  it('is shown with its walls, to scale, and with the velocities that it begins with', () => {
    const written = create(ScenarioSchema, {
      bodies: [{name: 'a', radiusM: 0.1, velocityMPerS: 2}, {name: 'b', radiusM: 0.2, nextTo: 'a', gapM: 0.01}, {name: 'c', positionM: 1, motion: {kind: {case: 'uniform', value: {velocityMPerS: -3}}}}],
      contacts: [{between: ['a', 'b'], stiffness: 1}, {between: ['c'], wall: {positionM: 2, side: Wall_Side.RIGHT}, stiffness: 1}],
    });
    const stage = atStart(mechanicsOf(written));
    expect([stage.velocities, stage.magnification]).toEqual([[2, 0, -3], 1]);
    expect(stage.mechanics.bodies[1]!.position).toBeCloseTo(0.31, 12);
    expect([stage.low < -0.1, stage.low > -0.4, stage.high > 2, stage.high < 2.3]).toEqual([true, true, true, true]);
  });
  it('is shown with its first bodies, and the contacts among them', () => {
    const row = create(ScenarioSchema, {bodies: Array.from({length: 70}, (_, i) => ({name: `b${i}`, positionM: i})),
      contacts: Array.from({length: 69}, (_, i) => ({between: [`b${i}`, `b${i + 1}`]}))});
    const part = firstBodies(mechanicsOf(row));
    expect([part.bodies.length, part.contacts.length, atStart(part).velocities!.length]).toEqual([60, 59, 60]);
  });
});
