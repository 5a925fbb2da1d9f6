// Two axes of a grid as a map that fills while cells are computed.

import type {SweepCell} from '../../api/generated/contact/v1/event_pb';
import {extent} from '../../model/panel';
import {exact, short} from '../../model/numbers';
import {cellIndex, inkOn, metricOf, outcomeOf, viridis} from '../../model/sweep';

const WIDTH = 900;
const LEFT = 90;
const BOTTOM = 56;

export interface Axis {
  name: string;
  values: number[];
}

interface Props {
  x: Axis;
  y: Axis;
  /** The number of the cell at a place. */
  indexAt: (x: number, y: number) => number;
  cells: Map<number, SweepCell>;
  metric: number;
  metricName: string;
  log: boolean;
  chosen: number | undefined;
  choose: (cell: number) => void;
  open: (cell: number) => void;
}

/** Every nth tick, so that words do not overlap. */
const sparse = (n: number, room: number) => Math.max(1, Math.ceil(n / room));

function Cell({props, i, j, width, height, part}: {props: Props; i: number; j: number; width: number; height: number; part: (v: number) => number}) {
  const index = props.indexAt(i, j);
  const cell = props.cells.get(index);
  const outcome = outcomeOf(cell);
  const value = metricOf(cell, props.metric);
  const at = {x: LEFT + i * width, y: (props.y.values.length - 1 - j) * height};
  const known = outcome !== 'waiting' && Number.isFinite(value) && Number.isFinite(part(value));
  const text = outcome === 'failed' ? '×' : outcome === 'waiting' ? '' : Number.isFinite(value) ? short(value, 3) : '–';
  return (
    <g data-cell={index} data-outcome={outcome} onClick={() => (props.chosen === index ? props.open(index) : props.choose(index))}>
      <title>{`${props.x.name} = ${exact(props.x.values[i]!)}, ${props.y.name} = ${exact(props.y.values[j]!)}: ${exact(value)}, ${outcome}`}</title>
      <rect {...at} width={width} height={height} fill={known ? viridis(part(value)) : 'transparent'} class="cell" />
      {outcome === 'not converged' && <rect {...at} width={width} height={height} fill="url(#hatch)" />}
      {width > 30 && height > 13 && <text x={at.x + width / 2} y={at.y + height / 2 + 4} text-anchor="middle" class={`${known ? '' : 'ink'} ${outcome === 'not converged' ? `halo ${inkOn(part(value)) === '#000000' ? 'bright' : 'dark'}` : ''}`} fill={known ? inkOn(part(value)) : undefined}>{text}</text>}
      {props.chosen === index && <rect x={at.x + 1} y={at.y + 1} width={width - 2} height={height - 2} class="chosen" />}
    </g>
  );
}

function keysOf({x, y, indexAt, chosen, choose, open}: Props) {
  return (event: KeyboardEvent) => {
    const moves: Record<string, [number, number]> = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    if (event.key === 'Enter' && chosen !== undefined) { open(chosen); return; }
    const move = moves[event.key];
    if (!move) return;
    event.preventDefault();
    for (let i = 0; i < x.values.length; ++i) {
      for (let j = 0; j < y.values.length; ++j) {
        if (indexAt(i, j) !== chosen) continue;
        const clamp = (n: number, size: number) => Math.min(Math.max(n, 0), size - 1);
        choose(indexAt(clamp(i + move[0], x.values.length), clamp(j + move[1], y.values.length)));
        return;
      }
    }
    choose(indexAt(0, 0));
  };
}

export function HeatMap(props: Props) {
  const {x, y, cells, metric, log} = props;
  const found = extent([[...cells.values()].filter((c) => outcomeOf(c) !== 'failed').map((c) => metricOf(c, metric))], log) ?? [0, 1];
  const scale = (v: number) => (log ? Math.log(v) : v);
  const part = (v: number) => (found[0] === found[1] ? 0.5 : (scale(v) - scale(found[0])) / (scale(found[1]) - scale(found[0])));
  const width = (WIDTH - LEFT - 10) / x.values.length;
  const height = Math.min(Math.max(360 / y.values.length, 4), 44);
  const bottom = height * y.values.length;
  const every = [sparse(x.values.length, 14), sparse(y.values.length, bottom / 16)] as const;
  return (
    <>
      <div class="keys" tabIndex={0} role="application" onKeyDown={keysOf(props)}
        aria-label={`Map of ${props.metricName} over ${y.name} and ${x.name}; arrow keys choose a cell, Enter runs it`}>
      <svg class="map" viewBox={`0 0 ${WIDTH} ${bottom + BOTTOM}`}>
        <defs><pattern id="hatch" width="7" height="7" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">
          <rect width="7" height="7" fill="none" /><line x1="0" y1="0" x2="0" y2="7" stroke="#fff" stroke-width="2" /><line x1="2" y1="0" x2="2" y2="7" stroke="#000" stroke-width="1.4" /></pattern></defs>
        {y.values.flatMap((_, j) => x.values.map((__, i) => <Cell key={`${i},${j}`} props={props} i={i} j={j} width={width} height={height} part={part} />))}
        {x.values.map((v, i) => i % every[0] === 0 && <text key={`x${i}`} class="ink" x={LEFT + (i + 0.5) * width} y={bottom + 18} text-anchor="middle">{short(v)}</text>)}
        {y.values.map((v, j) => j % every[1] === 0 && <text key={`y${j}`} class="ink" x={LEFT - 8} y={(y.values.length - 0.5 - j) * height + 4} text-anchor="end">{short(v)}</text>)}
        <text class="ink name" x={LEFT + (WIDTH - LEFT) / 2} y={bottom + 42} text-anchor="middle">{x.name}</text>
        <text class="ink name" transform={`translate(16 ${bottom / 2}) rotate(-90)`} text-anchor="middle">{y.name}</text>
      </svg>
      </div>
      <p class="scale soft"><span class="mono">{exact(found[0])}</span>
        <svg width="180" height="12" aria-hidden="true">{Array.from({length: 60}, (_, i) => <rect key={i} x={i * 3} y="0" width="3" height="12" fill={viridis(i / 59)} />)}</svg>
        <span class="mono">{exact(found[1])}</span> hatched: not converged · ×: failed · –: no value</p>
    </>
  );
}

/** A slice of a grid: the place on each axis that is not shown. */
export function sliceIndex(sizes: number[], slice: number[], xAxis: number, yAxis: number) {
  return (i: number, j: number) => {
    const places = [...slice];
    places[xAxis] = i;
    places[yAxis] = j;
    return cellIndex(sizes, places);
  };
}
