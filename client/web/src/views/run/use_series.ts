// The recorded columns of all plots of a run, in one call: the server reads the same part of its log
// whatever the number of columns. Asked for again when the window changes or the run goes on.

import {useEffect, useLayoutEffect, useRef, useState} from 'preact/hooks';

import {readSeries, type Series} from '../../api/series';
import type {Window} from '../../plots/range';

const POINTS = 4000;
const POINTS_PER_CHANNEL = 500;
const MOST_BYTES = 3.5e6;        // The server answers with 4 MB at most.
const LIVE_PAUSE_MS = 400;       // Between two calls while a run goes on.
const LATE_MS = 150;             // After which plots do not wait for their values.

/** Samples to ask for, so that each column has enough and the answer is not too large. */
export function pointsFor(channels: number): number {
  const wanted = Math.max(POINTS, POINTS_PER_CHANNEL * channels);
  return Math.floor(Math.min(wanted, MOST_BYTES / (8 * (channels + 1))));
}

/** Notes how long it took from `start` to the frame that shows what the plots are about to draw. */
function measure(start: number): void {
  setTimeout(() => requestAnimationFrame(() => setTimeout(() => performance.measure('series', {start, end: performance.now()}))));
}

/** What the plots of a run show. */
export interface Shown {
  series?: Series | undefined;
  window: Window | undefined;
  /** Which part of which columns. */
  view: string;
}

/**
 * The columns and their window. Those of before stay until the next are there, so that each plot is drawn once; if that
 * takes long, their window moves on without them. `tick` grows as the run goes on, and is below 0 if it does not.
 */
export function useSeries(name: string, channels: string[], window: Window | undefined, tick: number): Shown {
  const view = `${name} ${channels.join(' ')} ${window?.[0]} ${window?.[1]}`;
  const [shown, setShown] = useState<Shown>({window, view});
  const state = useRef({busy: false, again: false, alive: true, asked: '', start: 0});
  const ask = useRef<() => void>(() => undefined);
  useEffect(() => { state.current.alive = true; return () => { state.current.alive = false; }; }, []);
  ask.current = () => {
    const now = state.current;
    if (channels.length === 0 || !now.alive) return;
    if (now.busy) { now.again = true; return; }
    Object.assign(now, {busy: true, again: false, asked: view});
    const start = performance.now();
    readSeries({name, channels, from: window?.[0], to: window?.[1], maxPoints: pointsFor(channels.length)})
      .then((series) => {
        now.start = start;
        if (now.alive) setShown({series, window, view});
      }, () => undefined)
      .finally(() => {
        now.busy = false;
        if (now.again) setTimeout(() => ask.current(), tick < 0 ? 0 : LIVE_PAUSE_MS);
      });
  };
  useLayoutEffect(() => { if (shown.series) measure(state.current.start); }, [shown.series]);
  useLayoutEffect(() => {
    if (tick >= 0 && state.current.asked === view && state.current.busy) state.current.again = true;
    else ask.current();
  }, [view, tick]);
  useEffect(() => {
    const late = setTimeout(() => setShown((now) => (now.view === view ? now : {...now, window, view})), LATE_MS);
    return () => clearTimeout(late);
  }, [view]);
  return shown;
}
