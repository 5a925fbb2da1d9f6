import {create} from '@bufbuild/protobuf';
import {describe, expect, it} from 'vitest';

import {SweepSchema, Wall_Side} from '../src/api/generated/contact/v1/scenario_pb';
import {cellAt, cornerOf} from '../src/model/cell_shapes';
import {planeOf} from '../src/model/map_data';
import {axisLabel, metricLabel} from '../src/model/sweep_labels';

describe('labels', () => {
  const label = (field: string) => axisLabel(create(SweepSchema, {axes: [{field}], base: {
    bodies: [{name: 'B1'}, {name: 'B2'}], contacts: [{between: ['B1', 'B2']}, {name: 'end', between: ['B2'], wall: {side: Wall_Side.RIGHT}}],
    loads: [{body: 'B2', kind: {case: 'constant', value: {forceN: 1}}}]}}), 0);
  it('of axes are those of contactctl', () => {   // tests/cli/text/sweep_labels_test.cpp has the same.
    expect(['bodies[0].velocity_m_per_s', 'contacts[0].restitution', 'contacts[1].wall.position_m', 'contacts[*].stiffness', 'loads[0].constant.force_n',
      'end_time_s', 'solver.step_s', 'solver.max_iterations', 'contacts[0].damping', 'bodies[0].colour', 'bodies[7].mass_kg'].map(label)).toEqual([
      'velocity of B1 [m/s]', 'restitution of B1-B2 [1]', 'wall position of end [m]', 'stiffness of all contacts [N/m^exponent]', 'constant force of loads[0] on B2 [N]',
      'end time [s]', 'solver step [s]', 'solver max iterations', 'damping of B1-B2', 'bodies[0].colour', 'mass of bodies[7] [kg]']);
  });
  it('of metrics are those of contactctl', () => {
    expect(['final_bodies[B3].velocity_m_per_s', 'cycles[B1-B2].alpha', 'cycles[B1-B2].mu_over_k_s_per_m', 'cycles[2].peak_force_n',
      'cycles[B1-B2].restitution_out', 'groups[B1-B2].mu', 'iterations', 'summary.energy_residual', 'convergence', 'nonsense', 'summary'].map(metricLabel)).toEqual([
      'final velocity of B3 [m/s]', 'alpha of B1-B2 [1]', 'mu over k of B1-B2 [s/m]', 'peak force of cycles[2] [N]',
      'restitution out, B1-B2 [1]', 'group mu of B1-B2 [N·s/m^(n+1)]', 'iterations', 'energy residual [1]', 'convergence', 'nonsense', 'summary']);
  });
});

describe('a map', () => {
  it('has the first axis down, its first value at the top, as contactctl and contactsim draw it', () => {
    const place = {left: 10, width: 5, height: 4, columns: 3, rows: 2};
    expect([cornerOf(place, 0, 0), cornerOf(place, 2, 1), cellAt(place, 12, 1), cellAt(place, 24, 7)]).toEqual([[10, 0], [20, 4], [0, 0], [2, 1]]);
    expect(planeOf(2, undefined, undefined)).toEqual({down: 0, across: 1});
  });
  it('never has the same axis both ways', () => {
    expect([[0, undefined], [1, undefined], [1, 1], [2, 2], [0, 0], [9, 9]].map(([y, x]) => planeOf(3, y, x))).toEqual(
      [{down: 0, across: 1}, {down: 1, across: 0}, {down: 1, across: 0}, {down: 2, across: 0}, {down: 0, across: 1}, {down: 2, across: 0}]);
  });
});
