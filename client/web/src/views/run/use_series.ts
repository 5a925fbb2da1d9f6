// The recorded columns of all plots of a run, in one call: the server reads the same part of its log
// whatever the number of columns. Asked for again when the window changes or the run goes on.

import {useEffect, useLayoutEffect, useMemo, useRef, useState} from 'preact/hooks';

import {passes} from '../../api/errors';
import {readSeries, type Series} from '../../api/series';
import {Turns, type Rest} from '../../api/turns';
import {insideOf} from '../../model/panel';
import {Recent} from '../../model/recent';
import type {Window} from '../../plots/range';

const POINTS = 4000;
const POINTS_PER_CHANNEL = 500;
const MOST_BYTES = 3.5e6;        // The server answers with 4 MB at most.
const LIVE_PAUSE_MS = 400;       // Between two calls while a run goes on.
const RETRY_MS = 1000;           // After a call that failed.
const LATE_MS = 150;             // After which plots do not wait for their values.
const ENOUGH = 1000;             // Samples in a window with which they do not wait at all.
const KEPT = 16;                 // Windows of a run that is over whose columns are kept: 0.3 MB each.

/** Samples to ask for, so that each column has enough and the answer is not too large. */
export function pointsFor(channels: number): number {
  const wanted = Math.max(POINTS, POINTS_PER_CHANNEL * channels);
  return Math.floor(Math.min(wanted, MOST_BYTES / (8 * (channels + 1))));
}

/** Notes how long it took from `start` to the frame that shows what the plots are about to draw. */
function measure(name: 'window' | 'series', start: number): void {
  setTimeout(() => requestAnimationFrame(() => setTimeout(() => performance.measure(name, {start, end: performance.now()}))));
}

/** What the plots of a run show. */
export interface Shown {
  series?: Series | undefined;
  window: Window | undefined;
  /** Which part of which columns. */
  view: string;
}

/** True if a window can be drawn of the columns of another one until its own are there. */
function servesFor({series}: Shown, window: Window | undefined): boolean {
  const times = series?.get('time')?.values;
  return !!times && !!window && insideOf(times, window) >= ENOUGH;
}

/** Moves on to a window without its columns: at once if those that are there serve for it, else when its own are late. */
function useMove(shown: Shown, setShown: (next: (now: Shown) => Shown) => void, {window, view}: Shown): void {
  useEffect(() => {
    const start = performance.now();
    const late = setTimeout(() => {
      setShown((now) => (now.view === view ? now : {...now, window, view}));
      measure('window', start);
    }, servesFor(shown, window) ? 0 : LATE_MS);
    return () => clearTimeout(late);
  }, [view]);
}

/**
 * The columns and their window. Those of before stay until the next are there. `tick` grows as the run goes on, and is
 * below 0 if it does not.
 */
export function useSeries(name: string, channels: string[], window: Window | undefined, tick: number): Shown {
  const view = `${name} ${channels.join(' ')} ${window?.[0]} ${window?.[1]}`;
  const [shown, setShown] = useState<Shown>({window, view});
  const asked = useRef({view: '', start: 0});
  const kept = useMemo(() => new Recent<Series>(KEPT), []);
  const own = useRef('');   // The view whose own columns are shown.
  const newest = useRef(view);
  newest.current = view;
  const call = useRef<() => Promise<Rest>>();
  call.current = async () => {
    const start = performance.now();
    asked.current.view = view;
    try {
      const series = await readSeries({name, channels, from: window?.[0], to: window?.[1], maxPoints: pointsFor(channels.length)});
      if (tick < 0) kept.put(view, series);
      if (view !== newest.current && own.current === newest.current) return {pauseMs: 0};   // A kept window is shown by now.
      asked.current.start = start;
      own.current = view;
      setShown((now) => (now.view === newest.current ? {...now, series} : {series, window, view}));   // Never back to a window.
      return {pauseMs: tick < 0 ? 0 : LIVE_PAUSE_MS};
    } catch (error) {
      return {pauseMs: RETRY_MS, again: passes(error)};
    }
  };
  const turns = useMemo(() => new Turns(() => call.current!()), []);
  useEffect(() => () => turns.end(), []);
  useLayoutEffect(() => { if (shown.series) measure('series', asked.current.start); }, [shown.series]);
  useLayoutEffect(() => {
    if (channels.length === 0) return;
    const known = tick < 0 ? kept.get(view) : undefined;
    if (known) {
      asked.current = {view, start: performance.now()};
      own.current = view;
      setShown({series: known, window, view});
    } else if (tick >= 0 && asked.current.view === view) turns.later();
    else turns.now();
  }, [view, tick]);
  useMove(shown, setShown, {window, view});
  return shown;
}
