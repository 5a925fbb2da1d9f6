// contactsim and the dashboard print the same: tests/python/axes_test.py has the same numbers and labels.
import {fromJson, type JsonValue} from '@bufbuild/protobuf';
import {describe, expect, it} from 'vitest';

import printed from '../../../tests/reference/words.json';
import {ScenarioSchema, SweepSchema} from '../src/api/generated/contact/v1/scenario_pb';
import {mechanicsOf, muUnit} from '../src/model/mechanics';
import {axisLabel, metricLabel} from '../src/model/sweep_labels';
import {readableUnit, typeset} from '../src/model/units';

describe('words', () => {
  it('name the units that axes show', () => {
    for (const [label, largest, shown, factor] of printed.units as [string, number, string, number][]) {
      const unit = readableUnit(label, largest);
      expect([typeset(unit.label), unit.factor / factor]).toEqual([typeset(shown), expect.closeTo(1, 12)]);
    }
  });
  it('raise exponents, as they are drawn', () => {
    expect(printed.typeset.map(([label]) => [label, typeset(label!)])).toEqual(printed.typeset);
  });
  it('name the unit of μ by the exponents of contacts', () => {
    const unit = (...contacts: object[]) => muUnit(mechanicsOf(fromJson(ScenarioSchema, {bodies: [{name: 'A'}, {name: 'B'}], contacts: contacts.map((one) => ({between: ['A', 'B'], ...one}))} as JsonValue)).contacts);
    expect([unit({}), unit({exponent: 1}), unit({exponent: 2.2}, {exponent: 2.2}), unit({}, {exponent: 1}), unit({damping: 'KELVIN_VOIGT'}), unit({damping: 'HERTZ_QUARTER_POWER'})])
      .toEqual(['N·s/m^(5/2)', 'N·s/m^2', 'N·s/m^(16/5)', 'N·s/m^(n+1)', 'N·s/m', 'N·s/m^(5/4)']);
  });
  it('name axes of sweeps and metrics', () => {
    const label = (field: string) => axisLabel(fromJson(SweepSchema, {base: printed.base, axes: [{field}]} as JsonValue), 0);
    expect(printed.axes.map(([field]) => [field, label(field!)])).toEqual(printed.axes);
    expect(printed.metrics.map(([metric]) => [metric, metricLabel(metric!)])).toEqual(printed.metrics);
  });
});
