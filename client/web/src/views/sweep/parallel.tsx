// All axes and metrics of a sweep side by side, a line for each cell.

import type {SweepCell} from '../../api/generated/contact/v1/event_pb';
import {extent} from '../../model/panel';
import {short} from '../../model/numbers';
import {outcomeOf, viridis} from '../../model/sweep';
import {useTheme} from '../../ui/theme';

const WIDTH = 900;
const HEIGHT = 300;
const TOP = 40;
const MOST = 2000;

interface Props {
  names: string[];
  /** Axes come first, then metrics. */
  axes: number;
  cells: SweepCell[];
  metric: number;
  choose: (cell: number) => void;
  chosen: number | undefined;
}

const anchor = (i: number, n: number) => (i === 0 ? 'start' : i === n - 1 ? 'end' : 'middle');

export function Parallel({names, axes, cells, metric, choose, chosen}: Props) {
  const dark = useTheme() === 'dark';
  const shown = cells.slice(0, MOST);
  const valuesOf = (cell: SweepCell) => [...cell.values, ...cell.metrics];
  const ranges = names.map((_, i): [number, number] => extent([shown.map((cell) => valuesOf(cell)[i]!)]) ?? [0, 1]);
  const x = (i: number) => 60 + i * (WIDTH - 120) / Math.max(names.length - 1, 1);
  const y = (i: number, value: number) => {
    const [low, high] = ranges[i]!;
    return TOP + HEIGHT * (low === high ? 0.5 : 1 - (value - low) / (high - low));
  };
  const path = (cell: SweepCell) => valuesOf(cell).map((value, i) =>
    (Number.isFinite(value) ? `${i === 0 || !Number.isFinite(valuesOf(cell)[i - 1]) ? 'M' : 'L'}${x(i)} ${y(i, value)}` : '')).join('');
  const colour = (cell: SweepCell) => {
    const [low, high] = ranges[axes + metric] ?? [0, 1];
    return viridis((dark ? 0.25 : 0) + (dark ? 0.75 : 0.9) * (low === high ? 0.5 : ((cell.metrics[metric] ?? NaN) - low) / (high - low) || 0));
  };
  return (
    <svg class="map parallel" viewBox={`0 0 ${WIDTH} ${HEIGHT + TOP + 30}`} role="img"
      aria-label={`${shown.length} cells as lines over ${names.join(', ')}`}>
      {shown.map((cell) => (
        <path key={cell.index} d={path(cell)} fill="none" stroke={colour(cell)} stroke-width={cell.index === chosen ? 4 : 1.3}
          stroke-opacity={chosen === undefined || cell.index === chosen ? 0.9 : 0.45}
          stroke-dasharray={outcomeOf(cell) === 'converged' ? undefined : '4 3'} onClick={() => choose(cell.index)} />))}
      {names.map((name, i) => (
        <g key={name}>
          <line x1={x(i)} x2={x(i)} y1={TOP} y2={TOP + HEIGHT} class="rule" />
          <text class="ink name" x={anchor(i, names.length) === 'start' ? 4 : anchor(i, names.length) === 'end' ? WIDTH - 4 : x(i)} y={i % 2 ? 14 : 28} text-anchor={anchor(i, names.length)}>{name}</text>
          <text class="ink" x={x(i) + 4} y={TOP + 12}>{short(ranges[i]![1])}</text>
          <text class="ink" x={x(i) + 4} y={TOP + HEIGHT}>{short(ranges[i]![0])}</text>
        </g>))}
    </svg>
  );
}
