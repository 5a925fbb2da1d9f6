// All axes and metrics of a sweep side by side, a line for each cell.

import {useMemo, useRef} from 'preact/hooks';

import type {SweepCell} from '../../api/generated/contact/v1/event_pb';
import {entriesOf, isInside} from '../../model/brush';
import {byColour, levelOf, nearestLine} from '../../model/cell_shapes';
import {extent} from '../../model/panel';
import {short} from '../../model/numbers';
import {countUnknown, metricOf, outcomeOf} from '../../model/sweep';
import {drawingOf, pointIn} from '../../plots/drawing';
import {ExportButtons} from '../../plots/exports';
import {useTheme} from '../../ui/theme';
import {useWidth} from '../../ui/use_width';
import {BrushLayer, Chosen, useBrushes, type Frame} from './brushes';
import {keysOver, type Choosing} from './choosing';

const NARROW_PX = 560;
const HEIGHT = 300;
const LINE_PX = 14;   // Of the names above.
const OUTSIDE = 'var(--rule)';   // The colour of cells that are not chosen.

interface Props extends Choosing {
  names: string[];
  /** Axes come first, then metrics. */
  axes: number;
  cells: SweepCell[];
  metric: number;
  csv: (cells: SweepCell[]) => string;
  source: string;
}

/** The lines of the cells: heights at each name, and where each name stands. */
interface Lines {
  ranges: [number, number][];
  /** Where the lines begin. */
  top: number;
  /** Rows in which the names stand above. */
  rows: number;
  xs: number[];
  heights: number[][];
  paths: string[];
  values: number[][];
}

const anchor = (i: number, n: number) => (i === 0 ? 'start' : i === n - 1 ? 'end' : 'middle');
const valuesOf = (cell: SweepCell) => [...cell.values, ...cell.metrics.map((_, i) => metricOf(cell, i))];
const round = (value: number) => Math.round(value * 10) / 10;

function linesOf(names: string[], cells: SweepCell[], width: number): Lines {
  const staggered = width < NARROW_PX ? names.length : 2;
  const top = LINE_PX * staggered + 12;
  const side = width < NARROW_PX ? 12 : 60;
  const rows = cells.map(valuesOf);
  const ranges = names.map((_, i): [number, number] => extent([rows.map((row) => row[i]!)]) ?? [0, 1]);
  const xs = names.map((_, i) => side + i * (width - 2 * side - 40) / Math.max(names.length - 1, 1));
  const height = (value: number, [low, high]: [number, number]) => top + HEIGHT * (low === high ? 0.5 : 1 - (value - low) / (high - low));
  const heights = rows.map((row) => names.map((_, i) => height(row[i]!, ranges[i]!)));
  return {ranges, top, rows: staggered, xs, heights, values: rows, paths: heights.map((line) => pathOf(xs, line))};
}

function pathOf(xs: number[], heights: number[]): string {
  return heights.map((y, i) => (Number.isFinite(y) ? `${i > 0 && Number.isFinite(heights[i - 1]) ? 'L' : 'M'}${round(xs[i]!)} ${round(y)}` : '')).join('');
}

/** A path for each colour, of the cells that converged or of the others. */
function pathsOf({paths}: Lines, cells: SweepCell[], colour: (cell: SweepCell, i: number) => string, converged: boolean): [string, string][] {
  return byColour(cells.flatMap((cell, i): [string, string][] =>
    ((outcomeOf(cell) === 'converged') === converged ? [[colour(cell, i), paths[i]!]] : [])));
}

function Axes({names, ranges, xs, top, rows, width}: Lines & {names: string[]; width: number}) {
  return (
    <>{names.map((name, i) => (
      <g key={name}>
        <line x1={xs[i]} x2={xs[i]} y1={top} y2={top + HEIGHT} class="rule" />
        <text class="ink name" x={anchor(i, names.length) === 'start' ? 4 : anchor(i, names.length) === 'end' ? width - 4 : xs[i]} y={LINE_PX * (rows - i % rows)} text-anchor={anchor(i, names.length)}>{name}</text>
        <text class="ink edge" x={xs[i]! + 4} y={top + 12}>{short(ranges[i]![1])}</text>
        <text class="ink edge" x={xs[i]! + 4} y={top + HEIGHT}>{short(ranges[i]![0])}</text>
      </g>))}</>
  );
}

