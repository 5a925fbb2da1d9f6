// Two axes of a grid as a map that fills while cells are computed.

import {useMemo, useRef, useState} from 'preact/hooks';

import {cellAt, cornerOf, GREYS, mapShapes, type MapPlace, type MapShapes} from '../../model/cell_shapes';
import {contourShapes} from '../../model/contour_shapes';
import {csvOf, placeOfCell, scaleOf, wordsOf, type Axis, type MapData} from '../../model/map_data';
import {exact, short} from '../../model/numbers';
import {countUnknown, viridis} from '../../model/sweep';
import {ExportButtons} from '../../plots/exports';
import {drawingOf, pointIn} from '../../plots/drawing';
import {useWidth} from '../../ui/use_width';
import type {Choosing} from './choosing';
import {Contours} from './contours';

const NARROW_PX = 560;
const BOTTOM = 56;
const TICK_PX = 64;   // Room for a number below the map.

interface Props extends MapData, Choosing {
  /** Changes with the cells. */
  version: number;
  /** Whether lines of equal value are drawn, instead of numbers in the cells. */
  contours: boolean;
  source: string;
}

/** Every nth tick, so that words do not overlap. */
const sparse = (n: number, room: number) => Math.max(1, Math.ceil(n / room));

function placeOf({x, y}: Props, room: number): MapPlace {
  const columns = x.values.length;
  const rows = y.values.length;
  const left = room < NARROW_PX ? 78 : 90;
  return {left, columns, rows, width: (room - left - 10) / columns, height: Math.min(Math.max(360 / rows, 4), 44)};
}

function keysOf(props: Props) {
  const {x, y, indexAt, chosen, choose, open} = props;
  return (event: KeyboardEvent) => {
    const moves: Record<string, [number, number]> = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
    if (event.key === 'Enter' && chosen !== undefined) { open(chosen); return; }
    const move = moves[event.key];
    if (!move) return;
    event.preventDefault();
    const now = placeOfCell(props, chosen);
    const clamp = (n: number, size: number) => Math.min(Math.max(n, 0), size - 1);
    choose(now ? indexAt(clamp(now[0] + move[0], x.values.length), clamp(now[1] + move[1], y.values.length)) : indexAt(0, 0));
  };
}

function Cells({shapes: {fills, hatched, cut, words}, large}: {shapes: MapShapes; large: boolean}) {
  return (
    <>
      <defs><pattern id="hatch" width="7" height="7" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">
        <rect width="7" height="7" fill="none" /><line x1="0" y1="0" x2="0" y2="7" stroke="#fff" stroke-width="2" /><line x1="2" y1="0" x2="2" y2="7" stroke="#000" stroke-width="1.4" /></pattern></defs>
      {fills.map(([colour, path]) => <path key={colour} d={path} fill={colour} class={large ? 'cell' : ''} shape-rendering="crispEdges" />)}
      {hatched && <path d={hatched} fill="url(#hatch)" />}
      {cut && <path d={cut} stroke="#000" stroke-width="1.5" />}
      {words.map(({x, y, text, ink, rim}) => <text key={`${x},${y}`} x={x} y={y} text-anchor="middle" fill={ink}
        class={`${ink ? '' : 'ink'} ${rim ? `halo ${ink === '#000000' ? 'bright' : 'dark'}` : ''}`}>{text}</text>)}
    </>
  );
}

function Ticks({x, y, place: {left, width, height, columns, rows}}: {x: Axis; y: Axis; place: MapPlace}) {
  const bottom = height * rows;
  const every = [sparse(columns, width * columns / TICK_PX), sparse(rows, bottom / 16)] as const;
  return (
    <>
      {x.values.map((v, i) => i % every[0] === 0 && <text key={`x${i}`} class="ink" x={left + (i + 0.5) * width} y={bottom + 18} text-anchor="middle">{short(v)}</text>)}
      {y.values.map((v, j) => j % every[1] === 0 && <text key={`y${j}`} class="ink" x={left - 8} y={(j + 0.5) * height + 4} text-anchor="end">{short(v)}</text>)}
      <text class="ink name" x={left + width * columns / 2} y={bottom + 42} text-anchor="middle">{x.name}</text>
      <text class="ink name" transform={`translate(14 ${bottom / 2}) rotate(-90)`} text-anchor="middle">{y.name}</text>
    </>
  );
}

