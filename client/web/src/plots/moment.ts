// The moment of the strip in a plot: a line that moves with it, and its values once it rests.

import {useEffect, useMemo, useRef} from 'preact/hooks';
import type uPlot from 'uplot';

import {short} from '../model/numbers';
import type {Panel} from '../model/panel';
import {unitOf, type AxisUnit} from '../model/units';
import {onPlayhead, playhead} from '../ui/playhead';
import {unitOfScale} from './axes';
import {lines} from './build';

const REST_MS = 200;
const DIGITS = 6;   // Of a value: more than the eye finds in a plot. Its CSV has all.

interface Drawn {
  current: uPlot | undefined;
}

const timed = ({overTime, countedX}: Panel) => overTime && !countedX;

/** The place of the sample closest to a time; null if it is not recorded. */
function placeOf(plot: uPlot | undefined, time: number | undefined): number | null {
  const times = plot?.data[0];
  if (!times || time === undefined || !(time >= times[0]! && time <= times[times.length - 1]!)) return null;
  return plot!.valToIdx(time);
}

/** The value of a curve in the unit of the axis. */
function valueAt(plot: uPlot, curve: number, place: number | null, {factor}: AxisUnit): string {
  const value = place === null ? undefined : plot.data[curve + 1]?.[place];
  return value === undefined || value === null ? '' : short(value / factor, DIGITS);
}

/** The values of a moment in a line, for those who do not see the key. */
function sentence(plot: uPlot, panel: Panel, place: number | null): string {
  const unit = unitOfScale(plot, 'y', panel.yLabel);
  const values = lines(panel).flatMap(({label}, i) => { const text = valueAt(plot, i, place, unit); return text ? [`${label} ${text}`] : []; });
  return values.length > 0 ? `${panel.title}, ${unit.label}, at ${short(plot.data[0][place!]!, 9)} s: ${values.join('; ')}` : '';
}

/** Where the values of the curves stand: in the key, at the pointer or else at the moment; and the moment's in words. */
export class Reading {
  values: (HTMLElement | null)[] = [];
  unit: HTMLElement | null = null;
  words: HTMLElement | null = null;
  #pointer: number | null = null;
  #time: number | undefined;

  constructor(private readonly plot: Drawn, public panel: Panel) {}

  /** The pointer is at a sample, or nowhere. */
  point(place: number | null): void {
    this.#pointer = place;
    this.#show();
  }

  /** The moment has come to rest at a time. */
  rest(time: number | undefined): void {
    this.#time = time;
    this.drawn();
  }

  /** The plot has been drawn, perhaps of other values, or of another part of them. */
  drawn(): void {
    if (timed(this.panel)) moveLine(this.plot, playhead());
    this.#show();
    const plot = this.plot.current;
    if (!plot || !this.words) return;
    const now = sentence(plot, this.panel, placeOf(plot, this.#time));
    if (this.words.textContent !== now) this.words.textContent = now;
  }

  #show(): void {
    const plot = this.plot.current;
    if (!plot) return;
    const place = this.#pointer ?? placeOf(plot, this.#time);
    const unit = unitOfScale(plot, 'y', this.panel.yLabel);
    this.values.forEach((at, i) => { if (at) at.textContent = ` ${valueAt(plot, i, place, unit)}`.trimEnd(); });
    if (this.unit) this.unit.textContent = unitOf(unit.label).replace(/^1$/, '');
  }
}

function moveLine({current: plot}: Drawn, time: number | undefined): void {
  if (!plot) return;
  const {over} = plot;
  let mark = over.querySelector<HTMLElement>('.playhead');
  if (!mark) over.append(mark = Object.assign(document.createElement('div'), {className: 'playhead'}));
  const left = time === undefined ? -1 : plot.valToPos(time, 'x');
  mark.hidden = !(left >= 0 && left <= over.clientWidth);
  if (!mark.hidden) mark.style.transform = `translateX(${left}px)`;
}

/** Follows the moment; gives what tells the values of the plot. */
export function useReading(plot: Drawn, panel: Panel): Reading {
  const reading = useMemo(() => new Reading(plot, panel), []);
  reading.panel = panel;
  const timer = useRef(0);
  useEffect(() => {
    if (!timed(panel)) return undefined;
    const place = (time: number | undefined) => {
      moveLine(plot, time);
      clearTimeout(timer.current);
      timer.current = window.setTimeout(() => reading.rest(time), REST_MS);
    };
    place(playhead());
    return onPlayhead(place);
  });
  useEffect(() => () => clearTimeout(timer.current), []);
  return reading;
}
