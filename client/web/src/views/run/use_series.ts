// Recorded columns for a plot: asked for again when the window changes or the run goes on.

import {useEffect, useRef, useState} from 'preact/hooks';

import {readSeries, type Series} from '../../api/series';
import type {Window} from '../../plots/range';

const POINTS_PER_CHANNEL = 1000;
const MOST_POINTS = 4000;

/** The columns; the last ones stay until the next are there. `tick` grows as the run goes on. */
export function useSeries(name: string, channels: string[], window: Window | undefined, tick: number): Series | undefined {
  const [series, setSeries] = useState<Series>();
  const state = useRef({busy: false, again: false, alive: true, asked: ''});
  const latest = useRef<() => void>(() => undefined);
  const key = `${name} ${channels.join(' ')} ${window?.[0]} ${window?.[1]} ${tick}`;
  useEffect(() => { state.current.alive = true; return () => { state.current.alive = false; }; }, []);
  latest.current = () => {
    const now = state.current;
    if (channels.length === 0) return;
    if (now.busy) { now.again = true; return; }
    now.busy = true;
    const started = performance.now();
    readSeries({name, channels, from: window?.[0], to: window?.[1],
      maxPoints: Math.min(MOST_POINTS, POINTS_PER_CHANNEL * channels.length)})
      .then((read) => {
        if (now.alive) setSeries(read);
        performance.measure('series', {start: started, end: performance.now()});
      }, () => undefined)
      .finally(() => {
        now.busy = false;
        if (now.again && now.alive) { now.again = false; latest.current(); }
      });
  };
  useEffect(() => latest.current(), [key]);
  return series;
}
