// contactsim and the dashboard print the same: tests/python/axes_test.py has the same numbers and labels.
import {fromJson, type JsonValue} from '@bufbuild/protobuf';
import {describe, expect, it} from 'vitest';

import printed from '../../../tests/reference/words.json';
import {SweepSchema} from '../src/api/generated/contact/v1/scenario_pb';
import {axisLabel, metricLabel} from '../src/model/sweep_labels';
import {readableUnit} from '../src/model/units';

describe('words', () => {
  it('name the units that axes show', () => {
    for (const [label, largest, shown, factor] of printed.units as [string, number, string, number][]) {
      const unit = readableUnit(label, largest);
      // There 10^-6 is set as 10⁻⁶ when it is drawn.
      const plain = unit.label.replace(/[⁻⁰¹²³⁴-⁹]+/, (digits) => `^${[...digits].map((d) => '-0123456789'['⁻⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(d)]).join('')}`);
      expect([plain, unit.factor / factor]).toEqual([shown, expect.closeTo(1, 12)]);
    }
  });
  it('name axes of sweeps and metrics', () => {
    const label = (field: string) => axisLabel(fromJson(SweepSchema, {base: printed.base, axes: [{field}]} as JsonValue), 0);
    expect(printed.axes.map(([field]) => [field, label(field!)])).toEqual(printed.axes);
    expect(printed.metrics.map(([metric]) => [metric, metricLabel(metric!)])).toEqual(printed.metrics);
  });
});
