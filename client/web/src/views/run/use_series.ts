// The recorded columns of all plots of a run, in one call: the server reads the same part of its log
// whatever the number of columns. Asked for again when the window changes or the run goes on.

import {useEffect, useRef, useState} from 'preact/hooks';

import {readSeries, type Series} from '../../api/series';
import type {Window} from '../../plots/range';

const POINTS = 4000;
const POINTS_PER_CHANNEL = 500;
const MOST_BYTES = 3.5e6;        // The server answers with 4 MB at most.
const LIVE_PAUSE_MS = 400;       // Between two calls while a run goes on.

/** Samples to ask for, so that each column has enough and the answer is not too large. */
export function pointsFor(channels: number): number {
  const wanted = Math.max(POINTS, POINTS_PER_CHANNEL * channels);
  return Math.floor(Math.min(wanted, MOST_BYTES / (8 * (channels + 1))));
}

/** The columns; the last ones stay until the next are there. `tick` grows as the run goes on. */
export function useSeries(name: string, channels: string[], window: Window | undefined, tick: number): Series | undefined {
  const [series, setSeries] = useState<Series>();
  const state = useRef({busy: false, again: false, alive: true, asked: ''});
  const told = useRef<number>();
  const ask = useRef<() => void>(() => undefined);
  const view = `${name} ${channels.join(' ')} ${window?.[0]} ${window?.[1]}`;
  useEffect(() => { state.current.alive = true; return () => { state.current.alive = false; }; }, []);
  ask.current = () => {
    const now = state.current;
    if (channels.length === 0 || !now.alive) return;
    if (now.busy) { now.again = true; return; }
    Object.assign(now, {busy: true, again: false, asked: view});
    const start = performance.now();
    readSeries({name, channels, from: window?.[0], to: window?.[1], maxPoints: pointsFor(channels.length)})
      .then((read) => {
        told.current = start;
        if (now.alive) setSeries(read);
      }, () => undefined)
      .finally(() => {
        now.busy = false;
        if (now.again) setTimeout(() => ask.current(), LIVE_PAUSE_MS);
      });
  };
  useEffect(() => {   // From the call to the frame that shows its answer.
    const start = told.current;
    told.current = undefined;
    if (start !== undefined) requestAnimationFrame(() => setTimeout(() => performance.measure('series', {start, end: performance.now()})));
  }, [series]);
  useEffect(() => {
    if (tick >= 0 && state.current.asked === view && state.current.busy) state.current.again = true;
    else ask.current();
  }, [view, tick]);
  return series;
}
