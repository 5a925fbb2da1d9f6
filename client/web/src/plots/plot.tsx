// A panel with its key and its exports.

import {useEffect, useLayoutEffect, useMemo, useRef} from 'preact/hooks';
import type uPlot from 'uplot';

import {logarithmic, type Panel} from '../model/panel';
import {useHidden} from '../ui/hidden';
import {setQuery, useParameter} from '../ui/route';
import {useTheme} from '../ui/theme';
import type {Ink} from './axes';
import {aligned, buildPlot, lines, type Shown} from './build';
import {Exports} from './exports';
import {Key} from './key';
import {LANE_PX} from './layers';
import {useReading} from './moment';
import type {Window} from './range';

interface Props {
  panel: Panel;
  window?: Window | undefined;
  onZoom?: (window: Window | undefined) => void;
  height?: number;
  /** Where the values come from, for exported files. */
  source: string;
  /** What to show where there are no points. */
  empty?: string;
  choosing?: Choosing;
}

/** How points are chosen by mouse and keys, where they stand for something. */
interface Choosing {
  label: string;
  press: (event: KeyboardEvent) => void;
  pick: (place: number) => void;
}

function inkOf(element: Element): Ink {
  const style = getComputedStyle(element);
  const ink = (name: string) => style.getPropertyValue(`--${name}`).trim();
  return {text: ink('text'), soft: ink('soft'), grid: ink('grid'), band: ink('band'), paper: ink('paper'), warn: ink('warn')};
}

/** What makes another plot necessary, rather than other data. */
function structure(panel: Panel): string {
  return JSON.stringify([panel.logX, panel.logY, panel.overTime, panel.countedX, panel.lanes?.length, !!panel.raster, panel.raster?.lines,
    lines(panel).map(({mark, colour}) => [mark, colour])]);
}

const UNSEEN_MS = 600;

/**
 * Calls `draw` soon where the plot can be seen, after what else is to be done for the same event, such as asking the
 * server; elsewhere when it is seen, or when nothing new has come for a while.
 */
function useSeen(box: {current: HTMLDivElement | null}): {draw: (draw: () => void) => void; flush: () => void} {
  const state = useRef({seen: true, timer: 0, waiting: undefined as (() => void) | undefined});
  const flush = () => {
    clearTimeout(state.current.timer);
    state.current.waiting?.();
    state.current.waiting = undefined;
  };
  useEffect(() => {
    const observer = new IntersectionObserver((entries) => {
      state.current.seen = entries.at(-1)!.isIntersecting;
      if (state.current.seen) flush();
    });
    observer.observe(box.current!);
    return () => { observer.disconnect(); clearTimeout(state.current.timer); };
  }, []);
  const draw = (drawing: () => void) => {
    clearTimeout(state.current.timer);
    state.current.waiting = drawing;
    state.current.timer = window.setTimeout(flush, state.current.seen ? 0 : UNSEEN_MS);
  };
  return {flush, draw};
}

/** What a plot shows, for those who do not see it. */
function namesOf({title, xLabel, yLabel, curves, raster, stamp}: Panel): string {
  return `${title}: ${raster?.label ?? yLabel} over ${xLabel}; ${raster ? `${raster.rows.length} rows as ${raster.lines ? 'lines' : 'colours'}, one a ${yLabel}` : ''}${curves.filter((c) => c.keyed !== false).map((c) => c.label).join(', ')}${stamp ? `; ${stamp}` : ''}`;
}

/** The attributes of a plot whose points are chosen. */
function choosable({label, press, pick}: Choosing, plot: {current: uPlot | undefined}) {
  const click = () => { if (typeof plot.current?.cursor.idx === 'number') pick(plot.current.cursor.idx); };
  return {role: 'application' as const, tabIndex: 0, 'aria-label': label, onKeyDown: press, onClick: click};
}

export function Plot({panel: given, window: span, onZoom, height = 240, source, empty, choosing}: Props) {
  const logs = useParameter('logs');
  const log = logs.includes(given.id);
  const panel = useMemo(() => (log ? logarithmic(given) : given), [given, log]);
  const theme = useTheme();
  const box = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot>();
  const shown = useRef<Shown>();
  const [hidden, setHidden] = useHidden(panel.id);
  const key = structure(panel);
  const whole = height + LANE_PX * (panel.lanes?.length ?? 0);   // Bars take nothing of the curves.
  const seen = useSeen(box);
  const reading = useReading(plot, panel);

  useLayoutEffect(() => {
    const ink = inkOf(box.current!);
    shown.current = {panel, window: span, hidden, theme, ink, onZoom: onZoom ?? (() => undefined), onCursor: (place) => reading.point(place),
      onDrawn: () => reading.drawn()};
    plot.current = buildPlot(shown.current, box.current!.clientWidth || 400, whole, box.current!);
    const observer = new ResizeObserver(() => {
      const width = box.current?.clientWidth;
      if (width && plot.current && width !== plot.current.width) plot.current.setSize({width, height: whole});
    });
    observer.observe(box.current!);
    return () => { observer.disconnect(); plot.current?.destroy(); plot.current = undefined; };
  }, [key, theme, whole]);

  useLayoutEffect(() => {
    if (!plot.current || !shown.current) return;
    Object.assign(shown.current, {panel, window: span, hidden, onZoom: onZoom ?? (() => undefined)});
    seen.draw(() => {
      plot.current?.batch((u: uPlot) => {   // Drawn when this returns: a file may be made of it at once.
        lines(panel).forEach(({label}, i) => {
          const visible = !hidden.has(label);
          if (u.series[i + 1]!.show !== visible) u.setSeries(i + 1, {show: visible});
        });
        u.setData(aligned(panel));
      });
    });
  }, [panel, span?.[0], span?.[1], hidden]);

  const points = (panel.raster?.time.length ?? 0) > 0 || panel.curves.some(({x, mark}) => x.length > 0 && mark !== 'start' && mark !== 'end');
  return (
    <figure class="plot" data-plot={panel.id} data-points={panel.raster?.time.length ?? lines(panel)[0]?.x.length ?? 0}>
      <figcaption>
        <h3>{panel.title}</h3>
        {panel.overTime && !panel.raster && (log || !panel.logY) && <button type="button" class="log" aria-pressed={log} aria-label={`${panel.title}, log scale`}
          onClick={() => setQuery({logs: log ? logs.filter((id) => id !== given.id) : [...logs, given.id]})}>log</button>}
        <Exports panel={panel} hidden={hidden} plot={plot} source={source} flush={seen.flush} />
      </figcaption>
      <div ref={box} class={choosing ? 'canvas keys' : 'canvas'} {...(choosing ? choosable(choosing, plot) : {role: 'img', 'aria-label': namesOf(panel)})} />
      {!points && <p class="nothing">{panel.nothing ?? empty ?? 'Nothing to show yet.'}</p>}
      <Key panel={panel} hidden={hidden} setHidden={setHidden} reading={reading} />
      <output class="hidden" ref={(at) => { reading.words = at; }} />
      {panel.note && <p class="note">{panel.note}</p>}
    </figure>
  );
}
