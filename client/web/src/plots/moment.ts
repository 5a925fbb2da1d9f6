// The moment of the strip in a plot: a line that moves with it, and its values once it rests.

import {useEffect, useMemo, useRef} from 'preact/hooks';
import type uPlot from 'uplot';

import {exact, short} from '../model/numbers';
import type {Panel} from '../model/panel';
import {onPlayhead, playhead} from '../ui/playhead';
import {lines} from './build';

const REST_MS = 200;

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

function valueAt(plot: uPlot | undefined, curve: number, place: number | null): string {
  const value = place === null ? undefined : plot?.data[curve + 1]?.[place];
  return value === undefined || value === null ? '' : exact(value);
}

/** The values of a moment in a line, for those who do not see the key. */
function sentence(plot: uPlot, panel: Panel, place: number | null): string {
  const values = lines(panel).flatMap(({label}, i) => (valueAt(plot, i, place) ? [`${label} ${valueAt(plot, i, place)}`] : []));
  return values.length > 0 ? `${panel.title}, ${panel.yLabel}, at ${short(plot.data[0][place!]!, 9)} s: ${values.join('; ')}` : '';
}

/** Where the values of the curves stand: in the key, at the pointer or else at the moment; and the moment's in words. */
export class Reading {
  values: (HTMLElement | null)[] = [];
  words: HTMLElement | null = null;
  #pointer: number | null = null;
  #time: number | undefined;

  constructor(private readonly plot: Drawn) {}

  /** The pointer is at a sample, or nowhere. */
  point(place: number | null): void {
    this.#pointer = place;
    this.#show();
  }

  /** The moment has come to rest at a time. */
  rest(time: number | undefined, panel: Panel): void {
    this.#time = time;
    this.drawn(panel);
  }

  /** The plot has been drawn, perhaps of other values, or of another part of them. */
  drawn(panel: Panel): void {
    if (timed(panel)) moveLine(this.plot, playhead());
    this.#show();
    const plot = this.plot.current;
    if (!plot || !this.words) return;
    const now = sentence(plot, panel, placeOf(plot, this.#time));
    if (this.words.textContent !== now) this.words.textContent = now;
  }

  #show(): void {
    const plot = this.plot.current;
    const place = this.#pointer ?? placeOf(plot, this.#time);
    this.values.forEach((at, i) => { if (at) at.textContent = ` ${valueAt(plot, i, place)}`.trimEnd(); });
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
  const reading = useMemo(() => new Reading(plot), []);
  const timer = useRef(0);
  useEffect(() => {
    if (!timed(panel)) return undefined;
    const place = (time: number | undefined) => {
      moveLine(plot, time);
      clearTimeout(timer.current);
      timer.current = window.setTimeout(() => reading.rest(time, panel), REST_MS);
    };
    place(playhead());
    return onPlayhead(place);
  });
  useEffect(() => () => clearTimeout(timer.current), []);
  return reading;
}
