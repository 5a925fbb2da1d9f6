// The bodies in motion: play, pause, speed, scrub.

import {useEffect, useLayoutEffect, useMemo, useRef, useState} from 'preact/hooks';

import type {Series} from '../../api/series';
import type {Mechanics} from '../../model/mechanics';
import {short} from '../../model/numbers';
import type {Window} from '../../plots/range';
import {firstBodies, MOST_BODIES, stageOf} from '../../model/stage';
import {drawStrip, sheetOf} from '../../plots/strip';
import {onPlayhead, playhead, setPlayhead} from '../../ui/playhead';
import {LeftOut} from '../../ui/left_out';
import {setQuery} from '../../ui/route';
import {useTheme} from '../../ui/theme';

const SECONDS = [2, 5, 10, 30, 60];   // In which the whole stretch is played.

interface Props {
  mechanics: Mechanics;
  series: Series | undefined;
  query: URLSearchParams;
}

/** Columns that the strip needs. */
export function stripChannels({bodies, contacts}: Mechanics): string[] {
  return [...bodies.slice(0, MOST_BODIES).map(({name}) => `${name}.position`),
    ...contacts.slice(0, MOST_BODIES).map(({name}) => `${name}.contact_force`)];
}

/** Moves the playhead through a stretch while `playing`. */
function usePlayer([from, to]: Window, seconds: number, playing: boolean, stop: () => void): void {
  useEffect(() => {
    if (!playing) return undefined;
    let last = performance.now();
    const start = playhead();
    if (start === undefined || start < from || start >= to) setPlayhead(from);
    let frame = requestAnimationFrame(function step(now) {
      const next = (playhead() ?? from) + (to - from) * (now - last) / 1000 / seconds;
      last = now;
      setPlayhead(Math.min(next, to));
      if (next >= to) stop();
      else frame = requestAnimationFrame(step);
    });
    return () => cancelAnimationFrame(frame);
  }, [playing, from, to, seconds]);
}

export function StripView({mechanics, series, query}: Props) {
  const theme = useTheme();
  const canvas = useRef<HTMLCanvasElement>(null);
  const slider = useRef<HTMLInputElement>(null);
  const moment = useRef<HTMLOutputElement>(null);
  const [playing, setPlaying] = useState(false);
  const [width, setWidth] = useState(0);
  const seconds = Number(query.get('play') ?? 5) || 5;
  const magnified = query.get('scale') !== 'true';
  const part = useMemo(() => firstBodies(mechanics), [mechanics]);
  const times = series?.get('time')?.values;
  const range: Window = useMemo(() => [times?.[0] ?? 0, times?.at(-1) ?? 1], [times]);
  const stage = useMemo(() => (series ? stageOf(part, series, magnified) : undefined), [series, part, magnified]);
  const pause = () => { setPlaying(false); setQuery({t: short(playhead() ?? 0, 9)}); };
  usePlayer(range, seconds, playing, pause);

  useLayoutEffect(() => {
    const observer = new ResizeObserver(() => setWidth(canvas.current?.clientWidth ?? 0));
    observer.observe(canvas.current!);
    return () => observer.disconnect();
  }, []);
  useEffect(() => {
    const given = query.get('t');
    if (given && playhead() === undefined) setPlayhead(Number(given));
    if (!stage || width === 0) return undefined;
    const sheet = sheetOf(canvas.current!, width, theme);
    const show = (time = range[0]) => {
      const shown = Math.min(Math.max(time, range[0]), range[1]);
      drawStrip(stage, sheet, shown);
      slider.current!.value = String((shown - range[0]) / (range[1] - range[0]) || 0);
      const words = `${short(shown * 1000, 7)} ms`;
      moment.current!.textContent = words;
      slider.current!.setAttribute('aria-valuetext', words);
    };
    show(playhead());
    return onPlayhead(show);
  }, [stage, width, theme]);

  return (
    <section aria-label="Bodies in motion" class="strip">
      <canvas ref={canvas} role="img" aria-label={`${part.bodies.length} bodies on their line, with contact forces as arrows`} />
      <div class="tools">
        <button type="button" aria-pressed={playing} onClick={() => (playing ? pause() : setPlaying(true))}>{playing ? '❚❚ Pause' : '▶ Play'}</button>
        <input ref={slider} class="scrub" type="range" min="0" max="1" step="0.0005" aria-label="moment"
          onInput={(e) => { setPlaying(false); setPlayhead(range[0] + Number(e.currentTarget.value) * (range[1] - range[0])); }}
          onChange={pause} />
        <output ref={moment} class="mono" />
        <label>all in <select value={seconds} onChange={(e) => setQuery({play: e.currentTarget.value})}>
          {SECONDS.map((s) => <option key={s} value={s}>{s} s</option>)}</select></label>
        <label><input type="checkbox" checked={!magnified} onChange={(e) => setQuery({scale: e.currentTarget.checked ? 'true' : undefined})} /> to scale</label>
        <LeftOut shown={part.bodies.length} all={mechanics.bodies.length} what="bodies" />
        {stage && stage.magnification > 1 && <span class="soft">displacements × {stage.magnification}</span>}
      </div>
    </section>
  );
}
