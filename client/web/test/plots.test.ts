import type uPlot from 'uplot';
import {describe, expect, it} from 'vitest';

import {unitOfScale} from '../src/plots/axes';

/** As much of a plot as the functions that place words and units look at. */
const plotOf = (scales: Record<string, Partial<uPlot.Scale>>) => ({scales}) as unknown as uPlot;

describe('an axis', () => {
  it('has a prefix that its ticks are divided by, and none if it is logarithmic', () => {
    const label = 'μ [N·s/m^(n+1)]';
    const of = (distr: uPlot.Scale.Distr) => unitOfScale(plotOf({y: {min: 1e6, max: 1e11, distr}}), 'y', label);
    expect(of(1)).toEqual({factor: 1e9, label: 'μ [GN·s/m^(n+1)]'});
    expect(of(3)).toEqual({factor: 1, label});
  });
});
