// Axes of uPlot: ticks in readable units, SI values below.

import uPlot from 'uplot';

import {decimals} from '../model/numbers';
import {power, readableUnit, typeset, type AxisUnit} from '../model/units';
import type {Panel} from '../model/panel';

export const FONT = '12px system-ui, sans-serif';
const BOLD = '600 12px system-ui, sans-serif';

export interface Ink {
  text: string;
  soft: string;
  grid: string;
  band: string;
  paper: string;
  warn: string;
}

const LOGARITHMIC: uPlot.Scale.Distr = 3;

/** The unit of an axis for what it shows now, as it is written there. Powers of ten on a logarithmic axis are of the unit itself. */
export function unitOfScale(u: uPlot, scale: 'x' | 'y', label: string): AxisUnit {
  const {min, max, distr} = u.scales[scale]!;
  const {factor, label: name} = distr === LOGARITHMIC ? {factor: 1, label} : readableUnit(label, Math.max(Math.abs(min ?? 0), Math.abs(max ?? 0)));
  return {factor, label: typeset(name)};
}

/** `10⁻⁶` for powers of ten, nothing for what lies between. */
export function powerOfTen(value: number): string {
  const exponent = Math.log10(value);
  if (Math.abs(exponent - Math.round(exponent)) > 1e-9) return '';
  return power(Math.round(exponent));
}

function ticks(label: () => string, scale: 'x' | 'y', log: boolean): uPlot.Axis.Values {
  return (u, splits, _axis, _space, step) => {
    if (log) return splits.map((value) => (value === null ? '' : powerOfTen(value)));
    const {factor} = unitOfScale(u, scale, label());
    const digits = decimals(step / factor);
    return splits.map((value) => (value / factor).toFixed(digits).replace(/^-(0(\.0+)?)$/, '$1').replace('-', '−'));
  };
}

function widthOf(u: uPlot, values: string[] | null, axis: number, cycle: number): number {
  const known = u.axes[axis]! as uPlot.Axis & {_size?: number};
  if (cycle > 1) return known._size ?? 60;
  const longest = Math.max(0, ...(values ?? []).map((text) => text.length));
  return Math.max(34, 14 + 7 * longest);
}

/** Powers of ten, every nth so that there are few. */
function powers(_u: uPlot, _axis: number, low: number, high: number): number[] {
  const first = Math.ceil(Math.log10(low) - 1e-9);
  const last = Math.floor(Math.log10(high) + 1e-9);
  const step = Math.max(1, Math.ceil((last - first) / 6));
  return Array.from({length: Math.floor((last - first) / step) + 1}, (_, i) => 10 ** (last - i * step)).reverse();
}

/** Both axes of a panel. Their names are those of what `shown` is when they are drawn. */
export function axesOf(shown: () => Panel, ink: Ink): uPlot.Axis[] {
  const panel = shown();
  const xName = () => shown().xLabel;
  const yName = () => shown().yLabel;
  const common: uPlot.Axis = {
    stroke: ink.text, font: FONT, labelFont: BOLD, labelSize: 18, labelGap: 0,
    grid: {stroke: ink.grid, width: 1}, ticks: {stroke: ink.grid, width: 1, size: 5}, gap: 4,
  };
  const label = (scale: 'x' | 'y', name: () => string) =>
    ((u: uPlot) => unitOfScale(u, scale, name()).label) as unknown as string;
  const whole = (counted?: boolean) => (counted ? {incrs: [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000]} : {});
  return [
    {...common, ...whole(panel.countedX), scale: 'x', size: 30, space: 70, label: label('x', xName),
      values: ticks(xName, 'x', !!panel.logX)},
    {...common, ...(panel.logY ? {splits: powers, filter: (_u: uPlot, splits: number[]) => splits} : {}), ...whole(panel.countedY), scale: 'y', size: widthOf, space: 32, label: label('y', yName),
      values: ticks(yName, 'y', !!panel.logY)},
  ];
}