export function Parallel({names, axes, cells, metric, choose, open, chosen, csv, source}: Props) {
  const dark = useTheme() === 'dark';
  const drawn = useRef<SVGSVGElement>(null);
  const [box, width] = useWidth(900);
  const lines = useMemo(() => linesOf(names, cells, width), [cells, names.join(), width]);
  const [low, high] = lines.ranges[axes + metric] ?? [0, 1];
  const colour = (cell: SweepCell) =>
    levelOf((dark ? 0.35 : 0) + (dark ? 0.65 : 0.6) * (low === high ? 0.5 : (metricOf(cell, metric) - low) / (high - low) || 0));
  const {top, xs, ranges} = lines;
  const frame: Frame = {names, xs, ranges, top, height: HEIGHT};
  const {brushes, set, clear, pointer, taken} = useBrushes(frame);
  const inside = useMemo(() => lines.values.map((row) => isInside(row, brushes)), [lines, entriesOf(brushes).join()]);
  const ofChoice = <T,>(list: T[]) => (brushes.size > 0 ? list.filter((_, i) => inside[i]) : list);
  const within = ofChoice(cells);
  const paths = useMemo(() => [true, false].flatMap((converged) =>
    pathsOf(lines, cells, (cell, i) => (inside[i] ? colour(cell) : OUTSIDE), converged).map(([ink, path]) => ({ink, path, converged})))
    .sort((a, b) => Number(b.ink === OUTSIDE) - Number(a.ink === OUTSIDE)), [lines, metric, dark, inside]);   // Grey lies below.
  const unknown = useMemo(() => names.slice(axes).map((_, i) => Object.values(countUnknown(cells, i)).some(Boolean)), [cells, names.join()]);
  const place = cells.findIndex(({index}) => index === chosen);
  const click = (event: MouseEvent) => {
    if (taken()) return;
    const near = within[nearestLine(xs, ofChoice(lines.heights), ...pointIn(drawn.current!, event))];
    if (near) choose(near.index);
  };
  const keys = keysOver(within, {chosen, choose, open});
  const press = (event: KeyboardEvent) => (event.key === 'Escape' && brushes.size > 0 ? clear() : keys(event));
  return (
    <figure class="plot" data-plot="parallel" data-lines={cells.length}>
      <figcaption><h3>Parallel coordinates</h3>
        <ExportButtons title="parallel coordinates" name={`${source}-parallel`} csv={() => csv(within)} svg={() => drawingOf(drawn.current!, names.join(', '), source)} /></figcaption>
      <div ref={box} class="keys" tabIndex={0} role="application" onKeyDown={press}
        aria-label={`${cells.length} cells as lines over ${names.join(', ')}; arrow keys choose a cell, Enter runs it`}>
        <svg ref={drawn} class="map parallel" viewBox={`0 0 ${width} ${HEIGHT + lines.top + 12}`} onClick={click} {...pointer}>
          {paths.map(({ink, path, converged}) => (
            <path key={`${converged}${ink}`} d={path} fill="none" stroke={ink} stroke-width="1.3" stroke-opacity={chosen === undefined ? 0.9 : 0.6} stroke-dasharray={converged ? undefined : '4 3'} />))}
          {place >= 0 && <path d={lines.paths[place]} fill="none" stroke={colour(cells[place]!)} stroke-width="4" />}
          <Axes names={names} width={width} {...lines} />
          <BrushLayer frame={frame} brushes={brushes} set={set} valuesOf={(place) => lines.values.map((row) => row[place]!)} />
        </svg>
      </div>
      <Chosen brushes={brushes} inside={within.length} all={cells.length} clear={clear} />
      <p class="note">dashed: not converged or failed{unknown.some(Boolean) && '; broken: CUT by the end, or no contact'}</p>
    </figure>
  );
}
