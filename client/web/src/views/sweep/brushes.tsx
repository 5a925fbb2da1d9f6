// Ranges along the axes of parallel coordinates, by dragging and by keys.

import {useRef, useState} from 'preact/hooks';

import {brushesIn, entriesOf, moved, rounded, stopsOf, withRange, type Brushes, type Range} from '../../model/brush';
import {count, short} from '../../model/numbers';
import {pointIn} from '../../plots/drawing';
import {setQuery, useParameter} from '../../ui/route';

/** Where the axes stand. */
export interface Frame {
  names: string[];
  xs: number[];
  /** What each axis shows from its lower end to its upper end. */
  ranges: Range[];
  top: number;
  height: number;
}

const NEAR_PX = 14;   // Of an axis.
const STILL_PX = 3;   // A press that moves less is a click.
const GRIP_PX = 9;
const FOCUSABLE = {tabindex: 0};   // SVG knows it in small letters only.
const LEAPS: Record<string, number> = {ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1, PageUp: 5, PageDown: -5};

interface Drag {
  place: number;
  from: number;
  /** The range that is moved; undefined: one is drawn. */
  held: Range | undefined;
  /** The ranges as it leaves them; undefined while it may be a click. */
  next: Brushes | undefined;
}

function heightOf({top, height}: Frame, value: number, [low, high]: Range): number {
  return top + height * (1 - (Math.min(Math.max(value, low), high) - low) / (high - low));
}

function valueAt({top, height}: Frame, y: number, [low, high]: Range): number {
  const part = Math.min(Math.max(1 - (y - top) / height, 0), 1);
  return rounded(low + part * (high - low), [low, high]);
}

/** The range of a drag that is at a height. */
function rangeOf(frame: Frame, {place, from, held}: Drag, y: number): Range {
  const whole = frame.ranges[place]!;
  if (!held) return [valueAt(frame, Math.max(from, y), whole), valueAt(frame, Math.min(from, y), whole)];
  const [low, high] = held.map((value) => heightOf(frame, value, whole)) as Range;
  const by = Math.min(Math.max(y - from, frame.top - high), frame.top + frame.height - low);
  return [valueAt(frame, low + by, whole), valueAt(frame, high + by, whole)];
}

/** The ranges of the address and those that are being drawn, and what the drawing does with a pointer. */
export function useBrushes(frame: Frame) {
  const entries = useParameter('brush');
  const [draft, setDraft] = useState<Brushes>();
  const drag = useRef<Drag>();
  const brushes = draft ?? brushesIn(entries, frame.names.length);
  const set = (next: Brushes) => { setDraft(undefined); setQuery({brush: entriesOf(next)}); };
  const axisAt = (x: number, y: number) => (y < frame.top - GRIP_PX || y > frame.top + frame.height + GRIP_PX ? -1
    : frame.xs.findIndex((at, i) => Math.abs(at - x) <= NEAR_PX && frame.ranges[i]![0] < frame.ranges[i]![1]));
  const pointer = {
    onPointerDown: (event: PointerEvent & {currentTarget: SVGSVGElement}) => {
      const [x, y] = pointIn(event.currentTarget, event);
      const place = event.button === 0 ? axisAt(x, y) : -1;
      drag.current = undefined;
      if (place < 0) return;
      const old = brushes.get(place);
      const held = old && y > heightOf(frame, old[1], frame.ranges[place]!) && y < heightOf(frame, old[0], frame.ranges[place]!) ? old : undefined;
      drag.current = {place, from: y, held, next: undefined};
      event.currentTarget.setPointerCapture(event.pointerId);
    },
    onPointerMove: (event: PointerEvent & {currentTarget: SVGSVGElement}) => {
      const now = drag.current;
      if (!now || !event.currentTarget.hasPointerCapture(event.pointerId)) return;
      const [, y] = pointIn(event.currentTarget, event);
      if (!now.next && Math.abs(y - now.from) <= STILL_PX) return;
      now.next = withRange(brushes, now.place, rangeOf(frame, now, y), frame.ranges[now.place]!);
      setDraft(now.next);
    },
    onPointerUp: () => { if (drag.current?.next) set(drag.current.next); },
    onPointerCancel: () => { drag.current = undefined; setDraft(undefined); },
  };
  /** True for a click that ends a drag, or takes a range away: it chooses no line. */
  const taken = () => {
    const now = drag.current;
    drag.current = undefined;
    if (now && !now.next && now.held) set(withRange(brushes, now.place, undefined, frame.ranges[now.place]!));
    return !!now && (!!now.next || !!now.held);
  };
  return {brushes, set, clear: () => set(new Map()), pointer, taken};
}

interface Props {
  frame: Frame;
  brushes: Brushes;
  set: (brushes: Brushes) => void;
  /** The values of all cells at an axis. */
  valuesOf: (place: number) => number[];
}

function Axis({frame, brushes, set, valuesOf, place}: Props & {place: number}) {
  const whole = frame.ranges[place]!;
  if (!(whole[0] < whole[1])) return null;
  const [x, name] = [frame.xs[place]!, frame.names[place]!];
  const range = brushes.get(place) ?? whole;
  const [bottom, top] = range.map((value) => heightOf(frame, value, whole)) as Range;
  const press = (end: 0 | 1) => (event: KeyboardEvent) => {
    const leap = event.key === 'Home' ? -Infinity : event.key === 'End' ? Infinity : LEAPS[event.key];
    if (!leap) return;
    event.preventDefault();
    event.stopPropagation();   // Arrows choose a cell elsewhere.
    const now = brushesIn(new URLSearchParams(location.search).getAll('brush'), frame.names.length);   // Keys may come faster than the page is drawn.
    const old = now.get(place) ?? whole;
    const next = Number.isFinite(leap) ? moved(old, end, leap, stopsOf(valuesOf(place))) : moved(old, end, leap > 0 ? 1 : -1, whole);
    set(withRange(now, place, next, whole));
  };
  return (
    <g class="brush" data-brush={brushes.has(place) ? range.join(':') : undefined}>
      <rect class="grip" x={x - NEAR_PX} y={frame.top - GRIP_PX} width={2 * NEAR_PX} height={frame.height + 2 * GRIP_PX} />
      {brushes.has(place) && <rect class="range" x={x - GRIP_PX} y={top} width={2 * GRIP_PX} height={Math.max(bottom - top, 1)} />}
      {([0, 1] as const).map((end) => (
        <path key={end} class="end" d={`M${x - GRIP_PX} ${end ? top : bottom}h${2 * GRIP_PX}l${-GRIP_PX} ${end ? -7 : 7}z`} {...FOCUSABLE} role="slider" aria-orientation="vertical"
          aria-label={`${end ? 'upper' : 'lower'} end of ${name}`} aria-valuemin={whole[0]} aria-valuemax={whole[1]} aria-valuenow={range[end]} aria-valuetext={short(range[end], 6)} onKeyDown={press(end)} />))}
    </g>
  );
}

export function BrushLayer(props: Props) {
  return <>{props.frame.names.map((name, place) => <Axis key={name} {...props} place={place} />)}</>;
}

/** How many cells the ranges choose. */
export function Chosen({brushes, inside, all, clear}: {brushes: Brushes; inside: number; all: number; clear: () => void}) {
  return (
    <p class="tools"><span role="status">{brushes.size > 0 ? `${count(inside)} of ${count(all)} cells chosen` : ''}</span>
      {brushes.size > 0 ? <button type="button" onClick={clear} title="key Escape">Choose all again</button>
        : <span class="soft hint">drag along an axis to choose a range; Tab and arrow keys move its ends</span>}</p>
  );
}