/** The keys of cells without a known number, if there are any. */
function UnknownKeys(counts: ReturnType<typeof countUnknown>) {
  const swatch = (colour: string, bar: boolean) => (
    <svg width="14" height="12" aria-hidden="true"><rect width="14" height="12" fill={colour} />{bar && <path d="M7 0v12" stroke="#000" stroke-width="1.5" />}</svg>);
  return (
    <>
      {counts.CUT > 0 && <> · {swatch(GREYS.CUT, true)} CUT by the end</>}
      {counts['no contact'] > 0 && <> · {swatch(GREYS['no contact'], false)} no contact</>}
    </>
  );
}

export function HeatMap(props: Props) {
  const {x, y, cells, indexAt, metric, log, chosen, choose, open, metricName} = props;
  const drawn = useRef<SVGSVGElement>(null);
  const [pointed, setPointed] = useState<[number, number]>();
  const [box, width] = useWidth(900);
  const place = placeOf(props, width);
  const view = [props.version, metric, log, props.contours, x.name, y.name, indexAt(0, 0), width];
  const {range, part} = useMemo(() => scaleOf(props), view);
  const unknown = useMemo(() => countUnknown(cells.values(), metric), view);
  const lines = useMemo(() => (props.contours ? contourShapes(props, place, range) : undefined), view);
  const shapes = useMemo(() => mapShapes(place, (i, j) => cells.get(indexAt(i, j)), metric, part, !lines?.contours.length), view);
  const ticks = useMemo(() => <Ticks x={x} y={y} place={place} />, [x.name, y.name, place.columns, place.rows, width]);
  const drawing = useMemo(() => <><Cells shapes={shapes} large={place.width > 12 && place.height > 8} />{lines && <Contours {...lines} />}</>, [shapes]);
  const marked = placeOfCell(props, chosen);
  const shown = pointed ?? marked;
  const under = (event: MouseEvent) => cellAt(place, ...pointIn(drawn.current!, event));
  const click = (event: MouseEvent) => {
    const at = under(event);
    if (!at) return;
    const index = indexAt(...at);
    if (index === chosen) open(index); else choose(index);
  };
  const corner = marked && cornerOf(place, ...marked);
  return (
    <figure class="plot" data-plot="map" data-filled={cells.size}>
      <figcaption><h3>{metricName} over {y.name} and {x.name}</h3>
        <ExportButtons title={`map of ${metricName}`} name={`${props.source}-map`} csv={() => csvOf(props)}
          svg={() => drawingOf(drawn.current!, `${metricName}, from ${exact(range[0])} (dark) to ${exact(range[1])} (bright)`, props.source)} /></figcaption>
      <div ref={box} class="keys" tabIndex={0} role="application" onKeyDown={keysOf(props)}
        aria-label={`Map of ${metricName} over ${y.name} and ${x.name}; arrow keys choose a cell, Enter runs it`}>
        <svg ref={drawn} class="map" viewBox={`0 0 ${width} ${place.height * place.rows + BOTTOM}`} onClick={click}
          onPointerMove={(e) => setPointed(under(e))} onPointerLeave={() => setPointed(undefined)}>
          {drawing}{ticks}
          {corner && ['chosen rim', 'chosen'].map((name) => <rect key={name} x={corner[0] + 1} y={corner[1] + 1} width={Math.max(place.width - 2, 2)} height={Math.max(place.height - 2, 2)} class={name} />)}
        </svg>
      </div>
      <p class="pointed soft mono">{shown ? wordsOf(props, shown) : '\u00a0'}</p>
      <p class="scale soft"><span class="mono">{short(range[0], 6)}</span>
        <svg width="180" height="12" aria-hidden="true">{Array.from({length: 60}, (_, i) => <rect key={i} x={i * 3} y="0" width="3" height="12" fill={viridis(i / 59)} />)}</svg>
        <span class="mono">{short(range[1], 6)}</span> hatched: not converged · ×: failed · –: no value<UnknownKeys {...unknown} /></p>
    </figure>
  );
}
